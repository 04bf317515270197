// Grains that sleep: what they do to the bits, to forces and energy, and that they wake in time.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

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

constexpr double kTolerance = 0.05, kStep = 1e-6;  // -, [s]
constexpr double kSide = 6e-4;                     // of a bed's floor [m]
constexpr std::size_t kFloor = 0, kTool = 1;       // walls
constexpr std::size_t kMostOfBed = 197;            // of 200 grains

/// Soft grains of 80 to 120 um on a floor (a box, so that it can be pulled away) between periodic sides; a
/// blade waits at the side, above the bed.
Model bed_model() {
  Model m = testing::plain_model({8200, 1e6, 0.3}, {0.2, 0.5, 0.005, 1e3}, testing::everything());
  m.domain = {{0, 0, -1e-2}, {kSide, kSide, 2e-2}};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::periodic, AxisBoundary::open};
  m.gravity = {0, 0, -9.81};
  m.walls = {{Box{{-1e-3, -1e-3, -1e-3}, {2e-3, 2e-3, 0}}, 0},
             {Box{{-2e-4, -1e-3, 1e-2}, {0, 2e-3, 1.1e-2}}, 0}};
  return m;
}

std::vector<NewGrain> loose_grains(std::size_t count) {
  Random random(5, 0);
  std::vector<NewGrain> grains;
  for (std::size_t i = 0; i < count; ++i) {
    NewGrain g;
    g.radius = random.uniform(40e-6, 60e-6);
    const double cell = 1.5e-4;
    const auto at = [&](std::size_t n) {
      return (static_cast<double>(n) + random.uniform(0.42, 0.58)) * cell;
    };
    g.position = {at(i % 4), at(i / 4 % 4), at(i / 16)};
    grains.push_back(g);
  }
  return grains;
}

Simulation poured_bed(std::size_t count, const SimulationOptions& options, const Model& model = bed_model()) {
  Simulation sim(model, kStep, options);
  sim.add_grains(loose_grains(count));
  return sim;
}

/// A bed of 200 grains that sleep, but for one or two that lie alone on the floor and spin about the
/// vertical, which no law here brakes; for 20 ms on end, so that no latecomer comes to rest any more.
const SavedState& sleeping_bed() {
  static const SavedState state = [] {
    Simulation sim = poured_bed(200, {.sleep_tolerance = kTolerance});
    int quiet = 0;
    for (int i = 0; i < 400 && quiet < 40; ++i) {
      sim.advance(500);
      quiet = sim.grains_asleep() < kMostOfBed ? 0 : quiet + 1;
    }
    EXPECT_EQ(quiet, 40);
    return sim.save();
  }();
  return state;
}

Simulation restored(const SavedState& state,
                    const SimulationOptions& options = {.sleep_tolerance = kTolerance},
                    const Model& model = bed_model()) {
  Simulation sim(model, kStep, options);
  sim.restore(state);
  return sim;
}

GrainColumns columns(const Simulation& sim) {
  GrainColumns c;
  sim.copy_columns(c);
  return c;
}

double top(const GrainColumns& c) {
  double z = 0;
  for (std::size_t i = 0; i < c.id.size(); ++i) z = std::max(z, c.z[i] + c.radius[i]);
  return z;
}

double weight(const Simulation& sim) {
  double sum = 0;
  for (const GrainRow& g : sim.rows()) sum += g.mass * 9.81;
  return sum;
}

/// A grain that falls gently onto the bed.
void drop_grain(Simulation& sim) {
  NewGrain g;
  g.radius = 40e-6;
  g.position = {0.5 * kSide, 0.4 * kSide, top(columns(sim)) + 45e-6};
  g.velocity = {0, 0, -0.005};
  sim.add_grains({&g, 1});
}

