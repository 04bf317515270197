// Grains that start in each other or in a wall: they part, with no more energy than the overlap holds.
#include "tests/extremes/support.h"

namespace interstice::dem {
namespace {

using namespace testing;

const double kRadius = 20e-6;
const Material kSteel{8200, 1e9, 0.3};

struct Release {
  double residual = 0;  // of the energy balance over the energy that the overlap held
  double momentum = 0;  // over the momentum of one grain
  double gained = 0;    // kinetic energy over the energy that the overlap held
  bool finite = false;
};

/// Two grains at rest whose centres are `distance` apart; a twentieth of the Rayleigh time of the smaller a
/// step.
Release release(double radius_a, double radius_b, double distance, const Laws& laws, const BackEnd& b) {
  Model m = open_model(kSteel, {}, laws, 1);
  m.pairs[0] = {.restitution = 1,
                .friction = 0.3,
                .rolling_friction = 0.01,
                .cohesion_energy_density = 1e7,
                .work_of_adhesion = 0.01,
                .hamaker_constant = 1e-19,
                .cutoff = 1e-9,
                .range = 1e-6,
                .stiffness = 2e4};
  SimulationOptions options = b.options;
  options.energies = true;
  Simulation sim(m, 0.05 * rayleigh_time(std::min(radius_a, radius_b), kSteel), options);
  sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0}, radius_a),
                                       grain({distance * 0.6, 0, distance * 0.8}, radius_b)});
  Release r;
  sim.advance(1);
  const double stored = std::fabs(energy_balance(sim).inserted) + 1e-300;
  for (int s = 0; s < 400; ++s) {
    sim.advance(1);
    const EnergyBalance e = energy_balance(sim);
    keep_worst(r.residual, std::fabs(e.residual()) / stored);
    keep_worst(r.gained, e.kinetic / stored);
  }
  const GrainColumns c = columns(sim);
  r.finite = all_finite(c);
  const double p = c.mass[0] * std::hypot(c.vx[0], c.vy[0], c.vz[0]);
  r.momentum =
      std::hypot(c.mass[0] * c.vx[0] + c.mass[1] * c.vx[1], c.mass[0] * c.vz[0] + c.mass[1] * c.vz[1]) /
      std::max(p, 1e-300);
  return r;
}

/// The worst of the energy balance over several starts, as one row; a refusal (the grains shoot apart too
/// fast to follow) is right too.
void expect_bounded(const std::string& extreme, const std::string& tried, double radius_b,
                    const std::vector<double>& distances, const Laws& laws, double tolerance) {
  std::string outcome = "part with the energy of the overlap; its balance closes within";
  bool right = true;
  for (const BackEnd& b : back_ends()) {
    double worst = 0;
    int refused = 0;
    for (const double distance : distances) {
      try {
        const Release r = release(kRadius, radius_b, distance, laws, b);
        keep_worst(worst, r.residual);
        right = right && r.finite && r.momentum < 1e-9 && r.gained < 1 + tolerance;
      } catch (const UnstableError&) {
        ++refused;
      }
    }
    right = right && worst <= tolerance;
    outcome +=
        fmt::format(" {:.1e} ({}{}),", worst, b.name, refused ? fmt::format("; {} refused", refused) : "");
  }
  outcome.pop_back();
  expect_outcome(extreme, tried, outcome, right);
}

struct NamedLaws {
  const char* name;
  Laws laws;
};
const NamedLaws kLaws[] = {
    {"hertz", {}},
    {"hooke", {.normal = NormalLaw::hooke}},
    {"hertz, mindlin, epsd2", {.tangential = TangentialLaw::mindlin, .rolling = RollingLaw::epsd2}},
    {"jkr", {.cohesion = CohesionLaw::jkr}},
    {"dmt", {.cohesion = CohesionLaw::dmt}},
    {"sjkr", {.cohesion = CohesionLaw::sjkr}},
    {"van der Waals", {.cohesion = CohesionLaw::van_der_waals}}};

TEST(Overlap, OfTwoEqualGrains) {
  // Nothing may be made of it beyond what the first step (which takes the contact for absent) and the step's
  // width cost: omega dt is 0.2 at full overlap, and (omega dt)^2 = 4e-2 of the energy swings to and fro.
  for (const NamedLaws& l : kLaws) {
    std::vector<double> distances;
    for (const double share : {0.01, 0.1, 0.3, 0.6, 0.9, 0.999})
      distances.push_back(2 * kRadius * (1 - share));
    expect_bounded("initial overlap",
                   fmt::format("1, 10, 30, 60, 90, 99.9 % of the diameter, e = 1, {}", l.name), kRadius,
                   distances, l.laws, 0.04);
    expect_bounded("coincident centres",
                   fmt::format("two equal grains, e = 1, {} (they part along x)", l.name), kRadius, {0},
                   l.laws, 0.04);
  }
}

TEST(Overlap, OfASmallGrainInsideALargeOne) {
  for (const NamedLaws& l : kLaws) {  // inside below 0.75 large radii
    expect_bounded("a grain inside another",
                   fmt::format("radii 5 and 20 um, centres 24, 18, 14, 10, 2, 0.2 um apart, {}", l.name),
                   kRadius / 4, {24e-6, 18e-6, 14e-6, 10e-6, 2e-6, 0.2e-6}, l.laws, 0.04);
  }
}

