// A granular gas that cools by its collisions: Haff's law (J. Fluid Mech. 134, 1983), its rate by the
// Enskog collision frequency with the contact value of Carnahan & Starling (1969), and the loss per collision
// of a Maxwellian gas (Brilliantov & Poeschel, Kinetic Theory of Granular Gases, 2004, ch. 5).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

#include "base/random.h"
#include "dem/simulation.h"
#include "dem/time_step.h"
#include "tests/dem/scenes.h"
#include "tests/report/report.h"

namespace interstice::dem {
namespace {

using interstice::testing::expect_ratio;
using interstice::testing::Reference;

constexpr double kDiameter = 1e-3, kDensity = 2500, kThermalSpeed = 0.1;  // [m], [kg/m^3], sqrt(T0/m) [m/s]
constexpr double kMass = M_PI / 6 * kDiameter * kDiameter * kDiameter * kDensity;

struct Gas {
  NormalLaw normal;
  double restitution;
  double solid_fraction;
  Precision precision;
  std::size_t count;
  unsigned seeds;  // of as many gases the mean is judged
};

/// Enskog collisions per grain and second at the starting temperature.
double collision_rate(const Gas& gas) {
  const double phi = gas.solid_fraction;
  const double density = phi / (M_PI / 6 * kDiameter * kDiameter * kDiameter);
  const double contact_value = (1 - phi / 2) / std::pow(1 - phi, 3);
  return 4 * density * kDiameter * kDiameter * contact_value * std::sqrt(M_PI) * kThermalSpeed;
}

double normal_deviate(Random& random) {
  return std::sqrt(-2 * std::log(random.uniform())) * std::cos(2 * M_PI * random.uniform());
}

bool has_room(const std::vector<NewGrain>& grains, const Vec3d& p, double side) {
  return std::none_of(grains.begin(), grains.end(), [&](const NewGrain& g) {
    Vec3d apart = p - g.position;
    for (int axis = 0; axis < 3; ++axis) apart[axis] -= side * std::round(apart[axis] / side);
    return dot(apart, apart) <= kDiameter * kDiameter;
  });
}

/// Random places without overlap, velocities of a Maxwellian with no mean and exactly the temperature asked
/// for.
std::vector<NewGrain> maxwellian(const Gas& gas, double side, unsigned seed) {
  Random random(seed, 0);
  std::vector<NewGrain> grains;
  while (grains.size() < gas.count) {
    const Vec3d p{random.uniform(0, side), random.uniform(0, side), random.uniform(0, side)};
    if (has_room(grains, p, side)) grains.push_back({p, kDiameter / 2, {}, {}, 0, 0});
  }
  Vec3d mean{0, 0, 0};
  for (NewGrain& g : grains) {
    g.velocity = {normal_deviate(random), normal_deviate(random), normal_deviate(random)};
    mean += (1 / static_cast<double>(gas.count)) * g.velocity;
  }
  double square = 0;
  for (NewGrain& g : grains) {
    g.velocity -= mean;
    square += dot(g.velocity, g.velocity) / (3 * static_cast<double>(gas.count));
  }
  for (NewGrain& g : grains) g.velocity = (kThermalSpeed / std::sqrt(square)) * g.velocity;
  return grains;
}

double temperature(const Simulation& sim) {  // over m [m^2/s^2]
  double sum = 0;
  for (const GrainRow& g : sim.rows()) sum += dot(g.velocity(), g.velocity());
  return sum / (3 * static_cast<double>(sim.grains()));
}

using Pairs = std::vector<std::pair<std::int64_t, std::int64_t>>;

Pairs touching_pairs(const Simulation& sim) {
  const PairContacts& contacts = sim.pair_contacts();
  Pairs touching;
  for (std::size_t k = 0; k < contacts.places(); ++k) {
    if (!contacts.touching(k)) continue;
    touching.emplace_back(sim.site(contacts.pair(k).a).id, sim.site(contacts.pair(k).b).id);
  }
  std::sort(touching.begin(), touching.end());
  return touching;
}

/// Contacts last 1 % of the time between collisions at first (and ever less of it), so that they count as
/// instants: 2 % would slow the cooling by 2 % more. Their stiffness follows; the step is 1/25 of a contact.
Simulation make_gas(const Gas& gas, double contact_time, unsigned seed) {
  Model m =
      testing::plain_model({kDensity, 1, 0.3}, {.restitution = gas.restitution}, Laws{.normal = gas.normal});
  const double side = std::cbrt(static_cast<double>(gas.count) * M_PI / 6 / gas.solid_fraction) * kDiameter;
  m.domain = {{0, 0, 0}, {side, side, side}};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::periodic, AxisBoundary::periodic};
  m.pairs[0].stiffness = kMass / 2 * M_PI * M_PI / (contact_time * contact_time);
  const double at_unit_modulus =
      collision_time(kMass / 2, kDiameter / 4, 1, std::sqrt(M_PI) * kThermalSpeed);  // mean normal approach
  const double effective_modulus = std::pow(at_unit_modulus / contact_time, 2.5);    // t_c ~ E*^(-2/5)
  m.materials[0].youngs_modulus = effective_modulus * 2 * (1 - 0.3 * 0.3);
  Simulation sim(m, contact_time / 25, {.precision = gas.precision});
  sim.add_grains(maxwellian(gas, side, seed));
  return sim;
}

constexpr std::array kTimes{0.5, 1., 1.5};  // in Haff times: to 1/6 of the first temperature

/// A cooling gas at these times: its temperature over that by Haff's law in time, and in collisions.
struct Cooling {
  std::array<double, kTimes.size()> by_time{}, by_collisions{};
};

Cooling cool(const Gas& gas, unsigned seed) {
  const double rate = collision_rate(gas), loss = 1 - gas.restitution * gas.restitution;
  const double haff_time = 6 / (loss * rate);
  Simulation sim = make_gas(gas, 0.01 / rate, seed);
  const double first = temperature(sim);
  std::int64_t collisions = 0;
  Pairs before;
  Cooling seen;
  for (std::size_t i = 0; i < kTimes.size(); ++i) {
    while (sim.time() < kTimes[i] * haff_time) {
      sim.advance(5);  // a fifth of a contact: none is missed
      Pairs now = touching_pairs(sim), begun;
      std::set_difference(now.begin(), now.end(), before.begin(), before.end(), std::back_inserter(begun));
      collisions += static_cast<std::int64_t>(begun.size());
      before = std::move(now);
    }
    const double cooled = temperature(sim) / first, t = sim.time() / haff_time;
    const double per_grain = 2 * static_cast<double>(collisions) / static_cast<double>(gas.count);
    seen.by_time[i] = cooled * (1 + t) * (1 + t);
    seen.by_collisions[i] = cooled / std::exp(-loss * per_grain / 3);
  }
  return seen;
}

/// Well before clusters form in so small a box. (Not with the reference back end, whose search for neighbours
/// is for small scenes.)
void check_cooling(const Gas& gas, const std::string& name) {
  const Reference haff{fmt::format("Haff's law: {}", name), "Haff 1983; Brilliantov & Pöschel 2004, ch. 5"};
  Cooling mean;
  for (unsigned seed = 0; seed < gas.seeds; ++seed) {
    const Cooling seen = cool(gas, 11 + seed);
    for (std::size_t i = 0; i < kTimes.size(); ++i) {
      mean.by_time[i] += seen.by_time[i] / gas.seeds;
      mean.by_collisions[i] += seen.by_collisions[i] / gas.seeds;
    }
  }
  // 3 %: contacts that last (1 %), the velocities' departure from a Maxwellian (0.8 %) and chance, 1.3 % of a
  // gas of 1000 grains.
  for (std::size_t i = 0; i < kTimes.size(); ++i) {
    expect_ratio(haff, fmt::format("T over Haff's at {} Haff times", kTimes[i]), mean.by_time[i], 1, 0.03);
    expect_ratio(haff, fmt::format("T over Haff's after as many collisions, {} Haff times", kTimes[i]),
                 mean.by_collisions[i], 1, 0.03);
  }
}

TEST(GranularGas, OfHertzSpheresCoolsByHaffsLaw) {
  check_cooling({NormalLaw::hertz, 0.9, 0.1, Precision::real64, 2000, 1}, "hertz, e 0.9, φ 0.1");
}

TEST(GranularGas, OfHookeSpheresInMixedPrecisionCoolsByHaffsLaw) {
  check_cooling({NormalLaw::hooke, 0.9, 0.05, Precision::mixed, 1000, 4}, "hooke, e 0.9, φ 0.05, mixed");
}

}  // namespace
}  // namespace interstice::dem
