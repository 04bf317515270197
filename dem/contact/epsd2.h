// Elastic-plastic spring rolling friction without dashpot: a rolling spring of stiffness k_t R*^2 that yields
// at mu_r F_n R* (Iwashita & Oda, J. Eng. Mech. 124, 1998; Ai, Chen, Rotter & Ooi, Powder Technol. 206, 2011,
// model C; with the stiffness of the `epsd2` model of LIGGGHTS). It can hold a grain at rest.
#pragma once

#include "dem/contact/mindlin.h"

namespace interstice::dem {

/// Torque on the first body [N m] as the `force` of a spring in the tangent plane, whose stiffness [N m] is
/// k_t R*^2, which relative rolling [rad] loads and `limit` = mu_r F_n R* [N m] ends. The law of the sliding
/// spring without its dashpot, rescaled when the contact unloads for the same reason.
template <class T>
INTERSTICE_HD inline TangentialForce<T> epsd2_torque(const TangentialSpring<T>& old, const Vec3<T>& normal,
                                                     const Vec3<T>& relative_spin, const T& dt,
                                                     const T& rolling_stiffness, const T& limit) {
  const Vec3<T> rolling = relative_spin - dot(relative_spin, normal) * normal;
  return mindlin_force(old, normal, rolling, dt, rolling_stiffness, T(0), limit);
}

}  // namespace interstice::dem