TEST(Overlap, SjkrNeverRepels) {
  // Its area of intersection is a chord's circle; a sphere wholly inside another or wholly beyond a wall cuts
  // no circle, and the formula turns negative there.
  expect_small("sjkr beyond its geometry", "grain inside another; grain beyond a wall by 3 radii",
               "attraction there (of E* r^2):", 0, 0, [](const BackEnd& b) {
                 double worst = 0;
                 for (const bool wall : {false, true}) {
                   double force[2];
                   for (const bool sticky : {false, true}) {
                     Model m = open_model(kSteel, {.cohesion_energy_density = sticky ? 1e7 : 0}, {}, 1);
                     m.laws.cohesion = CohesionLaw::sjkr;
                     if (wall) m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
                     Simulation sim(m, 1e-15, b.options);
                     sim.add_grains(wall ? std::vector<NewGrain>{grain({0, 0, -3 * kRadius}, kRadius)}
                                         : std::vector<NewGrain>{grain({0, 0, 0}, kRadius),
                                                                 grain({1e-6, 0, 0}, kRadius / 4)});
                     sim.advance(1);
                     force[sticky] =
                         wall ? wall_statistics(sim, 0).normal_force : contact_statistics(sim).force_max;
                   }
                   keep_worst(worst, std::fabs(force[1] - force[0]) / (5e8 * kRadius * kRadius));
                 }
                 return worst;
               });
}

TEST(Overlap, OfAGrainInAWall) {
  // Started wholly in a floor, or in a box from which the nearest way out is up; a wall throws it out with
  // the energy of the overlap, 2/5 F overlap.
  for (const bool box : {false, true}) {
    for (const double depth :
         {0.01, 0.5, 1.0, 1.5, 3.0}) {  // overlap in radii; beyond 1 the centre is inside
      const auto error = [&](const BackEnd& b) {
        Model m = open_model(kSteel, {.restitution = 1}, {}, 1);
        const Shape shape =
            box ? Shape{Box{{-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 0}}} : Shape{Plane{{0, 0, 0}, {0, 0, 1}}};
        m.walls = {{shape, 0}};
        Simulation sim(m, 0.01 * rayleigh_time(kRadius, kSteel), b.options);
        sim.add_grains(std::vector<NewGrain>{grain({0, 0, kRadius * (1 - depth)}, kRadius)});
        const double overlap = depth * kRadius, modulus = 1e9 / 1.82;
        const double energy = 8.0 / 15 * modulus * std::sqrt(kRadius) * std::pow(overlap, 2.5);
        sim.advance(2000);
        return std::fabs(kinetic_sum(sim) / energy - 1);
      };
      // (omega dt)^2 = 2e-3 with a starting kink; and the wall's force is continuous through its surface.
      expect_small("initial overlap with a wall",
                   fmt::format("{}, {:g} radii deep, e = 1", box ? "box" : "plane", depth),
                   "thrown out with the energy of the overlap within", 1e-2, 1e-2, error);
    }
  }
}

TEST(Overlap, CohesionBeyondTheSpringCollapses) {
  // sjkr with k >= 0.85 E*: the attraction of two equal spheres exceeds Hertz's force down to the common
  // centre. Nothing holds them apart; what must not happen is energy without end.
  expect_small("sjkr stronger than the spring", "k = 2 E*, e = 0.5, 2e5 steps of 0.02 t_R",
               "pair collapses into one; finite; kinetic energy at the end, of E* r^3", 1e-3, 1e-3,
               [](const BackEnd& b) {
                 Model m = open_model(kSteel, {.restitution = 0.5, .cohesion_energy_density = 1.1e9}, {}, 1);
                 m.laws.cohesion = CohesionLaw::sjkr;
                 Simulation sim(m, 0.02 * rayleigh_time(kRadius, kSteel), b.options);
                 sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0}, kRadius),
                                                      grain({1.99 * kRadius, 0, 0}, kRadius)});
                 sim.advance(200000);
                 return all_finite(columns(sim)) ? kinetic_sum(sim) / (5.5e8 * std::pow(kRadius, 3)) : NAN;
               });
}

TEST(Energy, OfAGrainPutIntoAWallIsAccountedFor) {
  expect_small("initial overlap with a wall", "energies kept, 0.5 radii deep",
               "residual of the balance (of the overlap's energy)", 0.01, 0.01, [](const BackEnd& b) {
                 Model m = open_model(kSteel, {.restitution = 1}, {}, 1);
                 m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
                 SimulationOptions options = b.options;
                 options.energies = true;
                 Simulation sim(m, 0.01 * rayleigh_time(kRadius, kSteel), options);
                 sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0.5 * kRadius}, kRadius)});
                 const double energy =
                     8.0 / 15 * 1e9 / 1.82 * std::sqrt(kRadius) * std::pow(0.5 * kRadius, 2.5);
                 sim.advance(2000);
                 return std::fabs(energy_balance(sim).residual()) / energy;
               });
}

}  // namespace
}  // namespace interstice::dem
