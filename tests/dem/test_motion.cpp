// Motion against closed forms: flight, impact, rolling, sliding, walls, boundaries.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "dem/statistics.h"
#include "dem/time_step.h"
#include "tests/dem/scenes.h"

namespace interstice::dem {
namespace {

using testing::plain_model;
using testing::powder;

NewGrain grain(const Vec3d& position, double radius, const Vec3d& velocity = {0, 0, 0},
               const Vec3d& spin = {0, 0, 0}) {
  return {position, radius, velocity, spin, 0, 0};
}

GrainColumns columns(const Simulation& sim) {
  GrainColumns c;
  sim.copy_columns(c);
  return c;
}

TEST(Flight, IsExactUnderGravity) {
  Model m = plain_model(powder(), {}, {});
  m.gravity = {1, -2, -9.81};
  Simulation sim(m, 1e-5);
  const std::vector<NewGrain> g{grain({0, 0, 0.5}, 1e-4, {0.3, 0, 0.1})};
  sim.add_grains(g);
  sim.advance(10000);
  const GrainColumns c = columns(sim);
  const double t = 0.1;
  // Verlet is exact for a constant acceleration; 1e4 roundings of 1e-16 of 0.5 m remain.
  EXPECT_NEAR(c.x[0], 0.3 * t + 0.5 * t * t, 1e-13);
  EXPECT_NEAR(c.y[0], -t * t, 1e-13);
  EXPECT_NEAR(c.z[0], 0.5 + 0.1 * t - 0.5 * 9.81 * t * t, 1e-13);
  EXPECT_NEAR(c.vz[0], 0.1 - 9.81 * t, 1e-12);
}

/// Rebound over approach of two 40 um spheres meeting head on at +-v/2, at a step of `fraction` of the
/// contact time, first touched at `phase` of a step.
double rebound(double restitution, double fraction, double phase, bool clip, double speed = 0.1) {
  const double r = 20e-6;
  Model m = plain_model(powder(), {restitution, 0, 0, 0}, Laws{.clip = clip});
  const double mass = 4.0 / 3 * M_PI * r * r * r * 8200;
  const double contact = collision_time(mass / 2, r / 2, 1e9 / (2 * 0.91), speed);
  Simulation sim(m, fraction * contact);
  const double gap = (2 + phase) * sim.time_step() * speed;
  sim.add_grains(std::vector<NewGrain>{grain({-r - gap / 2, 0, 0}, r, {speed / 2, 0, 0}),
                                       grain({r + gap / 2, 0, 0}, r, {-speed / 2, 0, 0})});
  sim.advance(static_cast<std::int64_t>(4 / fraction) + 10);
  const GrainColumns c = columns(sim);
  EXPECT_EQ(c.vx[0], -c.vx[1]);  // momentum, to the bit
  return (c.vx[1] - c.vx[0]) / speed;
}

double mean_rebound(double restitution, double fraction, bool clip) {
  double sum = 0;
  for (int p = 0; p < 40; ++p) sum += rebound(restitution, fraction, p / 40.0, clip);
  return sum / 40;
}

TEST(Restitution, IsWhatWasAskedForAsTheStepShrinks) {
  for (const double e : {0.1, 0.2, 0.35, 0.5, 0.7, 0.9}) {
    EXPECT_NEAR(rebound(e, 0.0005, 0.3, false), e, 2e-4)
        << e;  // first-order start of the dashpot: 0.1 dt/t_c
  }
  EXPECT_NEAR(rebound(0.35, 0.001, 0.3, false), 0.350, 0.001);
  EXPECT_NEAR(rebound(1.0, 0.005, 0.3, false), 1, 1e-5);  // reference table 5.1
}

// Realised restitution when the force is clipped at zero, by integrating the equation of motion (reference
// table 2.2).
TEST(Restitution, ClippedIsAsTheReferenceIntegrated) {
  const double table[][2] = {{0.1, 0.2527}, {0.2, 0.3249}, {0.35, 0.4342},
                             {0.5, 0.5503}, {0.7, 0.7182}, {0.9, 0.9020}};
  for (const auto& [set, realised] : table)
    EXPECT_NEAR(rebound(set, 0.0005, 0.3, true), realised, 3e-4) << set;
}

TEST(Restitution, PerfectlyPlasticSpheresDoNotBounce) {
  // e = 0 with tension: the overdamped limit separates with (almost) nothing; no NaN from ln 0.
  const double e = rebound(0, 0.001, 0.3, false);
  EXPECT_TRUE(std::isfinite(e));
  EXPECT_NEAR(rebound(0, 0.0005, 0.3, true), std::exp(-2.0), 2e-3);  // clipped at e = 0: e^-2
}

TEST(Restitution, DoesNotDependOnSpeed) {
  EXPECT_NEAR(rebound(0.35, 0.001, 0.3, false, 0.01), rebound(0.35, 0.001, 0.3, false, 1.0), 1e-9);
}

TEST(Restitution, ErrorsOfCoarseStepsStayInTheReferenceBand) {
  // Reference table 5.1 (velocity Verlet, 40 phases of first touch): elastic error at 0.02, 0.05 and 0.1 t_c.
  const double table[][2] = {{0.02, 4e-5}, {0.05, 4.3e-4}, {0.1, 2.6e-3}};
  for (const auto& [fraction, largest] : table) {
    double worst = 0;
    for (int p = 0; p < 40; ++p)
      worst = std::max(worst, std::fabs(rebound(1, fraction, p / 40.0, false) - 1));
    EXPECT_LE(worst, 1.15 * largest) << fraction;  // the phases sampled need not be the reference's
  }
  EXPECT_NEAR(mean_rebound(0.35, 0.02, false), 0.35, 0.006);
}

TEST(Restitution, OnAWallAndOnABoxEdgeAreTheSame) {
  const double r = 20e-6, v = 0.1;
  for (const Shape& shape :
       {Shape{Plane{{0, 0, 0}, {0, 0, 1}}}, Shape{Box{{-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 0}}},
        Shape{Box{{-1e-3, -1e-3, -1e-3}, {0, 1e-3, 0}}}}) {
    Model m = plain_model(powder(), {0.35, 0, 0, 0}, {});
    m.walls = {{shape, 0}};
    const double mass = 4.0 / 3 * M_PI * r * r * r * 8200;
    Simulation sim(m, 1e-3 * collision_time(mass, r, 1e9 / (2 * 0.91), v));
    const bool edge = std::holds_alternative<Box>(shape) && std::get<Box>(shape).hi.x == 0;
    const Vec3d n = edge ? Vec3d{std::sqrt(0.5), 0, std::sqrt(0.5)} : Vec3d{0, 0, 1};
    sim.add_grains(std::vector<NewGrain>{grain((r + 2.5 * sim.time_step() * v) * n, r, -v * n)});
    sim.advance(3000);
    const GrainColumns c = columns(sim);
    EXPECT_NEAR(dot({c.vx[0], c.vy[0], c.vz[0]}, n) / v, 0.35, 5e-4);
  }
}

TEST(Impact, LargestOverlapAndForceOfChungAndOoiTestOne) {
  Model m = plain_model({2800, 4.8e10, 0.2}, {1, 0, 0, 0}, {});
  const double r = 10e-3, contact = 40.339e-6;
  Simulation sim(m, contact / 2000);
  sim.add_grains(std::vector<NewGrain>{grain({-r - 1e-8, 0, 0}, r, {10, 0, 0}),
                                       grain({r + 1e-8, 0, 0}, r, {-10, 0, 0})});
  double deepest = 0, strongest = 0;
  for (int s = 0; s < 2200; ++s) {
    sim.advance(1);
    const GrainColumns c = columns(sim);
    deepest = std::max(deepest, 2 * r - (c.x[1] - c.x[0]));
    strongest = std::max(strongest, contact_statistics(sim).force_max);
  }
  EXPECT_NEAR(deepest, 274.113e-6, 0.001e-6);  // closed form, six digits
  EXPECT_NEAR(strongest, 10.6969e3, 0.001e3);
}

/// A 1 mm sphere on a floor that stays put vertically: it starts at its equilibrium overlap.
Simulation rolling(const PairCoefficients& pair, const Laws& laws, double v0) {
  const double r = 1e-3;
  Model m = plain_model({2500, 1e8, 0.3}, pair, laws);
  m.gravity = {0, 0, -9.81};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  const double mass = 4.0 / 3 * M_PI * r * r * r * 2500;
  const double overlap = std::pow(mass * 9.81 / (4.0 / 3 * (1e8 / (2 * 0.91)) * std::sqrt(r)), 2.0 / 3);
  Simulation sim(m, 1e-6);
  sim.add_grains(std::vector<NewGrain>{grain({-0.5, 0, r - overlap}, r, {v0, 0, 0})});
  return sim;
}

TEST(Friction, SlidingTurnsIntoRollingAtFiveSeventhsOfTheSpeed) {
  const double v0 = 1, mu = 0.3;
  Simulation sim = rolling({0.5, mu, 0, 0}, testing::with_friction(), v0);
  sim.advance(120000);  // t = 2 v0 / (7 mu g) = 97.08 ms, and some
  const GrainColumns c = columns(sim);
  EXPECT_NEAR(c.vx[0], 5.0 / 7 * v0, 2e-4);    // overlap shortens the arm by 1e-4 relative
  EXPECT_NEAR(c.wy[0] * 1e-3, c.vx[0], 5e-4);  // it rolls
  const double t1 = 2 * v0 / (7 * mu * 9.81), x1 = 12 * v0 * v0 / (49 * mu * 9.81);
  EXPECT_NEAR(c.x[0] + 0.5, x1 + (0.12 - t1) * 5.0 / 7 * v0, 2e-4 * 0.1 * 2);
}

TEST(Rolling, ConstantTorqueStopsTheSphereWhereTheClosedFormSays) {
  const double v0 = 0.1, mu_r = 0.02;
  Simulation sim = rolling({0.5, 0.5, mu_r, 0}, testing::with_rolling(), v0);
  // Start it rolling: a spin that matches.
  Model m = sim.model();
  Simulation spinning(m, 1e-6);
  const GrainColumns start = columns(sim);
  spinning.add_grains(
      std::vector<NewGrain>{grain({-0.5, 0, start.z[0]}, 1e-3, {v0, 0, 0}, {0, v0 / 1e-3, 0})});
  const double a = 5.0 / 7 * mu_r * 9.81, x_stop = v0 * v0 / (2 * a);
  spinning.advance(static_cast<std::int64_t>(0.5 * v0 / a / 1e-6));
  EXPECT_NEAR(columns(spinning).vx[0], 0.5 * v0, 2e-3 * v0);
  spinning.advance(static_cast<std::int64_t>(0.6 * v0 / a / 1e-6));
  EXPECT_NEAR(columns(spinning).x[0] + 0.5, x_stop, 5e-3 * x_stop);
}

TEST(Boundaries, AGrainThatLeavesIsCountedAndGone) {
  Model m = plain_model(powder(), {}, {});
  m.domain = {{0, 0, 0}, {1e-3, 1e-3, 1e-3}};
  Simulation sim(m, 1e-6);
  sim.add_grains(
      std::vector<NewGrain>{grain({5e-4, 5e-4, 5e-4}, 1e-5, {1, 0, 0}), grain({5e-4, 2e-4, 5e-4}, 1e-5)});
  sim.advance(1000);
  EXPECT_EQ(sim.grains(), 1u);
  EXPECT_EQ(sim.grains_lost(), 1);
  EXPECT_EQ(columns(sim).id[0], 1);
}

TEST(Boundaries, TheLastGrainMayLeaveAndOthersCome) {
  Model m = plain_model(powder(), {}, {});
  m.domain = {{0, 0, 0}, {1e-3, 1e-3, 1e-3}};
  for (const Rates& rates : {Rates{}, Rates{2e-5, 2}}) {
    Simulation sim(m, 1e-6, {.rates = rates});
    const std::vector<NewGrain> fast{grain({5e-4, 5e-4, 5e-4}, 1e-5, {1, 0, 0})};
    for (int round = 1; round <= 2; ++round) {
      sim.add_grains(fast);
      sim.advance(1000);
      EXPECT_EQ(sim.grains(), 0u);
      EXPECT_EQ(sim.grains_lost(), round);
    }
  }
}

TEST(Boundaries, PeriodicPairsCollideThroughTheFace) {
  const double r = 20e-6;
  Model m = plain_model(powder(), {0.35, 0.3, 0.01, 0}, testing::with_rolling());
  m.domain = {{0, 0, 0}, {4e-4, 4e-4, 4e-4}};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::open, AxisBoundary::open};
  Simulation across(m, 1e-8);
  across.add_grains(std::vector<NewGrain>{grain({1e-6, 2e-4, 2e-4}, r, {-0.1, 0, 0}),
                                          grain({3.5e-4, 2.1e-4, 2e-4}, r, {0.1, 0, 0})});
  Simulation inside(m, 1e-8);
  inside.add_grains(std::vector<NewGrain>{grain({2.01e-4, 2e-4, 2e-4}, r, {-0.1, 0, 0}),
                                          grain({1.5e-4, 2.1e-4, 2e-4}, r, {0.1, 0, 0})});
  across.advance(20000);
  inside.advance(20000);
  const GrainColumns a = columns(across), b = columns(inside);
  EXPECT_GT(a.vx[0], 0);  // it did bounce
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(a.vx[i], b.vx[i],
                1e-9);  // positions differ by rounding of 1e-19 m; the contact multiplies it
    EXPECT_NEAR(a.wz[i], b.wz[i], 1e-4);
  }
}

