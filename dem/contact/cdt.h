// Constant-directional-torque rolling friction (Ai, Chen, Rotter & Ooi, Powder Technol. 206, 2011, model A).
#pragma once

#include "base/vec3.h"
#include "dem/contact/numeric.h"

namespace interstice::dem {

/// Share of the spin that one contact may take away in a step: keeps several contacts on a grain stable.
inline constexpr double kCdtShare = 0.2;

/// Torque on the first body, of magnitude `limit` = mu_r F_n R* against the relative spin; its part about the
/// normal (twisting) is left out [N m]. Near rest the torque alone would reverse the spin within a step dt
/// and chatter from then on; it takes at most kCdtShare of the spin of a sphere of mass m* and radius R* a
/// step.
template <class T>
INTERSTICE_HD inline Vec3<T> cdt_torque(const Vec3<T>& relative_spin, const Vec3<T>& normal, const T& limit,
                                        const T& effective_mass, const T& effective_radius,
                                        const T& inverse_dt) {
  const T stopping =
      T(kCdtShare * 0.4) * (effective_mass * inverse_dt) * square(effective_radius);  // [N m s]
  const T scale = min_of(limit * inverse_spin_of(relative_spin), stopping);
  const Vec3<T> along_spin = scale * relative_spin;
  return multiply_add(dot(along_spin, normal), normal, -along_spin);
}

}  // namespace interstice::dem
