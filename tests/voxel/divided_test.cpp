// The 29 points of CFD couplings.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>

#include "base/error.h"
#include "tests/voxel/support.h"
#include "voxel/field.h"
#include "voxel/methods.h"

namespace interstice::voxel::test {
namespace {

FieldRequest request_for(double voxel, double least_void = 0) {
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {200e-6, 200e-6, 200e-6}}, voxel);
  request.method = Method::divided;
  request.least_void = least_void;
  return request;
}

Spheres inner_bed() {
  return random_spheres(200, {{35e-6, 35e-6, 35e-6}, {165e-6, 165e-6, 165e-6}}, 2.5e-6, 32.5e-6, 41);
}

TEST(DividedMethod, PointsLieAtTheMeanDistancesOfEqualShares) {
  // numbers worked out by hand: 0.75 (b^4 - a^4) / (b^3 - a^3), a^3, b^3 = 1/29, 15/29 and 15/29, 1
  int centre = 0, inner = 0, outer = 0, diagonal = 0;
  Vec3d sum{0, 0, 0};
  for (const Vec3d& p : divided_points()) {
    const double r = norm(p);
    centre += r == 0;
    inner += std::abs(r - 0.627610) < 1e-5;
    outer += std::abs(r - 0.908530) < 1e-5;
    diagonal += std::abs(p.x * p.y * p.z) > 0.01;
    sum = sum + p;
  }
  EXPECT_EQ(centre, 1);
  EXPECT_EQ(inner, 14);
  EXPECT_EQ(outer, 14);
  EXPECT_EQ(diagonal, 16);
  EXPECT_NEAR(norm(sum), 0, 1e-14);
}

TEST(DividedMethod, SplitsASphereBetweenCells) {
  Spheres spheres;  // centre in the middle of a cell twice the inner, less than twice the outer distance wide
  spheres.add({100e-6, 100e-6, 100e-6}, 12.5e-6);
  const Field field = compute_field(spheres.view(), {}, request_for(200e-6 / 11));
  const double part = ball_volume(12.5e-6) / std::pow(200e-6 / 11, 3) / 29;
  const auto at = [&](int i, int j, int k) {
    return static_cast<double>(field.solid_fraction->tree().getValue({i, j, k}));
  };
  EXPECT_NEAR(at(5, 5, 5), 23 * part, 1e-6);  // outer diagonals reach 8.03 um along z, the cell 9.09
  for (const int side : {4, 6}) {
    EXPECT_NEAR(at(side, 5, 5), part, 1e-6);
    EXPECT_NEAR(at(5, side, 5), part, 1e-6);
    EXPECT_NEAR(at(5, 5, side), part, 1e-6);
  }
  EXPECT_EQ(field.solid_fraction->activeVoxelCount(), 7u);
}

TEST(DividedMethod, ConservesSpheresWhoseCentreIsInside) {
  for (const double voxel : {3e-6, 17.3e-6, 60e-6}) {
    const Spheres spheres = inner_bed();
    const Field field = compute_field(spheres.view(), {}, request_for(voxel));
    EXPECT_NEAR(field.sums.solid_volume_field / spheres.volume(), 1, 1e-12);
  }
}

TEST(DividedMethod, PointsOutsideCountWhereTheCentreIs) {
  Spheres spheres;
  spheres.add({2e-6, 100e-6, 100e-6}, 20e-6);   // points beyond x = 0
  spheres.add({100e-6, -1e-6, 100e-6}, 20e-6);  // centre outside: nothing
  const Field field = compute_field(spheres.view(), {}, request_for(10e-6));
  EXPECT_NEAR(field.sums.solid_volume_field / ball_volume(20e-6), 1, 1e-12);
}

TEST(DividedMethod, AcrossPeriodicFacesAllPointsAreFound) {
  Spheres moved_over, inner;
  inner.add({101e-6, 103e-6, 99e-6}, 24e-6);
  moved_over.add({1e-6, 3e-6, 199e-6}, 24e-6);
  FieldRequest request = request_for(10e-6);
  request.periodic = {true, true, true};
  const Field a = compute_field(inner.view(), {}, request), b = compute_field(moved_over.view(), {}, request);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      for (int k = 0; k < 20; ++k)
        ASSERT_FLOAT_EQ(a.solid_fraction->tree().getValue({i, j, k}),
                        b.solid_fraction->tree().getValue({(i + 10) % 20, (j + 10) % 20, (k + 10) % 20}));
}

TEST(DividedMethod, TheLeastVoidFractionDeletesSolidAndSaysHowMuch) {
  const Spheres spheres = inner_bed();
  const Field all = compute_field(spheres.view(), {}, request_for(17.3e-6));
  const Field field = compute_field(spheres.view(), {}, request_for(17.3e-6, 0.1));
  double deleted = 0;
  for (auto voxel = all.solid_fraction->cbeginValueOn(); voxel; ++voxel) {
    const double before = static_cast<double>(*voxel);
    const double after = static_cast<double>(field.solid_fraction->tree().getValue(voxel.getCoord()));
    deleted += std::max(0.0, before - 0.9);
    ASSERT_FLOAT_EQ(after, std::min(before, 0.9));
  }
  EXPECT_GT(field.sums.deleted_volume, 0.02 * spheres.volume());
  EXPECT_NEAR(field.sums.deleted_volume / (deleted * std::pow(17.3e-6, 3)), 1, 1e-5);
  EXPECT_NEAR((field.sums.solid_volume_field + field.sums.deleted_volume) / spheres.volume(), 1, 1e-12);
  EXPECT_NEAR(field.sums.void_min, 0.1, 1e-12);
  EXPECT_EQ(field.sums.negative_voxels, 0);
}

TEST(DividedMethod, TheLeastVoidFractionIsOfWhatWallsLeave) {
  Spheres spheres;
  spheres.add({100e-6, 100e-6, 15e-6}, 14e-6);
  Solids solids;
  solids.shapes.push_back(Box{{0, 0, 0}, {200e-6, 200e-6, 15e-6}});
  const Field field = compute_field(spheres.view(), solids, request_for(20e-6, 0.1));
  for (auto voxel = field.void_fraction->cbeginValueOn(); voxel; ++voxel)
    ASSERT_GE(*voxel, 0.1f * field.available_fraction->tree().getValue(voxel.getCoord()) - 1e-6f);
  EXPECT_GT(field.sums.deleted_volume, 0);
}

TEST(DividedMethod, ImpossibleLimitsAreRefused) {
  for (const double least : {-0.1, 1.0, 2.0, std::nan("")})
    EXPECT_THROW(compute_field(inner_bed().view(), {}, request_for(20e-6, least)), InputError) << least;
  FieldRequest request = request_for(20e-6, 0.1);
  request.method = Method::exact;
  EXPECT_THROW(compute_field(inner_bed().view(), {}, request), InputError);
}

}  // namespace
}  // namespace interstice::voxel::test
