// Elastic normal force of two spheres (Hertz 1882; Johnson, Contact Mechanics, 1985, eq. 4.23).
#pragma once

#include "dem/contact/numeric.h"

namespace interstice::dem {

/// Tangent stiffness S = dF/d(overlap) = 2 E* sqrt(R* overlap) [N/m].
template <class T>
INTERSTICE_HD inline T hertz_stiffness(const T& effective_modulus, const T& sqrt_radius_overlap) {
  return T(2) * effective_modulus * sqrt_radius_overlap;
}

/// F = 4/3 E* sqrt(R*) overlap^(3/2) = 2/3 S overlap [N].
template <class T>
INTERSTICE_HD inline T hertz_force(const T& stiffness, const T& overlap) {
  return T(2.0 / 3.0) * stiffness * overlap;
}

}  // namespace interstice::dem
