// Grains of any size, density and stiffness: the same motion when scaled; flight without contact; nothing to
// simulate; input that makes no sense.
#include <functional>

#include "base/random.h"
#include "tests/extremes/support.h"

namespace interstice::dem {
namespace {

using namespace testing;

/// Units in which a model is built: lengths, densities and moduli. Speeds scale with sqrt(E/rho).
struct Units {
  double length = 20e-6, density = 8200, modulus = 1e9;
  double speed() const { return std::sqrt(modulus / density); }
  double time() const { return length / speed(); }
};

/// Five grains that meet obliquely above a floor with all laws at work, in the units given; their positions
/// and velocities after 4,000 steps in those units.
std::vector<double> small_collision(const Units& u, const Laws& laws, const BackEnd& b) {
  Model m = open_model({u.density, u.modulus, 0.3}, {}, laws, 1e3 * u.length);
  m.pairs[0] = {.restitution = 0.6,
                .friction = 0.4,
                .rolling_friction = 0.02,
                .cohesion_energy_density = 1e-3 * u.modulus,
                .work_of_adhesion = 1e-6 * u.modulus * u.length};
  m.gravity = {0, 0, -1e-6 * u.speed() * u.speed() / u.length};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  Simulation sim(m, 0.02 * u.time(), b.options);
  const double v = 2e-3 * u.speed(), r = u.length;
  sim.add_grains(std::vector<NewGrain>{grain({-1.02 * r, 0.3 * r, 1.01 * r}, r, {v, 0, -v}, {0, v / r, 0}),
                                       grain({1.02 * r, 0, 1.01 * r}, r, {-v, 0, 0}, {v / r, 0, 0}),
                                       grain({0, 0.1 * r, 2.75 * r}, 0.9 * r, {0, 0, -v}),
                                       grain({0.2 * r, 1.9 * r, 0.71 * r}, 0.7 * r, {0, -v, 0}),
                                       grain({0.1 * r, -1.9 * r, 0.81 * r}, 0.8 * r, {0, v, 0})});
  sim.advance(4000);
  const GrainColumns c = columns(sim);
  std::vector<double> state;
  for (std::size_t i = 0; i < c.id.size(); ++i) {
    for (const double x : {c.x[i], c.y[i], c.z[i]}) state.push_back(x / u.length);
    for (const double x : {c.vx[i], c.vy[i], c.vz[i]}) state.push_back(x / v);
    for (const double x : {c.wx[i], c.wy[i], c.wz[i]}) state.push_back(x * r / v);
  }
  return state;
}

TEST(Scales, TheSameMotionInAnyUnits) {
  // Nothing but ratios matters. Rounding of 1e-16 grows in 4,000 steps of contact to about 1e-13; single
  // precision starts from 6e-8.
  const Laws all[] = {
      {.tangential = TangentialLaw::mindlin, .rolling = RollingLaw::epsd2, .cohesion = CohesionLaw::sjkr},
      {.tangential = TangentialLaw::mindlin, .rolling = RollingLaw::epsd2, .cohesion = CohesionLaw::jkr},
      {.tangential = TangentialLaw::mindlin, .rolling = RollingLaw::epsd2, .cohesion = CohesionLaw::dmt}};
  const char* names[] = {"sjkr", "jkr", "dmt"};
  const std::pair<Units, const char*> tried[] = {{{20e-6, 1, 1e9}, "density 1 kg/m3"},
                                                 {{20e-6, 2e4, 1e9}, "density 2e4 kg/m3"},
                                                 {{50e-9, 8200, 1e9}, "grains of 100 nm"},
                                                 {{50e-9, 1, 1e3}, "100 nm, 1 kg/m3, 1 kPa"},
                                                 {{5e-9, 8200, 1e9}, "grains of 10 nm"},
                                                 {{0.5, 8200, 1e9}, "grains of 1 m"},
                                                 {{0.5, 2e4, 1e12}, "1 m, 2e4 kg/m3, 1 TPa"},
                                                 {{20e-6, 8200, 1e3}, "E 1 kPa"},
                                                 {{20e-6, 8200, 1e12}, "E 1 TPa"}};
  for (int l = 0; l < 3; ++l) {
    for (const auto& [units, name] : tried) {
      expect_small("scales", fmt::format("{}; mindlin, epsd2, {}", name, names[l]),
                   "scaled motion of five grains is that of 40 um steel within", 1e-10, 1e-3,
                   [&, u = units](const BackEnd& b) {
                     const auto expected = small_collision({}, all[l], b),
                                found = small_collision(u, all[l], b);
                     double worst = expected.size() == found.size() ? 0 : INFINITY;
                     for (std::size_t i = 0; i < std::min(expected.size(), found.size()); ++i)
                       keep_worst(worst, std::fabs(expected[i] - found[i]));
                     return worst;
                   });
    }
  }
}

TEST(Flight, WithoutGravityIsStraight) {
  // x = v t to the rounding of each of 1e5 steps, in either number type (motion is in double).
  expect_small("no gravity, no contact", "one grain, 1e5 steps",
               "velocity kept to the bit, path straight within", 1e-11, 1e-11, [](const BackEnd& b) {
                 Simulation sim(open_model({8200, 1e9, 0.3}, {}, {}, 1), 1e-6, b.options);
                 sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0}, 1e-3, {0.3, -0.2, 0.1}, {5, 6, 7})});
                 sim.advance(100000);
                 const GrainColumns c = columns(sim);
                 if (c.vx[0] != 0.3 || c.vy[0] != -0.2 || c.vz[0] != 0.1 || c.wz[0] != 7) return 1.0;
                 return std::fabs(c.x[0] / 0.03 - 1) + std::fabs(c.y[0] / -0.02 - 1) +
                        std::fabs(c.z[0] / 0.01 - 1);
               });
}