TEST(Boundaries, APeriodicAxisShorterThanTwoGrainsIsRefused) {
  Model m = plain_model(powder(), {}, {});
  m.domain = {{0, 0, 0}, {7e-5, 1e-3, 1e-3}};
  m.boundary[0] = AxisBoundary::periodic;
  Simulation sim(m, 1e-8);
  sim.add_grains(std::vector<NewGrain>{grain({1e-5, 5e-4, 5e-4}, 2e-5)});
  EXPECT_THROW(sim.advance(1), InputError);
}

TEST(Walls, AMovingBoxPushesAGrainAtItsSpeed) {
  Model m = plain_model(powder(), {0.1, 0, 0, 0}, {});
  m.walls = {{Box{{-1e-3, -1e-3, -1e-3}, {0, 1e-3, 1e-3}}, 0}};
  Simulation sim(m, 2e-8);
  sim.add_grains(std::vector<NewGrain>{grain({1e-4, 0, 0}, 2e-5)});
  sim.set_wall_velocity(0, {0.05, 0, 0});
  sim.advance(200000);  // 4 ms: the box has come 0.2 mm
  EXPECT_NEAR(std::get<Box>(sim.walls()[0]).hi.x, 2e-4, 1e-15);
  EXPECT_NEAR(columns(sim).vx[0], 0.05 * 1.1, 1e-4);  // one bounce at e = 0.1, then it flies ahead
  sim.set_wall_velocity(0, {0, 0, 0});
  sim.advance(1000);
  EXPECT_NEAR(std::get<Box>(sim.walls()[0]).hi.x, 2e-4, 1e-15);
}

