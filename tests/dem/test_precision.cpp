// How exact forces in mixed precision are.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>

#include "tests/dem/scenes.h"

namespace interstice::dem {
namespace {

constexpr std::size_t kGrains = 1500;

/// Grains of 5 to 65 um stuck to each other at random, overlapping by up to 1e-5 of the sum of their radii as
/// in a bed at rest, and moving against each other. Far from the origin, where positions have fewer digits.
std::vector<NewGrain> clump() {
  Random random(11, 0);
  std::vector<NewGrain> grains;
  const auto direction = [&] {
    for (;;) {
      const Vec3d v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
      const double length = norm(v);
      if (length > 0.1 && length < 1) return (1 / length) * v;
    }
  };
  const auto fits = [&](const NewGrain& g) {
    return std::ranges::all_of(grains, [&](const NewGrain& other) {
      const double reach = g.radius + other.radius;
      return norm(g.position - other.position) > (1 - 1e-5) * reach;
    });
  };
  while (grains.size() < kGrains) {
    NewGrain g;
    g.radius = random.uniform(2.5e-6, 32.5e-6);
    g.position = {2.9e-3, 0.4e-3, 1.4e-3};
    if (!grains.empty()) {
      const auto partner = static_cast<std::size_t>(random.uniform(0, static_cast<double>(grains.size())));
      const NewGrain& at = grains[std::min(partner, grains.size() - 1)];
      g.position = at.position + ((1 - random.uniform(1e-6, 1e-5)) * (g.radius + at.radius)) * direction();
    }
    g.velocity = 5e-3 * direction();
    g.spin = 100.0 * direction();
    if (fits(g)) grains.push_back(g);
  }
  return grains;
}

using ForceByPair = std::map<std::pair<std::int64_t, std::int64_t>, Vec3d>;

/// The forces of one step from this state.
ForceByPair forces_after(const Model& model, double dt, const SavedState& state, Precision precision) {
  SimulationOptions options;
  options.precision = precision;
  Simulation sim(model, dt, options);
  sim.restore(state);
  sim.advance(1);
  ForceByPair forces;
  const PairContacts& contacts = sim.pair_contacts();
  for (std::size_t k = 0; k < contacts.places(); ++k) {
    if (!contacts.touching(k)) continue;
    const std::int64_t a = sim.row(contacts.pair(k).a).id, b = sim.row(contacts.pair(k).b).id;
    forces[{std::min(a, b), std::max(a, b)}] =
        a < b ? contacts.memories().force(k) : -contacts.memories().force(k);
  }
  return forces;
}

/// Both sum what a force is made of in some twenty roundings of 6e-8 and a contact of the bed bears at most
/// some tens of the mean: 1e-4 of the mean is the error that a user may meet.
TEST(Precision, NoForceInMixedIsOffByMoreThanATenThousandthOfTheMean) {
  Model m = testing::plain_model(testing::powder(), {0.35, 0.3, 0.005, 1e6}, testing::everything());
  const double dt = 7.8e-9;
  Simulation sim(m, dt);
  sim.add_grains(clump());
  sim.advance(20);
  const SavedState state = sim.save();
  const ForceByPair exact = forces_after(m, dt, state, Precision::real64),
                    mixed = forces_after(m, dt, state, Precision::mixed);
  ASSERT_GT(exact.size(), kGrains / 2);
  ASSERT_EQ(exact.size(), mixed.size());
  double sum = 0, worst = 0;
  for (const auto& [pair, force] : exact) {
    sum += norm(force);
    worst = std::max(worst, norm(force - mixed.at(pair)));
  }
  const double mean = sum / static_cast<double>(exact.size());
  EXPECT_LT(worst / mean, 1e-4);
  EXPECT_GT(worst / mean, 1e-9) << "mixed is single precision";
}

}  // namespace
}  // namespace interstice::dem
