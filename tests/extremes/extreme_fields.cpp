// Extremes of the fields: grains against voxels, boxes and each other.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/error.h"
#include "tests/report/report.h"
#include "voxel/field.h"
#include "voxel/overlap.h"

namespace interstice::voxel {
namespace {

using interstice::testing::expect_outcome;

struct Spheres {
  std::vector<double> x, y, z, r;

  void add(const Vec3d& p, double radius) {
    x.push_back(p.x), y.push_back(p.y), z.push_back(p.z), r.push_back(radius);
  }
  SpheresView view() const { return {x.size(), x.data(), y.data(), z.data(), r.data(), nullptr}; }
};

double volume(double r) { return 4.0 / 3 * M_PI * r * r * r; }

Field field_of(const Spheres& s, const Box& box, double voxel) {
  FieldRequest request;
  request.lattice = cubic_lattice(box, voxel);
  return compute_field(s.view(), {}, request);
}

const Box kUnit{{0, 0, 0}, {1e-3, 1e-3, 1e-3}};

TEST(Fields, EmptyAndOneGrain) {
  const Field none = field_of({}, kUnit, 1e-4);
  const bool right = none.sums.solid_volume_field == 0 && none.sums.void_min == 1 && none.sums.void_max == 1;
  expect_outcome("empty scene", "a field of no grains", "solid 0, void fraction 1 in every voxel", right);
  Spheres one;
  one.add({3e-4, 4e-4, 5e-4}, 2e-4);
  const double error = field_of(one, kUnit, 1e-4).sums.solid_volume_field / volume(2e-4) - 1;
  expect_outcome("one grain", "d = 4 voxels", fmt::format("its volume to {:.1e}", std::fabs(error)),
                 std::fabs(error) <= 1e-14);
}

TEST(Fields, OnFaceEdgeAndCorner) {
  const double r = 3e-5;
  double worst = 0;
  for (const auto& [p, share] :
       {std::pair{Vec3d{0, 5e-4, 5e-4}, 2.0}, {Vec3d{0, 0, 5e-4}, 4.0}, {Vec3d{0, 0, 0}, 8.0}}) {
    Spheres s;
    s.add(p, r);
    worst =
        std::max(worst, std::fabs(field_of(s, kUnit, 1e-4).sums.solid_volume_field * share / volume(r) - 1));
  }
  expect_outcome("grain on a face, an edge, a corner of the box", "1/2, 1/4, 1/8 of it inside",
                 fmt::format("to {:.1e}", worst), worst <= 1e-14);
  Spheres s;  // on a corner that eight voxels share
  s.add({5e-4, 5e-4, 5e-4}, r);
  const double whole = field_of(s, kUnit, 1e-4).sums.solid_volume_field / volume(r) - 1;
  expect_outcome("grain on a corner of eight voxels", "sum over them",
                 fmt::format("its volume to {:.1e}, counted once", std::fabs(whole)),
                 std::fabs(whole) <= 1e-14);
}

TEST(Fields, VoxelsMuchSmallerAndMuchLarger) {
  double worst = 0;
  for (const double ratio : {1e-3, 1e-2, 0.1, 0.5, 1.0, 3.0, 10.0, 40.0}) {  // R / h
    const double h = 1e-4, r = ratio * h, side = std::max(4 * r, 3 * h);
    Spheres s;
    s.add({0.47 * side, 0.51 * side, 0.49 * side}, r);
    const Field f = field_of(s, {{0, 0, 0}, {side, side, side}}, h);
    worst = std::max(worst, std::fabs(f.sums.solid_volume_field / volume(r) - 1));
    EXPECT_GE(f.sums.void_min, -1e-12);
  }
  expect_outcome("grain against voxel", "R/h from 1e-3 to 40",
                 fmt::format("volume to {:.1e}, no voxel overfull", worst), worst <= 1e-12);
}

TEST(Fields, LargerThanTheBox) {
  Spheres s;
  s.add({5e-4, 5e-4, -1e-3}, 1.2e-3);  // a cap reaches into the box, cut by its sides too
  const double inside = field_of(s, kUnit, 5e-5).sums.solid_volume_field;
  const Box around{{-2e-3, -2e-3, -3e-3}, {3e-3, 3e-3, 1e-3}};
  double parts = 0;  // the box around, cut into 4 x 4 x 4 boxes of which ours is one
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) {
      for (int k = 0; k < 4; ++k) {
        const auto edge = [](double lo, double mid0, double mid1, double hi, int at) {
          const double edges[] = {lo, mid0, 0.5 * (mid0 + mid1), mid1, hi};
          return std::pair{edges[at], edges[at + 1]};
        };
        const auto [x0, x1] = edge(around.lo.x, 0, 1e-3, around.hi.x, i);
        const auto [y0, y1] = edge(around.lo.y, 0, 1e-3, around.hi.y, j);
        const auto [z0, z1] = edge(around.lo.z, -1e-3, 0, around.hi.z, k);
        parts += sphere_box_volume({5e-4, 5e-4, -1e-3}, 1.2e-3, {{x0, y0, z0}, {x1, y1, z1}});
      }
    }
  }
  const double error = std::fabs(parts / volume(1.2e-3) - 1);
  const double exact = sphere_box_volume({5e-4, 5e-4, -1e-3}, 1.2e-3, kUnit);
  expect_outcome("grain larger than the box", "clipped to the box",
                 fmt::format("inside to {:.1e}, inside + outside = whole to {:.1e}",
                             std::fabs(inside / exact - 1), error),
                 std::fabs(inside / exact - 1) <= 1e-12 && error <= 1e-12);
}

