// What the verification programs share: the back ends that each runs on, and encounters of one or two bodies.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

#include "dem/simulation.h"
#include "dem/time_step.h"
#include "tests/dem/scenes.h"
#include "tests/report/report.h"

namespace interstice::dem::verification {

using interstice::testing::disclose;
using interstice::testing::expect_between;
using interstice::testing::expect_close;
using interstice::testing::expect_ratio;
using interstice::testing::Reference;
using testing::plain_model;

/// One way to compute the same thing.
struct BackEnd {
  std::string name;
  SimulationOptions options;

  bool mixed() const { return options.precision == Precision::mixed; }
  /// The bound that fits how finely this back end rounds.
  double either(double in_double, double in_mixed) const { return mixed() ? in_mixed : in_double; }
  /// A row's quantity, with the back end that it was measured on.
  std::string row(const std::string& quantity) const { return quantity + " (" + name + ")"; }
};
inline std::ostream& operator<<(std::ostream& out, const BackEnd& b) { return out << b.name; }

inline std::vector<BackEnd> back_ends() {
  return {{"double", {}}, {"reference", {.reference = true}}, {"mixed", {.precision = Precision::mixed}}};
}

/// A test body that runs on each back end.
class OnEachBackEnd : public ::testing::TestWithParam<BackEnd> {};
inline std::string name_of(const ::testing::TestParamInfo<BackEnd>& info) { return info.param.name; }

inline NewGrain sphere(const Vec3d& position, double radius, const Vec3d& velocity = {0, 0, 0},
                       const Vec3d& spin = {0, 0, 0}, std::uint16_t material = 0) {
  return {.position = position, .radius = radius, .velocity = velocity, .spin = spin, .material = material};
}

inline double mass_of(double radius, const Material& m) {
  return 4.0 / 3 * M_PI * std::pow(radius, 3) * m.density;
}

/// How many times stiffer than the sphere a "rigid" wall is: E* is then short of E/(1 - nu^2) by 1e-6.
inline constexpr double kRigid = 1e6;

/// A floor at z = 0, of a material so stiff that it does not deform.
inline Model on_rigid_floor(const Material& material, const PairCoefficients& pair, const Laws& laws) {
  Model m = plain_model(material, pair, laws);
  Material rigid = material;
  rigid.youngs_modulus *= kRigid;
  m.materials = {material, rigid};
  m.pairs = {pair, pair, pair, pair};
  m.walls = {{.shape = Plane{{0, 0, 0}, {0, 0, 1}}, .material = 1}};
  return m;
}

inline GrainRow grain_of(const Simulation& sim, std::int64_t id) {
  std::size_t slot = 0;
  while (sim.site(slot).id != id) ++slot;
  return sim.row(slot);
}

/// Between the surfaces of the only two bodies, two grains or a grain and the floor z = 0 [m].
inline double gap_of(const Simulation& sim) {
  const GrainRow a = grain_of(sim, 0);
  if (sim.grains() == 1) return a.z - a.radius;
  const GrainRow b = grain_of(sim, 1);
  return norm(a.position() - b.position()) - a.radius - b.radius;
}

/// The state of that contact, and its force on the first grain (a wall's: on the grain).
struct ContactNow {
  ContactState state = ContactState::apart;
  Vec3d force{0, 0, 0};
};
inline ContactNow contact_of(const Simulation& sim) {
  for (std::size_t k = 0; k < sim.wall_contacts().places(); ++k) {
    const WallContact w = sim.wall_contacts().at(k);
    if (w.state != ContactState::apart) return {w.state, w.force};
  }
  const PairContacts& p = sim.pair_contacts();
  for (std::size_t k = 0; k < p.places(); ++k) {
    if (p.memories().state(k) != ContactState::apart) return {p.memories().state(k), p.memories().force(k)};
  }
  return {};
}

/// What an encounter was like. Afterwards the bodies are apart, unless `parted` is false.
struct Encountered {
  bool parted = false;
  double deepest = 0;    // overlap [m]
  double strongest = 0;  // largest force [N]
  double duration = 0;   // [s]
  double approach = 0;   // speed at which the gap closed [m/s]
  double rebound = 0;    // and opened [m/s]
};

/// Advances until the two bodies have met and parted, at most for `limit` steps. They must start apart, by
/// more than a step. First and last touch are interpolated along the free flights before and after.
inline Encountered meet(Simulation& sim, std::int64_t limit) {
  Encountered e;
  const double dt = sim.time_step(), start = gap_of(sim);
  sim.advance(1);
  e.approach = (start - gap_of(sim)) / dt;
  bool met = false;
  for (std::int64_t s = 0; s < limit && !e.parted; ++s) {
    sim.advance(1);
    const ContactNow now = contact_of(sim);
    met = met || now.state == ContactState::touching;
    e.parted = met && now.state == ContactState::apart;
    e.deepest = std::max(e.deepest, -gap_of(sim));
    e.strongest = std::max(e.strongest, norm(now.force));
  }
  const double gap = gap_of(sim), time = sim.time();
  sim.advance(1);
  e.rebound = (gap_of(sim) - gap) / dt;
  e.duration = time - gap / e.rebound - start / e.approach;
  return e;
}

}  // namespace interstice::dem::verification