TEST(Flight, OneGrainFallsAsVerletIsExact) {
  // 1e5 roundings of 1e-16 of 0.5 m at worst in one direction: 1e-11.
  expect_small("one grain", "free fall, 1e5 steps", "z = g t^2/2 within", 1e-11, 1e-11, [](const BackEnd& b) {
    Model m = open_model({8200, 1e9, 0.3}, {}, {}, 1);
    m.gravity = {0, 0, -9.81};
    Simulation sim(m, 1e-6, b.options);
    sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0.5}, 1e-3)});
    sim.advance(100000);
    return std::fabs((columns(sim).z[0] - 0.5) / (0.5 * 9.81 * 0.01) + 1);
  });
}

void simulate_nothing(bool periodic) {
  for (const BackEnd& b : back_ends()) {
    {
      Model m = open_model({8200, 1e9, 0.3}, {.work_of_adhesion = 1e-3},
                           {.tangential = TangentialLaw::mindlin, .cohesion = CohesionLaw::jkr}, 1e-3);
      if (periodic) m.boundary.fill(AxisBoundary::periodic);
      m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
      SimulationOptions options = b.options;
      options.energies = true;
      Simulation sim(m, 1e-8, options);
      sim.add_grains({});
      sim.set_wall_velocity(0, {0, 0, 0.1});
      sim.advance(1000);
      Simulation again(m, 1e-8, options);
      again.restore(sim.save());
      again.advance(10);
      const bool zeros = contact_statistics(again).contacts == 0 && wall_statistics(again, 0).contacts == 0 &&
                         motion_statistics(again).kinetic_energy == 0 && check_step(again).ratio == 0 &&
                         energy_balance(again).residual() == 0;
      expect_outcome(
          "empty scene",
          fmt::format("no grains, {} box, a moving wall ({})", periodic ? "periodic" : "open", b.name),
          "runs, saves and restores; all statistics are 0", zeros && again.step() == 1010);
    }
  }
}

TEST(Nothing, IsSimulatedWithoutFuss) { simulate_nothing(false); }
TEST(Nothing, IsSimulatedInAPeriodicBoxWithoutFuss) { simulate_nothing(true); }

/// What happened when `act` was done: the error's words, or nothing.
std::string refusal(const std::function<void()>& act) {
  try {
    act();
  } catch (const InputError& e) {
    return e.what();
  } catch (const UnstableError& e) {
    return e.what();
  }
  return "";
}

TEST(Input, StepsThatAreNoStepsAreRefused) {
  const Model m = open_model({8200, 1e9, 0.3}, {}, {}, 1e-3);
  for (const double dt : {0.0, -1e-8, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
    const std::string words = refusal([&] { Simulation(m, dt); });
    expect_outcome("time step", fmt::format("{} s", dt), fmt::format("refuses: {}", words), !words.empty());
  }
  Simulation sim(m, 1e-8);
  sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0}, 1e-5, {1, 0, 0})});
  sim.advance(0);
  expect_outcome("time step", "advance by 0 steps", "nothing changes",
                 sim.step() == 0 && columns(sim).x[0] == 0);
  for (const double dt : {1e-30, 1e-300}) {
    Simulation still(m, dt);
    still.add_grains(std::vector<NewGrain>{grain({0, 0, 0}, 1e-5, {1, 0, 0}), grain({1e-5, 0, 0}, 1e-5)});
    still.advance(100);
    expect_outcome("time step", fmt::format("{:g} s, a pair in contact, 100 steps", dt),
                   "finite; nothing moves",
                   all_finite(columns(still)) && std::fabs(columns(still).x[0]) < 1e-20);
  }
}

TEST(Input, GrainsThatFlyOffNumbersAreRefused) {
  Model m = open_model({8200, 1e9, 0.3}, {}, {}, 1e-3);
  for (const BackEnd& b : back_ends()) {
    for (const double v : {static_cast<double>(NAN), static_cast<double>(INFINITY), 1e300}) {
      const std::string words = refusal([&] {
        Simulation sim(m, 1e-8, b.options);
        sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0}, 1e-5), grain({1e-4, 0, 0}, 1e-5, {v, 0, 0})});
        sim.advance(10);
      });
      expect_outcome("velocity that is no number", fmt::format("{} m/s ({})", v, b.name),
                     fmt::format("refuses: {}", words), words.find("grain 1") != std::string::npos);
    }
  }
}

}  // namespace
}  // namespace interstice::dem
