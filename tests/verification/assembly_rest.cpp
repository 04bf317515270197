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

using interstice::testing::disclose;
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

GrainRow grain_of(const Simulation& sim, std::int64_t id) {
  std::size_t slot = 0;
  while (sim.site(slot).id != id) ++slot;
  return sim.row(slot);
}

/// Sets all velocities to zero; the springs of the contacts stay as they are.
void halt(Simulation& sim) {
  constexpr std::size_t reals_per_grain = 17, first = 3, last = 9;  // position, velocity, spin, ...
  SavedState state = sim.save();
  std::vector<double>& grains = state.real.at("grains");
  for (std::size_t at = 0; at < grains.size(); at += reals_per_grain) {
    std::fill(grains.begin() + static_cast<std::ptrdiff_t>(at + first),
              grains.begin() + static_cast<std::ptrdiff_t>(at + last), 0.0);
  }
  sim.restore(state);
}

double fastest(const Simulation& sim) {  // of centres [m/s]
  double speed = 0;
  for (const GrainRow& g : sim.rows()) speed = std::max(speed, norm(g.velocity()));
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

double mass_of(double radius, double density) { return 4.0 / 3 * M_PI * radius * radius * radius * density; }

/// How deep a sphere's weight presses it into a plane of the same material (Hertz).
double resting_overlap(double radius, const Material& m) {
  const double modulus = m.youngs_modulus / (2 * (1 - m.poisson_ratio * m.poisson_ratio));
  return std::pow(0.75 * mass_of(radius, m.density) * kGravity / (modulus * std::sqrt(radius)), 2.0 / 3);
}

class SizeRatio : public ::testing::TestWithParam<BackEnd> {};
INSTANTIATE_TEST_SUITE_P(BackEnds, SizeRatio, ::testing::ValuesIn(back_ends()),
                         [](const auto& backend) { return backend.param.name; });

// The test of Vyas et al. (with the numbers of their input in examples/granular/in.sync_verlet of LAMMPS: mu
// 0.5, 1 degree off the top, large spheres of 10 mm): a small sphere in the crevice between two large ones
// that touch must roll down, not stick. Without slip it is a pendulum on the circle of radius rho about the
// line of the large centres that spins (R + r)/r times as fast as it turns: theta'^2 = 2 g (cos theta_0 - cos
// theta) / (rho I), I = 1
// + 2/5 (R + r)^2/rho^2. Friction can enforce that up to some 60 degrees.
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
  /// From rest at the start to a (small) angle [s].
  double time_to(double angle) const {
    return std::acosh(angle / kStartAngle) / std::sqrt(kGravity / (rho * inertia));
  }
};

/// No grain can be held fast, so the large spheres are heavy, stiff, and lie on a floor between two walls.
Simulation crevice_scene(const Crevice& c, const SimulationOptions& options) {
  const Material heavy{.density = 2.5e5, .youngs_modulus = 1e11, .poisson_ratio = 0.3};
  const Material light{.density = 2500, .youngs_modulus = 1e7, .poisson_ratio = 0.3};
  const PairCoefficients frictional{.restitution = 0.5, .friction = 0.5};
  Model m = testing::plain_model(heavy, frictional, testing::with_friction());
  m.materials.push_back(light);
  m.pairs.assign(4, frictional);
  m.gravity = {0, 0, -kGravity};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0},
             {Plane{{-2 * kLarge, 0, 0}, {1, 0, 0}}, 0},
             {Plane{{2 * kLarge, 0, 0}, {-1, 0, 0}}, 0}};
  const double z = kLarge - resting_overlap(kLarge, heavy);
  std::vector<NewGrain> grains{
      {{-kLarge, 0, z}, kLarge, {}, {}, 0, 0},
      {{kLarge, 0, z}, kLarge, {}, {}, 0, 0},
      {{0, c.rho * std::sin(kStartAngle), z + c.rho * std::cos(kStartAngle)}, c.small, {}, {}, 1, 0}};
  Simulation sim(m, 0.1 * rayleigh_time(c.small, light), options);
  sim.add_grains(grains);
  return sim;
}

TEST_P(SizeRatio, ASmallSphereRollsDownTheCreviceOfTwoLargeOnes) {
  for (const double ratio : {3.0, 10.0, 30.0, 100.0}) {
    const Reference vyas{fmt::format("Three-particle test, size ratio {}, {}", ratio, GetParam().name),
                         "Vyas et al. 2025; rolling pendulum, closed form"};
    const Crevice c(ratio);
    Simulation sim = crevice_scene(c, GetParam().options);
    for (const double degrees : {5.0, 40.0}) {
      const double target = degrees * M_PI / 180;
      double angle = 0, angle_rate = 0;
      while (angle < target && sim.time() < 3 * c.time_to(target)) {
        sim.advance(20);
        const GrainRow small = grain_of(sim, 2), large = grain_of(sim, 0);
        angle = std::atan2(small.y - large.y, small.z - large.z);
        angle_rate = (small.vy * std::cos(angle) - small.vz * std::sin(angle)) / c.rho;
      }
      // 0.5 %: the small sphere starts just above contact and bounces as it finds its balance.
      expect_ratio(vyas, fmt::format("dθ/dt at {}° [rad/s]", degrees), angle_rate, c.rate_at(angle), 0.005);
      if (degrees > 5) {
        expect_ratio(vyas, "spin over dθ/dt", -grain_of(sim, 2).wx / angle_rate, (kLarge + c.small) / c.small,
                     0.005);
      } else {  // where sin θ = θ holds within 0.1 %
        expect_ratio(vyas, "time to 5° [s]", sim.time(), c.time_to(angle), 0.005);
      }
    }
  }
}

