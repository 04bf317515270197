// Adhesion from none to ten thousand times the weight: one grain under an inverted plate.
#include "tests/extremes/support.h"

namespace interstice::dem {
namespace {

using namespace testing;

const double kGravity = 9.81;

/// A law of adhesion, and the coefficients that give it a pull-off from the plate of `bond` weights.
struct Adhesive {
  const char* name;
  CohesionLaw law;
};
const Adhesive kAdhesives[] = {{"jkr", CohesionLaw::jkr},
                               {"dmt", CohesionLaw::dmt},
                               {"sjkr", CohesionLaw::sjkr},
                               {"van der Waals", CohesionLaw::van_der_waals}};

struct Plate {
  double radius = 20e-6;
  Material material{8200, 1e8, 0.3};
  CohesionLaw law = CohesionLaw::jkr;
  double bond = 1;  // pull-off over weight

  double weight() const { return sphere_mass(radius, material.density) * kGravity; }
  double modulus() const { return material.youngs_modulus / 2 / (1 - 0.09); }
  PairCoefficients pair() const {
    PairCoefficients p{.restitution = 0.2};
    const double pull = bond * weight();
    p.work_of_adhesion = pull / ((law == CohesionLaw::jkr ? 1.5 : 2) * M_PI * radius);
    // sjkr: pull-off is a third of the slope 2 pi R k at 4/9 of the equilibrium overlap (1.5 pi k/E*)^2 R.
    p.cohesion_energy_density =
        std::cbrt(pull * 27 / (8 * M_PI * radius) / (2.25 * M_PI * M_PI * radius) * modulus() * modulus());
    p.cutoff = 1e-9;
    p.range = 0.5e-6;
    p.hamaker_constant = 6 * pull * p.cutoff * p.cutoff / radius;
    return p;
  }
};

struct Outcome {
  bool hangs = false;
  double kinetic = 0;  // at the end, over m g R
};

/// The grain starts where elastic force and adhesion balance, then gravity draws at it. So strongly damped
/// (zeta = 3) that it does not overshoot: the load is as good as static. Followed for 1e5 steps of 0.05
/// sqrt(m/S).
Outcome hang(const Plate& plate, const BackEnd& b) {
  const Laws laws{.cohesion = plate.law};
  Model m = open_model(plate.material, plate.pair(), laws, 1e3 * plate.radius);
  m.damping = DampingRule::exact_when_clipped;
  m.gravity = {0, 0, -kGravity};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, -1}}, 0}};
  const double mass = sphere_mass(plate.radius, plate.material.density);
  const double start = equilibrium_overlap(laws, m.constants(0, 0), {plate.radius, mass});
  const double stiffness =
      2 * plate.modulus() * std::sqrt(plate.radius * std::max(start, 1e-7 * plate.radius));
  Simulation sim(m, 0.05 * std::sqrt(mass / stiffness), b.options);
  sim.add_grains(std::vector<NewGrain>{grain({0, 0, -plate.radius + start}, plate.radius)});
  sim.advance(100000);
  return {sim.grains() == 1 && columns(sim).z[0] > -1.02 * plate.radius,
          kinetic_sum(sim) / (mass * kGravity * plate.radius)};
}

TEST(InvertedPlate, DropsWhatWeighsMoreThanThePullOff) {
  for (const Adhesive& adhesive : kAdhesives) {
    for (const double bond : {0.0, 0.1, 0.9, 0.98, 1.02, 1.1, 10.0, 100.0, 1e4}) {
      const Plate plate{.law = adhesive.law, .bond = bond};
      std::string outcome;
      bool right = true;
      for (const BackEnd& b : back_ends()) {
        const Outcome o = hang(plate, b);
        outcome += fmt::format(
            "{}{} ({})", outcome.empty() ? "" : ", ",
            o.hangs ? fmt::format("hangs, kinetic energy {:.0e} m g R", o.kinetic) : "falls", b.name);
        right = right && o.hangs == (bond > 1) && (!o.hangs || o.kinetic < 1e-6);
      }
      expect_outcome("adhesion under a plate", fmt::format("{}, pull-off {:g} weights", adhesive.name, bond),
                     outcome, right);
    }
  }
}

