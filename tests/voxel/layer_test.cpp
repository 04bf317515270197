// Columns of a layer against sums over the spheres.
#include "voxel/layer.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "tests/voxel/support.h"
#include "voxel/overlap.h"

namespace interstice::voxel::test {
namespace {

LayerRequest request_for(std::int64_t nx, std::int64_t ny) {
  return {{{0, 0, 10e-6}, {300e-6, 200e-6, 90e-6}}, {nx, ny}, {false, false, false}, 4430};
}

Spheres grains(std::size_t count = 150) {
  return random_spheres(count, {{-20e-6, -20e-6, 0}, {320e-6, 220e-6, 110e-6}}, 2.5e-6, 32.5e-6, 61);
}

// Gaps higher than the spheres, and lower, so that floor and top cut the same sphere.
class LayerColumnsOf : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Heights, LayerColumnsOf, testing::Values(80e-6, 15e-6));

TEST_P(LayerColumnsOf, AreSumsOverSpheres) {
  LayerRequest request = request_for(9, 4);
  const double gap_height = GetParam(), ceiling = 10e-6 + gap_height;
  request.box.hi.z = ceiling;
  const Spheres spheres = grains();
  const Solids walls{{Box{{-1, -1, -1}, {50e-6, 77e-6, 10e-6 + 0.6 * gap_height}}}};
  const LayerColumns columns = layer_columns(spheres.view(), walls, request);
  const double dx = 300e-6 / 9, dy = 200e-6 / 4;
  ASSERT_EQ(columns.solid_fraction.size(), 36u);
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 9; ++i) {
      const auto c = static_cast<std::size_t>(i + 9 * j);
      const Box gap{{i * dx, j * dy, 10e-6}, {(i + 1) * dx, (j + 1) * dy, ceiling}};
      Box whole = gap;
      whole.hi.z = 1;
      double in_gap = 0, above = 0, top = 0;
      for (std::size_t s = 0; s < spheres.size(); ++s) {
        const Vec3d p = spheres.center(s);
        const double r = spheres.radius[s];
        in_gap += sphere_box_volume(p, r, gap);
        above += sphere_box_volume(p, r, whole);
        const double ox = p.x - std::clamp(p.x, gap.lo.x, gap.hi.x),
                     oy = p.y - std::clamp(p.y, gap.lo.y, gap.hi.y);
        const double square = r * r - ox * ox - oy * oy;
        if (square > 0) top = std::max(top, p.z + std::sqrt(square) - 10e-6);
      }
      const double available = gap.volume() - solid_volume(walls, gap);
      // rounding of a hundred sums and of the columns' edges: 1e-13 of a column
      EXPECT_NEAR(columns.available_volume[c] / gap.volume(), available / gap.volume(), 1e-13);
      EXPECT_NEAR(columns.solid_fraction[c], in_gap / available, 1e-12);
      EXPECT_NEAR(columns.mass_density[c], 4430 * in_gap / available, 4430 * 1e-12);
      const double height = above / (available / gap_height);  // per area that the wall leaves free
      EXPECT_NEAR(columns.solid_height[c], height, 1e-4 * 1e-12);
      EXPECT_NEAR(columns.surface_height[c], top, 1e-4 * 1e-12);
      EXPECT_NEAR(columns.solid_fraction_below_surface[c], top > 0 ? height / top : 0, 1e-11);
      EXPECT_NEAR(columns.x[static_cast<std::size_t>(i)], (i + .5) * dx, 1e-18);
      EXPECT_NEAR(columns.y[static_cast<std::size_t>(j)], (j + .5) * dy, 1e-18);
    }
}

