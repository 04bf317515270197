// Elastic normal force of two spheres (Hertz 1882; Johnson, Contact Mechanics, 1985, eq. 4.23).
#pragma once

#include "dem/contact/numeric.h"

namespace interstice::dem {

/// Tangent stiffness S = dF/d(overlap) = 2 E* a, a = sqrt(R* overlap) the contact radius [N/m].
template <class T>
INTERSTICE_HD inline T hertz_stiffness(const T& effective_modulus, const T& contact_radius) {
  return T(2) * effective_modulus * contact_radius;
}

/// F = 4/3 E* sqrt(R*) overlap^(3/2) = 2/3 S overlap [N].
template <class T>
INTERSTICE_HD inline T hertz_force(const T& stiffness, const T& overlap) {
  return T(2.0 / 3.0) * stiffness * overlap;
}

/// Integral of the force, 2/5 F overlap [J].
template <class T>
INTERSTICE_HD inline T hertz_energy(const T& force, const T& overlap) {
  return T(0.4) * force * overlap;
}

}  // namespace interstice::dem
