// What comes back from an impact, against what was asked for; and what a coarse time step makes of it.
#include "tests/verification/set_up.h"

namespace interstice::dem::verification {
namespace {

class Restitution : public OnEachBackEnd {};

/// How an impact of two equal spheres is set up.
struct Setting {
  NormalLaw normal = NormalLaw::hertz;
  bool clip = false;
  DampingRule rule = DampingRule::exact_with_tension;
  double restitution = 1;
  double fraction = 5e-4;  // time step over contact time
};

/// Rebound over approach when first touch comes `phase` of a step after a step.
double rebound(const Setting& s, double phase, const BackEnd& b) {
  const double radius = 20e-6, speed = 0.1, stiffness = 500;
  const Material material{8200, 1e9, 0.3};
  Model m = plain_model(material, {.restitution = s.restitution, .stiffness = stiffness},
                        {.normal = s.normal, .clip = s.clip});
  m.damping = s.rule;
  const double mass = mass_of(radius, material) / 2;
  const double contact = s.normal == NormalLaw::hertz
                             ? collision_time(mass, radius / 2, m.constants(0, 0).effective_modulus, speed)
                             : M_PI * std::sqrt(mass / stiffness);
  Simulation sim(m, s.fraction * contact, b.options);
  const double gap = (2 + phase) * sim.time_step() * speed;
  sim.add_grains(std::vector<NewGrain>{sphere({-radius - gap / 2, 0, 0}, radius, {speed / 2, 0, 0}),
                                       sphere({radius + gap / 2, 0, 0}, radius, {-speed / 2, 0, 0})});
  const Encountered e = meet(sim, static_cast<std::int64_t>(20 / s.fraction) + 10);
  return e.rebound / e.approach;
}

struct Spread {
  double mean = 0, least = 1e300, most = -1e300;
};
Spread over_phases(const Setting& s, int phases, const BackEnd& b) {
  Spread out;
  for (int p = 0; p < phases; ++p) {
    const double e = rebound(s, static_cast<double>(p) / phases, b);
    out.mean += e / phases;
    out.least = std::min(out.least, e);
    out.most = std::max(out.most, e);
  }
  return out;
}

std::string with(const char* name, double value) { return name + std::to_string(value).substr(0, 5); }

// 2000 steps a contact; a dashpot that starts up to a step late shifts e by less than the step over the
// contact time, and the mean of four phases by less than a third of that.
constexpr double kFine = 2e-4;

TEST_P(Restitution, IsWhatWasAskedFor) {
  const Reference r{"Restitution with tension allowed until the bodies part",
                    "Tsuji et al. 1992; Antypov & Elliott 2011: exact for both springs"};
  for (const NormalLaw normal : {NormalLaw::hertz, NormalLaw::hooke}) {
    const std::string law = normal == NormalLaw::hertz ? "hertz, " : "hooke, ";
    for (const double e : {0.1, 0.2, 0.35, 0.5, 0.7, 0.8, 0.9, 1.0}) {
      const double got = over_phases({.normal = normal, .restitution = e}, 4, GetParam()).mean;
      expect_close(r, GetParam().row(law + with("e = ", e)), got, e, kFine);
    }
  }
}

TEST_P(Restitution, ClippedIsAsIntegrated) {
  const Reference r{"Restitution when the force is cut off at zero, damping not corrected",
                    "Schwager & Poeschel 2007, and the equation of motion integrated apart from this code"};
  const double table[][2] = {{0.1, 0.2527}, {0.2, 0.3249}, {0.35, 0.4342}, {0.5, 0.5503},
                             {0.7, 0.7182}, {0.8, 0.8081}, {0.9, 0.9020},  {0, 0.1353}};  // e = 0: exp(-2)
  for (const NormalLaw normal : {NormalLaw::hertz, NormalLaw::hooke}) {
    const std::string law = normal == NormalLaw::hertz ? "hertz, " : "hooke, ";
    for (const auto& [set, realised] : table) {
      const Setting s{.normal = normal, .clip = true, .restitution = set};
      expect_close(r, GetParam().row(law + with("asked for ", set)), over_phases(s, 4, GetParam()).mean,
                   realised,
                   kFine + 5e-5);  // four digits in the table
    }
  }
}

TEST_P(Restitution, ClippedAndCorrectedIsWhatWasAskedFor) {
  const Reference r{"Restitution when the force is cut off at zero, damping corrected for it",
                    "Schwager & Poeschel 2007: exact from e = 0.03"};
  for (const NormalLaw normal : {NormalLaw::hertz, NormalLaw::hooke}) {
    const std::string law = normal == NormalLaw::hertz ? "hertz, " : "hooke, ";
    for (const double e : {0.03, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.0}) {
      const Setting s{
          .normal = normal, .clip = true, .rule = DampingRule::exact_when_clipped, .restitution = e};
      // The overdamped dashpots of small e act at once: there the late start counts some ten times.
      expect_close(r, GetParam().row(law + with("e = ", e)), over_phases(s, 4, GetParam()).mean, e,
                   e < 0.2 ? 2e-3 : kFine);
    }
  }
}

TEST_P(Restitution, OfNothingIsNearlyNothing) {
  const Reference r{"Restitution 0", "critical damping never brings the bodies back to touch: e -> 0"};
  const double got = rebound({.restitution = 0}, 0.3, GetParam());
  expect_close(r, GetParam().row("tension allowed"), got, 0, 0.01);
  const Setting clipped{.clip = true, .rule = DampingRule::exact_when_clipped, .restitution = 0};
  expect_close({"Restitution 0", "least value of the corrected rule, zeta = 3 (Schwager & Poeschel 2007)"},
               GetParam().row("cut off at zero"), over_phases(clipped, 4, GetParam()).mean, 0.0238, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(BackEnds, Restitution, ::testing::ValuesIn(back_ends()), name_of);

const char* const kVerlet =
    "velocity Verlet of one Hertz contact, 40 phases of first touch, integrated apart";

TEST(TimeStep, ErrorOfAnElasticImpact) {
  const double table[][2] = {{0.005, 1e-5},  {0.01, 1e-5},   {0.02, 4e-5}, {0.05, 4.3e-4}, {0.1, 2.6e-3},
                             {0.2, 1.75e-2}, {0.33, 7.1e-2}, {0.4, 0.16},  {0.5, 1.39}};
  const Reference r{"Largest error of e = 1 at a coarse time step", kVerlet};
  for (const auto& [fraction, error] : table) {
    const Spread s = over_phases({.fraction = fraction}, 40, {"double", {}});
    const double got = std::max(s.most - 1, 1 - s.least);
    // The table has one to three digits; the phases sampled need not be the same.
    if (fraction < 0.02) {
      expect_between(r, with("dt/t_c = ", fraction), got, 0, 1.5 * error);
    } else {
      expect_ratio(r, with("dt/t_c = ", fraction), got, error, fraction < 0.05 ? 0.15 : 0.08);
    }
  }
}

TEST(TimeStep, GateOfMercuryDpm) {
  // Two spheres of 0.5 m and 1 kg at +-1 m/s, e = 0.8, 50 steps a contact: 0.8 +- 0.01.
  const Material material{6 / M_PI, 20000 * 2 * (1 - 0.09), 0.3};
  const Model m = plain_model(material, {.restitution = 0.8}, {});
  Simulation sim(m, collision_time(0.5, 0.25, 20000, 2) / 50);
  sim.add_grains(
      std::vector<NewGrain>{sphere({-0.55, 0, 0}, 0.5, {1, 0, 0}), sphere({0.55, 0, 0}, 0.5, {-1, 0, 0})});
  const Encountered e = meet(sim, 1000);
  expect_close({"Self-test of MercuryDPM: Hertz spheres, 50 steps a contact", "MercuryDPM, with its gate"},
               "speed afterwards [m/s]", e.rebound / 2, 0.8, 0.01);
}

TEST(TimeStep, OrderOfAnElasticImpact) {
  const auto error = [](double fraction) {
    const Spread s = over_phases({.fraction = fraction}, 40, {"double", {}});
    return std::max(s.most - 1, 1 - s.least);
  };
  // Velocity Verlet alone would give 2; but the energy that it errs by in mid-contact it has given back when
  // the bodies part, and what stays comes from the first step of a force that begins as the 3/2 power: 1 +
  // 3/2.
  const Reference r{"Order of the time step for e = 1",
                    "onset of a 3/2 power force within a step: order 5/2"};
  expect_close(r, "measured order, dt 0.04 -> 0.02 t_c", std::log2(error(0.04) / error(0.02)), 2.5, 0.1);
  expect_close(r, "measured order, dt 0.02 -> 0.01 t_c", std::log2(error(0.02) / error(0.01)), 2.5, 0.1);
}

TEST(TimeStep, ErrorOfADampedImpact) {
  struct Row {
    double fraction, mean, least, most;
  };
  const Reference r{"e = 0.35 at a coarse time step", kVerlet};
  for (const Row& row :
       {Row{0.005, .3492, .3490, .3498}, Row{0.01, .3485, .3477, .3497}, Row{0.02, .3469, .3451, .3494},
        Row{0.05, .3427, .3380, .3521}, Row{0.1, .3342, .3190, .3552}, Row{0.2, .3186, .2826, .3667}}) {
    const Spread s = over_phases({.restitution = 0.35, .fraction = row.fraction}, 40, {"double", {}});
    // The reference's dashpot sees the velocity of the half step, this code's the velocity of the step itself
    // (predicted to second order, see Simulation::begin_rows): nearer to e at fine steps, and farther at 0.2,
    // where no run should be. So ours is held to the reference's worst phase up to 0.1, and both are shown.
    const double bound = std::max(row.most - 0.35, 0.35 - row.least);
    if (row.fraction < 0.15) expect_close(r, with("mean at dt/t_c = ", row.fraction), s.mean, 0.35, bound);
    disclose(r, with("mean at dt/t_c = ", row.fraction), s.mean, row.mean,
             "with half-step velocities in the dashpot");
    disclose(r, with("least at dt/t_c = ", row.fraction), s.least, row.least,
             "with half-step velocities in the dashpot");
    disclose(r, with("most at dt/t_c = ", row.fraction), s.most, row.most,
             "with half-step velocities in the dashpot");
  }
}

}  // namespace
}  // namespace interstice::dem::verification
