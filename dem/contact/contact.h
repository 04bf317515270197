// One contact, whole: the sub-laws put together in the order in which the physics is derived. `laws` is
// either FixedLaws<...>, of which the compiler keeps only what is named, or Laws, chosen at run time.
#pragma once

#include "base/vec3.h"
#include "dem/contact/cdt.h"
#include "dem/contact/damping.h"
#include "dem/contact/dmt.h"
#include "dem/contact/epsd2.h"
#include "dem/contact/hertz.h"
#include "dem/contact/hooke.h"
#include "dem/contact/jkr.h"
#include "dem/contact/laws.h"
#include "dem/contact/mindlin.h"
#include "dem/contact/pair_constants.h"
#include "dem/contact/sjkr.h"
#include "dem/contact/slider.h"
#include "dem/contact/van_der_waals.h"

namespace interstice::dem {

/// How two bodies in contact stand and move. The normal points from the second body to the first.
template <class T>
struct ContactKinematics {
  Vec3<T> normal;
  T overlap;              // [m]; negative in the neck of a JKR contact
  T effective_radius;     // R* [m]
  T effective_mass;       // m* [kg]
  T area;                 // in which the undeformed surfaces intersect [m^2] (sjkr only)
  Vec3<T> velocity;       // of the first surface relative to the second at the contact point [m/s]
  Vec3<T> relative_spin;  // [rad/s] (rolling only)
};

/// What a contact remembers from step to step.
template <class T>
struct ContactMemory {
  TangentialSpring<T> sliding;  // mindlin
  TangentialSpring<T> rolling;  // epsd2: torque [N m] and stiffness [N m]
};

/// The numbers of a step that a contact needs.
template <class T>
struct StepConstants {
  T dt;               // [s]
  T inverse_dt;       // [1/s]
  T slider_velocity;  // [m/s]
};

template <class T>
StepConstants<T> step_constants(double dt, double slider_velocity) {
  return {T(dt), T(1 / dt), T(slider_velocity)};
}

/// What was lost in one step, by mechanism [J].
template <class T>
struct ContactHeat {
  T damping, sliding, rolling;
};

template <class T>
struct ContactForce {
  Vec3<T> force;           // on the first body [N]
  Vec3<T> tangential;      // its tangential part [N]
  Vec3<T> rolling_torque;  // on the first body; the second gets the opposite [N m]
  ContactMemory<T> memory;
  ContactHeat<T> heat;
};

/// The elastic normal force (with JKR's adhesion, which is part of it) and the tangent stiffness that the
/// dashpots and the tangential spring are made of.
template <class T>
struct NormalResponse {
  T force;      // [N]
  T stiffness;  // [N/m]
  T load;       // what friction and rolling friction go by before damping [N]
};

template <class Laws, class T>
INTERSTICE_HD inline NormalResponse<T> normal_response(const Laws& laws, const T& overlap,
                                                       const T& effective_radius, const PairConstants<T>& c) {
  if (laws.cohesion == CohesionLaw::jkr) {
    const T a = jkr_contact_radius(c.effective_modulus, c.work_of_adhesion, effective_radius, overlap);
    const T force = jkr_force(c.effective_modulus, c.work_of_adhesion, effective_radius, a);
    // Friction goes by F_n + 2 F_pulloff (Thornton, J. Phys. D 24, 1991).
    const T load = force + T(2) * jkr_pull_off(c.work_of_adhesion, effective_radius);
    return {force, hertz_stiffness(c.effective_modulus, a), load};
  }
  const bool hertz = laws.normal == NormalLaw::hertz;
  const T stiffness =
      hertz ? hertz_stiffness(c.effective_modulus, sqrt_of(effective_radius * overlap)) : c.stiffness;
  const T force = hertz ? hertz_force(stiffness, overlap) : hooke_force(stiffness, overlap);
  return {force, stiffness, force};
}

/// Attraction that acts beside the elastic force in contact [N].
template <class Laws, class T>
INTERSTICE_HD inline T attraction_in_contact(const Laws& laws, const T& overlap, const T& effective_radius,
                                             const T& area, const PairConstants<T>& c) {
  switch (laws.cohesion) {
    case CohesionLaw::sjkr:
      return sjkr_attraction(c.cohesion_energy_density, area);
    case CohesionLaw::dmt:
      return dmt_attraction(c.work_of_adhesion, effective_radius);
    case CohesionLaw::van_der_waals:
      return van_der_waals_attraction(c.hamaker_constant, c.cutoff, c.range, effective_radius, overlap);
    case CohesionLaw::none:
    case CohesionLaw::jkr:
      break;
  }
  return T(0);
}

template <class Laws, class T>
INTERSTICE_HD inline ContactForce<T> evaluate_contact(const Laws& laws, const ContactKinematics<T>& k,
                                                      const PairConstants<T>& c,
                                                      const ContactMemory<T>& memory,
                                                      const StepConstants<T>& step) {
  const NormalResponse<T> normal = normal_response(laws, k.overlap, k.effective_radius, c);
  const T normal_speed = dot(k.velocity, k.normal);
  const T gamma = dashpot(c.damping, normal.stiffness, k.effective_mass);
  const T damped = subtract_product(gamma, normal_speed, normal.force);
  const T repulsion = laws.clip ? max_of(damped, min_of(normal.force, T(0))) : damped;
  const T attraction = attraction_in_contact(laws, k.overlap, k.effective_radius, k.area, c);
  const bool jkr = laws.cohesion == CohesionLaw::jkr;

  ContactForce<T> out{};
  out.heat.damping = (normal.force - repulsion) * normal_speed * step.dt;
  const Vec3<T> slip = subtract_product(normal_speed, k.normal, k.velocity);
  const T shear_stiffness = c.shear_ratio * normal.stiffness;
  const T friction_limit = c.friction * abs_of(jkr ? normal.load : repulsion);
  if (laws.tangential == TangentialLaw::slider) {
    out.tangential = slider_force(slip, friction_limit, step.slider_velocity, k.effective_mass, step.dt);
    out.heat.sliding = -step.dt * dot(out.tangential, slip);
  } else if (laws.tangential == TangentialLaw::mindlin) {
    const auto t = mindlin_force(memory.sliding, k.normal, slip, step.dt, shear_stiffness,
                                 c.shear_damping * gamma, friction_limit);
    out.tangential = t.force;
    out.memory.sliding = t.spring;
    out.heat.sliding = t.slip_heat;
    out.heat.damping = out.heat.damping + t.damping_heat;
  }
  out.force = multiply_add(repulsion - attraction, k.normal, out.tangential);

  const T rolling_limit = c.rolling_friction * abs_of(normal.load) * k.effective_radius;
  if (laws.rolling == RollingLaw::cdt) {
    out.rolling_torque = cdt_torque(k.relative_spin, k.normal, rolling_limit, k.effective_mass,
                                    k.effective_radius, step.inverse_dt);
    out.heat.rolling = -step.dt * dot(out.rolling_torque, k.relative_spin);
  } else if (laws.rolling == RollingLaw::epsd2) {
    const auto r = epsd2_torque(memory.rolling, k.normal, k.relative_spin, step.dt,
                                shear_stiffness * square(k.effective_radius), rolling_limit);
    out.rolling_torque = r.force;
    out.memory.rolling = r.spring;
    out.heat.rolling = r.slip_heat;
  }
  return out;
}

}  // namespace interstice::dem
