// Friction and rolling friction on a slope: from none to more than any material has, grains of 100 nm to 1 m.
#include "tests/extremes/support.h"

namespace interstice::dem {
namespace {

using namespace testing;

struct Slope {
  double radius = 20e-6, density = 8200, modulus = 1e8;
  double angle = 30;  // degrees
  double friction = 0.3, rolling = 0;
  Laws laws{.tangential = TangentialLaw::mindlin};
  int steps = 4000;
};

struct Descent {
  double acceleration = 0;  // down the slope, of the second half of the run, over g
  double spin_up = 0;       // R dw/dt over g
  double energy_error = 0;  // change of the residual over the work of gravity
  bool finite = false;
};

/// One grain let go in equilibrium with the slope's normal force; the slope is the floor, gravity leans.
Descent descend(const Slope& s, const BackEnd& b) {
  const double g = 9.81, angle = s.angle * M_PI / 180;
  Model m = open_model({s.density, s.modulus, 0.3}, {}, s.laws, 1e6 * s.radius);
  m.pairs[0] = {.restitution = 0.3, .friction = s.friction, .rolling_friction = s.rolling};
  m.gravity = {g * std::sin(angle), 0, -g * std::cos(angle)};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  const double mass = sphere_mass(s.radius, s.density), modulus = s.modulus / 1.82;
  const double overlap =
      std::pow(mass * g * std::cos(angle) / (4.0 / 3 * modulus * std::sqrt(s.radius)), 2.0 / 3);
  const double stiffness = 2 * modulus * std::sqrt(s.radius * overlap);
  SimulationOptions options = b.options;
  options.energies = true;
  Simulation sim(m, 0.05 * std::sqrt(mass / stiffness), options);
  sim.add_grains(std::vector<NewGrain>{grain({0, 0, s.radius - overlap}, s.radius)});
  sim.advance(1);
  const double inserted = energy_balance(sim).residual();  // the elastic energy that it was started with
  sim.advance(s.steps / 2 - 1);
  const GrainColumns half = columns(sim);
  sim.advance(s.steps / 2);
  const GrainColumns c = columns(sim);
  const double time = s.steps / 2 * sim.time_step();
  const EnergyBalance e = energy_balance(sim);
  Descent d;
  d.finite = all_finite(c);
  d.acceleration = (c.vx[0] - half.vx[0]) / time / g;
  d.spin_up = (c.wy[0] - half.wy[0]) / time * s.radius / g;
  d.energy_error = std::fabs(e.residual() - inserted) / (std::fabs(e.gravity) + mass * g * overlap);
  return d;
}

/// a/g of a rigid sphere: rolls where tan(angle) <= 7/2 mu, slides else.
double rigid(const Slope& s) {
  const double sine = std::sin(s.angle * M_PI / 180), cosine = std::cos(s.angle * M_PI / 180);
  return sine <= 3.5 * s.friction * cosine ? 5.0 / 7 * sine : sine - s.friction * cosine;
}

TEST(Slope, FrictionFromNoneToTenThousand) {
  // The spring's oscillation is damped within the first half (e = 0.3); what is left is 1e-3 of g.
  for (const double mu : {0.0, 1e-6, 0.01, 0.1, 0.3, 1.0, 10.0, 1e4}) {
    const Slope s{.friction = mu};
    expect_small("friction on a slope", fmt::format("mu = {:g}, 30 degrees, a sphere let go", mu),
                 fmt::format("a/g = {:.4f} as a rigid sphere's within", rigid(s)), 2e-3, 2e-3,
                 [&](const BackEnd& b) {
                   const Descent d = descend(s, b);
                   return std::fabs(d.acceleration - rigid(s)) + (d.finite ? 0 : INFINITY);
                 });
  }
}

TEST(Slope, GrainsOfAnySize) {
  struct Case {
    const char* name;
    double radius, density, modulus;
  };
  const Case cases[] = {{"100 nm, 8200 kg/m3, 1e8 Pa", 50e-9, 8200, 1e8},
                        {"100 nm, 1 kg/m3, 1e8 Pa", 50e-9, 1, 1e8},
                        {"1 um, 8200 kg/m3, 1e8 Pa", 0.5e-6, 8200, 1e8},
                        {"1 m, 2e4 kg/m3, 1e12 Pa", 0.5, 2e4, 1e12},
                        {"1 m, 1 kg/m3, 1e6 Pa", 0.5, 1, 1e6}};
  for (const Case& c : cases) {
    for (const double mu : {0.1, 0.5}) {  // slides, rolls
      Slope s{.radius = c.radius, .density = c.density, .modulus = c.modulus, .friction = mu};
      expect_small("grain size", fmt::format("{}, 30 degrees, mu = {}", c.name, mu),
                   fmt::format("a/g = {:.4f} as a rigid sphere's within", rigid(s)), 2e-3, 2e-3,
                   [&](const BackEnd& b) { return std::fabs(descend(s, b).acceleration - rigid(s)); });
    }
  }
}

/// A sphere that rolls (mu large) with a rolling resistance of moment mu_r N R: a = 5/7 g (sin - mu_r cos),
/// at rest where mu_r >= tan(angle). epsd2 holds it by a spring without a dashpot: it swings for ever, within
/// the yield moment; cdt creeps at the speed that gravity makes in a step.
void roll_down(RollingLaw law, std::initializer_list<double> coefficients) {
  for (const double mu_r : coefficients) {
    Slope s{.friction = 10, .rolling = mu_r};
    s.laws.rolling = law;
    const double sine = 0.5, cosine = std::sqrt(0.75);
    const double expected = std::max(0.0, 5.0 / 7 * (sine - mu_r * cosine));
    // 5e-3: the mean over the second half of an undamped rolling swing is not exactly 0.
    expect_small(
        "rolling friction on a slope",
        fmt::format("mu_r = {:g}, {}, 30 degrees, mu = 10", mu_r, law == RollingLaw::cdt ? "cdt" : "epsd2"),
        fmt::format("a/g = {:.4f}{} within", expected, expected > 0 ? "" : " (rests)"), 5e-3, 5e-3,
        [&](const BackEnd& b) {
          const Descent d = descend(s, b);
          return std::fabs(d.acceleration - expected) + (d.finite ? 0 : INFINITY);
        });
  }
}

TEST(Slope, RollingFrictionFromNoneToTenThousand) {
  roll_down(RollingLaw::epsd2, {0, 1e-6, 0.01, 0.3, 1, 10, 1e4});
  roll_down(RollingLaw::cdt, {0, 1e-6, 0.01, 0.3, 1, 10});
}

// A moment that took more spin away in a step than there is would turn it about every step, by more than
// friction can follow, and the grain would slide as if there were none.
TEST(Slope, HugeCdtHolds) { roll_down(RollingLaw::cdt, {100, 1e3, 1e4}); }

TEST(Slope, EnergyBalanceClosesWithAnyFriction) {
  // First-order sums of heat at omega dt = 0.05: percents of what gravity puts in.
  for (const double mu : {0.0, 0.1, 1e4}) {
    for (const double mu_r : {0.0, 0.1, 10.0}) {
      Slope s{.friction = mu, .rolling = mu_r};
      s.laws.rolling = RollingLaw::epsd2;
      expect_small("energy with friction",
                   fmt::format("mu = {:g}, mu_r = {:g} (epsd2), 30 degrees", mu, mu_r),
                   "balance closes within (of the work of gravity)", 0.03, 0.03,
                   [&](const BackEnd& b) { return descend(s, b).energy_error; });
    }
  }
}

/// A large grain held between two walls, a small one in the groove between it and the left wall, both with
/// friction: the largest speed over sqrt(g d) in 1e5 steps after settling, d that of the small one, and what
/// the step check said of dashpots at the worst.
struct Unrest {
  double fastest = 0, damping = 0;
};
Unrest unrest(double ratio, double restitution, double step, const BackEnd& b) {
  const double r = 20e-6, big = ratio * r, gap = 1e-5;
  Model m = open_model({8200, 1e8, 0.3}, {.restitution = restitution, .friction = 0.6},
                       {.tangential = TangentialLaw::mindlin}, 10 * big);
  m.gravity = {0, 0, -9.81};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0},
             {Plane{{-big * (1 - gap), 0, 0}, {1, 0, 0}}, 0},
             {Plane{{big * (1 - gap), 0, 0}, {-1, 0, 0}}, 0}};
  // As stiff as the floor under the large grain: the stiffest contact over the lightest mass.
  const double load = sphere_mass(big, 8200) * 9.81, modulus = 1e8 / 1.82;
  const double overlap = std::pow(load / (4.0 / 3 * modulus * std::sqrt(big)), 2.0 / 3) + gap * big;
  const double light = std::sqrt(sphere_mass(r, 8200) / (2 * modulus * std::sqrt(r * 1e-4 * r)));
  const double heavy = std::sqrt(sphere_mass(big, 8200) / (2 * modulus * std::sqrt(big * overlap)));
  Simulation sim(m, step * std::min(light, heavy), b.options);
  const double across = big - r, along = big + r;  // the small one touches the large one and the wall
  sim.add_grains(
      std::vector<NewGrain>{grain({0, 0, big * (1 - gap)}, big),
                            grain({-across, 0, big + std::sqrt(along * along - across * across)}, r)});
  sim.advance(static_cast<std::int64_t>(200000 + 2000 * ratio));
  Unrest u;
  for (int k = 0; k < 1000; ++k) {
    sim.advance(100);
    keep_worst(u.fastest, motion_statistics(sim).fastest / std::sqrt(9.81 * 2 * r));
    u.damping = std::max(u.damping, check_step(sim).damping);
  }
  return u;
}

