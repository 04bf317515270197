// How the grains of a group of pairs stand to each other.
#pragma once

#include "dem/kernels/kernels.h"
#include "dem/simd/pack.h"

namespace interstice::dem {

template <class P>
struct ScalarOf;
template <class T, int N>
struct ScalarOf<simd::Pack<T, N>> {
  using type = T;
};
template <class P>
using RealOf = typename ScalarOf<P>::type;

/// How the grains of a group stand to each other.
template <class P>
struct PairGeometry {
  Vec3<P> normal;               // from b to a
  P distance, overlap;          // [m]
  P radius_a, radius_b, reach;  // and their sum [m]
  P inverse_reach;
};

/// From positions in double: s^2 - d^2 keeps its digits where s - d would lose them in single precision.
template <class P, class D>
PairGeometry<P> pair_geometry(const Vec3<D>& a, const D& radius_a, const Vec3<D>& b, const D& radius_b,
                              const Vec3d& period) {
  using Real = RealOf<P>;
  Vec3<D> apart = a - b;
  for (int axis = 0; axis < 3; ++axis) {
    if (period[axis] == 0) continue;
    D& x = apart[axis];
    x = select(x > D(0.5 * period[axis]), x - D(period[axis]),
               select(x < D(-0.5 * period[axis]), x + D(period[axis]), x));
  }
  const D reach = radius_a + radius_b;
  const D d2 = dot(apart, apart);
  const auto coincide = !(d2 > D(0));  // a fixed direction
  apart.x = select(coincide, D(1e-6) * reach, apart.x);
  const D squared = select(coincide, square(apart.x), d2);
  PairGeometry<P> g;
  const Vec3<P> between = simd::converted<Real>(apart);
  const P d2_real = simd::converted<Real>(squared);
  const P inverse_distance = inverse_root_of(d2_real);
  g.radius_a = simd::converted<Real>(radius_a);
  g.radius_b = simd::converted<Real>(radius_b);
  g.reach = simd::converted<Real>(reach);
  g.distance = d2_real * inverse_distance;
  const P sum = g.reach + g.distance, inverse = inverse_of(g.reach * sum);  // one division for two
  g.inverse_reach = sum * inverse;
  g.overlap = simd::converted<Real>(square(reach) - squared) * (g.reach * inverse);
  g.normal = inverse_distance * between;
  return g;
}

}  // namespace interstice::dem
