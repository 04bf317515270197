// Spheres spread smoothly: what is conserved, and where it goes.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <cmath>

#include "base/error.h"
#include "tests/voxel/support.h"
#include "voxel/field.h"

namespace interstice::voxel::test {
namespace {

FieldRequest request_for(double voxel, double length) {
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {200e-6, 200e-6, 200e-6}}, voxel);
  request.method = Method::kernel;
  request.kernel_length = length;
  return request;
}

/// Share of [lo, hi] in the bump around c, by the midpoint rule on its formula.
double bump_share(double lo, double hi, double c, double length) {
  const int n = 20000;
  double sum = 0;
  for (int p = 0; p < n; ++p) {
    const double u = (lo + (p + 0.5) / n * (hi - lo) - c) / length;
    if (std::abs(u) < 1) sum += 15.0 / 16 * (1 - u * u) * (1 - u * u) / length;
  }
  return sum * (hi - lo) / n;
}

TEST(KernelMethod, SpreadsASphereAsItsFormulaSays) {
  Spheres spheres;
  spheres.add({93e-6, 101e-6, 116e-6}, 17e-6);
  const double h = 10e-6, length = 34e-6;
  const Field field = compute_field(spheres.view(), {}, request_for(h, length));
  double sum = 0;
  for (int i = 4; i < 15; ++i)
    for (int j = 4; j < 15; ++j)
      for (int k = 4; k < 17; ++k) {
        const double expected =
            ball_volume(17e-6) / (h * h * h) * bump_share(i * h, i * h + h, 93e-6, length) *
            bump_share(j * h, j * h + h, 101e-6, length) * bump_share(k * h, k * h + h, 116e-6, length);
        const double share = static_cast<double>(field.solid_fraction->tree().getValue({i, j, k}));
        ASSERT_NEAR(share, expected, 1e-6);
        sum += share;
      }
  EXPECT_NEAR(sum * h * h * h / ball_volume(17e-6), 1, 1e-6);
}

TEST(KernelMethod, ConservesWhateverLiesInTheBox) {
  const Spheres spheres =
      random_spheres(300, {{-20e-6, -20e-6, -20e-6}, {220e-6, 220e-6, 220e-6}}, 2.5e-6, 32.5e-6, 3);
  Solids solids;
  solids.shapes.push_back(Box{{60e-6, -1, -1}, {83e-6, 1, 1}});
  solids.shapes.push_back(Plane{{0, 0, 13e-6}, {0, 0, 1}});
  for (const bool walls : {false, true})
    for (const bool periodic : {false, true})
      for (const double length : {3e-6, 40e-6, 120e-6}) {
        FieldRequest request = request_for(17.3e-6, length);
        if (periodic) request.lattice = cubic_lattice({{0, 0, 0}, {200e-6, 200e-6, 200e-6}}, 20e-6);
        request.periodic = {periodic, periodic, false};
        const Field field = compute_field(spheres.view(), walls ? solids : Solids{}, request);
        EXPECT_NEAR(field.sums.solid_volume_field / field.sums.solid_volume_particles, 1, 1e-12)
            << walls << periodic << length;
      }
}

TEST(KernelMethod, PutsNothingIntoWallsAsFarAsThereIsRoomBesideThem) {
  Spheres spheres;
  spheres.add({100e-6, 100e-6, 55e-6}, 15e-6);
  Solids solids;
  solids.shapes.push_back(Plane{{0, 0, 40e-6}, {0, 0, 1}});
  const Field field = compute_field(spheres.view(), solids, request_for(10e-6, 50e-6));
  for (int k = 0; k < 4; ++k) EXPECT_EQ(field.solid_fraction->tree().getValue({10, 10, k}), 0.0f);
  EXPECT_GT(field.solid_fraction->tree().getValue({10, 10, 4}), 0.0f);
}

TEST(KernelMethod, ASphereWithNoRoomInReachCountsWhereItIs) {
  Spheres spheres;
  spheres.add({100e-6, 100e-6, 30e-6}, 15e-6);  // inside the wall
  Solids solids;
  solids.shapes.push_back(Plane{{0, 0, 100e-6}, {0, 0, 1}});
  FieldRequest request = request_for(10e-6, 20e-6);
  const Field field = compute_field(spheres.view(), solids, request);
  request.method = Method::exact;
  const Field exact = compute_field(spheres.view(), solids, request);
  for (int k = 0; k < 8; ++k)
    EXPECT_FLOAT_EQ(field.solid_fraction->tree().getValue({10, 10, k}),
                    exact.solid_fraction->tree().getValue({10, 10, k}));
}

TEST(KernelMethod, IsTheSameAcrossAPeriodicFace) {
  Spheres inner, across;
  inner.add({103e-6, 100e-6, 100e-6}, 20e-6);
  across.add({3e-6, 100e-6, 100e-6}, 20e-6);
  FieldRequest request = request_for(10e-6, 45e-6);
  request.periodic = {true, false, false};
  const Field a = compute_field(inner.view(), {}, request), b = compute_field(across.view(), {}, request);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      EXPECT_FLOAT_EQ(a.solid_fraction->tree().getValue({i, j, 10}),
                      b.solid_fraction->tree().getValue({(i + 10) % 20, j, 10}));
}

TEST(KernelMethod, ASymmetricSphereHasItsCentreOfMassKept) {
  Spheres spheres;
  spheres.add({98.7e-6, 104.1e-6, 101.9e-6}, 20e-6);
  const double h = 5e-6;
  const Field field = compute_field(spheres.view(), {}, request_for(h, 60e-6));
  double sum = 0, first = 0;
  for (auto voxel = field.solid_fraction->cbeginValueOn(); voxel; ++voxel) {
    sum += static_cast<double>(*voxel);
    first += static_cast<double>(*voxel) * (voxel.getCoord().x() + 0.5) * h;
  }
  EXPECT_NEAR(first / sum, 98.7e-6, 1e-3 * h);
}

TEST(KernelMethod, ImpossibleLengthsAreRefused) {
  Spheres spheres;
  spheres.add({100e-6, 100e-6, 100e-6}, 20e-6);
  for (const double length : {0.0, -1e-5, std::nan(""), 1.0 / 0.0, 1.0})
    EXPECT_THROW(compute_field(spheres.view(), {}, request_for(20e-6, length)), InputError) << length;
}

}  // namespace
}  // namespace interstice::voxel::test