/// A grain falls on the bed: many wake, and some fall asleep again.
GrainColumns disturbed(const SimulationOptions& options, int threads, std::int64_t at_once = 12000) {
  tbb::task_arena arena(threads);
  return arena.execute([&] {
    Simulation sim = restored(sleeping_bed(), options);
    drop_grain(sim);
    for (std::int64_t s = 0; s < 12000; s += at_once) sim.advance(at_once);
    EXPECT_GT(sim.grains_asleep(), 10u);
    EXPECT_LT(sim.grains_asleep(), 190u);
    return columns(sim);
  });
}

TEST(SleepingBits, AreTheSameForAnyThreadsSkinAndOrder) {
  const GrainColumns one = disturbed({.sleep_tolerance = kTolerance}, 1);
  expect_same_bits(one, disturbed({.sleep_tolerance = kTolerance}, 2));
  expect_same_bits(one, disturbed({.sleep_tolerance = kTolerance}, 4));
  expect_same_bits(one, disturbed({.skin = 2e-6, .sleep_tolerance = kTolerance}, 1));
  expect_same_bits(one, disturbed({.skin = 4e-5, .sleep_tolerance = kTolerance}, 3));
}

/// The reference leaves nothing out, neither does a step after which forces are asked for.
TEST(SleepingBits, AreTheSameWhenNothingIsLeftOut) {
  const GrainColumns spared = disturbed({.sleep_tolerance = kTolerance}, 1);
  expect_same_bits(spared, disturbed({.reference = true, .sleep_tolerance = kTolerance}, 1));
  expect_same_bits(spared, disturbed({.sleep_tolerance = kTolerance}, 1, 1));
  expect_same_bits(spared, disturbed({.sleep_tolerance = kTolerance}, 2, 75));
}

TEST(SleepingBits, AreTheSameInMixedPrecisionToo) {
  const SimulationOptions options{.precision = Precision::mixed, .sleep_tolerance = kTolerance};
  SimulationOptions reference = options;
  reference.reference = true;
  const GrainColumns one = disturbed(options, 1);
  expect_same_bits(one, disturbed(options, 2, 300));
  expect_same_bits(one, disturbed(reference, 1));
}

TEST(SleepingBits, GoOnAfterSavingAndRestoring) {
  for (const std::int64_t stop : {700, 4001, 9984}) {
    Simulation whole = restored(sleeping_bed());
    drop_grain(whole);
    whole.advance(12000);
    Simulation first = restored(sleeping_bed());
    drop_grain(first);
    first.advance(stop);
    Simulation second = restored(first.save());
    EXPECT_EQ(first.grains_asleep(), second.grains_asleep());
    second.advance(12000 - stop);
    EXPECT_EQ(whole.grains_asleep(), second.grains_asleep());
    expect_same_bits(columns(whole), columns(second));
  }
}

TEST(SleepingBits, AreThoseOfAPlainRunWhileNobodySleeps) {
  Simulation plain = falling_cloud(300), sleeping = falling_cloud(300, {.sleep_tolerance = kTolerance});
  plain.advance(4000);
  sleeping.advance(4000);
  EXPECT_EQ(sleeping.grains_asleep(), 0u);
  expect_same_bits(columns(plain), columns(sleeping));
}

TEST(SleepingBed, StandsStillAndPressesTheFloorWithItsWeight) {
  Simulation sim = restored(sleeping_bed());
  const GrainColumns before = columns(sim);
  sim.advance(20000);
  const GrainColumns after = columns(sim);
  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.id.size(); ++i)
    moved += before.x[i] != after.x[i] || before.z[i] != after.z[i];
  EXPECT_LE(moved, before.id.size() - kMostOfBed);
  EXPECT_GE(sim.grains_asleep(), kMostOfBed);
  // Each sleeper may be out of balance by the tolerance, at worst all in one sense.
  EXPECT_NEAR(wall_statistics(sim, kFloor).normal_force, weight(sim), kTolerance * weight(sim));
}