TEST(InvertedPlate, HoldsGrainsOfAnySize) {
  // Titanium alloy (4430 kg/m3, w = 2e-4 J/m2): the finer, the more adhesion outweighs them. Softened to 10
  // MPa, as such powders are simulated, so that they can be followed until they rest.
  for (const double diameter : {1e-7, 1e-6, 10e-6, 35e-6, 100e-6, 200e-6, 300e-6, 500e-6, 2e-3}) {
    Plate plate{.radius = diameter / 2, .material = {4430, 1e7, 0.342}};
    plate.bond = 1.5 * M_PI * 2e-4 * plate.radius / plate.weight();
    std::string outcome;
    bool right = true;
    for (const BackEnd& b : back_ends()) {
      const Outcome o = hang(plate, b);
      outcome += fmt::format("{}{} ({})", outcome.empty() ? "" : ", ", o.hangs ? "hangs" : "falls", b.name);
      right = right && o.hangs == (plate.bond > 1);
    }
    expect_outcome(
        "grain size with adhesion",
        fmt::format("jkr, w = 0.2 mJ/m2, {:g} um: pull-off {:.3g} weights", diameter * 1e6, plate.bond),
        outcome, right);
  }
}

TEST(InvertedPlate, PullOffIsWhatTheScalesSay) {
  for (const Adhesive& adhesive : kAdhesives) {
    const Plate plate{.law = adhesive.law, .bond = 7};
    const auto c = derive_pair_constants(plate.material, plate.material, plate.pair());
    const double mass = sphere_mass(plate.radius, plate.material.density);
    const double found = bond_number({.cohesion = plate.law}, c, {plate.radius, mass}, mass, kGravity);
    expect_outcome("adhesion under a plate",
                   fmt::format("{}: bond_number of the tried coefficients", adhesive.name),
                   fmt::format("{:.6f} for 7", found), std::fabs(found / 7 - 1) < 1e-9);
  }
}

/// Two grains that meet at `speed`: do they part? Undamped.
bool parts(CohesionLaw law, double speed, const BackEnd& b) {
  Plate plate{.law = law, .bond = 100};
  PairCoefficients pair = plate.pair();
  pair.restitution = 1;
  Model m = open_model(plate.material, pair, {.cohesion = law}, 1e3 * plate.radius);
  const double contact =
      collision_time(0.5 * sphere_mass(plate.radius, 8200), plate.radius / 2, plate.modulus(), speed);
  Simulation sim(m, 2e-4 * contact, b.options);
  const double r = plate.radius;
  sim.add_grains(std::vector<NewGrain>{grain({-1.00001 * r, 0, 0}, r, {speed / 2, 0, 0}),
                                       grain({1.00001 * r, 0, 0}, r, {-speed / 2, 0, 0})});
  sim.advance(40000);
  const GrainColumns c = columns(sim);
  return c.x[1] - c.x[0] > 2.0001 * r && c.vx[1] > c.vx[0];
}

TEST(Impact, OfJkrSticksBelowTheStickingSpeed) {
  // Thornton & Ning 1998: an undamped JKR impact loses the work from touch to tear-off; slower ones stick.
  const Plate plate{.law = CohesionLaw::jkr, .bond = 100};
  const double mass = sphere_mass(plate.radius, 8200);
  const double v_s = sticking_speed({.cohesion = CohesionLaw::jkr},
                                    derive_pair_constants(plate.material, plate.material, plate.pair()),
                                    {plate.radius / 2, mass / 2});
  for (const double share : {0.1, 0.98, 1.02, 10.0}) {
    std::string outcome;
    bool right = true;
    for (const BackEnd& b : back_ends()) {
      const bool parted = parts(CohesionLaw::jkr, share * v_s, b);
      outcome += fmt::format("{}{} ({})", outcome.empty() ? "" : ", ", parted ? "parts" : "sticks", b.name);
      right = right && parted == (share > 1);
    }
    expect_outcome("sticking speed", fmt::format("jkr, e = 1, {:g} of the sticking speed", share), outcome,
                   right);
  }
}

}  // namespace
}  // namespace interstice::dem