TEST(Fields, OverlappingGrainsOverfillAndSaySo) {
  const double r = 1e-4, d = 0.3e-4;
  Spheres s;
  s.add({5e-4, 5e-4, 5e-4}, r);
  s.add({5e-4 + d, 5e-4, 5e-4}, r);
  const Field f = field_of(s, kUnit, 2e-5);
  const double sum = f.sums.solid_volume_field / (2 * volume(r)) - 1;
  expect_outcome(
      "overlapping grains", "0.85 of a diameter deep",
      fmt::format("both counted (to {:.1e}), {} voxels with negative void fraction (down to {:.2f}) "
                  "reported, none clamped",
                  std::fabs(sum), f.sums.negative_voxels, f.sums.void_min),
      std::fabs(sum) <= 1e-12 && f.sums.negative_voxels > 0 && f.sums.void_min < -0.9);
}

TEST(Fields, FarFromTheOrigin) {
  const double far = 1024;  // [m], a binary number, so that only places are rounded: by 1e-13 m
  Spheres near, away;
  for (int i = 0; i < 20; ++i) {
    const Vec3d p{1e-4 + 4e-5 * i, 5e-4, 3e-4 + 1e-5 * i};
    near.add(p, 2e-5);
    away.add(p + Vec3d{far, far, far}, 2e-5);
  }
  const double a = field_of(near, kUnit, 2e-5).sums.solid_volume_field;
  const double b = field_of(away, {kUnit.lo + Vec3d{far, far, far}, kUnit.hi + Vec3d{far, far, far}}, 2e-5)
                       .sums.solid_volume_field;
  expect_outcome("domain far from the origin", "1 km away, grains of 40 um",
                 fmt::format("the same volume to {:.1e}", std::fabs(b / a - 1)),
                 std::fabs(b / a - 1) <= 1e-12);
}

TEST(Fields, WhatIsNoNumberIsRefused) {
  int refused = 0;
  for (const double bad : {std::nan(""), double{INFINITY}, -1e-5, 0.0}) {
    Spheres s;
    s.add({1e-4, 1e-4, 1e-4}, bad);
    try {
      field_of(s, kUnit, 1e-4);
    } catch (const InputError&) {
      ++refused;
    }
  }
  expect_outcome("radius NaN, infinite, negative, zero", "fields", "refused before anything is computed",
                 refused == 4);
}

}  // namespace
}  // namespace interstice::voxel
