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
/// A double a pair.
using Doubles = simd::Pack<double, kLanes>;

/// Lengths of the domain's periodic axes and their inverses; 0 along the others [m, 1/m].
struct Periods {
  Vec3<Doubles> length, inverse;

  explicit Periods(const Vec3d& period) {
    for (int axis = 0; axis < 3; ++axis) {
      length[axis] = Doubles(period[axis]);
      inverse[axis] = Doubles(period[axis] > 0 ? 1 / period[axis] : 0);
    }
  }
};

/// Where the grains of a group of pairs are, so far as it takes double to know.
template <class P>
struct PairSites {
  Vec3<P> apart;  // from b to a [m]
  P squared;      // its square, s^2 less that, and s, the sum of the radii
  P excess, reach;
};

/// From positions a - b and the sum of the radii in double: s^2 - d^2 keeps its digits where s - d would lose
/// them in single precision.
template <class P>
PairSites<P> pair_sites(Vec3<Doubles> apart, const Doubles& reach, const Periods& periods) {
  using Real = RealOf<P>;
  for (int axis = 0; axis < 3; ++axis)
    apart[axis] =
        multiply_add(-rounded(apart[axis] * periods.inverse[axis]), periods.length[axis], apart[axis]);
  const Doubles d2 = dot(apart, apart);
  const auto coincide = !(d2 > Doubles(0));  // a fixed direction
  apart.x = select(coincide, Doubles(1e-6) * reach, apart.x);
  const Doubles squared = select(coincide, square(apart.x), d2);
  return {simd::converted<Real>(apart), simd::converted<Real>(squared),
          simd::converted<Real>(multiply_add(reach, reach, -squared)), simd::converted<Real>(reach)};
}

/// How the grains of a group of pairs stand to each other.
template <class P>
struct PairGeometry {
  Vec3<P> normal;       // from b to a
  P distance, overlap;  // [m]
  P inverse_reach;      // of the sum of the radii [1/m]
};

template <class P>
PairGeometry<P> pair_geometry(const PairSites<P>& sites) {
  PairGeometry<P> g;
  const P inverse_distance = inverse_root_of(sites.squared);
  g.distance = sites.squared * inverse_distance;
  const P sum = sites.reach + g.distance, inverse = inverse_of(sites.reach * sum);  // one division for two
  g.inverse_reach = sum * inverse;
  g.overlap = sites.excess * (sites.reach * inverse);
  g.normal = inverse_distance * sites.apart;
  return g;
}

}  // namespace interstice::dem
