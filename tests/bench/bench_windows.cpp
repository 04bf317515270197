// What averaging over each window costs, beside each other in one run. Prints the table of
// docs/PERFORMANCE.md.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <vector>

#include "base/random.h"
#include "voxel/average.h"

namespace {

using namespace interstice;
using voxel::DenseShares;
using voxel::Lattice;

constexpr std::array kShapes{WindowShape::box, WindowShape::sphere, WindowShape::gaussian};

DenseShares random_shares(const Lattice& lattice) {
  DenseShares shares;
  shares.range = voxel::all_cells(lattice);
  shares.solid.resize(static_cast<std::size_t>(lattice.cells()));
  for (std::size_t c = 0; c < shares.solid.size(); ++c) shares.solid[c] = Random(1, c).uniform();
  return shares;
}

double seconds_of(const Lattice& lattice, const voxel::Window& window, DenseShares shares) {
  const auto begin = std::chrono::steady_clock::now();
  voxel::average(lattice, window, {shares.range}, shares);
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

/// Windows take turns, so that what else the machine does falls on all of them.
void measure(const char* name, const Lattice& lattice, double cells, int rounds) {
  const DenseShares shares = random_shares(lattice);
  std::array<std::vector<double>, kShapes.size()> times;
  for (int round = 0; round < rounds; ++round)
    for (std::size_t s = 0; s < kShapes.size(); ++s) {
      const auto window = voxel::averaging_window(lattice, kShapes[s], cells, {false, true, false});
      times[s].push_back(1e9 * seconds_of(lattice, window, shares) / static_cast<double>(lattice.cells()));
    }
  for (auto& each : times) std::sort(each.begin(), each.end());
  const std::size_t middle = times[0].size() / 2;
  std::string row = fmt::format("| {} | {:g} |", name, cells);
  for (const auto& each : times)
    row += fmt::format(" {:.1f} ({:.1f}–{:.1f}) |", each[middle], each[0], each.back());
  row += fmt::format(" 1 : {:.1f} : {:.1f} |", times[1][middle] / times[0][middle],
                     times[2][middle] / times[0][middle]);
  fmt::print("{}\n", row);
}

}  // namespace

int main(int argc, char** argv) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, 1);
  const int rounds = argc > 1 ? std::max(1, std::atoi(argv[1])) : 9;
  fmt::print("ns a voxel: median (least–most) of {} interleaved rounds, one thread\n\n", rounds);
  fmt::print(
      "| voxels | length in voxels | box | sphere | gaussian | ratio of medians "
      "|\n|---|---|---|---|---|---|\n");
  const Lattice layer{{0, 0, 0}, {1, 1, 1}, {1040, 87, 6}}, cube{{0, 0, 0}, {1, 1, 1}, {128, 128, 128}};
  measure("1040 × 87 × 6", layer, 6.94, rounds);
  for (const double cells : {5., 10., 20., 40.}) measure("128³", cube, cells, rounds);
}
