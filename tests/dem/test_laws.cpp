// Each law against its closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/contact/contact.h"
#include "dem/time_step.h"

namespace interstice::dem {
namespace {

// shared references: Chung & Ooi (2011) test 1, glass spheres of 10 mm at 2 x 10 m/s.
TEST(Hertz, ForceAtTheLargestOverlapOfAKnownImpact) {
  const PairConstants c = derive_pair_constants({2800, 4.8e10, 0.2}, {2800, 4.8e10, 0.2}, {});
  EXPECT_NEAR(c.effective_modulus, 25e9, 1);  // E / (2 (1 - nu^2)), exact
  const double overlap = 274.113e-6, radius = 5e-3;
  const double force =
      hertz_force(hertz_stiffness(c.effective_modulus, std::sqrt(radius * overlap)), overlap);
  EXPECT_NEAR(force, 10.6969e3,
              0.0005e3 * 1.5);  // the reference has six digits of overlap, which count 1.5 times
}

TEST(Hertz, StiffnessIsTheSlopeOfTheForce) {
  const double modulus = 1e9, radius = 2e-5, overlap = 3e-8, h = 1e-13;
  const auto force = [&](double d) {
    return hertz_force(hertz_stiffness(modulus, std::sqrt(radius * d)), d);
  };
  const double slope = (force(overlap + h) - force(overlap - h)) / (2 * h);
  EXPECT_NEAR(hertz_stiffness(modulus, std::sqrt(radius * overlap)) / slope, 1, 1e-8);  // h^2 error is 1e-12
}

TEST(PairConstants, MindlinShearModulusOfEqualBodies) {
  const PairConstants c = derive_pair_constants({1, 1e9, 0.3}, {1, 1e9, 0.3}, {});
  const double shear = 1e9 / (2 * 1.3);
  EXPECT_NEAR(c.shear_modulus, shear / (2 * (2 - 0.3)), 1e-3);  // Johnson eq. 7.42: G* = G / (2 (2 - nu))
}

TEST(PairConstants, ARigidPartnerLeavesTheSoftOne) {
  const PairConstants c = derive_pair_constants({1, 1e9, 0.3}, {1, 1e18, 0.3}, {});
  EXPECT_NEAR(c.effective_modulus * 0.91 / 1e9, 1, 2e-9);  // the moduli are 1e9 apart
}

TEST(Damping, AgreesWithTheClosedFormAtBothEnds) {
  EXPECT_EQ(damping_coefficient(1), 0);
  EXPECT_NEAR(damping_coefficient(0), 2 * std::sqrt(5.0 / 6), 1e-15);
  // alpha = sqrt(5) |beta| of the reference table relates to the coefficient c by K delta^1/4: c sqrt(3/2).
  EXPECT_NEAR(damping_coefficient(0.35) * std::sqrt(1.5), 0.70870, 5e-6);
  EXPECT_NEAR(damping_coefficient(0.9) * std::sqrt(1.5), 0.07495, 5e-6);
}

TEST(Sjkr, EqualSpheresIntersectInTheExactCircle) {
  const double r = 20e-6, overlap = 1e-6, d = 2 * r - overlap;
  EXPECT_NEAR(sphere_sphere_area(r, r, d, overlap) / (M_PI * (r * r - 0.25 * d * d)), 1, 1e-13);
}

TEST(Sjkr, UnequalSpheresIntersectInTheExactCircle) {
  const double a = 30e-6, b = 10e-6, overlap = 2e-6, d = a + b - overlap;
  const double x = (d * d + a * a - b * b) / (2 * d);  // where the plane of the circle stands
  EXPECT_NEAR(sphere_sphere_area(a, b, d, overlap) / (M_PI * (a * a - x * x)), 1, 1e-12);
}

TEST(Sjkr, SpherePlaneCircle) {
  const double r = 20e-6, d = 19e-6;
  EXPECT_NEAR(sphere_plane_area(r, r - d) / (M_PI * (r * r - d * d)), 1, 1e-13);
}

// Pull-off of paper 004's median pair: 6.64 nN, 2.58 times its weight (three digits in the reference).
TEST(Sjkr, PullOffOfTheMedianPairOfPaper004) {
  const double r = 19.7e-6, k = 1e6;
  const PairConstants c = derive_pair_constants({8200, 1e9, 0.3}, {8200, 1e9, 0.3}, {0.35, 0, 0, k});
  double lowest = 0;
  for (double overlap = 1e-11; overlap < 2e-9; overlap += 1e-12) {
    ContactKinematics<double> kin{};
    kin.normal = {1, 0, 0};
    kin.overlap = overlap;
    kin.effective_radius = 0.5 * r;
    kin.effective_mass = 1;
    kin.area = sphere_sphere_area(r, r, 2 * r - overlap, overlap);
    const auto f = evaluate_contact<ContactFeatures<false, false, true>>(kin, c, {}, 1e-9, false);
    lowest = std::min(lowest, f.force.x);
  }
  EXPECT_NEAR(-lowest, 6.64e-9, 0.01e-9);
}

TEST(Mindlin, SticksBelowTheLimitAndSlidesAtIt) {
  const Vec3d n{0, 0, 1};
  const auto stick = mindlin<double>({1e-9, 0, 0.5e-9}, n, {0, 0, 0}, 1e-8, 10, 0, 1);
  EXPECT_EQ(stick.displacement.z, 0);  // turned into the tangent plane
  EXPECT_DOUBLE_EQ(stick.force.x, -1e-8);
  const auto slide = mindlin<double>({3e-9, 4e-9, 0}, n, {0, 0, 0}, 1e-8, 10, 0, 1e-8);
  EXPECT_NEAR(norm(slide.force), 1e-8, 1e-23);
  EXPECT_NEAR(slide.displacement.x / slide.displacement.y, 0.75, 1e-15);  // its direction is kept
  EXPECT_NEAR(norm(slide.displacement), 1e-9, 1e-24);                     // what the limit can hold
}

TEST(Mindlin, FrictionDoesNotDependOnOrientation) {
  const double limit = 1e-8;
  for (double angle = 0.1; angle < 6; angle += 0.7) {
    const Vec3d along{std::cos(angle), std::sin(angle), 0};
    const auto f = mindlin<double>(1e-8 * along, {0, 0, 1}, {0, 0, 0}, 1e-8, 10, 0, limit);
    EXPECT_NEAR(dot(f.force, along), -limit, 1e-22);
  }
}

TEST(Cdt, TorqueIsConstantOpposesRollingAndLeavesTwistingAlone) {
  const Vec3d n{0, 0, 1};
  const Vec3d slow = cdt_torque<double>({0, 2, 0}, n, 0.01, 3, 5e-6),
              fast = cdt_torque<double>({0, 200, 0}, n, 0.01, 3, 5e-6);
  EXPECT_NEAR(slow.y, -0.01 * 3 * 5e-6, 1e-22);
  EXPECT_NEAR(fast.y, slow.y, 1e-22);
  EXPECT_EQ(norm(cdt_torque<double>({0, 0, 9}, n, 0.01, 3, 5e-6)), 0);
  EXPECT_EQ(norm(cdt_torque<double>({0, 0, 0}, n, 0.01, 3, 5e-6)), 0);
}

TEST(Contact, ClippingRemovesTensionButNotCohesion) {
  const PairConstants c =
      derive_pair_constants(Material{8200, 1e9, 0.3}, Material{8200, 1e9, 0.3}, {0.1, 0, 0, 1e6});
  ContactKinematics<double> kin{};
  kin.normal = {1, 0, 0};
  kin.overlap = 1e-9;
  kin.effective_radius = 1e-5;
  kin.effective_mass = 1e-10;
  kin.velocity = {1, 0, 0};  // separating fast: the dashpot pulls
  using Plain = ContactFeatures<false, false, false>;
  EXPECT_LT((evaluate_contact<Plain>(kin, c, {}, 1e-9, false).force.x), 0);
  EXPECT_EQ((evaluate_contact<Plain>(kin, c, {}, 1e-9, true).force.x), 0);
  kin.area = 1e-14;
  EXPECT_DOUBLE_EQ((evaluate_contact<ContactFeatures<false, false, true>>(kin, c, {}, 1e-9, true).force.x),
                   -1e-8);
}

// docs: Rayleigh time of the smallest grain of paper 004, 39.2 ns.
TEST(TimeStep, RayleighTimeOfPaper004) {
  EXPECT_NEAR(rayleigh_time(2.5e-6, {8200, 1e9, 0.3}), 39.2e-9, 0.05e-9);
}

// Contact times of the closed form (Hertz), five digits in the reference.
TEST(TimeStep, CollisionTimesOfChungAndOoi) {
  const double density = 2800, r = 10e-3, mass = 4.0 / 3 * M_PI * r * r * r * density;
  EXPECT_NEAR(collision_time(mass / 2, r / 2, 25e9, 20), 40.339e-6, 0.001e-6);
  const double alloy = 4.0 / 3 * M_PI * 1e-3 * 2699;
  EXPECT_NEAR(collision_time(alloy, 0.1, 7e10 / 0.91, 0.2), 731.66e-6, 0.02e-6);
}

TEST(TimeStep, LimitsTakeTheLightestAndStiffestPair) {
  Model m;
  m.materials = {{8200, 1e9, 0.3}, {2500, 70e9, 0.2}};
  m.pairs.assign(4, {});
  const StepLimits soft = step_limits(m, {{0, 5e-6}}, 0.1),
                   both = step_limits(m, {{0, 5e-6}, {1, 5e-6}}, 0.1);
  EXPECT_LT(both.collision_time, soft.collision_time);
  EXPECT_LT(both.rayleigh_time, soft.rayleigh_time);
  EXPECT_TRUE(std::isinf(step_limits(m, {{0, 5e-6}}, 0).collision_time));
}

}  // namespace
}  // namespace interstice::dem
