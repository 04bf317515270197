// One grain's contacts with walls, for any laws and number type. A wall is flat and heavy: R* = R, m* = m.
#pragma once

#include "dem/kernels/geometry.h"
#include "dem/wall_distance.h"

namespace interstice::dem {

inline void part_from_wall(WallContact& contact, WallTotals& totals) {
  if (contact.state == ContactState::apart) return;
  totals.heat += {0, spring_energy(contact.sliding), spring_energy(contact.rolling), 0};
  contact.state = ContactState::apart;
  contact.sliding = {};
  contact.rolling = {};
}

template <class L, class Real>
void touch_wall(const L& laws, const StepView& v, WallContact& contact, const ContactKinematics<Real>& kin,
                const PairConstants<Real>& c, WallTotals& totals) {
  const auto step = step_constants<Real>(v.dt, v.slider_velocity);
  const ContactMemory<Real> memory{as<Real>(contact.sliding), as<Real>(contact.rolling)};
  const ContactForce<Real> f = evaluate_contact(laws, kin, c, memory, step);
  contact.state = ContactState::touching;
  contact.force = as_double(f.force);
  if (laws.tangential == TangentialLaw::mindlin) contact.sliding = as_double(f.memory.sliding);
  if (laws.rolling == RollingLaw::epsd2) contact.rolling = as_double(f.memory.rolling);
  totals.force += contact.force;
  if (laws.tangential != TangentialLaw::none || laws.rolling != RollingLaw::none) {
    const double arm = static_cast<double>(kin.effective_radius) - static_cast<double>(kin.overlap);
    totals.torque += as_double(f.rolling_torque) - arm * as_double(cross(kin.normal, f.tangential));
  }
  totals.heat += {static_cast<double>(f.heat.damping), static_cast<double>(f.heat.sliding),
                  static_cast<double>(f.heat.rolling), 0};
}

template <class L, class Real>
void evaluate_wall(const L& laws, const StepView& v, const WallGrain& g, WallContact& contact,
                   WallTotals& totals) {
  const WallDistance surface = wall_distance(v.walls[contact.wall], g.position);
  const bool overlap = surface.distance < g.radius;
  const bool necked = laws.cohesion == CohesionLaw::jkr && contact.state == ContactState::touching;
  if (!overlap && !necked && laws.cohesion != CohesionLaw::van_der_waals)
    return part_from_wall(contact, totals);

  const PairConstants<Real>& c = constants_of<Real>(v, g.material, v.wall_models[contact.wall].material);
  const Vec3d wall_velocity = v.wall_velocities[contact.wall];
  ContactKinematics<Real> kin;
  kin.overlap = static_cast<Real>(g.radius - surface.distance);
  kin.effective_radius = static_cast<Real>(g.radius);
  if (!overlap && necked && !neck_holds(c, kin.effective_radius, kin.overlap)) {
    totals.heat.adhesion += static_cast<double>(tear_heat(c, kin.effective_radius));
    return part_from_wall(contact, totals);
  }
  if (!overlap && laws.cohesion == CohesionLaw::van_der_waals) {
    part_from_wall(contact, totals);
    const double attraction = static_cast<double>(
        van_der_waals_attraction(c.hamaker_constant, c.cutoff, c.range, kin.effective_radius, kin.overlap));
    if (!(attraction > 0)) return;
    contact.state = ContactState::attracting;
    contact.force = -attraction * surface.normal;
    totals.force += contact.force;
    totals.power += dot(contact.force, wall_velocity);
    return;
  }
  kin.normal = as<Real>(surface.normal);
  kin.effective_mass = static_cast<Real>(g.mass);
  if (laws.cohesion == CohesionLaw::sjkr) kin.area = sphere_plane_area(kin.effective_radius, kin.overlap);
  Vec3d velocity = g.velocity - wall_velocity;
  if (laws.tangential != TangentialLaw::none) velocity -= cross(surface.distance * g.spin, surface.normal);
  kin.velocity = as<Real>(velocity);
  if (laws.rolling != RollingLaw::none) kin.relative_spin = as<Real>(g.spin);
  touch_wall(laws, v, contact, kin, c, totals);
  totals.power += dot(contact.force, wall_velocity);
}

template <class L, class Real>
void evaluate_walls(const L& laws, const StepView& v, const WallGrain& grain, std::span<WallContact> contacts,
                    WallTotals& totals) {
  for (WallContact& contact : contacts) evaluate_wall<L, Real>(laws, v, grain, contact, totals);
}

}  // namespace interstice::dem