/// A hundred grains in the way of a box that moves at 10 m/s, after the box has come 0.4 mm.
Simulation swept_by_a_fast_box(double step) {
  Model m = plain_model(powder(), {0.35, 0.3, 0.005, 0}, testing::with_rolling());
  m.domain = {{-1e-2, -1e-2, -1e-2}, {1e-2, 1e-2, 1e-2}};
  m.walls = {{Box{{-1e-3, -1e-3, -1e-3}, {0, 1e-3, 1e-3}}, 0}};
  Simulation sim(m, step);
  std::vector<NewGrain> g;
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < 10; ++j) g.push_back(grain({(i + 1) * 4.5e-5, j * 4.5e-5, 0}, 2e-5));
  }
  sim.add_grains(g);
  sim.set_wall_velocity(0, {10, 0, 0});
  sim.advance(static_cast<std::int64_t>(4e-4 / (10 * step)));
  return sim;
}

TEST(Walls, NoGrainCrossesAFastBox) {
  const Simulation sim = swept_by_a_fast_box(2e-8);
  const double face = std::get<Box>(sim.walls()[0]).hi.x;
  EXPECT_NEAR(face, 4e-4, 1e-12);
  for (const double x : columns(sim).x) EXPECT_GT(x, face);
}

TEST(Walls, AStepTooCoarseForAFastBoxIsRefusedRatherThanCrossed) {
  EXPECT_THROW(swept_by_a_fast_box(9e-7), UnstableError);  // 0.45 of a radius a step
}

