// The lists hold every pair that touches, at every step, however fast grains are; whatever reaches they were
// made by.
#include <gtest/gtest.h>

#include <set>

#include "base/error.h"
#include "tests/dem/scenes.h"

namespace interstice::dem {
namespace {

using testing::falling_cloud;

using Pairs = std::set<std::pair<std::int64_t, std::int64_t>>;

Pairs touching(const Simulation& sim) {
  Pairs pairs;
  for (std::size_t k = 0; k < sim.pair_contacts().places(); ++k) {
    if (!sim.pair_contacts().touching(k)) continue;
    const PairRef& pair = sim.pair_contacts().pair(k);
    const auto [a, b] = std::minmax({sim.site(pair.a).id, sim.site(pair.b).id});
    EXPECT_TRUE(pairs.insert({a, b}).second) << "listed twice";
  }
  return pairs;
}

/// By trying every pair of grains, and none of the lists.
Pairs overlapping(const Simulation& sim) {
  Pairs pairs;
  for (std::size_t i = 0; i < sim.grains(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const GrainSite a = sim.site(i), b = sim.site(j);
      const Vec3d d = separation(a.position(), b.position(), sim.search_space());
      if (dot(d, d) < (a.radius + b.radius) * (a.radius + b.radius)) pairs.insert(std::minmax(a.id, b.id));
    }
  }
  return pairs;
}

void expect_whole_lists(Simulation& sim, std::int64_t steps) {
  std::size_t seen = 0;
  for (std::int64_t s = 0; s < steps; ++s) {
    sim.advance(s % 3 == 0 ? 1 : 2);
    const Pairs pairs = touching(sim);
    ASSERT_EQ(pairs, overlapping(sim)) << "step " << sim.step();
    seen += pairs.size();
  }
  EXPECT_GT(seen, 300u);  // contacts that came or went would show
}

TEST(Lists, HoldEveryTouchingPairOfAFallingCloud) {
  Simulation sim = falling_cloud(400);
  sim.advance(6000);
  expect_whole_lists(sim, 200);
}

TEST(Lists, HoldEveryTouchingPairForATinySkin) {
  Simulation sim = falling_cloud(400, {false, 2e-8});
  sim.advance(6000);
  expect_whole_lists(sim, 100);
}

/// A grain at 20 m/s through a cloud that barely moves: lists are made for its path, not for the
/// cloud's.
TEST(Lists, AreNotMadeAnewForOneFastGrain) {
  Simulation sim = falling_cloud(150);
  sim.advance(200);
  const std::int64_t before = sim.rebuilds();
  NewGrain fast;
  fast.position = {0.5e-4, 0.5e-4, 4e-2};  // far above all others
  fast.radius = 1e-5;
  fast.velocity = {0, 0, 20};
  sim.add_grains({&fast, 1});
  sim.advance(400);
  EXPECT_LT(sim.rebuilds() - before, 12);  // by its 8e-5 m on the way; the least reach would take a hundred
}

/// However fast: reaches end where a grain would be near two images of another. Of the box only size counts.
TEST(Lists, OfFastGrainsFitIntoASmallPeriodicBox) {
  const double r = 1e-5;
  const auto box_of = [&](double length, double speed) {
    Model m = testing::plain_model(testing::powder(), {0.9, 0.3, 0.005, 0}, testing::with_friction());
    m.domain = {{0, 0, 0}, {length, length, length}};
    m.boundary.fill(AxisBoundary::periodic);
    Simulation sim(m, 1e-9);
    NewGrain still, fast;
    still.radius = fast.radius = r;
    still.position = {r, r, r};
    fast.position = {3.2 * r, 1.5 * r, r};
    fast.velocity = {-speed, 0.4 * speed, 0};
    const NewGrain grains[] = {still, fast};
    sim.add_grains(grains);
    return sim;
  };
  Simulation sim = box_of(4.2 * r, 30);
  std::size_t seen = 0;
  for (int s = 0; s < 3000; ++s) {
    sim.advance(1);
    const Pairs pairs = touching(sim);
    ASSERT_EQ(pairs, overlapping(sim)) << "step " << sim.step();
    seen += pairs.size();
  }
  EXPECT_GT(seen, 10u);
  EXPECT_THROW(box_of(3.9 * r, 0).advance(1), InputError);
}

}  // namespace
}  // namespace interstice::dem
