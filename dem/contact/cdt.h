// Constant-directional-torque rolling friction (Ai, Chen, Rotter & Ooi, Powder Technol. 206, 2011, model A).
#pragma once

#include "base/vec3.h"
#include "dem/contact/numeric.h"

namespace interstice::dem {

/// Torque on the first body, of magnitude `limit` = mu_r F_n R* against the relative spin; its part about the
/// normal (twisting) is left out [N m].
template <class T>
INTERSTICE_HD inline Vec3<T> cdt_torque(const Vec3<T>& relative_spin, const Vec3<T>& normal, const T& limit) {
  const T speed = norm(relative_spin);
  const auto spins = speed > T(0);
  const T scale = select(spins, limit / select(spins, speed, T(1)), T(0));
  const Vec3<T> torque = -scale * relative_spin;
  return torque - dot(torque, normal) * normal;
}

}  // namespace interstice::dem
