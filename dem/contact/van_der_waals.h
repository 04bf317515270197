// Van der Waals attraction of two spheres at the separation D of their surfaces, F = A R* / (6 D^2) (Hamaker,
// Physica 4, 1937; Derjaguin's approximation, D << R*; Israelachvili, Intermolecular and Surface Forces,
// 2011, table 13.1). Below the cut-off distance D0, in contact too, it stays at its value there.
#pragma once

#include "dem/contact/numeric.h"

namespace interstice::dem {

/// Attraction [N]; `overlap` = -D. Zero beyond `range`.
template <class T>
INTERSTICE_HD inline T van_der_waals_attraction(const T& hamaker, const T& cutoff, const T& range,
                                                const T& effective_radius, const T& overlap) {
  const T nearest = max_of(-overlap, cutoff);
  const T force = hamaker * effective_radius / (T(6) * nearest) / nearest;
  return select(-overlap < range, force, T(0));
}

/// Integral of the attraction from `range` inwards [J], > 0.
template <class T>
INTERSTICE_HD inline T van_der_waals_work(const T& hamaker, const T& cutoff, const T& range,
                                          const T& effective_radius, const T& overlap) {
  const T scale = hamaker * effective_radius / T(6);
  const T nearest = max_of(-overlap, cutoff);
  const T outside = scale / nearest - scale / range;
  const T inside = scale / cutoff / cutoff * max_of(cutoff + overlap, T(0));
  return select(-overlap < range, outside + inside, T(0));
}

}  // namespace interstice::dem
