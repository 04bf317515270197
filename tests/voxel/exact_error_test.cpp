// How far shares of voxels are off, against quadrature with 34 digits: the bound that the documentation
// states, 1e-15 max(1, (R/h)^3), of every kernel that a field is computed by.
#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "base/random.h"
#include "tests/voxel/reference_volume.h"
#include "voxel/overlap.h"
#include "voxel/small_spheres.h"

namespace interstice::voxel::test {
namespace {

using Quad = boost::multiprecision::cpp_bin_float_quad;

/// Share of the cell with lower corner `cell` (in cells from the sphere's own), of the numbers as they are.
double quad_share(const Lattice& lattice, const PlacedSphere& sphere,
                  const std::array<std::int64_t, 3>& cell) {
  const Quad h = lattice.h.x, r = sphere.radius;
  std::array<Quad, 3> lo, hi;
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    const Quad first = cell[at] - sphere.cell[axis];
    lo[at] = (first * h - sphere.offset[axis]) / r;
    hi[at] = ((first + 1) * h - sphere.offset[axis]) / r;
  }
  return static_cast<double>(reference_unit_volume<Quad>(lo, hi, Quad(1e-18)) * (r / h) * (r / h) * (r / h));
}

/// A cell that the surface passes, chosen at random among those of one sphere.
void expect_within_bound(double ratio, std::uint64_t seed, double& worst) {
  const double h = 17.3e-6;
  const Lattice lattice{{0, 0, 0}, {h, h, h}, {1, 1, 1}};
  Random random(31, seed);
  const Vec3d center{h * random.uniform(), h * random.uniform(), h * random.uniform()};
  const PlacedSphere sphere = place(lattice, center, ratio * h);
  const CellRange bounding = bounding_cells(lattice, sphere);
  CellRows rows;
  const bool small = is_small(bounding);
  if (small) {
    rows.reset(bounding);
    const SmallSphere one{sphere, bounding, 0};
    add_small_spheres(lattice, &one, 1, Precision::real64, Channels{}, rows);
  }
  int looked_at = 0;
  for (int attempt = 0; attempt < 2000 && looked_at < 1; ++attempt) {
    std::array<std::int64_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] =
          bounding.lo[axis] +
          static_cast<std::int64_t>(random.uniform() * static_cast<double>(bounding.size(axis)));
    double share = 0;
    const CellRange only{cell, {cell[0] + 1, cell[1] + 1, cell[2] + 1}};
    exact_fractions(lattice, sphere, only, &share);
    if (share <= 0 || share >= 1) continue;
    ++looked_at;
    const double expected = quad_share(lattice, sphere, cell),
                 bound = 1e-15 * std::max(1., ratio * ratio * ratio);
    EXPECT_NEAR(share, expected, bound) << "R/h " << ratio << ", sphere " << seed;
    worst = std::max(worst, std::abs(share - expected) / bound);
    if (!small) continue;
    const double row = rows.row(cell[0], cell[1])[cell[2] - bounding.lo[2]];
    EXPECT_NEAR(row, expected, bound) << "row kernel, R/h " << ratio << ", sphere " << seed;
    worst = std::max(worst, std::abs(row - expected) / bound);
  }
  EXPECT_GT(looked_at, 0);
}

TEST(ExactError, OfAShareStaysWithinItsBound) {
  double worst = 0;
  for (const double ratio : {.05, .4, 1., 1.9, 3.2, 12., 49.})
    for (std::uint64_t seed = 0; seed < 3; ++seed) expect_within_bound(ratio, seed, worst);
  RecordProperty("worst_share_of_the_bound", std::to_string(worst));
  EXPECT_GT(worst, 1e-3);  // the reference is another way: bit for bit the same would be suspicious
}

}  // namespace
}  // namespace interstice::voxel::test
