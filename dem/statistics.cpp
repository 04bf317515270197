#include "dem/statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "dem/contact/hertz.h"
#include "dem/wall_distance.h"

namespace interstice::dem {
namespace {

constexpr double kFootprintCell = 50e-6;  // [m]

/// Calls body(slot a, slot b, pair) for every touching pair, by ascending ids.
template <class Body>
void for_touching_pairs(const Simulation& sim, const Body& body) {
  for (const std::uint32_t slot : sim.slots_by_id()) {
    for (const Adjacent& e : sim.pair_contacts().of(slot)) {
      if (!e.second && sim.pair_contacts().touching(e.pair)) body(slot, e.slot, e.pair);
    }
  }
}

/// A key of the 50 um surface cell that holds a point of a wall: which face, and where on it.
std::array<std::int64_t, 4> surface_cell(const Vec3d& point, const Vec3d& normal) {
  int face = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (std::fabs(normal[axis]) > std::fabs(normal[face])) face = axis;
  }
  std::array<std::int64_t, 4> key{2 * face + (normal[face] > 0 ? 1 : 0), 0, 0, 0};
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != face) key[axis + 1] = static_cast<std::int64_t>(std::floor(point[axis] / kFootprintCell));
  }
  return key;
}

/// Only the neck of a JKR contact has a negative overlap; elsewhere rounding may leave one.
double stored_overlap(const Laws& laws, double overlap) {
  return laws.cohesion == CohesionLaw::jkr ? overlap : std::max(overlap, 0.0);
}

/// Radius of the contact circle [m].
double contact_radius(const Laws& laws, const PairConstants<double>& c, double effective_radius,
                      double overlap) {
  if (laws.cohesion == CohesionLaw::jkr)
    return jkr_contact_radius(c.effective_modulus, c.work_of_adhesion, effective_radius, overlap);
  return std::sqrt(effective_radius * std::max(overlap, 0.0));
}

}  // namespace

ContactStatistics contact_statistics(const Simulation& sim) {
  ContactStatistics s;
  double sum = 0, normal_sum = 0;
  const SearchSpace space = sim.search_space();
  for_touching_pairs(sim, [&](std::uint32_t slot_a, std::uint32_t slot_b, std::uint32_t pair) {
    const GrainSite a = sim.site(slot_a), b = sim.site(slot_b);
    const Vec3d force = sim.pair_contacts().memories().force(pair);
    const Vec3d apart = separation(a.position(), b.position(), space);
    const double magnitude = norm(force), distance = norm(apart);
    ++s.contacts;
    sum += magnitude;
    normal_sum += distance > 0 ? std::fabs(dot(force, apart)) / distance : magnitude;
    s.force_max = std::max(s.force_max, magnitude);
  });
  if (s.contacts > 0) {
    s.force_mean = sum / static_cast<double>(s.contacts);
    s.normal_force_mean = normal_sum / static_cast<double>(s.contacts);
  }
  return s;
}

WallStatistics wall_statistics(const Simulation& sim, std::size_t wall) {
  WallStatistics s;
  Vec3d shear{0, 0, 0};
  std::vector<std::array<std::int64_t, 4>> cells;
  const auto rows = sim.rows();
  for (const std::uint32_t slot : sim.slots_by_id()) {
    for (const WallContact& c : sim.wall_contacts().of(slot)) {
      if (c.wall != wall || !c.touching()) continue;
      const GrainRow& g = rows[slot];
      const WallDistance surface = wall_distance(sim.walls()[wall], g.position());
      const double pressing = dot(c.force, surface.normal);
      const Vec3d tangential = c.force - pressing * surface.normal;
      s.normal_force += pressing;
      shear -= tangential;  // on the wall: the opposite of what the grain feels
      s.shear_force_sum += norm(tangential);
      ++s.contacts;
      const PairConstants<double>& constants = sim.constants(g.material, sim.model().walls[wall].material);
      const double a = contact_radius(sim.model().laws, constants, g.radius, g.radius - surface.distance);
      s.contact_area += M_PI * a * a;
      cells.push_back(surface_cell(g.position() - surface.distance * surface.normal, surface.normal));
    }
  }
  s.particles = s.contacts;  // a sphere meets a plane or a box in one point
  s.shear_force = norm(shear);
  std::sort(cells.begin(), cells.end());
  const auto distinct = std::unique(cells.begin(), cells.end()) - cells.begin();
  s.footprint_area = static_cast<double>(distinct) * kFootprintCell * kFootprintCell;
  return s;
}