TEST(Guards, AGrainThatOutrunsItsOwnRadiusStopsTheRun) {
  Simulation sim(plain_model(powder(), {}, {}), 1e-4);
  sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0}, 1e-5, {1, 0, 0})});
  EXPECT_THROW(sim.advance(1), UnstableError);
}

TEST(Guards, CoincidentCentresPartWithoutNan) {
  Simulation sim(plain_model(powder(), {0.35, 0.3, 0.005, 1e6}, testing::everything()), 1e-12);
  sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0}, 2e-5), grain({0, 0, 0}, 2e-5)});
  sim.advance(10);
  const GrainColumns c = columns(sim);
  EXPECT_TRUE(std::isfinite(c.vx[0]));
  EXPECT_EQ(c.vx[0], -c.vx[1]);
  EXPECT_GT(c.x[0], c.x[1]);
}

TEST(Cohesion, ReturnsAllEnergyWithoutDamping) {
  // SJKR has no hysteresis: e = 1 comes back whole (1e-4 at 0.02 t_c; here 0.002 t_c).
  const double r = 20e-6, v = 0.02;
  Model m = plain_model(powder(), {1, 0, 0, 1e6}, testing::with_sjkr());
  const double mass = 4.0 / 3 * M_PI * r * r * r * 8200;
  Simulation sim(m, 0.002 * collision_time(mass / 2, r / 2, 1e9 / (2 * 0.91), v));
  sim.add_grains(std::vector<NewGrain>{grain({-r - 1e-10, 0, 0}, r, {v / 2, 0, 0}),
                                       grain({r + 1e-10, 0, 0}, r, {-v / 2, 0, 0})});
  sim.advance(3000);
  const GrainColumns c = columns(sim);
  EXPECT_NEAR((c.vx[1] - c.vx[0]) / v, 1, 1e-5);
}

