// What memory would allow: bytes that a step must move where no cache holds the bed, and how many
// particle-steps a second the measured bandwidth leaves room for.
//   bench_limits [PAIRS]     listed pairs a grain, as `interstice bench --json` gives them (2.6)
#include <fmt/format.h>

#include <cstdlib>

#include "base/large_pages.h"
#include "base/parallel.h"
#include "dem/contacts.h"
#include "dem/grain_store.h"
#include "tests/bench/timing.h"

using namespace interstice;

namespace {

/// Bytes a second that pass through memory both ways while half a gigabyte is changed in place: the most of
/// several rounds.
double bandwidth() {
  LargeVector<double> numbers(std::size_t{1} << 26, 1.0);
  const auto change = [&] {
    for_each_block({numbers.size(), std::size_t{1} << 16},
                   [&](std::size_t, std::size_t begin, std::size_t end) {
                     for (std::size_t i = begin; i < end; ++i) numbers[i] = 0.5 * numbers[i] + 0.5;
                   });
  };
  double most = 0;
  for (int round = 0; round < 7; ++round)
    most = std::max(most, 2 * 8 * static_cast<double>(numbers.size()) / bench::wall_seconds(change));
  return most;
}

/// What a step reads, and reads and writes, of a grain with so many listed pairs. Ends of pairs stay in cache
/// (dem/end_places.h).
template <class Real>
double bytes_of_grain(double pairs) {
  const double both_ways =
      sizeof(dem::PairRow<Real>) + sizeof(dem::GroupMotion) / dem::kLanes + sizeof(double);
  const double springs = dem::kSpringReals * sizeof(Real), bits = 1.0 * sizeof(dem::GroupBits) / dem::kLanes;
  const double read = sizeof(std::uint32_t) + pairs * (sizeof(dem::PairRef) + sizeof(dem::PairEnds));
  return 2 * both_ways + read + pairs * 2 * (springs + bits);
}

}  // namespace

int main(int argc, char** argv) {
  const double pairs = argc > 1 ? std::atof(argv[1]) : 2.6;
  const double mixed = bytes_of_grain<float>(pairs), full = bytes_of_grain<double>(pairs);
  fmt::print("{} listed pairs a grain: {:.0f} bytes a step and grain in mixed, {:.0f} in double\n\n", pairs,
             mixed, full);
  fmt::print(
      "| threads | bandwidth, GB/s | mixed: at most M particle-steps/s | double |\n|---|---|---|---|\n");
  for (const int threads : {1, 2}) {
    double most = 0;
    bench::on_threads(threads, [&] { most = bandwidth(); });
    fmt::print("| {} | {:.1f} | {:.0f} | {:.0f} |\n", threads, most * 1e-9, most / mixed * 1e-6,
               most / full * 1e-6);
  }
}
