// Each law against its closed form.
#include <gtest/gtest.h>

#include <cmath>

#include "dem/contact/contact.h"
#include "dem/time_step.h"

namespace interstice::dem {
namespace {

// shared references: Chung & Ooi (2011) test 1, glass spheres of 10 mm at 2 x 10 m/s.
TEST(Hertz, ForceAtTheLargestOverlapOfAKnownImpact) {
  const PairConstants<double> c = derive_pair_constants({2800, 4.8e10, 0.2}, {2800, 4.8e10, 0.2}, {});
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
  const PairConstants<double> c = derive_pair_constants({1, 1e9, 0.3}, {1, 1e9, 0.3}, {});
  const double shear = 1e9 / (2 * 1.3);
  // Johnson eq. 7.42: G* = G / (2 (2 - nu)); the ratio of stiffnesses is 4 G*/E* = 2 (1 - nu)/(2 - nu).
  EXPECT_NEAR(c.shear_ratio * c.effective_modulus / 4, shear / (2 * (2 - 0.3)), 1e-3);
  EXPECT_NEAR(c.shear_ratio, 2 * 0.7 / 1.7, 1e-15);
}

TEST(PairConstants, ARigidPartnerLeavesTheSoftOne) {
  const PairConstants<double> c = derive_pair_constants({1, 1e9, 0.3}, {1, 1e18, 0.3}, {});
  EXPECT_NEAR(c.effective_modulus * 0.91 / 1e9, 1, 2e-9);  // the moduli are 1e9 apart
}

TEST(Damping, AgreesWithTheClosedFormAtBothEnds) {
  EXPECT_EQ(damping_ratio(1), 0);
  EXPECT_EQ(damping_ratio(0), 1);
  // alpha = sqrt(5) zeta of the reference table.
  EXPECT_NEAR(damping_ratio(0.35) * std::sqrt(5.0), 0.70870, 5e-6);
  EXPECT_NEAR(damping_ratio(0.9) * std::sqrt(5.0), 0.07495, 5e-6);
  // Hertz: the coefficient of sqrt(S m*) is 2 sqrt(5/6) zeta; Hooke: 2 zeta.
  const PairCoefficients e{.restitution = 0.35};
  const Material m{1, 1e9, 0.3};
  EXPECT_NEAR(derive_pair_constants(m, m, e).damping * std::sqrt(1.5), 0.70870, 5e-6);
  EXPECT_NEAR(derive_pair_constants(m, m, e, NormalLaw::hooke).damping, 2 * damping_ratio(0.35), 1e-15);
}

// Reference table: what is returned when the force is cut off at zero (integrated there; four digits).
TEST(Damping, ClippedRestitutionIsTheTables) {
  const double table[][2] = {{0.1, 0.2527}, {0.2, 0.3249}, {0.35, 0.4342}, {0.5, 0.5503},
                             {0.7, 0.7182}, {0.8, 0.8081}, {0.9, 0.9020}};
  for (const auto& [set, realised] : table)
    EXPECT_NEAR(clipped_restitution(damping_ratio(set)), realised, 6e-5) << set;
  EXPECT_NEAR(clipped_restitution(damping_ratio(0)), std::exp(-2.0), 1e-12);
  EXPECT_EQ(clipped_restitution(0), 1);
}

TEST(Damping, ClippedRatioInvertsClippedRestitution) {
  for (const double e : {0.03, 0.1, 0.1353, 0.14, 0.35, 0.7, 0.99, 1.0})
    EXPECT_NEAR(clipped_restitution(clipped_damping_ratio(e)), e, 1e-9) << e;
  EXPECT_EQ(clipped_damping_ratio(0), kLargestClippedRatio);
}

TEST(Sjkr, EqualSpheresIntersectInTheExactCircle) {
  const double r = 20e-6, overlap = 1e-6, d = 2 * r - overlap;
  EXPECT_NEAR(sphere_sphere_area(r, r, d, 1 / d, overlap) / (M_PI * (r * r - 0.25 * d * d)), 1, 1e-13);
}

TEST(Sjkr, UnequalSpheresIntersectInTheExactCircle) {
  const double a = 30e-6, b = 10e-6, overlap = 2e-6, d = a + b - overlap;
  const double x = (d * d + a * a - b * b) / (2 * d);  // where the plane of the circle stands
  EXPECT_NEAR(sphere_sphere_area(a, b, d, 1 / d, overlap) / (M_PI * (a * a - x * x)), 1, 1e-12);
}

TEST(Sjkr, SpherePlaneCircle) {
  const double r = 20e-6, d = 19e-6;
  EXPECT_NEAR(sphere_plane_area(r, r - d) / (M_PI * (r * r - d * d)), 1, 1e-13);
}

// Pull-off of paper 004's median pair: 6.64 nN, 2.58 times its weight (three digits in the reference).
TEST(Sjkr, PullOffOfTheMedianPairOfPaper004) {
  const double r = 19.7e-6, k = 1e6;
  const PairConstants<double> c = derive_pair_constants({8200, 1e9, 0.3}, {8200, 1e9, 0.3}, {0.35, 0, 0, k});
  double lowest = 0;
  for (double overlap = 1e-11; overlap < 2e-9; overlap += 1e-12) {
    ContactKinematics<double> kin{};
    kin.normal = {1, 0, 0};
    kin.overlap = overlap;
    kin.effective_radius = 0.5 * r;
    kin.effective_mass = 1;
    kin.area = sphere_sphere_area(r, r, 2 * r - overlap, 1 / (2 * r - overlap), overlap);
    const auto f =
        evaluate_contact(Laws{.cohesion = CohesionLaw::sjkr}, kin, c, {}, step_constants<double>(1e-9, 1e-3));
    lowest = std::min(lowest, f.force.x);
  }
  EXPECT_NEAR(-lowest, 6.64e-9, 0.01e-9);
}

/// A contact that opens as fast as can be, with loaded springs, at zero overlap.
template <class T>
ContactForce<T> force_without_overlap(const Laws& laws) {
  PairConstants<double> c =
      derive_pair_constants({8200, 1e9, 0.3}, {8200, 1e9, 0.3}, {0.35, 0.3, 0.2, 1e6});
  c.stiffness = 1e3, c.work_of_adhesion = 1e-3;
  ContactKinematics<T> kin{};
  kin.normal = {T(0), T(0.6), T(0.8)};
  kin.effective_radius = T(1e-5), kin.effective_mass = T(1e-10);
  kin.area = sphere_sphere_area(T(2e-5), T(2e-5), T(4e-5), T(1) / T(4e-5), T(0));
  kin.velocity = {T(0.3), T(0.2), T(0.5)}, kin.relative_spin = {T(100), T(-20), T(3)};
  const ContactMemory<T> loaded{{{T(1e-7), T(0), T(0)}, T(10)}, {{T(0), T(1e-12), T(0)}, T(1e-9)}};
  return evaluate_contact(laws, kin, c.template as<T>(), loaded, step_constants<T>(1e-8, 1e-3));
}

/// Kernels leave out to set what these laws make zero (fades_out); the others would leave something behind.
template <class T>
void fades_out_where_it_says() {
  for (const NormalLaw normal : {NormalLaw::hertz, NormalLaw::hooke})
    for (const TangentialLaw tangential :
         {TangentialLaw::none, TangentialLaw::slider, TangentialLaw::mindlin})
      for (const RollingLaw rolling : {RollingLaw::none, RollingLaw::cdt, RollingLaw::epsd2})
        for (const CohesionLaw cohesion : {CohesionLaw::none, CohesionLaw::sjkr, CohesionLaw::dmt}) {
          const Laws laws{normal, false, tangential, rolling, cohesion};
          const ContactForce<T> f = force_without_overlap<T>(laws);
          const bool zero = f.force == Vec3<T>{} && f.rolling_torque == Vec3<T>{} &&
                            f.tangential == Vec3<T>{} && f.memory.sliding.force == Vec3<T>{} &&
                            f.memory.rolling.force == Vec3<T>{};
          EXPECT_EQ(zero, fades_out(laws)) << int(normal) << int(tangential) << int(rolling) << int(cohesion);
        }
}
TEST(Contact, FadesOutWithItsOverlapWhereItSaysSo) {
  fades_out_where_it_says<double>();
  fades_out_where_it_says<float>();
}

/// A spring that holds `force`, stored at the stiffness 10 N/m.
TangentialSpring<double> holding(const Vec3d& force) { return {force, 10}; }

TEST(Mindlin, SticksBelowTheLimitAndSlidesAtIt) {
  const Vec3d n{0, 0, 1};
  const auto stick = mindlin_force<double>(holding({-1e-8, 0, 0.5e-8}), n, {0, 0, 0}, 1e-8, 10, 0, 1);
  EXPECT_EQ(stick.force.z, 0);  // turned into the tangent plane
  EXPECT_DOUBLE_EQ(stick.force.x, -1e-8);
  const auto slide = mindlin_force<double>(holding({-3e-8, -4e-8, 0}), n, {0, 0, 0}, 1e-8, 10, 0, 1e-8);
  EXPECT_NEAR(norm(slide.force), 1e-8, 1e-23);
  EXPECT_NEAR(slide.force.x / slide.force.y, 0.75, 1e-15);  // its direction is kept
  EXPECT_EQ(norm(slide.spring.force - slide.force), 0);     // the spring holds what the limit can hold
}

TEST(Mindlin, LoadsByStiffnessTimesSlipAndOpposesIt) {
  const auto f = mindlin_force<double>({}, {0, 0, 1}, {2, -1, 0}, 1e-8, 10, 0, 1);
  EXPECT_DOUBLE_EQ(f.force.x, -10 * 2 * 1e-8);
  EXPECT_DOUBLE_EQ(f.force.y, 10 * 1e-8);
}

TEST(Mindlin, FrictionDoesNotDependOnOrientation) {
  const double limit = 1e-8;
  for (double angle = 0.1; angle < 6; angle += 0.7) {
    const Vec3d along{std::cos(angle), std::sin(angle), 0};
    const auto f = mindlin_force<double>(holding(-1e-7 * along), {0, 0, 1}, {0, 0, 0}, 1e-8, 10, 0, limit);
    EXPECT_NEAR(dot(f.force, along), -limit, 1e-22);
  }
}

// Thornton, Cummins & Cleary (2013): with the displacement held, the force stays while the contact loads and
// falls with the stiffness while it unloads: no cycle of the normal load makes energy.
TEST(Mindlin, IsRescaledOnUnloadingOnly) {
  const auto loaded = mindlin_force<double>(holding({1e-8, 0, 0}), {0, 0, 1}, {0, 0, 0}, 1e-8, 20, 0, 1);
  EXPECT_DOUBLE_EQ(loaded.force.x, 1e-8);
  const auto unloaded = mindlin_force<double>(loaded.spring, {0, 0, 1}, {0, 0, 0}, 1e-8, 5, 0, 1);
  EXPECT_DOUBLE_EQ(unloaded.force.x, 0.25e-8);
  EXPECT_GE(loaded.slip_heat, 0);
  EXPECT_GE(unloaded.slip_heat, 0);
  const double before = spring_energy(holding({1e-8, 0, 0}));
  EXPECT_NEAR(loaded.slip_heat + unloaded.slip_heat + spring_energy(unloaded.spring), before, 1e-15 * before);
}

TEST(Mindlin, HeatIsWorkLessWhatIsStored) {
  const double dt = 1e-8, k = 10, gamma = 1e-8, limit = 3e-8;
  const Vec3d v{4, 1, 0}, n{0, 0, 1};
  TangentialSpring<double> spring = holding({1e-8, -1e-8, 0});
  for (int step = 0; step < 5; ++step) {
    const auto t = mindlin_force<double>(spring, n, v, dt, k, gamma, limit);
    const bool slides = norm(t.force) > 0.999999 * limit;
    const Vec3d mean = 0.5 * (spring.force + t.spring.force);
    const double work = -dt * dot(mean, v) + (slides ? 0 : dt * gamma * dot(v, v));
    const double kept = spring_energy(t.spring) - spring_energy(spring);
    EXPECT_NEAR(t.slip_heat + t.damping_heat, work - kept, 1e-12 * work);
    spring = t.spring;
  }
}

TEST(Slider, IsCoulombAboveTheThresholdAndInProportionBelow) {
  const double limit = 1e-8, threshold = 1e-3, mass = 1e-9, dt = 1e-7;
  EXPECT_NEAR(norm(slider_force<double>({0.3, 0.4, 0}, limit, threshold, mass, dt)), limit, 1e-23);
  EXPECT_NEAR(slider_force<double>({1e-4, 0, 0}, limit, threshold, mass, dt).x, -0.1 * limit, 1e-24);
  EXPECT_EQ(norm(slider_force<double>({0, 0, 0}, limit, threshold, mass, dt)), 0);
}

TEST(Slider, NeverReversesTheSlipInAStep) {
  const double limit = 1, mass = 1e-9, dt = 1e-6, v = 1e-3;  // the limit alone would give 3.5e3 m/s
  const double taken = norm(slider_force<double>({v, 0, 0}, limit, 1e-9, mass, dt)) * dt / (2.0 / 7 * mass);
  EXPECT_NEAR(taken / v, kSliderShare, 1e-12);
}

TEST(Cdt, TorqueIsConstantOpposesRollingAndLeavesTwistingAlone) {
  const Vec3d n{0, 0, 1};
  const double limit = 0.01 * 3 * 5e-6, mass = 1e-3, radius = 5e-6, dt = 1e-9;
  const Vec3d slow = cdt_torque<double>({0, 20, 0}, n, limit, mass, radius, 1 / dt),
              fast = cdt_torque<double>({0, 200, 0}, n, limit, mass, radius, 1 / dt);
  EXPECT_NEAR(slow.y, -limit, 1e-22);
  EXPECT_NEAR(fast.y, slow.y, 1e-22);
  EXPECT_EQ(norm(cdt_torque<double>({0, 0, 9}, n, limit, mass, radius, 1 / dt)), 0);
  EXPECT_EQ(norm(cdt_torque<double>({0, 0, 0}, n, limit, mass, radius, 1 / dt)), 0);
}

TEST(Cdt, NeverReversesTheSpinOfASphereOnAWall) {
  const double mass = 1e-9, radius = 2e-5, dt = 1e-6, spin = 3;
  const double torque = cdt_torque<double>({0, spin, 0}, {0, 0, 1}, 1e3, mass, radius, 1 / dt).y;
  EXPECT_NEAR(torque * dt / (0.4 * mass * radius * radius), -kCdtShare * spin, 1e-12);
}

TEST(Epsd2, IsASpringUpToTheLimitAndIgnoresTwisting) {
  const Vec3d n{0, 0, 1};
  const auto little = epsd2_torque<double>({}, n, {0, 2, 7}, 1e-6, 1e-3, 1);
  EXPECT_DOUBLE_EQ(little.force.y, -1e-3 * 2 * 1e-6);
  EXPECT_EQ(little.force.z, 0);
  const auto much = epsd2_torque<double>(little.spring, n, {0, 2e9, 0}, 1e-6, 1e-3, 1e-2);
  EXPECT_NEAR(much.force.y, -1e-2, 1e-16);
}

TEST(Contact, ClippingRemovesTensionButNotCohesion) {
  const PairConstants<double> c =
      derive_pair_constants(Material{8200, 1e9, 0.3}, Material{8200, 1e9, 0.3}, {0.1, 0, 0, 1e6});
  ContactKinematics<double> kin{};
  kin.normal = {1, 0, 0};
  kin.overlap = 1e-9;
  kin.effective_radius = 1e-5;
  kin.effective_mass = 1e-10;
  kin.velocity = {1, 0, 0};  // separating fast: the dashpot pulls
  EXPECT_LT(evaluate_contact(Laws{}, kin, c, {}, step_constants<double>(1e-9, 1e-3)).force.x, 0);
  EXPECT_EQ(evaluate_contact(Laws{.clip = true}, kin, c, {}, step_constants<double>(1e-9, 1e-3)).force.x, 0);
  kin.area = 1e-14;
  EXPECT_DOUBLE_EQ(evaluate_contact(Laws{.clip = true, .cohesion = CohesionLaw::sjkr}, kin, c, {},
                                    step_constants<double>(1e-9, 1e-3))
                       .force.x,
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