TEST(Cohesion, HoldsASlowPairTogether) {
  const double r = 20e-6;
  Model m = plain_model(powder(), {0.35, 0, 0, 1e6}, testing::with_sjkr());
  Simulation sim(m, 2e-8);
  sim.add_grains(
      std::vector<NewGrain>{grain({-r, 0, 0}, r, {1e-5, 0, 0}), grain({r, 0, 0}, r, {-1e-5, 0, 0})});
  sim.advance(200000);
  const GrainColumns c = columns(sim);
  // Equilibrium overlap (1.5 pi k / E*)^2 R* (closed form for small overlap): 0.736 nm here.
  const double expected = std::pow(1.5 * M_PI * 1e6 / (1e9 / 1.82), 2) * r / 2;
  EXPECT_NEAR((2 * r - (c.x[1] - c.x[0])) / expected, 1, 1e-3);
}

TEST(Conservation, MomentumOfAGasOfGrainsStays) {
  Model m = plain_model(powder(), {0.9, 0.5, 0.01, 0}, testing::with_rolling());
  m.domain = {{0, 0, 0}, {4e-4, 4e-4, 4e-4}};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::periodic, AxisBoundary::periodic};
  Simulation sim(m, 1e-8);
  Random random(3, 0);
  std::vector<NewGrain> g;
  for (int i = 0; i < 125; ++i) {
    g.push_back(grain({(i % 5 + 0.5) * 8e-5, (i / 5 % 5 + 0.5) * 8e-5, (i / 25 + 0.5) * 8e-5},
                      random.uniform(1e-5, 3e-5),
                      {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}));
  }
  sim.add_grains(g);
  const auto momentum = [&] {
    const GrainColumns c = columns(sim);
    Vec3d p{0, 0, 0};
    double scale = 0;
    for (std::size_t i = 0; i < c.id.size(); ++i) {
      p += c.mass[i] * Vec3d{c.vx[i], c.vy[i], c.vz[i]};
      scale += c.mass[i];
    }
    return (1 / scale) * p;
  };
  const Vec3d before = momentum();
  sim.advance(20000);
  EXPECT_LT(norm(momentum() - before), 1e-12);  // of 1 m/s: roundings only
  EXPECT_LT(motion_statistics(sim).kinetic_energy, 1e-3);
}

}  // namespace
}  // namespace interstice::dem
