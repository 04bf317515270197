// How fast fields are, from positions to finished OpenVDB grids, as the tables of docs/PERFORMANCE.md:
//   bench_fields throughput [SPHERES]   exact in double and in single beside the straightforward way
//   bench_fields scaling [MOST]         time and memory from 1,000 to MOST (10,000,000) spheres
//   bench_fields ratios                 one sphere of R/h from 0.001 to 1,000
//   bench_fields quantities [SPHERES]   what each quantity beside the fractions costs, against the plain
//   field
// Diameters are normal by number, mean 39.4 um, sd 10.5 um, cut to 5 to 65 um; voxels are 17.3 um. What is
// compared is run in turns, so that a machine's changing speed touches all alike; a row is the median of the
// rounds, and the fastest.
#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <ctime>
#include <fstream>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "tests/bench/powder_spheres.h"
#include "tests/bench/timing.h"
#include "voxel/field.h"
#include "voxel/overlap.h"
#include "voxel/small_spheres.h"

namespace {

using namespace interstice;
using namespace interstice::bench;
using voxel::Field;
using voxel::FieldRequest;

/// One sphere at a time, voxel by voxel through an accessor: the same formula, as one would write it first.
openvdb::FloatGrid::Ptr straightforward(const Bed& bed, const voxel::Lattice& lattice) {
  auto grid = openvdb::FloatGrid::create(0.0f);
  auto cells = grid->getAccessor();
  const double cell = lattice.cell_volume();
  for (std::size_t s = 0; s < bed.size(); ++s) {
    voxel::for_each_overlap(lattice, {bed.x[s], bed.y[s], bed.z[s]}, bed.radius[s], voxel::all_cells(lattice),
                            [&](std::int64_t i, std::int64_t j, std::int64_t k, double volume) {
                              const openvdb::Coord at(static_cast<int>(i), static_cast<int>(j),
                                                      static_cast<int>(k));
                              cells.setValue(at, cells.getValue(at) + static_cast<float>(volume / cell));
                            });
  }
  return grid;
}

void throughput(std::size_t count) {
  const Bed bed = make_bed(count);
  struct Case {
    const char* name;
    int threads;
    std::function<void()> work;
    std::vector<double> wall, processor;
  };
  const auto field = [&](voxel::Precision precision) {
    return [&bed, precision] { voxel::compute_field(bed.view(), {}, request_for(bed, precision)); };
  };
  std::vector<Case> cases{
      {"straightforward", 1, [&] { straightforward(bed, request_for(bed).lattice); }, {}, {}},
      {"exact", 1, field(voxel::Precision::real64), {}, {}},
      {"exact, single", 1, field(voxel::Precision::mixed), {}, {}},
      {"exact", 2, field(voxel::Precision::real64), {}, {}},
      {"exact, single", 2, field(voxel::Precision::mixed), {}, {}}};
  for (int round = 0; round < 21; ++round)
    for (Case& c : cases)
      on_threads(c.threads, [&] {
        const Seconds seconds = timed(c.work);
        c.wall.push_back(seconds.wall);
        c.processor.push_back(seconds.processor);
      });
  const double n = static_cast<double>(count);
  fmt::print("{} spheres, voxels of {:g} um, kernel for {}\n\n", count, 1e6 * kVoxel,
             voxel::small_spheres_target());
  fmt::print(
      "| way | threads | ms a frame: median (least) | processor ms: median (least) | M spheres/s: median "
      "(most) |\n");
  fmt::print("|---|---|---|---|---|\n");
  for (const Case& c : cases) {
    const Spread wall = spread_of(c.wall), processor = spread_of(c.processor);
    fmt::print("| {} | {} | {:.1f} ({:.1f}) | {:.1f} ({:.1f}) | {:.2f} ({:.2f}) |\n", c.name, c.threads,
               1e3 * wall.median, 1e3 * wall.least, 1e3 * processor.median, 1e3 * processor.least,
               1e-6 * n / wall.median, 1e-6 * n / wall.least);
  }
}

/// VmRSS or VmHWM of this process [bytes].
double memory(const char* key) {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(key, 0) == 0) return 1024 * std::stod(line.substr(std::strlen(key) + 1));
  }
  return NAN;
}
void forget_peak() { std::ofstream("/proc/self/clear_refs") << "5"; }

void scaling(std::size_t most) {
  fmt::print(
      "| spheres | ns a sphere (processor) | leaves | peak above the columns, MB | kB a leaf "
      "|\n|---|---|---|---|---|\n");
  for (std::size_t count = 1000; count <= most; count *= 10) {
    const Bed bed = make_bed(count);
    const FieldRequest request = request_for(bed);
    std::vector<double> each;
    double peak = 0;
    std::size_t leaves = 0;
    const int rounds = count < 100'000 ? 9 : count < 10'000'000 ? 3 : 1;
    for (int round = 0; round < rounds; ++round) {
      forget_peak();
      const double before = memory("VmRSS");
      on_threads(1, [&] {
        const Seconds seconds = timed([&] {
          const Field field = voxel::compute_field(bed.view(), {}, request);
          leaves = field.solid_fraction->tree().leafCount();
        });
        each.push_back(seconds.processor / static_cast<double>(count));
      });
      if (round == 0) peak = memory("VmHWM") - before;
    }
    fmt::print("| {} | {:.0f} | {} | {:.1f} | {:.1f} |\n", count, 1e9 * spread_of(each).median, leaves,
               1e-6 * peak, 1e-3 * peak / static_cast<double>(leaves));
  }
}

