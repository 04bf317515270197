// Positions to finished grids: a settled-like bed of 35,000 spheres with the size distribution of a published
// spreading study (diameters 5 to 65 um, normal by number, mean 39.3 um, sd 10.46 um) in voxels of 17.3 um.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "voxel/field.h"

namespace {

using namespace interstice;
using namespace interstice::voxel;

struct Bed {
  std::vector<double> x, y, z, radius;
  Box box;

  SpheresView view() const { return {radius.size(), x.data(), y.data(), z.data(), radius.data(), nullptr}; }
};

// Random positions in a box that the spheres would fill to a solid fraction of 0.45. They overlap, which
// costs the field no more and no less than if they did not.
Bed make_bed(std::size_t count) {
  Bed bed;
  double volume = 0;
  Random random(4, 0);
  while (bed.radius.size() < count) {
    const double normal =
        std::sqrt(-2 * std::log(random.uniform())) * std::cos(2 * std::numbers::pi * random.uniform());
    const double diameter = 39.3e-6 + 10.46e-6 * normal;
    if (diameter < 5e-6 || diameter > 65e-6) continue;
    bed.radius.push_back(0.5 * diameter);
    volume += std::numbers::pi / 6 * diameter * diameter * diameter;
  }
  const double width = 1.8e-3, height = 0.3e-3, length = volume / (0.45 * width * height);
  bed.box = {{0, 0, 0}, {length, width, height}};
  for (const double r : bed.radius) {
    bed.x.push_back(random.uniform(r, length - r));
    bed.y.push_back(random.uniform(r, width - r));
    bed.z.push_back(random.uniform(r, height - r));
  }
  return bed;
}

// range(0): threads; range(1): 0 exact, 1 centre, 2 eight points an edge; range(2): averaging cube in um, 0
// for none
void fields(benchmark::State& state) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(state.range(0)));
  const Bed bed = make_bed(35'000);
  FieldRequest request;
  request.lattice = cubic_lattice(bed.box, 17.3e-6);
  request.method = state.range(1) == 0   ? Method::exact
                   : state.range(1) == 1 ? Method::centre
                                         : Method::subsample;
  request.subsample = 8;
  request.average_length = 1e-6 * static_cast<double>(state.range(2));
  double sum = 0;
  for (auto _ : state) {
    const Field field = compute_field(bed.view(), {}, request);
    benchmark::DoNotOptimize(sum += field.sums.solid_volume_field);
  }
  state.SetItemsProcessed(state.iterations() * 35'000);
}

BENCHMARK(fields)
    ->ArgNames({"threads", "method", "average_um"})
    ->Args({1, 0, 0})
    ->Args({2, 0, 0})
    ->Args({1, 1, 0})
    ->Args({1, 2, 0})
    ->Args({1, 0, 100})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
