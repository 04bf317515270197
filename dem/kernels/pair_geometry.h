// How the grains of a group of pairs stand to each other.
#pragma once

#include <algorithm>
#include <limits>

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

/// Lengths of the domain's periodic axes and their inverses [m, 1/m], 0 along others.
struct Periods {
  Vec3d length, inverse;
  Doubles farthest;  // squared distance up to which no pair is nearer through a periodic face [m^2]

  explicit Periods(const Vec3d& period) : length(period), inverse(0, 0, 0) {
    double shortest = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
      if (period[axis] == 0) continue;
      inverse[axis] = 1 / period[axis];
      shortest = std::min(shortest, period[axis]);
    }
    farthest = Doubles(0.25 * shortest * shortest);
  }
};

/// Where the grains of a group of pairs are, so far as it takes double to know.
template <class P>
struct PairSites {
  Vec3<P> apart;  // from b to a [m]
  P excess;       // s^2 - d^2, of the sum of the radii and the distance [m^2]
};

/// From positions a - b and the sum of the radii in double: s^2 - d^2 keeps its digits where s - d would lose
/// them in single precision.
template <class P>
PairSites<P> pair_sites(Vec3<Doubles> apart, const Doubles& reach, const Periods& periods) {
  using Real = RealOf<P>;
  Doubles squared = dot(apart, apart);
  if (!everywhere((squared > Doubles(0)) & (squared <= periods.farthest))) [[unlikely]] {
    for (int axis = 0; axis < 3; ++axis)
      apart[axis] = subtract_product(rounded(apart[axis] * Doubles(periods.inverse[axis])),
                                     Doubles(periods.length[axis]), apart[axis]);
    squared = dot(apart, apart);
    const auto distinct = squared > Doubles(0);  // else a fixed direction
    apart.x = select(distinct, apart.x, Doubles(1e-6) * reach);
    squared = select(distinct, squared, square(apart.x));
  }
  return {simd::converted<Real>(apart), simd::converted<Real>(multiply_add(reach, reach, -squared))};
}

/// How the grains of a group of pairs stand to each other.
template <class P>
struct PairGeometry {
  Vec3<P> normal;       // from b to a
  P distance, overlap;  // [m]
  P inverse_distance;   // [1/m]
  P inverse_reach;      // of the sum of the radii [1/m]
};

template <class P>
PairGeometry<P> pair_geometry(const PairSites<P>& sites, const P& reach) {
  PairGeometry<P> g;
  const P squared = dot(sites.apart, sites.apart);
  g.inverse_distance = inverse_root_of(squared);
  g.distance = squared * g.inverse_distance;
  const P sum = reach + g.distance, inverse = inverse_of(reach * sum);  // one division for two
  g.inverse_reach = sum * inverse;
  g.overlap = sites.excess * (reach * inverse);
  g.normal = g.inverse_distance * sites.apart;
  return g;
}

}  // namespace interstice::dem