/// Speed [m/s] to which the roundings of single precision, 6e-8 of the large grain's load, keep a small grain
/// shaking on its contact: acceleration over frequency.
double shaking_speed(double small, const Material& m) {
  const double load = mass_of(kLarge, m.density) * kGravity / 3, mass = mass_of(small, m.density);
  const double modulus = m.youngs_modulus / (2 * (1 - m.poisson_ratio * m.poisson_ratio));
  const double radius = small * kLarge / (small + kLarge);
  const double overlap = std::pow(0.75 * load / (modulus * std::sqrt(radius)), 2.0 / 3);
  return 6e-8 * load / mass / std::sqrt(2 * modulus * std::sqrt(radius * overlap) / mass);
}

// A large grain on three small ones on a floor: friction alone keeps the small ones from rolling out. The
// dashpots, made for the reduced mass, hardly brake the large one at such ratios, so its motion is halted
// again and again.
TEST_P(SizeRatio, ALargeGrainRestsOnThreeSmallOnes) {
  const Material m{.density = 2500, .youngs_modulus = 1e9, .poisson_ratio = 0.3};
  for (const double ratio : {3.0, 10.0, 30.0, 100.0}) {
    const double r = kLarge / ratio, a = 1.02 * 2 * r / std::sqrt(3.0);
    Model model = testing::plain_model(m, {.restitution = 0.2, .friction = 0.5}, testing::with_friction());
    model.gravity = {0, 0, -kGravity};
    model.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
    std::vector<NewGrain> grains{
        {{0, 0, r + std::sqrt((kLarge + r) * (kLarge + r) - a * a)}, kLarge, {}, {}, 0, 0}};
    for (const double angle : {0.0, 2 * M_PI / 3, 4 * M_PI / 3})
      grains.push_back({{a * std::cos(angle), a * std::sin(angle), r}, r, {}, {}, 0, 0});
    Simulation sim(model, 0.1 * rayleigh_time(r, m), GetParam().options);
    sim.add_grains(grains);
    for (int k = 0; k < 100; ++k) {
      sim.advance(static_cast<std::int64_t>(100 * std::pow(ratio, 0.9)));  // about a quarter of its period
      halt(sim);
    }
    const double unit = std::sqrt(kGravity * 2 * r);
    const bool single = GetParam().options.precision == Precision::mixed;
    expect_between(
        {"Large grain at rest on three small ones", "Vyas et al. 2025: v < 1e-6 √(g d) for 1e5 steps"},
        fmt::format("fastest speed over √(g d), size ratio {}, {}", ratio, GetParam().name),
        fastest_within(sim, 100000) / unit, 0, std::max(1e-6, single ? 2 * shaking_speed(r, m) / unit : 0));
  }
}

// A heap of small grains that leans on a large one. Rolling friction with a spring (epsd2), because spheres
// roll away on a flat floor without.
TEST_P(SizeRatio, AHeapOfSmallGrainsAgainstALargeOneComesToRest) {
  const Material m{.density = 2500, .youngs_modulus = 1e7, .poisson_ratio = 0.3};
  const PairCoefficients rough{.restitution = 0.2, .friction = 0.5, .rolling_friction = 0.2};
  const Laws laws{.tangential = TangentialLaw::mindlin, .rolling = RollingLaw::epsd2};
  // the reference back end's search makes many small grains dear
  const bool reference = GetParam().options.reference;
  for (const double ratio : reference ? std::vector{10.0} : std::vector{10.0, 30.0, 100.0}) {
    const double r = kLarge / ratio, wedge = 2 * std::sqrt(kLarge * r);
    Model model = testing::plain_model(m, rough, laws);
    model.gravity = {0, 0, -kGravity};
    model.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
    Simulation sim(model, 0.15 * rayleigh_time(r, m), GetParam().options);
    sim.add_grains(
        std::vector<NewGrain>{{{0, 0, kLarge - resting_overlap(kLarge, m)}, kLarge, {}, {}, 0, 0}});
    Rain rain;
    rain.radii.assign(30, r);
    rain.box = {{wedge, -5 * r, 0}, {wedge + 20 * r, 5 * r, 14 * r}};
    while (!rain.finished()) {
      pour(sim, rain);
      sim.advance(2000);
    }
    sim.advance(80000);
    const double unit = std::sqrt(kGravity * 2 * r);
    const Reference resting{"Heap of small grains against a large one",
                            "at rest: v < 1e-6 √(g d) for 1e5 steps"};
    expect_between(resting,
                   fmt::format("fastest speed over √(g d), size ratio {}, {}", ratio, GetParam().name),
                   fastest_within(sim, 100000) / unit, 0, 1e-6);
    double spin = 0;
    for (const GrainRow& g : sim.rows()) spin = std::max(spin, g.radius * norm(g.spin()));
    disclose(resting, fmt::format("fastest r ω over √(g d), size ratio {}, {}", ratio, GetParam().name),
             spin / unit, 0,
             "nothing stops a spin about the normal of a contact: there is no twisting friction");
  }
}

}  // namespace
}  // namespace interstice::dem
