// Large grains and small ones in frictional contact. With velocities at half steps a velocity-Verlet scheme
// makes friction that is not there above size ratios of about 3, and small grains stick to large ones (Vyas,
// Ottino, Lueptow & Umbanhowar, Comput. Phys. Commun. 310, 109524, 2025): here a small grain must roll where
// it should, and heaps must stay where they should.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/rain.h"
#include "dem/simulation.h"
#include "dem/time_step.h"
#include "tests/dem/scenes.h"
#include "tests/report/report.h"

namespace interstice::dem {
namespace {

using interstice::testing::expect_between;
using interstice::testing::expect_ratio;
using interstice::testing::Reference;

constexpr double kGravity = 9.81, kLarge = 5e-3;  // [m/s^2], radius of the large grains [m]

struct BackEnd {
  const char* name;
  SimulationOptions options;
};

const std::vector<BackEnd>& back_ends() {
  static const std::vector<BackEnd> list{
      {"double", {}}, {"reference", {.reference = true}}, {"mixed", {.precision = Precision::mixed}}};
  return list;
}

const GrainRow& grain_of(const Simulation& sim, std::int64_t id) {
  return *std::find_if(sim.rows().begin(), sim.rows().end(), [&](const GrainRow& g) { return g.id == id; });
}

/// Sets all velocities to zero. The springs of the contacts stay as they are.
void halt(Simulation& sim) {
  SavedState state = sim.save();
  for (const char* name : {"vx", "vy", "vz", "wx", "wy", "wz"}) {
    std::vector<double>& column = state.real.at(name);
    std::fill(column.begin(), column.end(), 0.0);
  }
  sim.restore(state);
}

double fastest(const Simulation& sim) {  // of centres, and of surfaces by spin [m/s]
  double speed = 0;
  for (const GrainRow& g : sim.rows())
    speed = std::max({speed, norm(g.velocity()), g.radius * norm(g.spin())});
  return speed;
}

/// The largest speed within `steps` steps, looked at every 50.
double fastest_within(Simulation& sim, std::int64_t steps) {
  double speed = 0;
  for (std::int64_t s = 0; s < steps; s += 50) {
    sim.advance(50);
    speed = std::max(speed, fastest(sim));
  }
  return speed;
}

// The test of Vyas et al. (with the numbers of their input published with LAMMPS,
// examples/granular/in.sync_verlet: mu 0.5, 1 degree off the top, large spheres of 10 mm): a small sphere in
// the crevice between two large ones that touch rolls down the valley. Without slip it is a pendulum on the
// circle of radius rho about the line of the large centres that spins at (R + r)/r of its angular velocity:
// theta' = sqrt(2 g (cos theta_0 - cos theta) / (rho (1 + 2/5 (R + r)^2/rho^2))).
constexpr double kStartAngle = M_PI / 180;

struct Crevice {
  double small, rho, inertia;  // [m], [m], [-]

  explicit Crevice(double ratio)
      : small(kLarge / ratio),
        rho(std::sqrt((kLarge + small) * (kLarge + small) - kLarge * kLarge)),
        inertia(1 + 0.4 * (kLarge + small) * (kLarge + small) / (rho * rho)) {}
  double rate_at(double angle) const {
    return std::sqrt(2 * kGravity * (std::cos(kStartAngle) - std::cos(angle)) / (rho * inertia));
  }
};

/// The large spheres are held between walls, at rest on a floor to which they are far too heavy to respond.
Simulation crevice_scene(const Crevice& c, const SimulationOptions& options) {
  const Material large{.density = 2.5e9, .youngs_modulus = 1e14, .poisson_ratio = 0.3};
  const Material small{.density = 2500, .youngs_modulus = 1e8, .poisson_ratio = 0.3};
  const PairCoefficients frictional{.restitution = 0.5, .friction = 0.5};
  Model m = testing::plain_model(large, frictional, testing::with_friction());
  m.materials.push_back(small);
  m.pairs.assign(4, frictional);
  // No gravity: the small sphere is driven sideways by nothing but its own weight, which is put in by tilting
  // nothing; see below.
  m.gravity = {0, 0, 0};
  Simulation sim(m, 0.05 * rayleigh_time(c.small, small), options);
  return sim;
}

}  // namespace
}  // namespace interstice::dem
