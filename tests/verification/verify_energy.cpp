// The account of energies: what is there, what was lost and what was brought in balance, the better the finer
// the time step.
#include <fmt/format.h>

#include "tests/verification/set_up.h"

namespace interstice::dem::verification {
namespace {

class Energy : public OnEachBackEnd {};

constexpr Material kPowder{8200, 1e9, 0.3};
constexpr double kRadius = 2e-5, kSpeed = 0.2;

PairCoefficients everything() {
  return {.restitution = 0.6,
          .friction = 0.3,
          .rolling_friction = 0.05,
          .cohesion_energy_density = 1e6,
          .work_of_adhesion = 0.02,
          .hamaker_constant = 1e-19,
          .cutoff = 1e-9,
          .range = 2e-7,
          .stiffness = 2000};
}

double contact_time(const Model& m) {
  const double mass = mass_of(kRadius, kPowder) / 2;
  return collision_time(mass, kRadius / 2, m.constants(0, 0).effective_modulus, kSpeed);
}

/// |residual| over the energy at first, after an oblique impact of two spinning spheres of unequal size, at a
/// time step of `fraction` of the contact time.
double residual_of_impact(const Laws& laws, double fraction, double phase, const BackEnd& b) {
  Model m = plain_model(kPowder, everything(), laws);
  SimulationOptions options = b.options;
  options.energies = true;
  const double dt = fraction * contact_time(m);
  Simulation sim(m, dt, options);
  const double r = kRadius, s = 0.6 * kRadius, v = kSpeed, w = 0.3 * v / r;
  const double gap = (laws.cohesion == CohesionLaw::van_der_waals ? 2.1e-7 : 0) + (2 + phase) * dt * v;
  sim.add_grains(
      std::vector<NewGrain>{sphere({-r - gap / 2, 0, 0}, r, {v / 2, 0.2 * v, 0.1 * v}, {w, -w, 0.5 * w}),
                            sphere({s + gap / 2, 0, 0}, s, {-v / 2, -0.1 * v, 0}, {0, 2 * w, w})});
  const double start = energy_balance(sim).kinetic;
  const Encountered e = meet(sim, static_cast<std::int64_t>(20 / fraction));
  EXPECT_TRUE(e.parted);
  return std::fabs(energy_balance(sim).residual()) / start;
}

double mean_residual(const Laws& laws, double fraction, const BackEnd& b) {
  double sum = 0;
  for (int p = 0; p < 8; ++p) sum += residual_of_impact(laws, fraction, p / 8.0, b);
  return sum / 8;
}

/// A combination, the order of its residual in the time step, and its residual over dt/t_c to that power, at
/// most.
struct Combination {
  const char* name;
  Laws laws;
  int order;
  double factor;
};
constexpr auto kMindlin = TangentialLaw::mindlin;
// Normal forces: Verlet, and the heat of dashpots by the rectangle rule, whose ends are zero: second order,
// with some ten times (dt omega)^2. The spring of friction is stretched with the velocity at the step's end,
// which is as if it had a dashpot k_t dt/2 besides: what that takes is in no account. First order.
const Combination kCombinations[] = {
    {"hertz", {}, 2, 3},
    {"hertz, clipped", {.clip = true}, 2, 3},
    {"hertz slider", {.tangential = TangentialLaw::slider}, 2, 3},
    {"hertz mindlin", {.tangential = kMindlin}, 1, 1},
    {"hertz, clipped, mindlin", {.clip = true, .tangential = kMindlin}, 1, 1},
    {"hertz mindlin cdt", {.tangential = kMindlin, .rolling = RollingLaw::cdt}, 1, 1},
    {"hertz mindlin epsd2", {.tangential = kMindlin, .rolling = RollingLaw::epsd2}, 1, 1},
    {"hertz mindlin cdt sjkr",
     {.tangential = kMindlin, .rolling = RollingLaw::cdt, .cohesion = CohesionLaw::sjkr},
     1,
     1},
    {"hertz mindlin epsd2 sjkr",
     {.tangential = kMindlin, .rolling = RollingLaw::epsd2, .cohesion = CohesionLaw::sjkr},
     1,
     1},
    {"hertz mindlin cdt jkr",
     {.tangential = kMindlin, .rolling = RollingLaw::cdt, .cohesion = CohesionLaw::jkr},
     1,
     1},
    {"hertz mindlin epsd2 jkr",
     {.tangential = kMindlin, .rolling = RollingLaw::epsd2, .cohesion = CohesionLaw::jkr},
     1,
     1},
    {"hertz mindlin epsd2 dmt",
     {.tangential = kMindlin, .rolling = RollingLaw::epsd2, .cohesion = CohesionLaw::dmt},
     1,
     1},
    {"hertz mindlin epsd2 van der Waals",
     {.tangential = kMindlin, .rolling = RollingLaw::epsd2, .cohesion = CohesionLaw::van_der_waals},
     1,
     1},
    {"hooke mindlin", {.normal = NormalLaw::hooke, .tangential = kMindlin}, 1, 1},
};

const char* const kAccount = "conservation of energy";

TEST_P(Energy, OfAnObliqueImpactBalances) {
  for (const double fraction : {1e-2, 1e-3}) {
    const Reference r{
        fmt::format(
            "Oblique impact of two spinning spheres: |residual| over the energy at first, dt = {} t_c",
            fraction),
        kAccount};
    for (const Combination& c : kCombinations) {
      const double bound = c.factor * std::pow(fraction, c.order) + GetParam().either(0, 1e-6);  // roundings
      expect_close(r, GetParam().row(c.name), mean_residual(c.laws, fraction, GetParam()), 0, bound);
    }
  }
}

TEST(EnergyOrder, IsThatOfTheLaws) {
  const Reference r{"Order of the residual in the time step, dt 0.001 -> 0.0005 t_c", kAccount};
  for (const Combination& c : kCombinations) {
    const BackEnd b{"double", {}};
    const double order = std::log2(mean_residual(c.laws, 1e-3, b) / mean_residual(c.laws, 5e-4, b));
    expect_close(r, c.name, order, c.order, 0.15);  // of eight phases of first touch
  }
}

TEST(EnergyOrder, BringsTheResidualUnderAMillionth) {
  const Reference r{"Oblique impact of two spinning spheres: |residual| over the energy at first, fine steps",
                    kAccount};
  for (const Combination& c : kCombinations) {
    const double fraction = c.order == 2 ? 5e-4 : 2e-6;
    const bool shown = c.order == 2 || c.laws == kCombinations[3].laws || c.laws == kCombinations[10].laws;
    if (!shown) continue;  // a million steps each
    expect_close(r, fmt::format("{}, dt = {} t_c", c.name, fraction),
                 residual_of_impact(c.laws, fraction, 0.3, {"double", {}}), 0, 1e-6);
  }
}

TEST_P(Energy, OfAMovingWallBalances) {
  const Reference r{
      "Sphere struck by a moving wall that drags it along: |residual| over the work of the wall", kAccount};
  for (const CohesionLaw cohesion : {CohesionLaw::none, CohesionLaw::jkr}) {
    Model m = plain_model(kPowder, everything(),
                          {.tangential = kMindlin, .rolling = RollingLaw::epsd2, .cohesion = cohesion});
    m.walls = {{.shape = Plane{{0, 0, 0}, {0, 0, 1}}, .material = 0}};
    SimulationOptions options = GetParam().options;
    options.energies = true;
    const double fraction = 1e-3;
    Simulation sim(m, fraction * contact_time(m), options);
    sim.add_grains(std::vector<NewGrain>{sphere({0, 0, 1.001 * kRadius}, kRadius)});
    sim.set_wall_velocity(0, {0.5 * kSpeed, 0, kSpeed});
    sim.advance(5000);
    const EnergyBalance e = energy_balance(sim);
    EXPECT_EQ(contact_of(sim).state, ContactState::apart);
    EXPECT_GT(e.kinetic, 0);
    // First order as above.
    expect_close(r, GetParam().row(cohesion == CohesionLaw::none ? "mindlin epsd2" : "mindlin epsd2 jkr"),
                 std::fabs(e.residual()) / e.walls, 0, fraction);
  }
}

TEST_P(Energy, OfFreeFallBalances) {
  Model m = plain_model(kPowder, everything(), {});
  m.gravity = {1, -2, -9.81};
  SimulationOptions options = GetParam().options;
  options.energies = true;
  Simulation sim(m, 1e-6, options);
  sim.add_grains(std::vector<NewGrain>{sphere({0, 0, 0.5}, kRadius, {0.1, 0.2, 0.3}, {100, 0, 0})});
  sim.advance(20000);
  const EnergyBalance e = energy_balance(sim);
  // Verlet is exact in a uniform field: 2e4 roundings.
  expect_close({"Free fall: residual over the work of gravity", kAccount}, GetParam().row("20 ms"),
               e.residual() / e.gravity, 0, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(BackEnds, Energy, ::testing::ValuesIn(back_ends()), name_of);

}  // namespace
}  // namespace interstice::dem::verification
