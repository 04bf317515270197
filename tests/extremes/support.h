// What the extremes share: the back ends, small models of any scale, one impact of two spheres.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/error.h"
#include "dem/contact/hooke.h"
#include "dem/contact_scales.h"
#include "dem/simulation.h"
#include "dem/statistics.h"
#include "dem/time_step.h"
#include "tests/report/report.h"

namespace interstice::dem::testing {

using interstice::testing::expect_outcome;

/// The ways in which the same model can be run; every extreme is tried on each.
struct BackEnd {
  std::string name;
  SimulationOptions options{};
  bool mixed() const { return options.precision == Precision::mixed; }
};

inline std::vector<BackEnd> back_ends() {
  return {{"double", {}},
          {"reference", {.reference = true}},
          {"mixed", {.reference = false, .skin = 0, .precision = Precision::mixed}}};
}

/// One row: `error(back end)` is held against `tolerance` (double) or `tolerance_mixed`. NaN fails.
template <class Error>
void expect_small(const std::string& extreme, const std::string& tried, const std::string& what,
                  double tolerance, double tolerance_mixed, const Error& error) {
  std::string outcome = what;
  bool right = true;
  for (const BackEnd& b : back_ends()) {
    const double found = error(b);
    right = right && found <= (b.mixed() ? tolerance_mixed : tolerance);
    outcome += fmt::format("{} {:.1e} ({})", outcome.size() == what.size() ? "" : ",", found, b.name);
  }
  expect_outcome(extreme, tried, outcome, right);
}

/// std::max lets a NaN pass unseen; this one keeps it.
inline void keep_worst(double& worst, double value) {
  if (!(value <= worst)) worst = value;
}

inline double sphere_mass(double radius, double density) {
  return 4.0 / 3 * M_PI * radius * radius * radius * density;
}

inline GrainColumns columns(const Simulation& sim) {
  GrainColumns c;
  sim.copy_columns(c);
  return c;
}

inline NewGrain grain(const Vec3d& position, double radius, const Vec3d& velocity = {0, 0, 0},
                      const Vec3d& spin = {0, 0, 0}, std::uint16_t material = 0) {
  return {position, radius, velocity, spin, material, 0};
}

/// One material, no gravity, a domain of +-`half` [m].
inline Model open_model(const Material& material, const PairCoefficients& pair, const Laws& laws,
                        double half) {
  Model m;
  m.domain = {{-half, -half, -half}, {half, half, half}};
  m.gravity = {0, 0, 0};
  m.materials = {material};
  m.pairs = {pair};
  m.laws = laws;
  return m;
}

inline bool all_finite(const GrainColumns& c) {
  for (const auto* column : {&c.x, &c.y, &c.z, &c.vx, &c.vy, &c.vz, &c.wx, &c.wy, &c.wz}) {
    for (const double v : *column) {
      if (!std::isfinite(v)) return false;
    }
  }
  return true;
}

/// Two spheres that meet along x.
struct Impact {
  double radius_a = 20e-6, radius_b = 20e-6;  // [m]
  Material a{8200, 1e9, 0.3}, b{8200, 1e9, 0.3};
  PairCoefficients pair{};
  Laws laws{};
  DampingRule damping = DampingRule::exact_with_tension;
  double speed = 0.1;      // of approach [m/s]
  double slip = 0;         // tangential, along y [m/s]
  double fraction = 0.01;  // time step over the duration of the contact
  double phase = 0.3;      // first touch within a step
  double lasts = 4;        // how long to follow it, in durations of the contact
};

struct Rebound {
  double restitution = 0;  // normal
  double slip = 0;         // of the surfaces afterwards [m/s]
  double momentum = 0;     // |sum| over the sum of magnitudes
  double energy = 0;       // kinetic, after over before
  bool finite = true;
};

inline double duration(const Impact& i) {
  const double ma = sphere_mass(i.radius_a, i.a.density), mb = sphere_mass(i.radius_b, i.b.density);
  const double mass = ma * mb / (ma + mb), radius = i.radius_a * i.radius_b / (i.radius_a + i.radius_b);
  if (i.laws.normal == NormalLaw::hooke) return hooke_contact_time(mass, i.pair.stiffness, 0);
  return collision_time(mass, radius, derive_pair_constants(i.a, i.b, i.pair).effective_modulus, i.speed);
}

inline double kinetic_sum(const Simulation& sim) { return motion_statistics(sim).kinetic_energy; }

inline Rebound collide(const Impact& i, const BackEnd& back_end) {
  Model m = open_model(i.a, i.pair, i.laws, 100 * (i.radius_a + i.radius_b));
  m.materials = {i.a, i.b};
  m.pairs = {i.pair, i.pair, i.pair, i.pair};
  m.damping = i.damping;
  Simulation sim(m, i.fraction * duration(i), back_end.options);
  const double gap = (2 + i.phase) * sim.time_step() * i.speed;
  const double ma = sphere_mass(i.radius_a, i.a.density), mb = sphere_mass(i.radius_b, i.b.density);
  const double share_a = mb / (ma + mb), share_b = ma / (ma + mb);  // the centre of mass stays
  sim.add_grains(std::vector<NewGrain>{
      grain({-i.radius_a - gap * share_a, 0, 0}, i.radius_a, {i.speed * share_a, i.slip * share_a, 0}),
      grain({i.radius_b + gap * share_b, 0, 0}, i.radius_b, {-i.speed * share_b, -i.slip * share_b, 0},
            {0, 0, 0}, 1)});
  const double before = kinetic_sum(sim);
  sim.advance(static_cast<std::int64_t>(i.lasts / i.fraction) + 10);
  const GrainColumns c = columns(sim);
  Rebound r;
  r.finite = all_finite(c);
  r.restitution = (c.vx[1] - c.vx[0]) / i.speed;
  r.slip = c.vy[0] - c.vy[1] + i.radius_a * c.wz[0] + i.radius_b * c.wz[1];
  r.momentum = std::hypot(ma * c.vx[0] + mb * c.vx[1], ma * c.vy[0] + mb * c.vy[1]) /
               (std::hypot(ma * i.speed * share_a, ma * i.slip * share_a) * 2);
  r.energy = kinetic_sum(sim) / before;
  return r;
}

}  // namespace interstice::dem::testing
