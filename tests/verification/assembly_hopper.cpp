// Discharge of a flat-bottomed box through a square orifice (Beverloo, Leniger & van de Velde, Chem. Eng.
// Sci. 15, 1961): W = 0.58 rho_b sqrt(g) (D - 1.4 d)^(5/2) for a round orifice. For a square one D is its
// hydraulic diameter, the side, and the flow is larger by the ratio of the areas, 4/pi (Nedderman, Statics
// and Kinematics of Granular Materials, 1992, ch. 10).
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

constexpr double kDiameter = 1e-3, kGravity = 9.81;
constexpr double kGrainMass = M_PI / 6 * kDiameter * kDiameter * kDiameter * 2500;
// Soft: the flow is ruled by gravity and geometry. Grains press into each other by less than 0.5 % of d.
const Material kSoft{.density = 2500, .youngs_modulus = 2e6, .poisson_ratio = 0.3};

struct Hopper {
  double side, depth;  // of the bed [m]
};

/// With an orifice of the given side in the middle of the floor; 0: closed.
Model hopper_model(const Hopper& h, double orifice) {
  Model m = testing::plain_model(kSoft, {.restitution = 0.5, .friction = 0.5}, testing::with_friction());
  const double a = h.side / 2, o = orifice / 2, thick = 2 * kDiameter;
  m.domain = {{-2 * a, -2 * a, -6 * kDiameter}, {2 * a, 2 * a, 4 * h.depth}};
  m.gravity = {0, 0, -kGravity};
  m.walls = {{Plane{{-a, 0, 0}, {1, 0, 0}}, 0},
             {Plane{{a, 0, 0}, {-1, 0, 0}}, 0},
             {Plane{{0, -a, 0}, {0, 1, 0}}, 0},
             {Plane{{0, a, 0}, {0, -1, 0}}, 0}};
  if (orifice == 0) {
    m.walls.push_back({Plane{{0, 0, 0}, {0, 0, 1}}, 0});
  } else {
    m.walls.push_back({Box{{-2 * a, -2 * a, -thick}, {-o, 2 * a, 0}}, 0});
    m.walls.push_back({Box{{o, -2 * a, -thick}, {2 * a, 2 * a, 0}}, 0});
    m.walls.push_back({Box{{-o, -2 * a, -thick}, {o, -o, 0}}, 0});
    m.walls.push_back({Box{{-o, o, -thick}, {o, 2 * a, 0}}, 0});
  }
  return m;
}

double step_of() { return 0.12 * rayleigh_time(kDiameter / 2, kSoft); }

/// Grains at rest that fill the closed box.
std::vector<NewGrain> filled(const Hopper& h) {
  Simulation sim(hopper_model(h, 0), step_of());
  Rain rain;
  rain.radii.assign(
      static_cast<std::size_t>(0.57 * h.side * h.side * h.depth / (M_PI / 6 * std::pow(kDiameter, 3))),
      kDiameter / 2);
  rain.box = {{-h.side / 2, -h.side / 2, 0}, {h.side / 2, h.side / 2, 2.6 * h.depth}};
  while (!rain.finished()) {
    pour(sim, rain, 2000);
    sim.advance(2000);
  }
  sim.advance(static_cast<std::int64_t>(0.2 / step_of()));
  std::vector<NewGrain> grains;
  for (const std::uint32_t slot : sim.slots_by_id())
    grains.push_back({sim.site(slot).position(), kDiameter / 2, {}, {}, 0, 0});
  return grains;
}

/// Of the lower half of the bed, before it flows [kg/m^3].
double bulk_density(const std::vector<NewGrain>& grains, const Hopper& h) {
  double mass = 0;
  for (const NewGrain& g : grains) {
    if (g.position.z > 0.1 * h.depth && g.position.z < 0.6 * h.depth) mass += kGrainMass;
  }
  return mass / (h.side * h.side * 0.5 * h.depth);
}

/// Mass flow between the loss of a tenth and of the given share of the grains [kg/s]: after the start, and
/// while the bed is still deeper than the orifice is wide.
double mass_flow(const std::vector<NewGrain>& grains, const Hopper& h, double orifice, double share) {
  Simulation sim(hopper_model(h, orifice), step_of());
  sim.add_grains(grains);
  const auto total = static_cast<double>(grains.size());
  double begin_time = 0, begin_lost = 0;
  while (static_cast<double>(sim.grains_lost()) < share * total && sim.time() < 3) {
    sim.advance(200);
    if (begin_time > 0 || static_cast<double>(sim.grains_lost()) < 0.1 * share * total) continue;
    begin_time = sim.time();
    begin_lost = static_cast<double>(sim.grains_lost());
  }
  return (static_cast<double>(sim.grains_lost()) - begin_lost) * kGrainMass / (sim.time() - begin_time);
}

void check_hopper(const Hopper& h, const std::vector<double>& orifices, double share) {
  const Reference reference{fmt::format("Beverloo's hopper, {:.0f} d wide", h.side / kDiameter),
                            "Beverloo et al. 1961; square orifice after Nedderman 1992"};
  const std::vector<NewGrain> grains = filled(h);
  const double density = bulk_density(grains, h);
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const double sides : orifices) {
    const double flow = mass_flow(grains, h, sides * kDiameter, share);
    const double law =
        4 / M_PI * 0.58 * density * std::sqrt(kGravity) * std::pow((sides - 1.4) * kDiameter, 2.5);
    expect_ratio(reference, fmt::format("mass flow, orifice {} d [kg/s]", sides), flow, law, 0.15);
    const double x = std::log(sides - 1.4), y = std::log(flow);
    sx += x, sy += y, sxx += x * x, sxy += x * y;
  }
  const auto n = static_cast<double>(orifices.size());
  expect_between(reference, "exponent of the flow in D - 1.4 d", (n * sxy - sx * sy) / (n * sxx - sx * sx),
                 2.2, 2.8);
}

TEST(Hopper, DischargesAsBeverlooSays) { check_hopper({20 * kDiameter, 20 * kDiameter}, {4, 5, 6, 8}, 0.15); }

}  // namespace
}  // namespace interstice::dem
