// Attraction of stiff, weakly adhesive spheres: Hertz's contact under a constant pull (Derjaguin, Muller &
// Toporov, J. Colloid Interface Sci. 53, 1975, in the form of Maugis, 1992): nothing beyond contact, no
// hysteresis.
#pragma once

#include "dem/contact/numeric.h"

namespace interstice::dem {

/// 2 pi w R* [N], w the work of adhesion.
template <class T>
INTERSTICE_HD inline T dmt_attraction(const T& work_of_adhesion, const T& effective_radius) {
  return T(2 * M_PI) * work_of_adhesion * effective_radius;
}

}  // namespace interstice::dem
