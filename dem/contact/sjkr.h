// Simplified JKR cohesion: an attraction proportional to the area in which the undeformed surfaces intersect
// (the `sjkr` model of LIGGGHTS, Kloss et al., Prog. Comput. Fluid Dyn. 12, 2012). No force beyond contact,
// no hysteresis.
#pragma once

#include "dem/contact/numeric.h"

namespace interstice::dem {

/// Area of the circle in which two spheres of radii a, b at centre distance d intersect [m^2];
/// inverse_d = 1/d, overlap = a + b - d: pi/4 overlap (d + a + b) (1 - ((a - b)/d)^2). None where one sphere
/// lies wholly inside the other (a bad start, a heavy press).
template <class T>
INTERSTICE_HD inline T sphere_sphere_area(const T& a, const T& b, const T& d, const T& inverse_d,
                                          const T& overlap) {
  const T lean = (a - b) * inverse_d;
  return max_of((T(0.25 * M_PI) * overlap) * (d + (a + b)) * subtract_product(lean, lean, T(1)), T(0));
}

/// Area in which a sphere of radius r intersects a plane at distance d = r - overlap from its centre [m^2].
template <class T>
INTERSTICE_HD inline T sphere_plane_area(const T& r, const T& overlap) {
  return max_of(T(M_PI) * overlap * (T(2) * r - overlap), T(0));
}

/// Attraction k A [N], k the cohesion energy density [J/m^3].
template <class T>
INTERSTICE_HD inline T sjkr_attraction(const T& energy_density, const T& area) {
  return energy_density * area;
}

/// Integral of sphere_sphere_area over the overlap [m^3].
template <class T>
INTERSTICE_HD inline T sphere_sphere_area_integral(const T& a, const T& b, const T& d, const T& overlap) {
  const T meeting = max_of(d, abs_of(a - b)), o = min_of(overlap, a + b - meeting);  // constant farther in
  return T(0.25 * M_PI) * square(o) * (a + b - o / T(3) - square(a - b) / meeting);
}

/// Integral of sphere_plane_area over the overlap [m^3].
template <class T>
INTERSTICE_HD inline T sphere_plane_area_integral(const T& r, const T& overlap) {
  const T o = min_of(overlap, T(2) * r);
  return T(M_PI) * square(o) * (r - o / T(3));
}

}  // namespace interstice::dem
