// Steps at two rates: the same bits whatever the lists, motion as with short steps for all, and nothing lost.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <array>
#include <cmath>

#include "base/error.h"
#include "dem/energy.h"
#include "dem/statistics.h"
#include "tests/dem/same_bits.h"
#include "tests/dem/scenes.h"

namespace interstice::dem {
namespace {

using testing::expect_same_bits;
using testing::falling_cloud;

constexpr Rates kRates{12e-6, 4};  // of 5 to 32 um a quarter is quick

SimulationOptions rated(SimulationOptions options = {}) {
  options.rates = kRates;
  return options;
}

GrainColumns columns(const Simulation& sim) {
  GrainColumns c;
  sim.copy_columns(c);
  return c;
}

GrainColumns fallen(const SimulationOptions& options, int threads, std::size_t grains = 900,
                    std::int64_t steps = 4000, std::int64_t at_once = 4000) {
  tbb::task_arena arena(threads);
  return arena.execute([&] {
    Simulation sim = falling_cloud(grains, options);
    for (std::int64_t s = 0; s < steps; s += at_once) sim.advance(at_once);
    EXPECT_GT(sim.rebuilds(), 1);
    return columns(sim);
  });
}

TEST(TwoRates, GiveTheSameBitsForAnyThreadsAndSkin) {
  const GrainColumns one = fallen(rated(), 1);
  expect_same_bits(one, fallen(rated(), 2));
  expect_same_bits(one, fallen(rated(), 4));
  expect_same_bits(one, fallen(rated({.skin = 1e-6}), 2));
  expect_same_bits(one, fallen(rated({.skin = 2e-5}), 2));
}

TEST(TwoRates, GiveTheSameBitsInMixedPrecision) {
  const SimulationOptions mixed = rated({.precision = Precision::mixed});
  SimulationOptions skinned = mixed;
  skinned.skin = 1e-5;
  expect_same_bits(fallen(mixed, 1), fallen(skinned, 4));
}

TEST(TwoRates, GiveTheBitsOfTheReference) {
  expect_same_bits(fallen(rated(), 2, 200), fallen(rated({.reference = true}), 1, 200));
}

TEST(TwoRates, GiveTheSameBitsHoweverStepsAreGrouped) {
  expect_same_bits(fallen(rated(), 2, 300, 1500, 1500), fallen(rated(), 2, 300, 1500, 3));
}

TEST(TwoRates, GiveTheSameBitsAfterARestart) {
  Simulation whole = falling_cloud(300, rated());
  whole.advance(4000);
  Simulation first = falling_cloud(300, rated());
  SavedState saved;
  do {  // a moment with both kinds of contact
    first.advance(37);
    saved = first.save();
  } while (first.step() < 2000 || saved.integer.at("pair_ids").empty() ||
           saved.integer.at("wall_ids").empty());
  ASSERT_LT(first.step(), 4000);
  Simulation second(first.model(), first.time_step(), rated());
  second.restore(saved);
  second.advance(4000 - first.step());
  expect_same_bits(columns(whole), columns(second));
}

/// A slow grain that no quick one touches moves as it would without any: a beat's sums are the step's.
TEST(TwoRates, DoNotTouchWhatQuickGrainsDoNotTouch) {
  Model m = testing::plain_model(testing::powder(), {0.35, 0.3, 0.005, 1e6}, testing::everything());
  m.gravity = {0, 0, -9.81};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  std::vector<NewGrain> slow(2);
  slow[0].radius = slow[1].radius = 30e-6;
  slow[0].position = {0, 0, 31e-6}, slow[1].position = {5e-6, 2e-6, 95e-6};
  slow[1].velocity = {0.01, 0, -0.5};
  NewGrain quick;  // so near that it is listed with them, and never touches
  quick.radius = 5e-6;
  quick.position = {40e-6, 0, 40e-6};
  std::vector<NewGrain> all = slow;
  all.push_back(quick);
  Simulation with(m, 4e-8, {.skin = 2e-5, .rates = {10e-6, 4}}), without(m, 4e-8, {.rates = {10e-6, 4}});
  without.add_grains(slow);
  with.add_grains(all);
  for (int i = 0; i < 20; ++i) {
    with.advance(50), without.advance(50);
    const GrainColumns a = columns(with), b = columns(without);
    for (std::size_t g = 0; g < 2; ++g) {
      ASSERT_EQ(a.x[g], b.x[g]) << i;
      ASSERT_EQ(a.z[g], b.z[g]) << i;
      ASSERT_EQ(a.vz[g], b.vz[g]) << i;
      ASSERT_EQ(a.wy[g], b.wy[g]) << i;
    }
  }
}

/// Action and reaction act at the same beats: momentum is lost to roundings only.
TEST(TwoRates, KeepMomentum) {
  Model m = testing::plain_model(testing::powder(), {0.35, 0.3, 0.005, 1e6}, testing::everything());
  Random random(3, 0);
  std::vector<NewGrain> grains;
  for (int i = 0; i < 216; ++i) {
    NewGrain g;
    g.radius = random.uniform(5e-6, 30e-6);
    const double side = 62e-6;
    g.position = {(i % 6) * side, (i / 6 % 6) * side, (i / 36) * side};
    g.velocity = Vec3d{190e-6, 190e-6, 190e-6} - g.position;
    g.velocity = 4e3 * g.velocity;  // all towards the middle
    grains.push_back(g);
  }
  Simulation sim(m, 4e-8, {.rates = {15e-6, 4}});
  sim.add_grains(grains);
  const auto momentum = [&] {
    Vec3d sum{0, 0, 0};
    for (const GrainRow& g : sim.rows()) sum = sum + g.mass * g.velocity();
    return sum;
  };
  double size = 0;
  for (const GrainRow& g : sim.rows()) size += g.mass * norm(g.velocity());
  const Vec3d before = momentum();
  sim.advance(5000);
  double rest = 0;
  for (const GrainRow& g : sim.rows()) rest += g.mass * norm(g.velocity());
  ASSERT_LT(rest, 0.5 * size);  // they did collide
  EXPECT_LT(norm(momentum() - before), 1e-12 * size);
}

/// The speeds at which three elastic bodies fly apart, after a small one was pressed between two large ones.
std::array<double, 3> speeds_apart(double step, const Rates& rates) {
  Model m = testing::plain_model({8200, 1e8, 0.3}, {1, 0, 0, 0}, {});
  Simulation sim(m, step, {.rates = rates});
  const double large = 30e-6, small = 8e-6, gap = 1e-7;
  std::vector<NewGrain> grains(3);
  grains[0].radius = grains[2].radius = large;
  grains[1].radius = small;
  grains[0].velocity = {0.1, 0, 0};
  grains[1].position = {large + small + gap, 0, 0};
  grains[2].position = {2 * (large + small) + 3 * gap, 0, 0};
  grains[2].velocity = {-0.1, 0, 0};
  sim.add_grains(grains);
  sim.advance(std::llround(32e-6 / step));
  const GrainColumns c = columns(sim);
  EXPECT_EQ(contact_statistics(sim).contacts, 0);
  return {c.vx[0], c.vx[1], c.vx[2]};
}

/// Short steps for the small body alone do what short steps for all do, and the error falls with the square
/// of the step.
TEST(TwoRates, AreOfSecondOrder) {
  const std::array<double, 3> exact = speeds_apart(1e-10, {});
  const auto error = [&](const std::array<double, 3>& speeds) {
    double worst = 0;
    for (std::size_t i = 0; i < 3; ++i) worst = std::max(worst, std::abs(speeds[i] - exact[i]));
    return worst / std::abs(exact[0]);
  };
  const double coarse = error(speeds_apart(6.4e-8, {10e-6, 4})),
               fine = error(speeds_apart(1.6e-8, {10e-6, 4}));
  EXPECT_NEAR(coarse / error(speeds_apart(1.6e-8, {})), 1, 0.01);  // no two slow ones touch here
  EXPECT_LT(coarse, error(speeds_apart(6.4e-8, {})) / 10);
  EXPECT_NEAR(coarse / fine, 16, 1);
}

/// Elastic grains in a box gain and lose no energy but what plain steps of the same length do, too.
TEST(TwoRates, KeepEnergy) {
  Model m = testing::plain_model({8200, 1e8, 0.3}, {1, 0, 0, 0}, {});
  const double side = 3e-4;
  for (const Vec3d& n : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    m.walls.push_back({Plane{{0, 0, 0}, n}, 0});
    m.walls.push_back({Plane{side * n, -1.0 * n}, 0});
  }
  Simulation sim(m, 6e-8, {.rates = {12e-6, 3}});
  Random random(9, 0);
  std::vector<NewGrain> grains;
  for (int i = 0; i < 64; ++i) {
    NewGrain g;
    g.radius = i % 2 == 0 ? 8e-6 : 25e-6;
    g.position = {(0.5 + i % 4) * side / 4, (0.5 + i / 4 % 4) * side / 4, (0.5 + i / 16) * side / 4};
    g.velocity = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    grains.push_back(g);
  }
  sim.add_grains(grains);
  const double before = motion_statistics(sim).kinetic_energy;
  double mean = 0;
  for (int i = 0; i < 200; ++i) {
    sim.advance(100);
    mean += motion_statistics(sim).kinetic_energy / 200;
  }
  // What is stored in contacts comes back; some 30 impacts a grain.
  EXPECT_NEAR(motion_statistics(sim).kinetic_energy, before, 0.02 * before);
  EXPECT_LT(mean, before);
}

/// The check of the step looks at each contact with the step that it gets.
TEST(TwoRates, AreCheckedByTheirOwnSteps) {
  const auto ratio = [](double quick_radius) {
    Model m = testing::plain_model(testing::powder(), {0.35, 0.3, 0.005, 0}, testing::with_friction());
    Simulation sim(m, 1e-8, {.rates = {10e-6, 4}});
    std::vector<NewGrain> grains(2);
    grains[0].radius = quick_radius, grains[1].radius = 20e-6;
    grains[1].position = {0.999 * (quick_radius + 20e-6), 0, 0};
    sim.add_grains(grains);
    sim.advance(1);
    return check_step(sim).ratio;
  };
  EXPECT_NEAR(ratio(10.001e-6) / ratio(9.999e-6), 4, 0.05);
}

TEST(TwoRates, ExcludeWhatTheyCannotDo) {
  const Model m = testing::plain_model(testing::powder(), {}, {});
  EXPECT_THROW(Simulation(m, 1e-8, rated({.energies = true})), InputError);
  EXPECT_THROW(Simulation(m, 1e-8, rated({.sleep_tolerance = 0.05})), InputError);
  EXPECT_THROW(Simulation(m, 1e-8, {.rates = {1e-5, 0}}), InputError);
  EXPECT_THROW(Simulation(m, 1e-8, {.rates = {-1, 2}}), InputError);
}

}  // namespace
}  // namespace interstice::dem
