#include <gtest/gtest.h>

#include <set>

#include "dem/rain.h"
#include "tests/dem/scenes.h"

namespace interstice::dem {
namespace {

Rain rain_of(std::size_t n, std::uint64_t seed) {
  Rain rain;
  Random sizes(seed, 0);
  for (std::size_t i = 0; i < n; ++i) rain.radii.push_back(sizes.uniform(3e-6, 30e-6));
  rain.box = {{0, 0, 1e-4}, {5e-4, 5e-4, 5e-4}};
  rain.velocity = {0, 0, -0.1};
  rain.random = Random(seed, 1);
  return rain;
}

Simulation empty_box() {
  Model m = testing::plain_model(testing::powder(), {0.35, 0.3, 0.005, 0}, testing::with_rolling());
  m.gravity = {0, 0, -9.81};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}, {Plane{{0, 0, 0}, {1, 0, 0}}, 0}};
  return Simulation(m, 2e-8);
}

TEST(Rain, PlacesGrainsInsideItsBoxWithoutOverlap) {
  Simulation sim = empty_box();
  Rain rain = rain_of(4000, 1);
  const std::size_t first = pour(sim, rain);
  EXPECT_GT(first, 200u);
  EXPECT_LT(first, 4000u);  // the box is full before all are in
  sim.advance(30000);
  const std::size_t second = pour(sim, rain);
  EXPECT_GT(second, 0u);
  const auto rows = sim.rows();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i].id < static_cast<std::int64_t>(first)) continue;  // has moved since
    const GrainRow& g = rows[i];
    EXPECT_GE(g.x - g.radius, rain.box.lo.x);
    EXPECT_LE(g.z + g.radius, rain.box.hi.z);
    for (std::size_t j = 0; j < rows.size(); ++j) {
      if (i == j) continue;
      EXPECT_GT(norm(g.position() - rows[j].position()), g.radius + rows[j].radius);
    }
  }
}

TEST(Rain, MakesRoomForGrainsThatReachInFromOutside) {
  // The box holds one place for a grain of 10 um; a large grain stands before one of its faces, its centre
  // outside.
  for (const double gap : {-1e-6, 1e-6}) {
    for (int axis = 0; axis < 3; ++axis) {
      Model m = testing::plain_model(testing::powder(), {0.35, 0.3, 0.005, 0}, testing::with_rolling());
      Simulation sim(m, 2e-8);
      Rain rain;
      rain.radii = {10e-6};
      rain.box = {{1e-4, 1e-4, 1e-4}, {1.2e-4 + 1e-12, 1.2e-4 + 1e-12, 1.2e-4 + 1e-12}};
      Vec3d before{1.1e-4, 1.1e-4, 1.1e-4};
      before[axis] += 10e-6 + 30e-6 + gap;
      sim.add_grains(std::vector<NewGrain>{{before, 30e-6}});
      EXPECT_EQ(pour(sim, rain), gap > 0 ? 1u : 0u) << axis;
    }
  }
}

TEST(Rain, FallsIntoABoxOfAnyWidth) {  // 1 m, 10^15 cells of the largest grain's size
  Model m = testing::plain_model(testing::powder(), {0.35, 0.3, 0.005, 0}, testing::with_rolling());
  m.domain = {{0, 0, 0}, {1, 1, 1}};
  Simulation sim(m, 2e-8);
  Rain rain = rain_of(2000, 6);
  rain.box = m.domain;
  EXPECT_EQ(pour(sim, rain), 2000u);
  EXPECT_EQ(sim.grains(), 2000u);
}

TEST(Rain, KeepsTheOrderOfSizes) {
  Simulation sim = empty_box();
  Rain rain = rain_of(300, 2);
  pour(sim, rain);
  for (const GrainRow& g : sim.rows()) EXPECT_EQ(g.radius, rain.radii[static_cast<std::size_t>(g.id)]);
}

TEST(Rain, IsTheSameForTheSameSeedOnly) {
  Simulation a = empty_box(), b = empty_box(), c = empty_box();
  Rain ra = rain_of(100, 3), rb = rain_of(100, 3), rc = rain_of(100, 4);
  pour(a, ra), pour(b, rb), pour(c, rc);
  GrainColumns ca, cb, cc;
  a.copy_columns(ca), b.copy_columns(cb), c.copy_columns(cc);
  EXPECT_EQ(ca.x, cb.x);
  EXPECT_NE(ca.x, cc.x);
}

TEST(Rain, FinishesAndThenDoesNothing) {
  Simulation sim = empty_box();
  Rain rain = rain_of(20, 5);
  EXPECT_EQ(pour(sim, rain), 20u);
  EXPECT_TRUE(rain.finished());
  EXPECT_EQ(pour(sim, rain), 0u);
}

TEST(Random, IsUniformAndItsStreamsDiffer) {
  Random a(1, 0), b(1, 1);
  double sum = 0, square = 0, product = 0;
  constexpr int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double u = a.uniform(), v = b.uniform();
    ASSERT_GT(u, 0);
    ASSERT_LT(u, 1);
    sum += u, square += u * u, product += (u - 0.5) * (v - 0.5);
  }
  EXPECT_NEAR(sum / n, 0.5, 5 * std::sqrt(1.0 / 12 / n));  // five standard errors
  EXPECT_NEAR(square / n, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / n));
  EXPECT_NEAR(product / n, 0, 5.0 / 12 / std::sqrt(n));
}

}  // namespace
}  // namespace interstice::dem
