// Every elastic force is the slope of its potential, F = -dU/dr = dU/d(overlap), by central differences; and
// the tabulated points of the adhesive laws.
#include <functional>

#include "dem/contact/contact.h"
#include "dem/contact_scales.h"
#include "tests/verification/set_up.h"

namespace interstice::dem::verification {
namespace {

constexpr double kModulus = 5e8, kRadius = 1e-5, kWork = 0.02;  // E* [Pa], R* [m], w [J/m^2]

const char* const kSlope = "central difference of the potential, as F = -dU/dr in any textbook";

/// Holds force(overlap) to the slope of energy(overlap) at several overlaps.
void hold_slope(const std::string& law, const std::function<double(double)>& force,
                const std::function<double(double)>& energy, std::initializer_list<double> overlaps) {
  for (const double overlap : overlaps) {
    const double h = 1e-4 * std::fabs(overlap);  // h^2 gives 1e-8, rounding of the energies 1e-12
    const double slope = (energy(overlap + h) - energy(overlap - h)) / (2 * h);
    expect_ratio({"Force as the slope of a potential: " + law, kSlope},
                 "at overlap " + std::to_string(overlap * 1e9) + " nm [uN]", force(overlap) * 1e6,
                 slope * 1e6, 1e-6);
  }
}

TEST(Potential, OfHertzAndHooke) {
  const auto hertz = [](double d) {
    return hertz_force(hertz_stiffness(kModulus, std::sqrt(kRadius * d)), d);
  };
  hold_slope("hertz", hertz, [&](double d) { return hertz_energy(hertz(d), d); }, {1e-9, 3e-8, 1e-6});
  hold_slope(
      "hooke", [](double d) { return hooke_force(700.0, d); },
      [](double d) { return hooke_energy(700.0, d); }, {1e-9, 3e-8, 1e-6});
}

TEST(Potential, OfJkrOnBothSidesOfTouch) {
  const double reach = jkr_reach(kModulus, kWork, kRadius);
  const auto radius = [](double d) { return jkr_contact_radius(kModulus, kWork, kRadius, d); };
  hold_slope(
      "jkr", [&](double d) { return jkr_force(kModulus, kWork, kRadius, radius(d)); },
      [&](double d) { return jkr_energy(kModulus, kWork, kRadius, radius(d)); },
      {-0.99 * reach, -0.5 * reach, -1e-3 * reach, 1e-3 * reach, 0.5 * reach, reach, 10 * reach, 1e-6});
}

TEST(Potential, OfTheIntersectionOfSpheresAndPlanes) {
  const double k = 1e6;
  for (const double b : {1e-5, 3e-5, 4e-4}) {
    const double a = 1e-5;
    hold_slope(
        "sjkr, radii 10 and " + std::to_string(b * 1e6).substr(0, 3) + " um",
        [&](double d) { return sjkr_attraction(k, sphere_sphere_area(a, b, a + b - d, 1 / (a + b - d), d)); },
        [&](double d) { return k * sphere_sphere_area_integral(a, b, a + b - d, d); }, {1e-9, 3e-8, 2e-6});
  }
  hold_slope(
      "sjkr, on a plane", [&](double d) { return sjkr_attraction(k, sphere_plane_area(1e-5, d)); },
      [&](double d) { return k * sphere_plane_area_integral(1e-5, d); }, {1e-9, 3e-8, 2e-6});
}

TEST(Potential, OfDmtAndVanDerWaals) {
  const double hamaker = 1e-19, cutoff = 1.65e-10, range = 1e-7;
  hold_slope(
      "dmt", [](double) { return dmt_attraction(kWork, kRadius); },
      [](double d) { return dmt_attraction(kWork, kRadius) * d; }, {1e-9, 3e-8});
  hold_slope(
      "van der Waals", [&](double d) { return van_der_waals_attraction(hamaker, cutoff, range, kRadius, d); },
      [&](double d) { return van_der_waals_work(hamaker, cutoff, range, kRadius, d); },
      {-9e-8, -1e-8, -1e-9, -2e-10, -1e-10, 1e-9});
}

TEST(AdhesionLaws, JkrPassesThroughThePointsOfItsCurve) {
  const Reference r{"JKR curve: points in units of F_c = 3/2 pi w R* and delta_c",
                    "Johnson, Kendall & Roberts 1971"};
  const double a0 = std::cbrt(9 * M_PI * kWork * kRadius * kRadius / (2 * kModulus));
  const double force_unit = 1.5 * M_PI * kWork * kRadius,
               length_unit = a0 * a0 / (2 * std::cbrt(6.0) * kRadius);
  struct Point {
    const char* name;
    double overlap, radius, force;
  };
  expect_ratio(r, "tear-off overlap over -delta_c", jkr_reach(kModulus, kWork, kRadius) / length_unit, 1,
               1e-12);
  // The table has six digits of the radius and four of the overlap; at the least of the force the slope is
  // zero.
  for (const Point& p : {Point{"equilibrium", 1.2114, 1, 0}, Point{"first touch", 0, 0.763143, -8.0 / 9},
                         Point{"least force", -0.4807, 0.629961, -1}}) {
    const double a = jkr_contact_radius(kModulus, kWork, kRadius, p.overlap * length_unit);
    expect_close(r, std::string(p.name) + ": contact radius over a0", a / a0, p.radius, 5e-5);
    expect_close(r, std::string(p.name) + ": force", jkr_force(kModulus, kWork, kRadius, a) / force_unit,
                 p.force, 2e-4);
  }
  // At tear-off the slope is infinite: the radius has the square root of the rounding.
  const double a = jkr_contact_radius(kModulus, kWork, kRadius, -length_unit);
  expect_close(r, "tear-off: contact radius over a0", a / a0, 0.302853, 2e-6);
  expect_close(r, "tear-off: force", jkr_force(kModulus, kWork, kRadius, a) / force_unit, -5.0 / 9, 2e-6);
}

TEST(AdhesionLaws, WorkOfTearingAJkrContact) {
  const Reference r{"JKR: work in units of (w^5 R*^4 / E*^2)^(1/3)",
                    "closed form from Johnson, Kendall & Roberts 1971"};
  const double unit = std::cbrt(std::pow(kWork, 5) * std::pow(kRadius, 4) / (kModulus * kModulus));
  const double reach = jkr_reach(kModulus, kWork, kRadius);
  const double a0 = std::cbrt(9 * M_PI * kWork * kRadius * kRadius / (2 * kModulus));
  // Simpson's rule of the force over s = sqrt(overlap + reach), which smooths the infinite slope at tear-off.
  const auto work = [&](double from) {
    const int n = 2000;
    const double top = std::sqrt(from + reach);
    double sum = 0;
    for (int i = 0; i <= n; ++i) {
      const double s = top * i / n, a = jkr_contact_radius(kModulus, kWork, kRadius, s * s - reach);
      sum += (i == 0 || i == n ? 1 : i % 2 ? 4 : 2) * -jkr_force(kModulus, kWork, kRadius, a) * 2 * s;
    }
    return sum * top / n / 3;
  };
  expect_ratio(r, "from first touch, by quadrature", work(0) / unit, 7.0922, 1e-5);
  expect_ratio(r, "from equilibrium, by quadrature", work(a0 * a0 / (3 * kRadius)) / unit, 11.6946, 1e-5);
  const double tear = jkr_contact_radius(kModulus, kWork, kRadius, -reach);
  expect_ratio(r, "from first touch, jkr_energy", jkr_energy(kModulus, kWork, kRadius, tear) / unit, 7.0922,
               1e-5);
  const double rest = jkr_energy(kModulus, kWork, kRadius, a0);
  expect_ratio(r, "from equilibrium, jkr_energy", (jkr_energy(kModulus, kWork, kRadius, tear) - rest) / unit,
               11.6946, 1e-5);
}

TEST(AdhesionLaws, PullOffForces) {
  PairConstants<double> c;
  c.effective_modulus = kModulus;
  c.work_of_adhesion = kWork;
  c.cohesion_energy_density = 1e6;
  c.hamaker_constant = 1e-19, c.cutoff = 1.65e-10, c.range = 1e-7;
  const Encounter pair{kRadius, 1e-12};
  const Reference r{"Pull-off force [nN]",
                    "JKR 3/2 pi w R*; DMT 2 pi w R*; A R*/(6 D0^2) (Israelachvili 2011); sjkr in "
                    "closed form for small overlaps"};
  const auto pull = [&](CohesionLaw law) { return 1e9 * pull_off_force({.cohesion = law}, c, pair); };
  expect_ratio(r, "jkr", pull(CohesionLaw::jkr), 1e9 * 1.5 * M_PI * kWork * kRadius, 1e-14);
  expect_ratio(r, "dmt", pull(CohesionLaw::dmt), 1e9 * 2 * M_PI * kWork * kRadius, 1e-14);
  expect_ratio(r, "van der Waals", pull(CohesionLaw::van_der_waals),
               1e9 * 1e-19 * kRadius / (6 * 1.65e-10 * 1.65e-10), 1e-14);
  const double rest = std::pow(1.5 * M_PI * 1e6 / kModulus, 2) * kRadius;
  expect_ratio(r, "sjkr", pull(CohesionLaw::sjkr), 1e9 / 3 * 2 * M_PI * kRadius * 1e6 * 4 / 9 * rest, 1e-12);
  // gamma = A / (24 pi D0^2) makes the pull-off of van der Waals that of DMT with w = 2 gamma.
  c.work_of_adhesion = 1e-19 / (12 * M_PI * 1.65e-10 * 1.65e-10);
  expect_ratio(r, "van der Waals, as DMT with w = A/(12 pi D0^2)", pull(CohesionLaw::van_der_waals),
               pull(CohesionLaw::dmt), 1e-14);
}

}  // namespace
}  // namespace interstice::dem::verification
