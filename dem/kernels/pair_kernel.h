// The loop over pairs of grains, for any laws and number type.
#pragma once

#include "dem/kernels/geometry.h"

namespace interstice::dem {

/// The pair k does not act on its grains any more; what its springs still hold is lost.
template <class L>
void part_pair(const L& laws, const StepView& v, std::size_t k, double heat) {
  if (v.heat) v.heat[k] = {0, 0, 0, heat};
  if (v.state[k] == ContactState::apart) return;
  if (v.heat && laws.tangential == TangentialLaw::mindlin) v.heat[k].sliding = spring_energy(v.sliding[k]);
  if (v.heat && laws.rolling == RollingLaw::epsd2) v.heat[k].rolling = spring_energy(v.rolling[k]);
  v.state[k] = ContactState::apart;
  if (laws.tangential == TangentialLaw::mindlin) v.sliding[k] = {};
  if (laws.rolling == RollingLaw::epsd2) v.rolling[k] = {};
}

/// Two grains that attract each other across a gap.
template <class L, class Real>
void attract_pair(const L& laws, const StepView& v, std::size_t k, const Vec3d& normal, Real attraction) {
  part_pair(laws, v, k, 0);
  v.state[k] = ContactState::attracting;
  v.results[k] = {-static_cast<double>(attraction) * normal, {0, 0, 0}, {0, 0, 0}};
}

template <class L, class Real>
void touch_pair(const L& laws, const StepView& v, std::size_t k, const ContactKinematics<Real>& kin,
                const PairConstants<Real>& c, double arm_a, double arm_b) {
  ContactMemory<Real> memory{};
  if (laws.tangential == TangentialLaw::mindlin) memory.sliding = as<Real>(v.sliding[k]);
  if (laws.rolling == RollingLaw::epsd2) memory.rolling = as<Real>(v.rolling[k]);
  const StepConstants<Real> step{static_cast<Real>(v.dt), static_cast<Real>(v.slider_velocity)};
  const ContactForce<Real> f = evaluate_contact(laws, kin, c, memory, step);
  v.state[k] = ContactState::touching;
  PairResult& result = v.results[k];
  result.force = as_double(f.force);
  if (laws.tangential != TangentialLaw::none || laws.rolling != RollingLaw::none) {
    const Vec3d turning = as_double(cross(kin.normal, f.tangential)), rolling = as_double(f.rolling_torque);
    result.torque_a = rolling - arm_a * turning;
    result.torque_b = -rolling - arm_b * turning;
  }
  if (laws.tangential == TangentialLaw::mindlin) v.sliding[k] = as_double(f.memory.sliding);
  if (laws.rolling == RollingLaw::epsd2) v.rolling[k] = as_double(f.memory.rolling);
  if (v.heat) {
    v.heat[k] = {static_cast<double>(f.heat.damping), static_cast<double>(f.heat.sliding),
                 static_cast<double>(f.heat.rolling), 0};
  }
}

template <class L, class Real>
void evaluate_pair(const L& laws, const StepView& v, std::size_t k) {
  const GrainRow& a = v.rows[v.pairs[k].a];
  const GrainRow& b = v.rows[v.pairs[k].b];
  const Vec3d apart = nearest_image(a.position() - b.position(), v.period);
  const double reach = a.radius + b.radius, d2 = dot(apart, apart);
  const bool overlap = d2 < reach * reach;
  const bool necked = laws.cohesion == CohesionLaw::jkr && v.state[k] == ContactState::touching;
  if (!overlap && !necked && laws.cohesion != CohesionLaw::van_der_waals) return part_pair(laws, v, k, 0);

  const PairConstants<Real>& c = constants_of<Real>(v, a.material, b.material);
  const double d = d2 > 0 ? std::sqrt(d2) : 1e-6 * reach;
  const Vec3d normal = d2 > 0 ? (1 / d) * apart : Vec3d{1, 0, 0};  // coincident centres: a fixed direction
  ContactKinematics<Real> kin;
  kin.overlap = static_cast<Real>(reach - d);
  kin.effective_radius = static_cast<Real>(a.radius * b.radius / reach);
  if (!overlap) {
    if (necked && !neck_holds(c, kin.effective_radius, kin.overlap)) {
      return part_pair(laws, v, k, tear_heat(c, kin.effective_radius));
    }
    if (laws.cohesion == CohesionLaw::van_der_waals) {
      const Real attraction =
          van_der_waals_attraction(c.hamaker_constant, c.cutoff, c.range, kin.effective_radius, kin.overlap);
      if (attraction > 0) return attract_pair(laws, v, k, normal, attraction);
      return part_pair(laws, v, k, 0);
    }
  }
  kin.normal = as<Real>(normal);
  kin.effective_mass = static_cast<Real>(a.mass * b.mass / (a.mass + b.mass));
  if (laws.cohesion == CohesionLaw::sjkr) {
    kin.area = sphere_sphere_area(static_cast<Real>(a.radius), static_cast<Real>(b.radius),
                                  static_cast<Real>(d), kin.overlap);
  }
  const double arm_a = a.radius - 0.5 * (reach - d), arm_b = b.radius - 0.5 * (reach - d);
  Vec3d velocity = a.velocity() - b.velocity();
  if (laws.tangential != TangentialLaw::none) {
    velocity -= cross(arm_a * a.spin() + arm_b * b.spin(), normal);
  }
  kin.velocity = as<Real>(velocity);
  if (laws.rolling != RollingLaw::none) kin.relative_spin = as<Real>(a.spin() - b.spin());
  touch_pair(laws, v, k, kin, c, arm_a, arm_b);
}

template <class L, class Real>
void evaluate_pairs(const L& laws, const StepView& v, std::size_t begin, std::size_t end) {
  for (std::size_t k = begin; k < end; ++k) evaluate_pair<L, Real>(laws, v, k);
}

}  // namespace interstice::dem
