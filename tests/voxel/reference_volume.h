// The volume of a ball in a box, by a way that has nothing in common with the library's: slices x = const,
// whose area is a mixed difference of the 2-D corner function, integrated adaptively in extended precision.
#pragma once

#include <algorithm>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <vector>

#include "base/shapes.h"

namespace interstice::voxel::test {

/// Area of the disc of squared radius q in [0,a] x [0,b], odd in a and b.
inline long double disc_corner(long double q, long double a, long double b) {
  if (a < 0) return -disc_corner(q, -a, b);
  if (b < 0) return -disc_corner(q, a, -b);
  if (a * a + b * b <= q) return a * b;
  const long double r = std::sqrt(q);
  a = std::min(a, r);
  b = std::min(b, r);
  // from y = 0 to where the arc leaves x = a, the rectangle; then under the arc up to y = b
  const long double from = std::sqrt(std::max(0.0L, q - a * a));
  // (one and the same rounded square root in both terms: its error cancels where it is large, at y = r)
  const auto under = [&](long double y) {
    const long double x = std::sqrt(std::max(0.0L, q - y * y));
    return 0.5L * (y * x + q * std::atan2(y, x));
  };
  return from >= b ? a * b : a * from + under(b) - under(from);
}

inline long double disc_in_rectangle(long double q, long double y0, long double y1, long double z0,
                                     long double z1) {
  if (q <= 0) return 0;
  return disc_corner(q, y1, z1) - disc_corner(q, y0, z1) - disc_corner(q, y1, z0) + disc_corner(q, y0, z0);
}

inline double reference_volume(const Vec3d& center, double radius, const Box& box) {
  using Rule = boost::math::quadrature::gauss_kronrod<long double, 31>;
  const long double r = radius;
  const auto at = [&](long double edge, double c) { return (edge - c) / r; };
  const long double x0 = std::max(-1.0L, at(box.lo.x, center.x)), x1 = std::min(1.0L, at(box.hi.x, center.x));
  const long double y0 = at(box.lo.y, center.y), y1 = at(box.hi.y, center.y);
  const long double z0 = at(box.lo.z, center.z), z1 = at(box.hi.z, center.z);
  const auto nearest = [](long double a, long double b) { return a > 0 ? a : b < 0 ? b : 0.0L; };
  const long double nx = nearest(x0, x1), ny = nearest(y0, y1), nz = nearest(z0, z1);
  if (x0 >= x1 || nx * nx + ny * ny + nz * nz >= 1) return 0;
  // the area has kinks where the circle touches an edge's line or passes a corner
  std::vector<long double> cuts{x0, x1, 0.0L};
  for (const long double a : {0.0L, y0, y1})
    for (const long double b : {0.0L, z0, z1}) {
      const long double square = 1 - a * a - b * b;
      if (square > 0) cuts.insert(cuts.end(), {std::sqrt(square), -std::sqrt(square)});
    }
  std::sort(cuts.begin(), cuts.end());
  long double volume = 0;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    const long double from = std::max(x0, cuts[c]), to = std::min(x1, cuts[c + 1]), length = to - from;
    if (length <= 0) continue;
    // x = from + length t^2 (3 - 2t) takes the square roots at the ends away
    volume += Rule::integrate(
        [&](long double t) {
          const long double x = from + length * t * t * (3 - 2 * t);
          return length * 6 * t * (1 - t) * disc_in_rectangle((1 - x) * (1 + x), y0, y1, z0, z1);
        },
        0.0L, 1.0L, 6, 1e-14L);
  }
  return static_cast<double>(volume * r * r * r);
}

}  // namespace interstice::voxel::test