/// Awake once more the bed hardly moves: nothing hung in it.
TEST(SleepingBed, StaysWhereItIsWhenItGoesOnAwake) {
  const SavedState& state = sleeping_bed();
  Simulation sim = restored(state, {});
  const GrainColumns before = columns(sim);
  sim.advance(20000);
  const GrainColumns after = columns(sim);
  for (std::size_t i = 0; i < before.id.size(); ++i)
    EXPECT_NEAR(after.z[i], before.z[i], 1e-6) << i;  // 1 % of d
}

TEST(SleepingBed, FallsWhenTheFloorIsTakenAway) {
  Simulation sim = restored(sleeping_bed());
  const GrainColumns before = columns(sim);
  sim.set_wall_velocity(kFloor, {0, 0, -2});
  sim.advance(5000);
  const GrainColumns after = columns(sim);
  const double t = 5000 * kStep, fall = 0.5 * 9.81 * t * t;
  double mean = 0;
  for (std::size_t i = 0; i < before.id.size(); ++i)
    mean += (before.z[i] - after.z[i]) / static_cast<double>(before.id.size());
  EXPECT_NEAR(mean, fall, 0.02 * fall);  // cohesion let the floor go a little late
  EXPECT_EQ(sim.grains_asleep(), 0u);
}

/// A floor that sinks from the start: no event wakes anyone, and what leans on it is slower than a grain at
/// rest may be. The bed must go down with it.
TEST(SleepingBed, FollowsAFloorThatCreeps) {
  Simulation sim = poured_bed(100, {.sleep_tolerance = kTolerance});
  const double speed = 1e-5;  // a thousandth of a diameter takes 10 ms
  sim.set_wall_velocity(kFloor, {0, 0, -speed});
  sim.advance(60000);
  const GrainColumns before = columns(sim);
  std::size_t most = 0;
  for (int i = 0; i < 100; ++i) {
    sim.advance(1000);
    most = std::max(most, sim.grains_asleep());
  }
  const GrainColumns after = columns(sim);
  double mean = 0;
  for (std::size_t i = 0; i < before.id.size(); ++i)
    mean += (before.z[i] - after.z[i]) / static_cast<double>(before.id.size());
  EXPECT_GT(most, 10u);  // else nothing is tested
  EXPECT_NEAR(mean, speed * 0.1, 0.1 * speed * 0.1);
}

/// The slider law creeps on a slope, slower here than what counts as standing still.
TEST(Sleepers, DoNotHangOnASlope) {
  Model m = testing::plain_model({8200, 1e6, 0.3}, {0.2, 0.5, 0, 0}, {.tangential = TangentialLaw::slider});
  m.gravity = {9.81 * std::sin(0.2), 0, -9.81 * std::cos(0.2)};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  m.slider_velocity = 5e-5;
  // Four grains that cannot roll: glued by nothing, but spinning is slowed at each other's sides; only the
  // plain run counts.
  const auto way = [&](double tolerance) {
    Simulation sim(m, kStep, {.sleep_tolerance = tolerance});
    NewGrain g;
    g.radius = 50e-6;
    g.position = {0, 0, 49.95e-6};
    sim.add_grains({&g, 1});
    sim.advance(100000);
    return columns(sim).x[0];
  };
  const double plain = way(0);
  EXPECT_NEAR(way(kTolerance), plain, 0.1 * plain);
}

TEST(SleepingBed, IsWokenByAGrainAndFallsAsleepAgain) {
  Simulation sim = restored(sleeping_bed());
  drop_grain(sim);
  std::size_t fewest = sim.grains();
  for (int i = 0; i < 1000 && (i < 50 || sim.grains_asleep() < kMostOfBed); ++i) {
    sim.advance(100);
    fewest = std::min(fewest, sim.grains_asleep());
  }
  EXPECT_LT(fewest, 190u);
  EXPECT_GE(sim.grains_asleep(), kMostOfBed);
  const GrainColumns c = columns(sim);
  EXPECT_LT(c.z.back(), top(c));  // it lies on the bed: nothing holds it above
  EXPECT_NEAR(wall_statistics(sim, kFloor).normal_force, weight(sim), kTolerance * weight(sim));
}