TEST(LayerColumns, HandValues) {
  // one sphere of 10 um resting on the floor in the middle of the second of two columns
  Spheres spheres;
  spheres.add({150e-6, 50e-6, 10e-6}, 10e-6);
  const LayerRequest request{{{0, 0, 0}, {200e-6, 100e-6, 15e-6}}, {2, 1}, {false, false, false}, 0};
  const LayerColumns columns = layer_columns(spheres.view(), {}, request);
  const double v = ball_volume(10e-6),
               cap = std::numbers::pi * 25e-12 * (30e-6 - 5e-6) / 3;  // above the gap: 5 um
  EXPECT_EQ(columns.solid_fraction[0], 0);
  EXPECT_EQ(columns.surface_height[0], 0);
  EXPECT_EQ(columns.solid_fraction_below_surface[0], 0);
  EXPECT_NEAR(columns.solid_fraction[1], (v - cap) / 1.5e-13, 1e-16);  // 1e-14 of the value
  EXPECT_NEAR(columns.solid_height[1], v / 1e-8, 1e-20);
  EXPECT_NEAR(columns.surface_height[1], 20e-6, 1e-19);
  EXPECT_EQ(columns.mass_density[1], 0);

  const LayerSummary summary = layer_summary(columns);
  const double fraction = (v - cap) / 1.5e-13;
  EXPECT_NEAR(summary.solid_fraction_gap, fraction / 2, 1e-16);
  EXPECT_NEAR(summary.solid_fraction_sd, fraction / std::sqrt(2.), 1e-16);  // of two values, N - 1
  EXPECT_NEAR(summary.solid_height, v / 2e-8, 1e-20);
  EXPECT_NEAR(summary.surface_height, 10e-6, 1e-19);
  EXPECT_NEAR(summary.solid_fraction_below_surface, v / 1e-8 / 20e-6, 1e-14);
}

TEST(LayerColumns, SumToTheSpheres) {
  Spheres spheres =
      random_spheres(200, {{35e-6, 35e-6, 60e-6}, {265e-6, 165e-6, 300e-6}}, 2.5e-6, 32.5e-6, 62);
  for (const auto& [nx, ny] : {std::pair{1, 1}, std::pair{7, 3}, std::pair{50, 41}}) {
    const LayerColumns columns = layer_columns(spheres.view(), {}, request_for(nx, ny));
    double sum = 0;
    for (const double height : columns.solid_height) sum += height * 300e-6 * 200e-6 / (nx * ny);
    EXPECT_NEAR(sum / spheres.volume(), 1, 1e-12);  // grains above the gap count in the solid height
  }
}

TEST(LayerColumns, PeriodicImagesComeBackOnTheOtherSide) {
  LayerRequest request = request_for(5, 3);
  request.periodic = {true, true, false};
  Spheres inside, shifted;
  for (std::size_t s = 0; s < 60; ++s) {
    Random random(63, s);
    const Vec3d p{random.uniform(0, 300e-6), random.uniform(0, 200e-6), random.uniform(50e-6, 200e-6)};
    inside.add(p, 20e-6);
    shifted.add(p + Vec3d{(s % 3 - 1.) * 300e-6, (s % 5 - 2.) * 200e-6, 0}, 20e-6);
  }
  const LayerColumns a = layer_columns(inside.view(), {}, request),
                     b = layer_columns(shifted.view(), {}, request);
  double sum = 0;
  for (std::size_t c = 0; c < 15; ++c) {
    EXPECT_NEAR(a.solid_fraction[c], b.solid_fraction[c], 1e-12);  // rounding of the shifted coordinates
    EXPECT_NEAR(a.surface_height[c], b.surface_height[c], 1e-16);
    sum += a.solid_height[c] * 300e-6 * 200e-6 / 15;
  }
  EXPECT_NEAR(sum / inside.volume(), 1, 1e-12);
}

TEST(LayerColumns, PowderBelowTheFloorDoesNotCount) {
  Spheres spheres;
  spheres.add({50e-6, 50e-6, 10e-6}, 20e-6);    // half below
  spheres.add({250e-6, 50e-6, -50e-6}, 20e-6);  // all below
  const LayerColumns columns = layer_columns(spheres.view(), {}, request_for(2, 1));
  EXPECT_NEAR(columns.solid_height[0] * 3e-8, ball_volume(20e-6) / 2, 1e-27);  // 1e-13 of it
  EXPECT_NEAR(columns.surface_height[0], 20e-6, 1e-19);
  EXPECT_EQ(columns.solid_height[1], 0);
  EXPECT_EQ(columns.surface_height[1], 0);
}

