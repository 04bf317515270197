// Strong dashpots in a bed at rest: on predicted velocities they are stable only while all those on a grain
// together take less than its velocity in a step. Beyond, the bed shakes and heats up with every spring
// resolved; the step check must see it.
#include <fmt/format.h>

#include "dem/rain.h"
#include "dem/statistics.h"
#include "dem/time_step.h"
#include "tests/dem/scenes.h"
#include "tests/report/report.h"

namespace interstice::dem {
namespace {

using interstice::testing::expect_outcome;

constexpr double kDiameter = 1e-3;
const Material kSoft{2500, 1e6, 0.3};

Model bed_model(double restitution) {
  Model m =
      testing::plain_model(kSoft, {.restitution = restitution, .friction = 0.5}, testing::with_friction());
  m.domain = {{0, 0, -kDiameter}, {5 * kDiameter, 5 * kDiameter, 60 * kDiameter}};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::periodic, AxisBoundary::open};
  m.gravity = {0, 0, -9.81};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  return m;
}

/// 200 grains poured and settled at a step of 0.05 Rayleigh times, where nothing shakes.
std::vector<NewGrain> settled(double restitution) {
  Simulation sim(bed_model(restitution), 0.05 * rayleigh_time(kDiameter / 2, kSoft));
  Rain rain;
  rain.radii.assign(200, kDiameter / 2);
  rain.box = {{0, 0, 0}, {5 * kDiameter, 5 * kDiameter, 30 * kDiameter}};
  while (!rain.finished()) {
    pour(sim, rain, 1000);
    sim.advance(2000);
  }
  sim.advance(40000);
  std::vector<NewGrain> grains;
  for (const std::uint32_t slot : sim.slots_by_id()) {
    const GrainRow g = sim.row(slot);
    grains.push_back({g.position(), g.radius, g.velocity(), g.spin(), 0, 0});
  }
  return grains;
}

/// Goes on at a coarser step: does the bed rest, and does the step check warn?
void go_on(const std::vector<NewGrain>& bed, double restitution, double fraction) {
  Simulation sim(bed_model(restitution), fraction * rayleigh_time(kDiameter / 2, kSoft));
  sim.add_grains(bed);
  sim.advance(20000);
  const MotionStatistics motion = motion_statistics(sim);
  const double energy = motion.kinetic_energy / (static_cast<double>(sim.grains()) * motion.fall_energy_mean);
  const double damping = check_step(sim).damping;
  const bool rests = energy<1e-5, warned = damping> 1;
  expect_outcome(
      "dashpots in a bed at rest", fmt::format("e = {:g}, {:g} of the Rayleigh time", restitution, fraction),
      fmt::format("kinetic energy {:.0e} m g d: {}; dashpots {:.2f} of what a step bears: {}", energy,
                  rests ? "rests" : "shakes", damping, warned ? "warned of" : "no warning"),
      rests || warned);
}

TEST(Damping, OfABedIsStableOrWarnedOf) {
  const std::vector<NewGrain> plastic = settled(0.3), elastic = settled(0.9);
  for (const double fraction : {0.1, 0.15, 0.2, 0.25}) go_on(plastic, 0.3, fraction);
  for (const double fraction : {0.2, 0.3}) go_on(elastic, 0.9, fraction);
}

}  // namespace
}  // namespace interstice::dem
