// Coulomb friction without a spring: limit along the slip, as the bonded binder-jet model has it, made
// regular near rest, where the direction of slip is undefined. It cannot hold a grain at rest on a slope: it
// creeps at `threshold` times the ratio of load to limit.
#pragma once

#include "base/vec3.h"
#include "dem/contact/numeric.h"

namespace interstice::dem {

/// Share of the slip that one contact may take away in one step: keeps several contacts on a grain stable.
inline constexpr double kSliderShare = 0.1;

/// Force on the first body [N]: `limit` = friction * |F_n| against the slip above `threshold` [m/s], in
/// proportion to the slip below. The threshold is raised where a step dt would otherwise reverse the slip:
/// two spheres resist slip with the mass 2/7 m* (translation and rotation together).
template <class T>
INTERSTICE_HD inline Vec3<T> slider_force(const Vec3<T>& velocity, const T& limit, const T& threshold,
                                          const T& effective_mass, const T& dt) {
  const T stable = limit * dt / (T(kSliderShare * 2.0 / 7.0) * effective_mass);
  const T speed = max_of(max_of(norm(velocity), T(1e-30)), max_of(threshold, stable));
  return (-limit / speed) * velocity;
}

}  // namespace interstice::dem
