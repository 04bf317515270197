// One impact of two spheres, at the ends of every parameter: restitution, stiffness, size, friction, time
// step.
#include "tests/extremes/support.h"

namespace interstice::dem {
namespace {

using namespace testing;

TEST(Restitution, OneReturnsAllEnergy) {
  // Velocity Verlet at 0.02 t_c returns it to 4e-5 (Hertz, integration over 40 phases of first touch); the
  // linear spring is discontinuous in stiffness at touch and loses up to (omega dt)^2/4 = 1e-3. Single
  // precision: rounding of 6e-8 a step over 50 steps.
  const auto error = [](NormalLaw normal, const BackEnd& b) {
    double worst = 0;
    for (const double phase : {0.0, 0.2, 0.4, 0.6, 0.8}) {
      for (const bool clip : {false, true}) {
        for (const DampingRule rule : {DampingRule::exact_with_tension, DampingRule::exact_when_clipped}) {
          Impact i{
              .laws = {.normal = normal, .clip = clip}, .damping = rule, .fraction = 0.02, .phase = phase};
          i.pair = {.restitution = 1, .stiffness = 1000};
          const Rebound r = collide(i, b);
          keep_worst(worst, std::fabs(r.restitution - 1));
        }
      }
    }
    return worst;
  };
  expect_small("e = 1", "hertz, dt 0.02 t_c, clipped or not, both damping rules, 5 phases of first touch",
               "|e - 1| at most", 1e-4, 1e-4, [&](const BackEnd& b) { return error(NormalLaw::hertz, b); });
  expect_small("e = 1", "hooke, dt 0.02 t_c, clipped or not, both damping rules, 5 phases of first touch",
               "|e - 1| at most", 1e-3, 1e-3, [&](const BackEnd& b) { return error(NormalLaw::hooke, b); });
}

TEST(Restitution, ZeroIsFiniteAndAsSmallAsTheRuleCanMakeIt) {
  // With tension: critical damping, the spheres end at rest on each other. Clipped: e^-2 with zeta = 1
  // (Schwager & Poeschel 2007); the rule exact_when_clipped stops at zeta = 3, e = 0.0238.
  struct Case {
    const char* tried;
    bool clip;
    DampingRule rule;
    double expected;
  };
  const Case cases[] = {
      {"tension kept, exact_with_tension", false, DampingRule::exact_with_tension, 0},
      {"clipped, exact_with_tension (realised e is e^-2)", true, DampingRule::exact_with_tension,
       std::exp(-2)},
      {"clipped, exact_when_clipped (the least is 0.0238)", true, DampingRule::exact_when_clipped, 0.0238},
      {"tension kept, exact_when_clipped (overdamped)", false, DampingRule::exact_when_clipped, 0}};
  for (const Case& c : cases) {
    for (const NormalLaw normal : {NormalLaw::hertz, NormalLaw::hooke}) {
      Impact i{
          .laws = {.normal = normal, .clip = c.clip}, .damping = c.rule, .fraction = 0.0005, .lasts = 12};
      i.pair = {.restitution = 0, .stiffness = 1000};
      // The dashpot starts to first order in dt: 0.1 dt/t_c of e for small damping, 3 times zeta for large.
      expect_small("e = 0", fmt::format("{}, {}", normal == NormalLaw::hertz ? "hertz" : "hooke", c.tried),
                   fmt::format("realised e is {:.4f} within", c.expected), 2e-3, 2e-3,
                   [&](const BackEnd& b) { return std::fabs(collide(i, b).restitution - c.expected); });
    }
  }
}

TEST(TimeStep, ErrorsGrowAsVelocityVerletsDo) {
  // Elastic |e - 1| over 40 phases of first touch, by independent integration of the same scheme; above
  // 0.33 t_c a contact gains energy, which the run loop refuses by StepCheck::frequency.
  const double table[][2] = {{0.01, 1e-5},  {0.02, 4e-5},   {0.05, 4.3e-4},
                             {0.1, 2.6e-3}, {0.2, 1.75e-2}, {0.33, 7.1e-2}};
  for (const auto& [fraction, largest] : table) {
    // Phases sampled need not be the reference's: 15 %. In single precision rounding adds 50 x 6e-8.
    expect_small("time step", fmt::format("{} t_c, e = 1, 40 phases of first touch", fraction),
                 fmt::format("|e - 1| as of velocity Verlet ({:.2g}):", largest), 1.15 * largest + 1e-6,
                 1.15 * largest + 2e-5, [&, step = fraction](const BackEnd& b) {
                   double worst = 0;
                   for (int p = 0; p < 40; ++p) {
                     Impact i{.fraction = step, .phase = p / 40.0};
                     keep_worst(worst, std::fabs(collide(i, b).restitution - 1));
                   }
                   return worst;
                 });
  }
}

/// The largest StepCheck::ratio and rebound of an elastic impact at a coarse step.
std::pair<double, double> coarse_impact(double fraction, const BackEnd& b) {
  double ratio = 0, rebound = 0;
  for (int p = 0; p < 40; ++p) {
    const Impact i{};
    Simulation sim(open_model(i.a, i.pair, {}, 1e-2), fraction * duration(i), b.options);
    const double gap = (2 + p / 40.0) * sim.time_step() * i.speed;
    sim.add_grains(std::vector<NewGrain>{grain({-20e-6 - gap / 2, 0, 0}, 20e-6, {i.speed / 2, 0, 0}),
                                         grain({20e-6 + gap / 2, 0, 0}, 20e-6, {-i.speed / 2, 0, 0})});
    for (int s = 0; s < 20; ++s) {
      sim.advance(1);
      ratio = std::max(ratio, check_step(sim).ratio);
    }
    const GrainColumns c = columns(sim);
    keep_worst(rebound, (c.vx[1] - c.vx[0]) / i.speed);
  }
  return {ratio, rebound};
}

TEST(TimeStep, TooCoarseIsSeenByTheStepCheck) {
  // Above 0.33 t_c an impact may gain energy; the run loop refuses a StepCheck::ratio above 0.8 (and, before
  // it starts, any dt above 0.2 t_c).
  for (const double fraction : {0.4, 0.5, 0.6}) {
    for (const BackEnd& b : back_ends()) {
      const auto [ratio, rebound] = coarse_impact(fraction, b);
      expect_outcome(
          "time step", fmt::format("{} t_c ({})", fraction, b.name),
          fmt::format("gains energy (e up to {:.2f}); check_step reports dt/sqrt(m/k) = {:.2f}, above "
                      "the 0.8 at which a run is refused",
                      rebound, ratio),
          std::isfinite(rebound) && ratio > 0.8);
    }
  }
}

TEST(Stiffness, RatioOfTheBodies) {
  // E* -> E/(1 - nu^2) of the softer body as the other stiffens: 1e-3 at a ratio of 1e3, and so on; the force
  // of a fixed overlap is Hertz's with that E*.
  for (const double ratio : {1.0, 1e3, 1e6, 1e9, 1e12}) {
    const double e = 1e7, nu = 0.3, r = 20e-6, overlap = 1e-7;
    const double rigid = e / (1 - nu * nu), expected = rigid / (1 + 1 / ratio);
    expect_small(
        "stiffness ratio", fmt::format("{:g}: grain of 10 MPa on a wall", ratio),
        fmt::format("E* is {:.3g} below the rigid limit; force of Hertz within",
                    1 - derive_pair_constants({1, e, nu}, {1, e * ratio, nu}, {}).effective_modulus / rigid),
        1e-9, 1e-6, [&](const BackEnd& b) {
          Model m = open_model({8200, e, nu}, {}, {}, 1e-3);
          m.materials.push_back({8200, e * ratio, nu});
          m.pairs = {{}, {}, {}, {}};
          m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 1}};
          Simulation sim(m, 1e-15, b.options);  // so short that nothing moves
          sim.add_grains(std::vector<NewGrain>{grain({0, 0, r - overlap}, r)});
          sim.advance(1);
          const double hertz = 4.0 / 3 * expected * std::sqrt(r) * std::pow(overlap, 1.5);
          return std::fabs(wall_statistics(sim, 0).normal_force / hertz - 1);
        });
  }
}

