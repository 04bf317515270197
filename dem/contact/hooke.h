// Linear normal spring F = k overlap (Cundall & Strack, Geotechnique 29, 1979, eq. 4), and the two published
// rules by which its stiffness follows from the fastest impact that is expected.
#pragma once

#include "dem/contact/numeric.h"

namespace interstice::dem {

/// F = k overlap [N].
template <class T>
INTERSTICE_HD inline T hooke_force(const T& stiffness, const T& overlap) {
  return stiffness * overlap;
}

/// 1/2 k overlap^2 [J].
template <class T>
INTERSTICE_HD inline T hooke_energy(const T& stiffness, const T& overlap) {
  return T(0.5) * stiffness * overlap * overlap;
}

/// Rule `overlap`: K_n = m* V^2 / Delta^2, so that an undamped impact at V overlaps by Delta (energy balance;
/// the K_n of the bonded binder-jet model, docs/PHYSICS.md) [N/m].
constexpr double stiffness_for_overlap(double effective_mass, double speed, double overlap) {
  return effective_mass * speed * speed / (overlap * overlap);
}

/// Rule `velocity`: k = 10 m v^2 / r^2, m and r of one grain (the foundry-sand model, docs/PHYSICS.md) [N/m].
constexpr double stiffness_for_velocity(double mass, double speed, double radius) {
  return 10 * mass * speed * speed / (radius * radius);
}

/// Half a period of the damped oscillator, pi sqrt(m*/k) / sqrt(1 - zeta^2) [s], zeta < 1 the damping ratio.
inline double hooke_contact_time(double effective_mass, double stiffness, double damping_ratio) {
  return M_PI * std::sqrt(effective_mass / stiffness / (1 - damping_ratio * damping_ratio));
}

}  // namespace interstice::dem
