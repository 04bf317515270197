// The same bits whatever the threads, the skin, the search, and a stop in between.
#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "tests/dem/same_bits.h"
#include "tests/dem/scenes.h"

namespace interstice::dem {
namespace {

using testing::expect_same_bits;
using testing::falling_cloud;

constexpr std::size_t kGrains = 900;  // several blocks of rows and of pairs
constexpr std::int64_t kSteps = 4000;

GrainColumns run(const SimulationOptions& options, int threads) {
  tbb::task_arena arena(threads);
  return arena.execute([&] {
    Simulation sim = falling_cloud(kGrains, options);
    sim.advance(kSteps);
    GrainColumns c;
    sim.copy_columns(c);
    EXPECT_GT(sim.rebuilds(), 3);
    return c;
  });
}

TEST(SameBits, ForOneTwoAndFourThreads) {
  const GrainColumns one = run({}, 1);
  expect_same_bits(one, run({}, 2));
  expect_same_bits(one, run({}, 4));
}

TEST(SameBits, ForEverySkin) {
  const GrainColumns chosen = run({}, 2);
  expect_same_bits(chosen, run({false, 1e-6}, 2));
  expect_same_bits(chosen, run({false, 2e-5}, 2));
}

TEST(SameBits, FromTheSerialReferenceWithBruteForceSearch) {
  Simulation fast = falling_cloud(200), reference = falling_cloud(200, {true, 0});
  fast.advance(kSteps);
  reference.advance(kSteps);
  GrainColumns a, b;
  fast.copy_columns(a);
  reference.copy_columns(b);
  expect_same_bits(a, b);
}

TEST(SameBits, AfterSavingAndRestoring) {
  Simulation whole = falling_cloud(300);
  whole.advance(kSteps);
  Simulation first = falling_cloud(300);
  SavedState saved;
  do {  // a moment with both kinds of contact
    first.advance(37);
    saved = first.save();
  } while (first.step() < kSteps / 2 || saved.integer.at("pair_ids").empty() ||
           saved.integer.at("wall_ids").empty());
  ASSERT_LT(first.step(), kSteps);
  Simulation second(first.model(), first.time_step());
  second.restore(saved);
  second.advance(kSteps - first.step());
  GrainColumns a, b;
  whole.copy_columns(a);
  second.copy_columns(b);
  expect_same_bits(a, b);
}

TEST(SameBits, HoweverTheStepsAreGrouped) {
  Simulation whole = falling_cloud(300), pieces = falling_cloud(300);
  whole.advance(1500);
  for (int i = 0; i < 500; ++i) pieces.advance(3);
  GrainColumns a, b;
  whole.copy_columns(a);
  pieces.copy_columns(b);
  expect_same_bits(a, b);
}

TEST(SameBits, ForAMirroredWorld) {
  // Reflected in x, the run must be the reflected run: nothing in the laws prefers a side.
  Model m = testing::plain_model(testing::powder(), {0.35, 0.3, 0.005, 1e6}, testing::everything());
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  m.gravity = {0, 0, -9.81};
  Random random(11, 0);
  std::vector<NewGrain> grains, mirrored;
  for (int i = 0; i < 60; ++i) {
    NewGrain g;
    g.radius = random.uniform(1e-5, 3e-5);
    g.position = {(i % 4 - 1.37) * 6.1e-5, (i / 4 % 4) * 6.1e-5, 4e-5 + (i / 16) * 6.1e-5};
    g.velocity = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), -1};
    g.spin = {random.uniform(-1e3, 1e3), random.uniform(-1e3, 1e3), random.uniform(-1e3, 1e3)};
    grains.push_back(g);
    g.position.x = -g.position.x;
    g.velocity.x = -g.velocity.x;
    g.spin = {g.spin.x, -g.spin.y, -g.spin.z};  // an axial vector
    mirrored.push_back(g);
  }
  Simulation left(m, 1e-8), right(m, 1e-8);
  left.add_grains(grains);
  right.add_grains(mirrored);
  left.advance(3000);
  right.advance(3000);
  GrainColumns a, b;
  left.copy_columns(a);
  right.copy_columns(b);
  for (std::size_t i = 0; i < a.id.size(); ++i) {
    EXPECT_EQ(a.x[i], -b.x[i]);
    EXPECT_EQ(a.z[i], b.z[i]);
    EXPECT_EQ(a.wx[i], b.wx[i]);
    EXPECT_EQ(a.wz[i], -b.wz[i]);
  }
}

/// The cloud without sides: grains leave all the time while others touch.
Simulation leaking_cloud(const SimulationOptions& options) {
  const Simulation closed = falling_cloud(400);
  Model m = closed.model();
  m.boundary = {AxisBoundary::open, AxisBoundary::open, AxisBoundary::open};
  std::vector<NewGrain> grains;
  for (const GrainRow& g : closed.rows())
    grains.push_back({g.position(), g.radius, 3.0 * g.velocity(), g.spin(), 0, 0});
  Simulation sim(m, closed.time_step(), options);
  sim.add_grains(grains);
  return sim;
}

TEST(SameBits, WhileGrainsLeave) {
  constexpr std::int64_t steps = 100 * 64;  // grains that left are taken away every 64
  const auto run = [](const SimulationOptions& options, std::int64_t at_once) {
    Simulation sim = leaking_cloud(options);
    for (std::int64_t s = 0; s < steps; s += at_once) sim.advance(at_once);
    EXPECT_GT(sim.grains_lost(), 40);
    EXPECT_GT(sim.grains(), 200u);
    GrainColumns c;
    sim.copy_columns(c);
    return c;
  };
  const GrainColumns chosen = run({}, steps);
  expect_same_bits(chosen, run({.reference = true}, steps));
  expect_same_bits(chosen, run({.skin = 2e-5}, steps));
  expect_same_bits(chosen, run({.skin = 4e-5}, 1));
  const Rates rates{12e-6, 4};
  const GrainColumns rated = run({.rates = rates}, steps);
  expect_same_bits(rated, run({.reference = true, .rates = rates}, steps));
  expect_same_bits(rated, run({.skin = 2e-5, .rates = rates}, 2));
}

/// A grain that leaves does not make anyone search for neighbours anew.
TEST(Lists, OutlastGrainsThatLeave) {
  Simulation sim = leaking_cloud({.skin = 1e-4});
  sim.advance(1);
  const std::int64_t before = sim.rebuilds();
  while (sim.grains_lost() < 40) sim.advance(1);
  EXPECT_LT(2 * (sim.rebuilds() - before), sim.grains_lost());  // grains that fly make some
}

TEST(SavedState, OfOtherWallsIsRefused) {
  Simulation a = falling_cloud(10);
  a.advance(5);
  Model other = a.model();
  other.walls.pop_back();
  Simulation b(other, a.time_step());
  EXPECT_ANY_THROW(b.restore(a.save()));
}

}  // namespace
}  // namespace interstice::dem
