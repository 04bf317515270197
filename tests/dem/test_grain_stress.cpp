#include <gtest/gtest.h>

#include "dem/grain_stress.h"
#include "dem/wall_distance.h"
#include "tests/dem/scenes.h"

namespace interstice::dem {
namespace {

double volume_of(double r) { return 4.0 / 3 * M_PI * r * r * r; }

/// Hertz, of two grains of the powder's stiffness.
double hertz_force(double a, double b, double overlap) {
  const double e_star = 1e9 / (2 * (1 - 0.3 * 0.3));
  return 4.0 / 3 * e_star * std::sqrt(a * b / (a + b)) * std::pow(overlap, 1.5);
}

TEST(GrainStress, OfTwoTouchingGrainsIsForceTimesBranchOverVolume) {
  const double a = 20e-6, b = 12e-6, overlap = 1e-8, distance = a + b - overlap;
  Simulation sim(testing::plain_model(testing::powder(), {1, 0, 0, 0}, {}), 1e-13);
  const Vec3d along{2.0 / 3, -2.0 / 3, 1.0 / 3};
  sim.add_grains(std::vector<NewGrain>{{{0, 0, 0}, a, {}, {}, 0, 0}, {distance * along, b, {}, {}, 0, 0}});
  sim.advance(1);
  const double force = hertz_force(a, b, overlap);
  const GrainStresses all = grain_stresses(sim);
  const std::array<double, 6> direction{along.x * along.x, along.y * along.y, along.z * along.z,
                                        along.x * along.y, along.y * along.z, along.x * along.z};
  for (std::size_t c = 0; c < 6; ++c) {
    // In the first step both move by some 1e-20 m, of an overlap of 1e-8 m known to 1e-16 of the distance.
    const double first = -force * distance * a / (a + b) * direction[c] / volume_of(a);
    const double second = -force * distance * b / (a + b) * direction[c] / volume_of(b);
    EXPECT_NEAR(all.stress[c][0] / first, 1, 1e-6) << c;
    EXPECT_NEAR(all.stress[c][1] / second, 1, 1e-6) << c;
  }
  EXPECT_EQ(all.contacts[0], 1);
  EXPECT_EQ(all.contacts[1], 1);
}

TEST(GrainStress, OfACompressedCubicLatticeIsForceOverTheCellsFace) {
  const double r = 20e-6, overlap = 2e-8, spacing = 2 * r - overlap;
  const int n = 4;
  Model m = testing::plain_model(testing::powder(), {1, 0, 0, 0}, {});
  m.domain = {{0, 0, 0}, {n * spacing, n * spacing, n * spacing}};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::periodic, AxisBoundary::periodic};
  Simulation sim(m, 1e-13);
  std::vector<NewGrain> grains;
  for (int i = 0; i < n * n * n; ++i)
    grains.push_back({{(i % n + 0.5) * spacing, (i / n % n + 0.5) * spacing, (i / n / n + 0.5) * spacing},
                      r,
                      {},
                      {},
                      0,
                      0});
  sim.add_grains(grains);
  sim.advance(1);
  const double pressure = hertz_force(r, r, overlap) / (spacing * spacing);
  const GrainStresses all = grain_stresses(sim);
  std::array<double, 6> mean{};
  for (std::size_t c = 0; c < 6; ++c)
    for (const double stress : all.stress[c]) mean[c] += stress * volume_of(r) / std::pow(n * spacing, 3);
  // places are rounded to 1e-16 of some 1e-4 m, 1e-12 of the overlap
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(-mean[c] / pressure, 1, 1e-9);
  for (std::size_t c = 3; c < 6; ++c) EXPECT_NEAR(mean[c] / pressure, 0, 1e-9);
  for (const double contacts : all.contacts) EXPECT_EQ(contacts, 6);
}

TEST(GrainStress, CountsWalls) {
  const double r = 50e-6;
  Model m = testing::plain_model({2500, 1e7, 0.3}, {0.2, 0.5, 0, 0}, testing::with_friction());
  m.gravity = {0, 0, -9.81};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  Simulation sim(m, 2e-7);
  std::vector<NewGrain> grains;
  for (int i = 0; i < 3; ++i) grains.push_back({{1e-5, 2e-5, r + 2 * r * i}, r, {}, {}, 0, 0});
  sim.add_grains(grains);
  sim.advance(200000);  // at rest
  const double weight = volume_of(r) * 2500 * 9.81;
  const GrainStresses all = grain_stresses(sim);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto n = static_cast<double>(i);
    // what lies above presses from above, and with the grain's own weight from below; r up to overlaps of
    // 1e-3
    EXPECT_NEAR(all.stress[2][i] / (-(2 - n + 3 - n) * weight * r / volume_of(r)), 1, 2e-3) << i;
    EXPECT_NEAR(all.stress[0][i] / all.stress[2][i], 0, 1e-6) << i;
  }
  EXPECT_EQ(all.contacts, (std::vector<double>{2, 2, 1}));
}

TEST(GrainStress, OfAGrainByItselfIsNone) {
  Simulation sim(testing::plain_model(testing::powder(), {1, 0, 0, 0}, {}), 1e-9);
  sim.add_grains(std::vector<NewGrain>{{{0, 0, 0}, 1e-5, {}, {}, 0, 0}});
  for (const int steps : {0, 1}) {  // before the first step there are no lists yet
    sim.advance(steps);
    const GrainStresses all = grain_stresses(sim);
    ASSERT_EQ(all.contacts, std::vector<double>{0});
    for (const auto& component : all.stress) EXPECT_EQ(component, std::vector<double>{0});
  }
}

TEST(GrainStress, SumsToTheVirialOfAllContacts) {
  Simulation sim = testing::falling_cloud(400);
  sim.advance(4000);
  const GrainStresses all = grain_stresses(sim);
  const SearchSpace space = sim.search_space();
  const auto rows = sim.rows();
  double trace = 0, expected = 0, magnitude = 0;
  GrainColumns columns;
  sim.copy_columns(columns);
  for (std::size_t i = 0; i < all.contacts.size(); ++i)
    trace += (all.stress[0][i] + all.stress[1][i] + all.stress[2][i]) * volume_of(columns.radius[i]);
  const PairContacts& pairs = sim.pair_contacts();
  for (std::size_t k = 0; k < pairs.places(); ++k) {
    if (pairs.memories().state(k) == ContactState::apart) continue;
    const GrainRow &a = rows[pairs.pair(k).a], &b = rows[pairs.pair(k).b];
    const double work = dot(separation(b.position(), a.position(), space), pairs.memories().force(k));
    expected += work, magnitude += std::abs(work);
  }
  for (std::size_t slot = 0; slot < rows.size(); ++slot)
    for (const WallContact& c : sim.wall_contacts().of(slot)) {
      if (c.state == ContactState::apart) continue;
      const auto surface = wall_distance(sim.walls()[c.wall], rows[slot].position());
      const double work = -surface.distance * dot(surface.normal, c.force);
      expected += work, magnitude += std::abs(work);
    }
  ASSERT_GT(magnitude, 0);
  EXPECT_NEAR(trace, expected, 1e-12 * magnitude);  // the same numbers in another order
}

}  // namespace
}  // namespace interstice::dem
