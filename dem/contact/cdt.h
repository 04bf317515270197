// Constant-directional-torque rolling friction (Ai, Chen, Rotter & Ooi, Powder Technol. 206, 2011, model A,
// eq. 5).
#pragma once

#include "base/vec3.h"
#include "dem/contact/numeric.h"

namespace interstice::dem {

/// Torque on the first body, against the relative spin; its part about the normal (twisting) is left out [N
/// m].
template <class T>
INTERSTICE_HD inline Vec3<T> cdt_torque(const Vec3<T>& relative_spin, const Vec3<T>& normal,
                                        const T& rolling_friction, const T& normal_force,
                                        const T& effective_radius) {
  const T speed = norm(relative_spin);
  const auto spins = speed > T(0);
  const T scale =
      select(spins, rolling_friction * normal_force * effective_radius / select(spins, speed, T(1)), T(0));
  const Vec3<T> torque = T(-1) * scale * relative_spin;
  return torque - dot(torque, normal) * normal;
}

}  // namespace interstice::dem
