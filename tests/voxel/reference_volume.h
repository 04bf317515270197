// The volume of a ball in a box, by a way that has nothing in common with the library's: slices x = const,
// whose area is a mixed difference of the 2-D corner function, integrated adaptively in extended precision,
// or in any other that is asked for.
#pragma once

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <vector>

#include "base/shapes.h"

namespace interstice::voxel::test {

/// Area of the disc of squared radius q in [0,a] x [0,b], odd in a and b.
template <class Real>
Real disc_corner(Real q, Real a, Real b) {
  using std::atan2, std::sqrt;
  if (a < 0) return -disc_corner<Real>(q, -a, b);
  if (b < 0) return -disc_corner<Real>(q, a, -b);
  if (a * a + b * b <= q) return a * b;
  const Real r = sqrt(q);
  a = std::min(a, r);
  b = std::min(b, r);
  // from y = 0 to where the arc leaves x = a, the rectangle; then under the arc up to y = b
  const Real from = sqrt(std::max(Real(0), Real(q - a * a)));
  // (one and the same rounded square root in both terms: its error cancels where it is large, at y = r)
  const auto under = [&](Real y) {
    const Real x = sqrt(std::max(Real(0), Real(q - y * y)));
    return Real((y * x + q * atan2(y, x)) / 2);
  };
  return from >= b ? Real(a * b) : Real(a * from + under(b) - under(from));
}

template <class Real>
Real disc_in_rectangle(Real q, Real y0, Real y1, Real z0, Real z1) {
  if (q <= 0) return 0;
  return disc_corner(q, y1, z1) - disc_corner(q, y0, z1) - disc_corner(q, y1, z0) + disc_corner(q, y0, z0);
}

/// In units of the radius: the unit ball in [lo, hi], each interval integrated to `tolerance`.
template <class Real>
Real reference_unit_volume(const std::array<Real, 3>& lo, const std::array<Real, 3>& hi, Real tolerance) {
  using std::sqrt;
  using Rule = boost::math::quadrature::gauss_kronrod<Real, 31>;
  const Real x0 = std::max(Real(-1), lo[0]), x1 = std::min(Real(1), hi[0]);
  const auto nearest = [](const Real& a, const Real& b) { return a > 0 ? a : b < 0 ? b : Real(0); };
  const Real nx = nearest(x0, x1), ny = nearest(lo[1], hi[1]), nz = nearest(lo[2], hi[2]);
  if (x0 >= x1 || nx * nx + ny * ny + nz * nz >= 1) return 0;
  // the area has kinks where the circle touches an edge's line or passes a corner
  std::vector<Real> cuts{x0, x1, Real(0)};
  for (const Real& a : {Real(0), lo[1], hi[1]})
    for (const Real& b : {Real(0), lo[2], hi[2]}) {
      const Real square = 1 - a * a - b * b;
      if (square > 0) cuts.insert(cuts.end(), {sqrt(square), Real(-sqrt(square))});
    }
  std::sort(cuts.begin(), cuts.end());
  Real volume = 0;
  for (std::size_t c = 0; c + 1 < cuts.size(); ++c) {
    const Real from = std::max(x0, cuts[c]), to = std::min(x1, cuts[c + 1]), length = to - from;
    if (length <= 0) continue;
    // x = from + length t^2 (3 - 2t) takes the square roots at the ends away
    volume += Rule::integrate(
        [&](const Real& t) {
          const Real x = from + length * t * t * (3 - 2 * t);
          return Real(length * 6 * t * (1 - t) *
                      disc_in_rectangle<Real>((1 - x) * (1 + x), lo[1], hi[1], lo[2], hi[2]));
        },
        Real(0), Real(1), 6, tolerance);
  }
  return volume;
}

inline double reference_volume(const Vec3d& center, double radius, const Box& box) {
  const long double r = radius;
  std::array<long double, 3> lo{}, hi{};
  for (int axis = 0; axis < 3; ++axis) {
    const auto at = static_cast<std::size_t>(axis);
    lo[at] = (static_cast<long double>(box.lo[axis]) - center[axis]) / r;
    hi[at] = (static_cast<long double>(box.hi[axis]) - center[axis]) / r;
  }
  return static_cast<double>(reference_unit_volume<long double>(lo, hi, 1e-14L) * r * r * r);
}

}  // namespace interstice::voxel::test
