// A small bed that settles: what several extremes look at.
#pragma once

#include "dem/packing.h"
#include "tests/extremes/support.h"

namespace interstice::dem::testing {

/// Grains of 50 um let down on a floor, periodic at the sides. As soft as 1 MPa (overlaps of 1e-3 of a
/// diameter at the bottom): stiffness hardly matters to how grains lie, and the steps are long.
struct Bed {
  std::size_t count = 200;
  std::uint64_t seed = 1;
  double bond = 0;    // pull-off of a pair over the weight of a grain (jkr)
  double step = 0.1;  // of the Rayleigh time
  Laws laws{.tangential = TangentialLaw::mindlin, .rolling = RollingLaw::epsd2};
  double side = 6;  // diameters

  static constexpr double kRadius = 25e-6, kModulus = 1e6, kDensity = 8200;
};

inline Simulation make_bed(const Bed& bed, const SimulationOptions& options) {
  const double r = Bed::kRadius, edge = 2 * r * bed.side;
  const double weight = sphere_mass(r, Bed::kDensity) * 9.81;
  Model m = open_model({Bed::kDensity, Bed::kModulus, 0.3}, {}, bed.laws, 1);
  m.domain = {{0, 0, -r}, {edge, edge, 1}};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::periodic, AxisBoundary::open};
  m.gravity = {0, 0, -9.81};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  m.pairs[0] = {.restitution = 0.3,
                .friction = 0.4,
                .rolling_friction = 0.02,
                .work_of_adhesion = bed.bond * weight / (1.5 * M_PI * r / 2)};
  if (bed.bond > 0) m.laws.cohesion = CohesionLaw::jkr;
  Simulation sim(m, bed.step * rayleigh_time(r, m.materials[0]), options);
  // Apart from each other, so that the start holds no elastic energy: a solid fraction of 0.2.
  auto grains = pack_in_cell(std::vector<double>(bed.count, 1.2 * r), edge, edge, 0.35, bed.seed);
  for (NewGrain& g : grains) g.radius = r;
  sim.add_grains(grains);
  return sim;
}

struct BedState {
  double fraction = 0;      // solid, of the layer twice as high as the mean of the grains' heights
  double coordination = 0;  // grain-grain contacts a grain
  double kinetic = 0;       // mean, over m g d
};

inline BedState state_of(const Simulation& sim, const Bed& bed) {
  const GrainColumns c = columns(sim);
  const double n = static_cast<double>(c.id.size()), edge = 2 * Bed::kRadius * bed.side;
  double height = 0;
  for (const double z : c.z) height += 2 * z / n;
  BedState s;
  s.fraction = n * 4.0 / 3 * M_PI * std::pow(Bed::kRadius, 3) / (edge * edge * height);
  s.coordination = 2 * static_cast<double>(contact_statistics(sim).contacts) / n;
  s.kinetic = kinetic_sum(sim) / n / motion_statistics(sim).fall_energy_mean;
  return s;
}

/// Farthest that a grain has come, in diameters (the periodic sides are not crossed by a bed at rest).
inline double creep(const GrainColumns& from, const GrainColumns& to) {
  double worst = from.id.size() == to.id.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(from.id.size(), to.id.size()); ++i) {
    keep_worst(worst, std::hypot(to.x[i] - from.x[i], to.y[i] - from.y[i], to.z[i] - from.z[i]) /
                          (2 * from.radius[i]));
  }
  return worst;
}

}  // namespace interstice::dem::testing
