#include <gtest/gtest.h>

#include "dem/statistics.h"
#include "tests/dem/scenes.h"

namespace interstice::dem {
namespace {

TEST(Statistics, ARestingColumnPressesWithItsWeight) {
  const double r = 50e-6;
  Model m = testing::plain_model({2500, 1e7, 0.3}, {0.2, 0.5, 0, 0}, testing::with_friction());
  m.gravity = {0, 0, -9.81};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  Simulation sim(m, 2e-7);
  std::vector<NewGrain> grains;
  for (int i = 0; i < 3; ++i) grains.push_back({{1e-5, 2e-5, r + 2 * r * i}, r, {}, {}, 0, 0});
  sim.add_grains(grains);
  sim.advance(200000);
  const double weight = 4.0 / 3 * M_PI * r * r * r * 2500 * 9.81;
  const WallStatistics w = wall_statistics(sim, 0);
  EXPECT_NEAR(w.normal_force / weight, 3, 1e-6);
  EXPECT_NEAR(w.shear_force / weight, 0, 1e-6);
  EXPECT_EQ(w.contacts, 1);
  EXPECT_EQ(w.particles, 1);
  const double e_star = 1e7 / (2 * 0.91),
               overlap = std::pow(3 * weight / (4.0 / 3 * e_star * std::sqrt(r)), 2.0 / 3);
  EXPECT_NEAR(w.contact_area / (M_PI * r * overlap), 1, 1e-6);
  EXPECT_DOUBLE_EQ(w.footprint_area, 2.5e-9);  // one cell of 50 um
  const ContactStatistics c = contact_statistics(sim);
  EXPECT_EQ(c.contacts, 2);
  EXPECT_NEAR(c.force_max / weight, 2, 1e-6);
  EXPECT_NEAR(c.force_mean / weight, 1.5, 1e-6);
  EXPECT_NEAR(c.normal_force_mean / weight, 1.5, 1e-6);
}

TEST(Statistics, KineticEnergyHasRotation) {
  Simulation sim(testing::plain_model(testing::powder(), {}, {}), 1e-9);
  const double r = 1e-4, mass = 4.0 / 3 * M_PI * r * r * r * 8200;
  sim.add_grains(std::vector<NewGrain>{{{0, 0, 0}, r, {2, 0, 0}, {0, 0, 1e4}, 0, 0}});
  EXPECT_NEAR(motion_statistics(sim).kinetic_energy / (0.5 * mass * (4 + 0.4 * r * r * 1e8)), 1, 1e-14);
  EXPECT_EQ(motion_statistics(sim).fastest, 2);
}

TEST(StepCheck, IsTheStepOverTheRootOfMassOverStiffness) {
  const double r = 20e-6, overlap = 1e-7;
  Simulation sim(testing::plain_model(testing::powder(), {1, 0, 0, 0}, {}), 1e-12);
  sim.add_grains(
      std::vector<NewGrain>{{{0, 0, 0}, r, {}, {}, 0, 0}, {{2 * r - overlap, 0, 0}, r, {}, {}, 0, 0}});
  EXPECT_EQ(check_step(sim).ratio, 0);  // nothing evaluated yet
  sim.advance(1);
  const double mass = 4.0 / 3 * M_PI * r * r * r * 8200 / 2;
  const double stiffness = 2 * (1e9 / 1.82) * std::sqrt(r / 2 * overlap);
  const StepCheck c = check_step(sim);
  EXPECT_NEAR(c.ratio / (1e-12 * std::sqrt(stiffness / mass)), 1, 1e-6);
  EXPECT_EQ(c.grain_a, 0);
  EXPECT_EQ(c.grain_b, 1);
}

}  // namespace
}  // namespace interstice::dem
