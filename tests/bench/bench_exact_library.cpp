// Void-fraction fields beside the published exact library for spheres in general convex cells (Strobl,
// Formella and Poeschel, J. Comput. Phys. 311, 158, 2016): the same spheres on the same voxels, one thread,
// in turns. Built against that library's header by compare_exact_library.sh.
//   bench_exact_library [SPHERES] [ROUNDS]
// The library is asked in the way that costs it least: the voxel's hexahedron is made once, and the sphere
// moved to it; voxels that the sphere's bounding box does not reach are not asked about.
#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <overlap.hpp>
#include <vector>

#include "tests/bench/powder_spheres.h"
#include "tests/bench/timing.h"
#include "voxel/overlap.h"

namespace {

namespace bench = interstice::bench;
namespace voxel = interstice::voxel;
using interstice::Vec3d;

/// Solid fractions of all voxels, x fastest, in double.
struct Dense {
  voxel::Lattice lattice;
  std::vector<double> solid;
  double asked = 0;  // pairs of a sphere and a voxel

  double& at(std::int64_t i, std::int64_t j, std::int64_t k) {
    return solid[static_cast<std::size_t>(i + lattice.n[0] * (j + lattice.n[1] * k))];
  }
};

Dense empty(const voxel::Lattice& lattice) {
  return {lattice, std::vector<double>(static_cast<std::size_t>(lattice.cells()))};
}

Hexahedron cube(double h) {
  return {vector_t(0, 0, 0), vector_t(h, 0, 0), vector_t(h, h, 0), vector_t(0, h, 0),
          vector_t(0, 0, h), vector_t(h, 0, h), vector_t(h, h, h), vector_t(0, h, h)};
}

Dense by_library(const bench::Bed& bed, const voxel::Lattice& lattice) {
  Dense field = empty(lattice);
  const Hexahedron hexahedron = cube(lattice.h.x);
  const double cell = lattice.cell_volume();
  for (std::size_t s = 0; s < bed.size(); ++s) {
    const Vec3d at{bed.x[s], bed.y[s], bed.z[s]};
    const voxel::CellRange reached =
        intersection(bounding_cells(lattice, place(lattice, at, bed.radius[s])), all_cells(lattice));
    for (std::int64_t k = reached.lo[2]; k < reached.hi[2]; ++k)
      for (std::int64_t j = reached.lo[1]; j < reached.hi[1]; ++j)
        for (std::int64_t i = reached.lo[0]; i < reached.hi[0]; ++i) {
          const vector_t center(at.x - static_cast<double>(i) * lattice.h.x - lattice.lo.x,
                                at.y - static_cast<double>(j) * lattice.h.y - lattice.lo.y,
                                at.z - static_cast<double>(k) * lattice.h.z - lattice.lo.z);
          field.at(i, j, k) += overlap(Sphere(center, bed.radius[s]), hexahedron) / cell;
          ++field.asked;
        }
  }
  return field;
}

/// Our own shares added up in double, so that the grids' rounding to floats hides no difference.
Dense by_shares(const bench::Bed& bed, const voxel::Lattice& lattice) {
  Dense field = empty(lattice);
  for (std::size_t s = 0; s < bed.size(); ++s)
    voxel::for_each_overlap(lattice, {bed.x[s], bed.y[s], bed.z[s]}, bed.radius[s], all_cells(lattice),
                            [&](std::int64_t i, std::int64_t j, std::int64_t k, double volume) {
                              field.at(i, j, k) += volume / lattice.cell_volume();
                            });
  return field;
}

Dense of_grid(const voxel::Field& computed) {
  Dense field = empty(computed.lattice);
  const auto values = computed.solid_fraction->getConstAccessor();
  const auto& n = computed.lattice.n;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) field.at(i, j, k) = values.getValue({i, j, k});
  return field;
}

struct Difference {
  double largest = 0, of_volume = 0;
};
Difference difference(const Dense& a, const Dense& b) {
  Difference d;
  double sum_a = 0, sum_b = 0;
  for (std::size_t c = 0; c < a.solid.size(); ++c) {
    d.largest = std::max(d.largest, std::abs(a.solid[c] - b.solid[c]));
    sum_a += a.solid[c];
    sum_b += b.solid[c];
  }
  d.of_volume = std::abs(sum_a / sum_b - 1);
  return d;
}

void row(const char* name, const std::vector<double>& seconds, double spheres) {
  const bench::Spread s = bench::spread_of(seconds);
  fmt::print("| {} | {:.1f} ({:.1f}-{:.1f}) | {:.3g} |\n", name, 1e3 * s.median, 1e3 * s.least, 1e3 * s.most,
             1e-6 * spheres / s.median);
}

void compare(std::size_t count, int rounds) {
  const bench::Bed bed = bench::make_bed(count);
  const voxel::FieldRequest request = bench::request_for(bed);
  std::vector<double> ours, library, ratio;
  voxel::Field field;
  Dense theirs;
  for (int round = 0; round < rounds; ++round) {
    // several of the short ones around each long one: a machine's speed changes within seconds
    std::vector<double> beside;
    const auto several = [&] {
      for (int r = 0; r < 5; ++r)
        beside.push_back(
            bench::timed([&] { field = voxel::compute_field(bed.view(), {}, request); }).processor);
    };
    several();
    library.push_back(bench::timed([&] { theirs = by_library(bed, request.lattice); }).processor);
    several();
    ratio.push_back(library.back() / bench::spread_of(beside).median);
    ours.insert(ours.end(), beside.begin(), beside.end());
  }
  fmt::print("{} spheres, {} x {} x {} voxels of {:g} um, {:.3g} M pairs of sphere and voxel, one thread\n\n",
             count, request.lattice.n[0], request.lattice.n[1], request.lattice.n[2], 1e6 * bench::kVoxel,
             1e-6 * theirs.asked);
  fmt::print("| way | processor ms a frame: median (least-most) | M spheres/s |\n|---|---|---|\n");
  row("published exact library, into an array", library, static_cast<double>(count));
  row("interstice, into OpenVDB grids", ours, static_cast<double>(count));
  const bench::Spread times = bench::spread_of(ratio);
  fmt::print("\ntimes as fast: {:.0f} ({:.0f}-{:.0f})\n", times.median, times.least, times.most);
  const Difference shares = difference(by_shares(bed, request.lattice), theirs);
  fmt::print(
      "largest difference of a voxel's solid fraction: {:.2g} in double, {:.2g} as written (floats); of all "
      "solid volume: {:.1g}\n",
      shares.largest, difference(of_grid(field), theirs).largest, shares.of_volume);
}

}  // namespace

int main(int argc, char** argv) {
  openvdb::initialize();
  const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 35'000;
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  bench::on_threads(1, [&] { compare(count, rounds); });
}