TEST(Sizes, RatioOfTheSpheres) {
  // Restitution depends on neither size nor stiffness: 0.0005 t_c gives it to 2e-4 (first-order start).
  for (const double ratio : {1.0, 2.0, 10.0, 100.0, 1000.0}) {
    expect_small("size ratio", fmt::format("{:g}: impact at e = 0.5, and e = 1 at 0.02 t_c", ratio),
                 "restitution and momentum within", 3e-4, 1e-3, [&](const BackEnd& b) {
                   double worst = 0;
                   Impact i{.radius_a = 5e-6, .radius_b = 5e-6 * ratio, .fraction = 0.001};
                   i.pair.restitution = 0.5;
                   const Rebound damped = collide(i, b);
                   keep_worst(worst, std::fabs(damped.restitution - 0.5));
                   keep_worst(worst, damped.momentum);
                   i.pair.restitution = 1;
                   i.fraction = 0.02;
                   keep_worst(worst, std::fabs(collide(i, b).restitution - 1));
                   return worst;
                 });
  }
}

TEST(Friction, SlidesRollsAndSaturates) {
  // Sliding throughout: the slip loses 7/2 mu (1 + e) v_n (rigid-body impulse; 7/2 = 1 + m R^2 / I).
  // Sticking: no energy made. Bodies as stiff as steel, because the line of centres turns by slip t_c / 2R
  // during the contact (7e-4 here); 0.002 t_c: the first and last step of contact are counted to first order.
  const double v_n = 0.1, slip = 0.1;
  std::vector<double> kept;
  for (const double mu : {0.0, 0.01, 0.05, 0.3, 1.0, 10.0, 100.0, 1e4}) {
    Impact i{.a = {8200, 1e11, 0.3}, .b = {8200, 1e11, 0.3}, .speed = v_n, .slip = slip, .fraction = 0.002};
    i.laws.tangential = TangentialLaw::mindlin;
    i.pair = {.restitution = 1, .friction = mu};
    const bool slides = slip / v_n >= 7.0 * mu;  // 7 (1 + e) / 2
    expect_small("friction", fmt::format("mu = {:g}, e = 1, slip = approach = 0.1 m/s", mu),
                 slides ? "slides; slip afterwards within (of the slip)" : "sticks; energy made, at most",
                 3e-3, 3e-3, [&](const BackEnd& b) {
                   const Rebound r = collide(i, b);
                   if (b.name == "double") kept.push_back(r.slip / slip);
                   if (slides) return std::fabs(r.slip - (slip - 7 * mu * v_n)) / slip;
                   return std::isfinite(r.slip) ? std::max(r.energy - 1, 0.0) : NAN;
                 });
  }
  // The ratio of tangential to normal force diverges as the contact ends, so a little slip is left at any mu;
  // it fades with 1/mu.
  const double from_10 = std::fabs(kept[7] - kept[5]), from_100 = std::fabs(kept[7] - kept[6]);
  expect_outcome("friction", "mu = 1, 10, 100, 1e4 (sticking)",
                 fmt::format("saturates: slip afterwards {:.4f}, {:.4f}, {:.4f}, {:.4f} of the slip before",
                             kept[4], kept[5], kept[6], kept[7]),
                 from_10 < 0.02 && from_100 < 0.002);
}

}  // namespace
}  // namespace interstice::dem
