// Simplified JKR cohesion: an attraction proportional to the area in which the undeformed surfaces intersect
// (the `sjkr` model of LIGGGHTS, Kloss et al., Prog. Comput. Fluid Dyn. 12, 2012). No force beyond contact,
// no hysteresis.
#pragma once

#include "dem/contact/numeric.h"

namespace interstice::dem {

/// Area of the circle in which two spheres of radii a, b at centre distance d intersect [m^2];
/// overlap = a + b - d.
template <class T>
INTERSTICE_HD inline T sphere_sphere_area(const T& a, const T& b, const T& d, const T& overlap) {
  return T(0.25 * M_PI) * overlap * (d + a - b) * (d - a + b) * (d + a + b) / (d * d);
}

/// Area in which a sphere of radius r intersects a plane at distance d = r - overlap from its centre [m^2].
template <class T>
INTERSTICE_HD inline T sphere_plane_area(const T& r, const T& overlap) {
  return T(M_PI) * overlap * (T(2) * r - overlap);
}

/// Attraction k A [N], k the cohesion energy density [J/m^3].
template <class T>
INTERSTICE_HD inline T sjkr_attraction(const T& energy_density, const T& area) {
  return energy_density * area;
}

/// Integral of sphere_sphere_area over the overlap [m^3].
template <class T>
INTERSTICE_HD inline T sphere_sphere_area_integral(const T& a, const T& b, const T& d, const T& overlap) {
  return T(0.25 * M_PI) * square(overlap) * (a + b - overlap / T(3) - square(a - b) / d);
}

/// Integral of sphere_plane_area over the overlap [m^3].
template <class T>
INTERSTICE_HD inline T sphere_plane_area_integral(const T& r, const T& overlap) {
  return T(M_PI) * square(overlap) * (r - overlap / T(3));
}

}  // namespace interstice::dem
