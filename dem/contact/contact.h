// One contact, whole: the sub-laws put together in the order in which the physics is derived. The features
// that a scene does not name are compiled out.
#pragma once

#include "base/vec3.h"
#include "dem/contact/cdt.h"
#include "dem/contact/damping.h"
#include "dem/contact/hertz.h"
#include "dem/contact/mindlin.h"
#include "dem/contact/pair_constants.h"
#include "dem/contact/sjkr.h"

namespace interstice::dem {

/// A compile-time choice of what is modelled.
template <bool Tangential, bool Rolling, bool Cohesion>
struct ContactFeatures {
  static constexpr bool tangential = Tangential, rolling = Rolling, cohesion = Cohesion;
};

/// How two touching bodies stand and move. The normal points from the second body to the first.
template <class T>
struct ContactKinematics {
  Vec3<T> normal;
  T overlap;              // [m], > 0
  T effective_radius;     // R* [m]
  T effective_mass;       // m* [kg]
  T area;                 // in which the undeformed surfaces intersect [m^2] (cohesion only)
  Vec3<T> velocity;       // of the first surface relative to the second at the contact point [m/s]
  Vec3<T> relative_spin;  // [rad/s]
};

template <class T>
struct ContactForce {
  Vec3<T> force;           // on the first body [N]
  Vec3<T> tangential;      // its tangential part [N]
  Vec3<T> rolling_torque;  // on the first body; the second gets the opposite [N m]
  Vec3<T> displacement;    // tangential spring after this step [m]
};

/// `clip` keeps spring and dashpot together from attracting (a cohesive force is not clipped).
template <class Features, class T>
INTERSTICE_HD inline ContactForce<T> evaluate_contact(const ContactKinematics<T>& k, const PairConstants& c,
                                                      const Vec3<T>& displacement, const T& dt, bool clip) {
  const T root = sqrt_of(k.effective_radius * k.overlap);
  const T stiffness = hertz_stiffness(T(c.effective_modulus), root);
  const T elastic = hertz_force(stiffness, k.overlap);
  const T normal_speed = dot(k.velocity, k.normal);
  const T damped = elastic - dashpot(T(c.damping), stiffness, k.effective_mass) * normal_speed;
  const T repulsion = clip ? max_of(damped, T(0)) : damped;

  ContactForce<T> out{};
  T normal_force = repulsion;
  if constexpr (Features::cohesion) normal_force = normal_force - T(c.cohesion_energy_density) * k.area;
  out.force = normal_force * k.normal;
  if constexpr (Features::tangential) {
    const Vec3<T> slip = k.velocity - normal_speed * k.normal;
    const T shear_stiffness = T(8) * T(c.shear_modulus) * root;
    const auto t =
        mindlin(displacement, k.normal, slip, dt, shear_stiffness,
                dashpot(T(c.damping), shear_stiffness, k.effective_mass), T(c.friction) * abs_of(repulsion));
    out.tangential = t.force;
    out.displacement = t.displacement;
    out.force += t.force;
  }
  if constexpr (Features::rolling) {
    out.rolling_torque =
        cdt_torque(k.relative_spin, k.normal, T(c.rolling_friction), elastic, k.effective_radius);
  }
  return out;
}

}  // namespace interstice::dem