TEST(SizeRatio, ASmallGrainRestsInTheGrooveOfALargeOne) {
  // Vyas et al. (Comput. Phys. Commun. 310, 109524, 2025): velocities half a step late make a friction that
  // is not there, above a ratio of 3, and such a grain does not come to rest.
  for (const double restitution : {0.0, 0.3}) {
    for (const double ratio : {2.0, 3.0, 10.0, 30.0, 100.0}) {
      expect_small(
          "size ratio",
          fmt::format("{:g}: a small grain in a groove, mu = 0.6, e = {:g}, 1e5 steps", ratio, restitution),
          "at rest: fastest, of sqrt(g d)", 1e-6, 1e-6,
          [&](const BackEnd& b) { return unrest(ratio, restitution, 0.05, b).fastest; });
    }
  }
}

// At e = 0 and twice that step a grain jammed in the groove vibrates for ever (0.1 sqrt(g d)). A dashpot on
// predicted velocities is stable for gamma dt/m < 1; the springs' own bound, 0.27 here, does not see it.
TEST(SizeRatio, AJammedPlasticGrainAtACoarserStepIsWarnedOf) {
  for (const BackEnd& b : back_ends()) {
    const Unrest u = unrest(100, 0, 0.1, b);
    expect_outcome(
        "size ratio",
        fmt::format("100: a small grain jammed in a groove, mu = 0.6, e = 0, 0.1 sqrt(m/k) ({})", b.name),
        fmt::format("vibrates at {:.1e} sqrt(g d); the step check warns: damping {:.2f} > 1", u.fastest,
                    u.damping),
        u.fastest < 1e-6 || u.damping > 1);
  }
}

}  // namespace
}  // namespace interstice::dem
