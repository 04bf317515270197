// Viscous damping that returns the restitution asked for, at any speed: gamma = 2 zeta sqrt(m* k) for a
// linear spring and sqrt(5/6) times that with the tangent stiffness S for k for the Hertz force (Tsuji,
// Tanaka & Ishida, Powder Technol. 71, 1992, eq. 17; that both obey the same equation: Antypov & Elliott, EPL
// 94, 2011, eq. 7).
#pragma once

#include "dem/contact/numeric.h"

namespace interstice::dem {

/// zeta at which spring and dashpot return e when they may attract until the bodies part:
/// zeta = -ln e / sqrt(ln^2 e + pi^2); 1 (critical) at e = 0.
double damping_ratio(double restitution);

/// Restitution when the force is cut off at zero (Schwager & Poeschel, Granular Matter 9, 2007).
double clipped_restitution(double damping_ratio);

/// The zeta at which that is e, at most kLargestClippedRatio: nothing returns less than
/// clipped_restitution(kLargestClippedRatio) = 0.024.
double clipped_damping_ratio(double restitution);
inline constexpr double kLargestClippedRatio = 3;

/// Dashpot coefficient gamma = coefficient * sqrt(S m*) [N s/m], S the tangent stiffness.
template <class T>
INTERSTICE_HD inline T dashpot(const T& coefficient, const T& stiffness, const T& effective_mass) {
  return coefficient * sqrt_of(stiffness * effective_mass);
}

}  // namespace interstice::dem