MotionStatistics motion_statistics(const Simulation& sim) {
  MotionStatistics s;
  const double gravity = norm(sim.model().gravity);
  const auto rows = sim.rows();
  for (const std::uint32_t slot : sim.slots_by_id()) {
    const GrainRow& g = rows[slot];
    const double v2 = dot(g.velocity(), g.velocity());
    s.kinetic_energy += kinetic_energy(g);
    s.fall_energy_mean += g.mass * gravity * 2 * g.radius;
    s.fastest = std::max(s.fastest, std::sqrt(v2));
  }
  if (!rows.empty()) s.fall_energy_mean /= static_cast<double>(rows.size());
  return s;
}

StepCheck check_step(const Simulation& sim) {
  StepCheck worst;
  const auto rows = sim.rows();
  const SearchSpace space = sim.search_space();
  const Laws& laws = sim.model().laws;
  std::vector<double> bound(rows.size(), 0);  // of the squared frequencies that a grain takes part in [1/s^2]
  std::vector<double> decay(rows.size(), 0);  // of the rates at which dashpots slow it [1/s]
  // At the surface a sphere yields with 2/7 of its mass, translation and rotation together.
  const auto decay_rate = [&](const PairConstants<double>& c, double stiffness, double mass) {
    const double gamma = dashpot(c.damping, stiffness, mass);
    return laws.tangential == TangentialLaw::mindlin ? std::max(gamma, 3.5 * c.shear_damping * gamma) : gamma;
  };
  const auto consider = [&](double step, double stiffness, double mass, std::int64_t a, std::int64_t b) {
    const double ratio = step * std::sqrt(stiffness / mass);
    if (ratio > worst.ratio) worst.ratio = ratio, worst.grain_a = a, worst.grain_b = b;
  };
  for_touching_pairs(sim, [&](std::uint32_t slot_a, std::uint32_t slot_b, std::uint32_t) {
    const GrainRow &a = rows[slot_a], &b = rows[slot_b];
    const double reach = a.radius + b.radius;
    const double overlap = reach - norm(separation(a.position(), b.position(), space));
    const PairConstants<double>& c = sim.constants(a.material, b.material);
    const double stiffness =
        normal_response(laws, stored_overlap(laws, overlap), a.radius * b.radius / reach, c).stiffness;
    const double mass = a.mass * b.mass / (a.mass + b.mass);
    consider(sim.step_of(std::min(a.radius, b.radius)), stiffness, mass, a.id, b.id);
    const double gamma = decay_rate(c, stiffness, mass);
    decay[slot_a] += gamma / a.mass;
    decay[slot_b] += gamma / b.mass;
    const double coupling = stiffness / std::sqrt(a.mass * b.mass);
    bound[slot_a] += stiffness / a.mass + coupling;
    bound[slot_b] += stiffness / b.mass + coupling;
  });
  for (std::size_t slot = 0; slot < rows.size(); ++slot) {
    const GrainRow& g = rows[slot];
    const double step = sim.step_of(g.radius);
    for (const WallContact& c : sim.wall_contacts().of(slot)) {
      if (!c.touching()) continue;
      const double overlap = g.radius - wall_distance(sim.walls()[c.wall], g.position()).distance;
      const double stiffness = normal_response(laws, stored_overlap(laws, overlap), g.radius,
                                               sim.constants(g.material, sim.model().walls[c.wall].material))
                                   .stiffness;
      consider(step, stiffness, g.mass, g.id, -1);
      bound[slot] += stiffness / g.mass;
    }
    const double frequency = step * std::sqrt(bound[slot]);
    const double slowed = step * decay[slot];
    if (slowed > worst.damping) worst.damping = slowed, worst.damping_grain = g.id;
    if (frequency > worst.frequency) worst.frequency = frequency, worst.frequency_grain = g.id;
  }
  return worst;
}

}  // namespace interstice::dem
