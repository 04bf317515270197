// The methods that trade accuracy for speed.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include "tests/voxel/support.h"
#include "voxel/field.h"

namespace interstice::voxel::test {
namespace {

FieldRequest request_for(Method method, int points, double voxel) {
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {200e-6, 200e-6, 200e-6}}, voxel);
  request.method = method;
  request.subsample = points;
  return request;
}

Spheres inner_bed() {  // wholly inside the box
  return random_spheres(200, {{35e-6, 35e-6, 35e-6}, {165e-6, 165e-6, 165e-6}}, 2.5e-6, 32.5e-6, 41);
}

TEST(CentreMethod, PutsTheWholeSphereWhereItsCentreIs) {
  Spheres spheres;
  spheres.add({101e-6, 55e-6, 9e-6}, 30e-6);
  const Field field = compute_field(spheres.view(), {}, request_for(Method::centre, 0, 10e-6));
  EXPECT_EQ(field.solid_fraction->activeVoxelCount(), 1u);
  const double share = ball_volume(30e-6) / 1e-15;
  EXPECT_FLOAT_EQ(field.solid_fraction->tree().getValue({10, 5, 0}), static_cast<float>(share));
  EXPECT_NEAR(field.sums.void_min, 1 - share, 1e-12);
  EXPECT_EQ(field.sums.negative_voxels, 1);
}

TEST(CentreMethod, ConservesSpheresWhoseCentreIsInside) {
  const Spheres spheres = inner_bed();
  const Field field = compute_field(spheres.view(), {}, request_for(Method::centre, 0, 17.3e-6));
  EXPECT_NEAR(field.sums.solid_volume_field / spheres.volume(), 1, 1e-12);
}

TEST(CentreMethod, APeriodicImageIsCountedOnce) {
  Spheres spheres;
  for (const double x : {-10e-6, 0., 100e-6, 195e-6, 200e-6, 210e-6}) spheres.add({x, 50e-6, 50e-6}, 12e-6);
  FieldRequest request = request_for(Method::centre, 0, 20e-6);
  request.periodic = {true, false, false};
  const Field field = compute_field(spheres.view(), {}, request);
  EXPECT_NEAR(field.sums.solid_volume_field / spheres.volume(), 1, 1e-12);
}

double rms_difference(const Field& a, const Field& b) {
  double sum = 0;
  for (int i = 0; i < a.lattice.n[0]; ++i)
    for (int j = 0; j < a.lattice.n[1]; ++j)
      for (int k = 0; k < a.lattice.n[2]; ++k) {
        const double d = static_cast<double>(a.solid_fraction->tree().getValue({i, j, k})) -
                         static_cast<double>(b.solid_fraction->tree().getValue({i, j, k}));
        sum += d * d;
      }
  return std::sqrt(sum / static_cast<double>(a.lattice.cells()));
}

TEST(SubsampleMethod, CountsPoints) {
  Spheres spheres;
  spheres.add({100e-6, 100e-6, 100e-6}, 9e-6);
  const Field field = compute_field(spheres.view(), {}, request_for(Method::subsample, 2, 20e-6));
  // points of voxel (5,5,5) at 105 and 115 um: only (105,105,105) is within 9 um, at 8.66; eight voxels share
  // it
  EXPECT_FLOAT_EQ(field.solid_fraction->tree().getValue({5, 5, 5}), 1.f / 8);
  EXPECT_FLOAT_EQ(field.solid_fraction->tree().getValue({4, 5, 4}), 1.f / 8);
  EXPECT_EQ(field.solid_fraction->activeVoxelCount(), 8u);
}

TEST(SubsampleMethod, ConvergesToTheExactField) {
  const Spheres spheres = inner_bed();
  const Field exact = compute_field(spheres.view(), {}, request_for(Method::exact, 0, 17.3e-6));
  double last = 1;
  for (const int points : {1, 2, 4, 8, 16}) {
    const Field field = compute_field(spheres.view(), {}, request_for(Method::subsample, points, 17.3e-6));
    const double error = rms_difference(exact, field);
    EXPECT_LT(error, last / 2.5) << points;  // published: about a factor of 4 per doubling
    last = error;
  }
  EXPECT_LT(last, .005);
}

}  // namespace
}  // namespace interstice::voxel::test
