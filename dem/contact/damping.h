// Viscous damping that returns the restitution asked for, at any speed, for the Hertz force (Tsuji, Tanaka &
// Ishida, Powder Technol. 71, 1992, eq. 17, with the closed form of Antypov & Elliott, EPL 94, 2011, eq. 7).
#pragma once

#include <cmath>

#include "dem/contact/numeric.h"

namespace interstice::dem {

/// 2 sqrt(5/6) |beta| with beta = ln e / sqrt(ln^2 e + pi^2); the limit 2 sqrt(5/6) at e = 0, and 0 at e = 1.
inline double damping_coefficient(double restitution) {
  const double limit = 2 * std::sqrt(5.0 / 6.0);
  if (restitution <= 0) return limit;
  const double log_e = std::log(restitution);
  return limit * -log_e / std::sqrt(log_e * log_e + M_PI * M_PI);
}

/// Dashpot coefficient gamma = coefficient * sqrt(S m*) [N s/m], S the tangent stiffness.
template <class T>
INTERSTICE_HD inline T dashpot(const T& coefficient, const T& stiffness, const T& effective_mass) {
  return coefficient * sqrt_of(stiffness * effective_mass);
}

}  // namespace interstice::dem
