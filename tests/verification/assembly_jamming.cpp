// Frictionless monodisperse spheres compressed until they jam: random close packing. Method: a periodic cube
// without gravity in which all radii grow together in small increments, with strongly damped contacts, past
// jamming; the pressure of relaxed states above it, p ~ (phi - phi_J)^(3/2) for Hertz contacts, extrapolates
// to phi_J (O'Hern, Silbert, Liu & Nagel, Phys. Rev. E 68, 2003: phi_J = 0.639 +- 0.001 for many spheres).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.h"
#include "dem/neighbours.h"
#include "dem/rain.h"
#include "dem/simulation.h"
#include "dem/time_step.h"
#include "tests/dem/scenes.h"
#include "tests/report/report.h"

namespace interstice::dem {
namespace {

using interstice::testing::expect_between;
using interstice::testing::Reference;

constexpr double kSide = 10e-3;  // [m]
const Material kSoft{
    .density = 2500, .youngs_modulus = 1e6, .poisson_ratio = 0.3};  // stiffness plays no part

double radius_at(double solid_fraction, std::size_t count) {
  return std::cbrt(3 / (4 * M_PI) * solid_fraction / static_cast<double>(count)) * kSide;
}

Model frictionless_cube() {
  Model m = testing::plain_model(kSoft, {.restitution = 0.3}, {});
  m.domain = {{0, 0, 0}, {kSide, kSide, kSide}};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::periodic, AxisBoundary::periodic};
  return m;
}

/// Without friction contacts remember nothing, so that grains of another radius just go on in a new
/// simulation.
void relax(std::vector<NewGrain>& grains, double radius, std::int64_t steps, double* pressure = nullptr) {
  Simulation sim(frictionless_cube(), 0.1 * rayleigh_time(radius, kSoft));
  for (NewGrain& g : grains) g.radius = radius;
  sim.add_grains(grains);
  sim.advance(steps);
  for (const GrainRow& g : sim.rows()) {
    grains[static_cast<std::size_t>(g.id)].position = g.position();
    grains[static_cast<std::size_t>(g.id)].velocity = g.velocity();
  }
  if (!pressure) return;
  double virial = 0;
  const PairContacts& contacts = sim.pair_contacts();
  for (std::size_t k = 0; k < contacts.places(); ++k) {
    if (!contacts.touching(k)) continue;
    const Vec3d apart = separation(sim.site(contacts.pair(k).a).position(),
                                   sim.site(contacts.pair(k).b).position(), sim.search_space());
    virial += dot(contacts.memories().force(k), apart);
  }
  *pressure = virial / (3 * kSide * kSide * kSide);
}

struct Line {
  double slope, intercept;
};

Line fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  const auto n = static_cast<double>(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
  const double slope = (n * sxy - sx * sy) / (n * sxx - sx * sx);
  return {slope, (sy - slope * sx) / n};
}

/// The solid fraction at which the pressure vanishes.
double jamming_fraction(std::size_t count, std::uint64_t seed) {
  Simulation start(frictionless_cube(), 1);
  Rain rain;
  rain.radii.assign(count, radius_at(0.25, count));
  rain.box = start.model().domain;
  rain.random = Random(seed, 0);
  pour(start, rain, 100000);
  std::vector<NewGrain> grains;
  for (const GrainRow& g : start.rows()) grains.push_back({g.position(), g.radius, {}, {}, 0, 0});
  EXPECT_EQ(grains.size(), count);

  for (double phi = 0.26; phi < 0.5999; phi += 0.01) relax(grains, radius_at(phi, count), 200);
  for (double phi = 0.6; phi < 0.6499; phi += 0.002) relax(grains, radius_at(phi, count), 1000);
  std::vector<double> fractions, pressures;  // p^(2/3)
  for (double phi = 0.65; phi < 0.6651; phi += 0.005) {
    double pressure = 0;
    relax(grains, radius_at(phi, count), 5000, &pressure);
    fractions.push_back(phi);
    pressures.push_back(std::pow(pressure, 2.0 / 3));
  }
  const Line line = fit_line(pressures, fractions);
  return line.intercept;
}

const Reference kClosePacking{"Random close packing of frictionless spheres",
                              "O'Hern et al. 2003; 0.636 to 0.64"};

TEST(ClosePacking, IsReachedByGrowingFrictionlessSpheres) {
  // +-0.005 about the published band: one packing of so few spheres scatters by about 0.003 (O'Hern et al.
  // 2003).
  expect_between(kClosePacking, "solid fraction at jamming, 1,000 spheres", jamming_fraction(1000, 1), 0.631,
                 0.645);
}

TEST(ClosePacking, DISABLED_LongIsReachedByTenThousandSpheres) {
  expect_between(kClosePacking, "solid fraction at jamming, 10,000 spheres", jamming_fraction(10000, 2),
                 0.634, 0.642);
}

}  // namespace
}  // namespace interstice::dem