TEST(LayerColumns, AColumnFullOfWallHasNoFraction) {
  Spheres spheres;
  spheres.add({250e-6, 50e-6, 50e-6}, 20e-6);
  const Solids walls{{Box{{-1, -1, -1}, {150e-6, 1, 1}}}};
  const LayerColumns columns = layer_columns(spheres.view(), walls, request_for(2, 1));
  EXPECT_EQ(columns.available_volume[0], 0);
  EXPECT_EQ(columns.solid_fraction[0], 0);
  EXPECT_NEAR(layer_summary(columns).solid_fraction_gap, columns.solid_fraction[1], 1e-15);
}

TEST(LayerProfile, AveragesOverTheOtherAxis) {
  const LayerColumns columns = layer_columns(grains().view(), {}, request_for(6, 4));
  for (int axis = 0; axis < 2; ++axis) {
    const LayerProfile profile = layer_profile(columns, axis);
    ASSERT_EQ(profile.at, axis == 0 ? columns.x : columns.y);
    for (std::size_t p = 0; p < profile.at.size(); ++p) {
      double fraction = 0, height = 0, surface = 0;
      const std::size_t others = axis == 0 ? 4 : 6;
      for (std::size_t q = 0; q < others; ++q) {
        const std::size_t c = axis == 0 ? p + 6 * q : q + 6 * p;
        fraction += columns.solid_fraction[c];
        height += columns.solid_height[c];
        surface += columns.surface_height[c];
      }
      const auto n = static_cast<double>(others);
      EXPECT_NEAR(profile.solid_fraction[p], fraction / n, 1e-14);  // no walls: all columns weigh the same
      EXPECT_NEAR(profile.solid_height[p], height / n, 1e-18);
      EXPECT_NEAR(profile.surface_height[p], surface / n, 1e-18);
      EXPECT_NEAR(profile.solid_fraction_below_surface[p], height / surface, 1e-14);
    }
  }
}

TEST(LayerColumns, EmptyAndRefused) {
  const LayerColumns columns = layer_columns({}, {}, request_for(3, 2));
  EXPECT_EQ(layer_summary(columns).solid_fraction_gap, 0);
  EXPECT_EQ(layer_summary(columns).solid_fraction_below_surface, 0);
  EXPECT_THROW(layer_columns({}, {}, request_for(0, 2)), InputError);
  LayerRequest flat = request_for(3, 2);
  flat.box.hi.z = flat.box.lo.z;
  EXPECT_THROW(layer_columns({}, {}, flat), InputError);
  Spheres bad = grains(3);
  bad.z[1] = std::nan("");
  EXPECT_THROW(layer_columns(bad.view(), {}, request_for(3, 2)), InputError);
}

TEST(LayerSummary, WallsThatCloseInMakeTheLayerHigher) {
  // The same grains on a third of the ground: three times the solid height, whatever the columns.
  Spheres spheres;
  for (int i = 0; i < 8; ++i) spheres.add({(20 + 35. * i) * 1e-6, 100e-6, 40e-6}, 15e-6);
  const double third = 200e-6 / 3;
  const Solids closed{{Box{{-1, -1, -1}, {1, third, 1}}, Box{{-1, 2 * third, -1}, {1, 1, 1}}}};
  for (const std::int64_t ny : {1, 3, 10}) {
    const LayerSummary open = layer_summary(layer_columns(spheres.view(), {}, request_for(4, ny)));
    const LayerSummary narrow = layer_summary(layer_columns(spheres.view(), closed, request_for(4, ny)));
    EXPECT_NEAR(narrow.solid_height / open.solid_height, 3, 1e-9);
    EXPECT_NEAR(narrow.solid_fraction_gap / open.solid_fraction_gap, 3, 1e-9);
  }
}

}  // namespace
}  // namespace interstice::voxel::test