TEST(SleepingBed, IsShakenAwakeByItsFloor) {
  Simulation sim = restored(sleeping_bed());
  for (int i = 0; i < 20; ++i) {
    sim.set_wall_velocity(kFloor, {0, 0, i % 2 == 0 ? 5e-3 : -5e-3});  // 2 g on average, 400 Hz
    sim.advance(1000);
    EXPECT_EQ(sim.grains_asleep(), 0u);
  }
}

/// A blade that comes at a constant speed from outside wakes what it meets, and pushes it along as it does in
/// a run without sleep.
TEST(SleepingBed, GivesWayToABlade) {
  Model m = bed_model();
  m.boundary[0] = AxisBoundary::open;
  m.pairs = {{0.2, 0.5, 0.1, 1e3}};  // or they roll far and wide
  m.domain.lo.x = -2e-3, m.domain.hi.x = 4e-3;
  m.walls[kFloor].shape = Box{{-3e-3, -1e-3, -1e-3}, {5e-3, 2e-3, 0}};
  m.walls[kTool].shape = Box{{-1.6e-3, -1e-3, 5e-5}, {-1.5e-3, 2e-3, 1e-2}};
  const auto run = [&](double tolerance) {
    Simulation sim = poured_bed(32, {.sleep_tolerance = tolerance}, m);
    sim.set_wall_velocity(kTool, {0.02, 0, 0});  // reaches the bed after 75 ms
    sim.advance(70000);
    EXPECT_TRUE(tolerance == 0 || sim.grains_asleep() > 10) << sim.grains_asleep();
    sim.advance(55000);
    const double face = std::get<Box>(sim.walls()[kTool]).hi.x;
    const GrainColumns c = columns(sim);
    double mean = 0;
    for (std::size_t i = 0; i < c.id.size(); ++i) {
      mean += c.x[i] / static_cast<double>(c.id.size());
      const bool above_gap = c.z[i] > 5e-5 + 0.3 * c.radius[i];
      EXPECT_FALSE(above_gap && c.x[i] > face - 1e-4 && c.x[i] < face) << "inside the blade: " << i;
    }
    return mean;
  };
  EXPECT_NEAR(run(kTolerance), run(0), 0.1 * kSide);
}

TEST(SleepingBed, KeepsTheAccountOfEnergies) {
  const auto residual = [](double tolerance) {
    Simulation sim = poured_bed(100, {.energies = true, .sleep_tolerance = tolerance});
    sim.advance(60000);
    const EnergyBalance e = energy_balance(sim);
    if (tolerance > 0) {
      EXPECT_GT(sim.grains_asleep(), 50u);
      EXPECT_GT(e.stilled, 0);
      EXPECT_LT(e.stilled, 1e-6 * e.gravity);  // speeds below a thousandth of that of a fall by a diameter
    }
    return std::fabs(e.residual()) / e.gravity;
  };
  EXPECT_LT(residual(kTolerance), 1.2 * residual(0) + 1e-6);
}

TEST(Sleepers, NeedGravityAndASmallTolerance) {
  Model m = bed_model();
  EXPECT_THROW(Simulation(m, kStep, {.sleep_tolerance = 0.5}), InputError);
  EXPECT_THROW(Simulation(m, kStep, {.sleep_tolerance = -0.1}), InputError);
  EXPECT_THROW(Simulation(m, kStep, {.sleep_tolerance = std::nan("")}), InputError);
  m.gravity = {0, 0, 0};
  EXPECT_THROW(Simulation(m, kStep, {.sleep_tolerance = kTolerance}), InputError);
}

}  // namespace
}  // namespace interstice::dem
