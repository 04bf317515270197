// Contacts with walls are worked on sixteen at a time: what a wall does to a grain must not depend on who
// else is near one.
#include <gtest/gtest.h>

#include <algorithm>

#include "dem/simd/pack.h"
#include "dem/wall_distance.h"
#include "tests/dem/same_bits.h"
#include "tests/dem/scenes.h"

namespace interstice::dem {
namespace {

using testing::everything;
using testing::plain_model;
using testing::powder;

/// A trough of five walls with a step in it that moves and a wall of another material: one plane is oblique.
Model trough() {
  Model m = plain_model(powder(), {0.35, 0.3, 0.005, 1e6}, everything());
  m.materials.push_back({2500, 5e8, 0.25});
  m.pairs = {{0.35, 0.3, 0.005, 1e6}, {0.6, 0.7, 0.01, 2e5}, {0.6, 0.7, 0.01, 2e5}, {0.9, 0.1, 0.02, 0}};
  m.gravity = {0, 0, -9.81};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0},
             {Plane{{0, 0, 0}, {1, 0, 0}}, 1},
             {Plane{{0, 0, 0}, {0, 1, 0}}, 0},
             {Plane{{0, 0.07, 0}, {0, -0.8, 0.6}}, 1},
             {Box{{0.01, -1, -1}, {0.02, 1, 3e-3}}, 0}};
  return m;
}

/// Grains that never meet, a little above or inside one, two or three of the walls.
std::vector<NewGrain> scattered() {
  Random random(11, 0);
  std::vector<NewGrain> grains;
  for (int i = 0; i < 300; ++i) {
    NewGrain g;
    g.radius = random.uniform(20e-6, 90e-6);
    const double near = g.radius * random.uniform(0.995, 1.02);
    g.position = {3e-3, 2e-4 * (i + 1), near};  // on the floor
    if (i % 3 == 1) g.position.x = g.radius * random.uniform(0.995, 1.02);
    if (i % 3 == 2) g.position = {0.01 + 3e-5 * i, 2e-4 * (i + 1), 3e-3 + near};          // on the step
    if (i % 7 == 0) g.position = {0.01 - 0.6 * near, 2e-4 * (i + 1), 3e-3 + 0.8 * near};  // at its edge
    if (i % 11 == 3)  // on the oblique wall
      g.position = {3e-3 + 2e-5 * i, 0.07 + 0.6e-3 - 0.8 * near, 0.8e-3 + 0.6 * near};
    g.velocity = {random.uniform(-0.1, 0.1), 0, random.uniform(-0.1, 0)};
    g.spin = {random.uniform(-1e3, 1e3), random.uniform(-1e3, 1e3), 0};
    grains.push_back(g);
  }
  return grains;
}

GrainColumns after(const std::vector<NewGrain>& grains, Precision precision) {
  SimulationOptions options;
  options.precision = precision;
  Simulation sim(trough(), 1e-8, options);
  sim.set_wall_velocity(4, {0.02, 0, 0.01});
  sim.add_grains(grains);
  for (int i = 0; i < 3; ++i) sim.advance(100);
  GrainColumns columns;
  sim.copy_columns(columns);
  return columns;
}

class WallContacts : public ::testing::TestWithParam<Precision> {};

TEST_P(WallContacts, DoNotDependOnEachOther) {
  const std::vector<NewGrain> grains = scattered();
  const GrainColumns together = after(grains, GetParam());
  std::size_t pushed = 0;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const GrainColumns alone = after({grains[i]}, GetParam());
    GrainColumns one;
    const auto take = [i](const auto& from, auto& to) { to.assign(1, from[i]); };
    take(together.x, one.x), take(together.y, one.y), take(together.z, one.z);
    take(together.vx, one.vx), take(together.vy, one.vy), take(together.vz, one.vz);
    take(together.wx, one.wx), take(together.wy, one.wy), take(together.wz, one.wz);
    one.id = alone.id;
    ASSERT_NO_FATAL_FAILURE(testing::expect_same_bits(one, alone)) << "grain " << i;
    pushed += alone.wx[0] != grains[i].spin.x || alone.wy[0] != grains[i].spin.y;
  }
  EXPECT_GT(pushed, grains.size() / 3);  // the others fly past
}

INSTANTIATE_TEST_SUITE_P(Precisions, WallContacts, ::testing::Values(Precision::real64, Precision::mixed),
                         [](const auto& p) { return p.param == Precision::mixed ? "mixed" : "real64"; });

TEST(WallDistance, IsTheSameInLanes) {
  using Pack = simd::Pack<double, 16>;
  Random random(3, 0);
  const Shape shapes[] = {Plane{{0.1, 0.2, 0.3}, {0.6, 0, 0.8}}, Box{{-1, -2, -3}, {1, 2, 3}}};
  for (const Shape& shape : shapes) {
    for (int round = 0; round < 200; ++round) {
      double at[3][16];
      for (auto& axis : at)
        for (double& p : axis)
          p = round == 0 ? 0 : random.uniform(-4, 4);  // first in the centre: all but ties
      const WallDistance lanes =
          wall_distance(shape, Vec3<Pack>{Pack::load(at[0]), Pack::load(at[1]), Pack::load(at[2])});
      double distance[16], normal[3][16];
      lanes.distance.store(distance);
      for (int axis = 0; axis < 3; ++axis) lanes.normal[axis].store(normal[axis]);
      for (int i = 0; i < 16; ++i) {
        const WallDistance one = wall_distance(shape, Vec3d{at[0][i], at[1][i], at[2][i]});
        // A root in lanes is a unit in the last place off at most (simd/pack.h).
        EXPECT_NEAR(distance[i], one.distance, 4e-16 * (1 + std::abs(one.distance)));
        for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(normal[axis][i], one.normal[axis], 4e-16);
      }
    }
  }
}

// From the middle of a cube all faces are equally far: out through the first of them.
TEST(WallDistance, OfTiesTakesTheFirstFace) {
  const WallDistance out = wall_distance(Shape(Box{{0, 0, 0}, {2, 2, 2}}), Vec3d{1, 1, 1});
  EXPECT_EQ(out.distance, -1);
  EXPECT_EQ(out.normal, (Vec3d{-1, 0, 0}));
}

}  // namespace
}  // namespace interstice::dem
