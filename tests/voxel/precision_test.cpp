// The exact method in single precision against itself in double, which has references of its own.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>

#include "tests/voxel/support.h"
#include "voxel/field.h"
#include "voxel/small_spheres.h"

namespace interstice::voxel::test {
namespace {

/// The shares that one sphere fills, by both precisions.
struct Both {
  CellRows real64, mixed;
  CellRange cells;
};

void add(const Lattice& lattice, const Vec3d& center, double radius, Both& both) {
  const PlacedSphere sphere = place(lattice, center, radius);
  const SmallSphere small{sphere, bounding_cells(lattice, sphere)};
  ASSERT_TRUE(is_small(small.bounding));
  both.cells = small.bounding;
  both.real64.reset(small.bounding);
  both.mixed.reset(small.bounding);
  add_small_spheres(lattice, &small, 1, Precision::real64, {}, both.real64);
  add_small_spheres(lattice, &small, 1, Precision::mixed, {}, both.mixed);
}

template <class Visit>
void for_cells(Both& both, const Visit& visit) {
  const CellRange& c = both.cells;
  for (std::int64_t i = c.lo[0]; i < c.hi[0]; ++i)
    for (std::int64_t j = c.lo[1]; j < c.hi[1]; ++j)
      for (std::int64_t k = 0; k < c.size(2); ++k) visit(both.real64.row(i, j)[k], both.mixed.row(i, j)[k]);
}

TEST(Single, AShareIsOffByLittle) {
  const double h = 17.3e-6;
  const Lattice lattice{{1, -2, 3}, {h, h, h}, {1, 1, 1}};  // far from the origin: places are kept in double
  for (const double ratio : {1e-3, .03, .3, 1., 2., 3.})
    for (std::uint64_t i = 0; i < 500; ++i) {
      Random random(21, i);
      const Vec3d center = lattice.lo + h * Vec3d{random.uniform(), random.uniform(), random.uniform()};
      Both both;
      add(lattice, center, ratio * h, both);
      double total = 0, worst = 0;
      for_cells(both, [&](double exact, double single) {
        worst = std::max(worst, std::abs(single - exact));
        total += single;
      });
      // eight corners, each of some 1/2 and off by two units in the last place: 8 * 2 * 2^-25
      EXPECT_LE(worst, 4.8e-7 * std::max(1., ratio * ratio * ratio)) << ratio;
      const double volume = ball_volume(ratio);
      EXPECT_NEAR(total / volume, 1, 1e-6) << ratio;
    }
}

TEST(Single, IsNotUsedForSpheresOfMoreThanThreeCells) {
  const double h = 10e-6;
  const Lattice lattice{{0, 0, 0}, {h, h, h}, {20, 20, 20}};
  Both both;
  add(lattice, {75e-6, 76e-6, 74e-6}, 3.01 * h, both);
  for_cells(both, [](double exact, double single) { EXPECT_EQ(exact, single); });
}

TEST(Single, AFieldKeepsItsVolumeAndSaysHowItWasMade) {
  const Spheres spheres = bed(2000);
  FieldRequest request;
  request.lattice = cubic_lattice(bed_box(), 17.3e-6);
  const Field exact = compute_field(spheres.view(), {}, request);
  request.precision = Precision::mixed;
  const Field single = compute_field(spheres.view(), {}, request);
  EXPECT_EQ(single.sums.solid_volume_particles, exact.sums.solid_volume_particles);  // in double, apart
  EXPECT_NEAR(single.sums.solid_volume_field / exact.sums.solid_volume_field, 1, 1e-7);
  EXPECT_EQ(single.solid_fraction->metaValue<std::string>("method"), "exact, single");
  for (auto at = exact.solid_fraction->cbeginValueOn(); at; ++at)
    EXPECT_NEAR(single.solid_fraction->tree().getValue(at.getCoord()), *at, 1e-5F + 1e-6F * *at);
}

TEST(Single, FullVoxelsAreNotTakenForOverfullOnes) {
  // two halves of a voxel's filling, from spheres that touch it from both sides of a plane through many
  // voxels
  Spheres spheres;
  const double h = 10e-6;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j) spheres.add({(2 * i + 1) * h, (2 * j + 1) * h, 8 * h}, h);  // touching rows
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {16 * h, 16 * h, 16 * h}}, h / 2.9);
  request.precision = Precision::mixed;
  EXPECT_EQ(compute_field(spheres.view(), {}, request).sums.negative_voxels, 0);
}

}  // namespace
}  // namespace interstice::voxel::test