/// Voxels that the surface of a sphere passes: those with a share between none and all.
std::size_t surface_voxels(const openvdb::FloatGrid& grid) {
  std::size_t count = 0;
  for (auto at = grid.cbeginValueOn(); at; ++at)
    if (at.isVoxelValue() && *at > 0 && *at < 1) ++count;
  return count;
}

void ratios() {
  fmt::print(
      "| R/h | surface voxels | ns a surface voxel | leaves | tiles | off in volume "
      "|\n|---|---|---|---|---|---|\n");
  for (const double ratio : {1e-3, 1e-2, 0.1, 1.0, 3.0, 10.0, 30.0, 100.0, 300.0, 1000.0}) {
    const double radius = ratio * kVoxel;
    const double half = std::ceil(ratio + 1) * kVoxel;
    const Vec3d at{0.31 * kVoxel, -0.17 * kVoxel, 0.23 * kVoxel};
    FieldRequest request;
    request.lattice = voxel::cubic_lattice({{-half, -half, -half}, {half, half, half}}, kVoxel);
    const int repeat = ratio <= 10 ? 200 : 1;
    Field field;
    double seconds = 0;
    on_threads(1, [&] {
      const std::clock_t begin = std::clock();
      for (int r = 0; r < repeat; ++r)
        field = voxel::compute_field({1, &at.x, &at.y, &at.z, &radius, nullptr}, {}, request);
      seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / repeat;
    });
    const auto& tree = field.solid_fraction->tree();
    const std::size_t surface = surface_voxels(*field.solid_fraction);
    fmt::print("| {:g} | {} | {:.0f} | {} | {} | {:.1e} |\n", ratio, surface,
               1e9 * seconds / static_cast<double>(surface), tree.leafCount(), tree.activeTileCount(),
               std::abs(field.sums.solid_volume_field / field.sums.solid_volume_particles - 1));
  }
}

void quantities(std::size_t count) {
  const Bed bed = make_bed(count);
  std::vector<double> numbers(count), density(count, 8200.0);
  std::vector<std::int32_t> classes(count), bonded(count);
  Random random(5, 0);
  for (std::size_t s = 0; s < count; ++s) {
    numbers[s] = random.uniform(-1, 1);
    classes[s] = random.uniform() < 0.5;
    bonded[s] = random.uniform() < 0.5;
  }
  voxel::SpheresView spheres = bed.view();
  spheres.velocity.fill(numbers.data()), spheres.stress.fill(numbers.data());
  spheres.coordination = numbers.data();
  spheres.bonded = bonded.data(), spheres.group = classes.data();
  voxel::SpheresView heavy = spheres;
  heavy.density = density.data();
  struct Case {
    const char* name;
    voxel::QuantityRequest request;
    const voxel::SpheresView* spheres;
    std::vector<double> ratio{};  // to the plain field beside it
  };
  const auto only = [](bool voxel::QuantityRequest::*flag) {
    voxel::QuantityRequest request;
    request.*flag = true;
    return request;
  };
  voxel::QuantityRequest two_classes;
  two_classes.groups = {"one", "two"};
  std::vector<Case> cases{
      {"mass density", {}, &heavy},
      {"velocity", only(&voxel::QuantityRequest::velocity), &spheres},
      {"temperature (with velocity)", only(&voxel::QuantityRequest::temperature), &spheres},
      {"mean diameter", only(&voxel::QuantityRequest::diameter), &spheres},
      {"coordination", only(&voxel::QuantityRequest::coordination), &spheres},
      {"stress and pressure", only(&voxel::QuantityRequest::stress), &spheres},
      {"bonded fraction and mask", only(&voxel::QuantityRequest::bonded), &spheres},
      {"two classes", two_classes, &spheres},
      {"all of these", {true, true, true, true, true, true, {"one", "two"}}, &heavy}};
  std::vector<double> plain;
  const auto seconds_of = [&](const voxel::SpheresView& view, const voxel::QuantityRequest& asked) {
    FieldRequest request = request_for(bed);
    request.quantities = asked;
    return timed([&] { voxel::compute_field(view, {}, request); }).processor;
  };
  on_threads(1, [&] {
    for (int round = 0; round < 15; ++round)
      for (Case& c : cases) {
        plain.push_back(seconds_of(spheres, {}));
        c.ratio.push_back(seconds_of(*c.spheres, c.request) / plain.back());
      }
  });
  const Spread frame = spread_of(plain);
  fmt::print(
      "{} spheres, voxels of {:g} um, one thread; the plain field takes {:.1f} ms ({:.1f}, {:.1f})\n\n",
      count, 1e6 * kVoxel, 1e3 * frame.median, 1e3 * frame.least, 1e3 * frame.most);
  fmt::print(
      "| beside the fractions | grids | time, plain field = 1: median (least, most) |\n|---|---|---|\n");
  for (const Case& c : cases) {
    const Spread ratio = spread_of(c.ratio);
    fmt::print("| {} | {} | {:.2f} ({:.2f}, {:.2f}) |\n", c.name, c.request.grids() + (c.spheres == &heavy),
               ratio.median, ratio.least, ratio.most);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::string what = argc > 1 ? argv[1] : "";
  const std::size_t count = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 0;
  openvdb::initialize();
  if (what == "throughput")
    throughput(count ? count : 35'000);
  else if (what == "scaling")
    scaling(count ? count : 10'000'000);
  else if (what == "ratios")
    ratios();
  else if (what == "quantities")
    quantities(count ? count : 35'000);
  else {
    fmt::print(stderr,
               "usage: bench_fields throughput [SPHERES] | scaling [MOST] | ratios | quantities [SPHERES]\n");
    return 2;
  }
}
