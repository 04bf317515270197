// What a group of pairs reads of its grains: rows of memory turned into lanes.
#pragma once

#include <cstddef>

#include "dem/kernels/geometry.h"
#include "dem/kernels/pair_geometry.h"
#include "dem/simd/transpose.h"

namespace interstice::dem {

/// One grain of each pair.
template <class P>
struct PairRows {
  Vec3<simd::Pack<double, kLanes>> position;
  simd::Pack<double, kLanes> radius;  // as exact as the positions
  Vec3<P> velocity, spin;
  P mass;
};

/// The first (second) grains of a group.
template <std::uint32_t PairRef::*which, class P>
PairRows<P> load_rows(const StepView& v, const PairRef* pairs) {
  using Real = RealOf<P>;
  using Row = PairRow<Real>;
  const auto* rows = static_cast<const std::byte*>(v.rows);
  simd::QuadLoader<double, kLanes> sites;
  simd::QuadLoader<Real, kLanes> velocities, spins;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    const std::byte* row = rows + sizeof(Row) * (pairs[i].*which);
    sites.template load<i>(row);
    velocities.template load<i>(row + offsetof(Row, vx));
    spins.template load<i>(row + offsetof(Row, wx));
  });
  const auto s = sites.quad();
  const auto u = velocities.quad(), w = spins.quad();
  return {{s.a, s.b, s.c}, s.d, {u.a, u.b, u.c}, {w.a, w.b, w.c}, u.d};
}

/// For grains of different materials: each lane's constants.
template <class Real>
PairConstants<simd::Pack<Real, kLanes>> constants_of_group(const StepView& v, const PairRef* pairs) {
  using Scalars = PairConstants<Real>;
  static_assert(sizeof(Scalars) == 12 * sizeof(Real), "three quads");
  const auto* rows = static_cast<const PairRow<Real>*>(v.rows);
  simd::QuadLoader<Real, kLanes> first, second, third;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    const Scalars& c = constants_of<Real>(v, rows[pairs[i].a].material, rows[pairs[i].b].material);
    first.template load<i>(reinterpret_cast<const std::byte*>(&c.effective_modulus));
    second.template load<i>(reinterpret_cast<const std::byte*>(&c.friction));
    third.template load<i>(reinterpret_cast<const std::byte*>(&c.hamaker_constant));
  });
  const auto p = first.quad(), q = second.quad(), r = third.quad();
  return {p.a, p.b, p.c, p.d, q.a, q.b, q.c, q.d, r.a, r.b, r.c, r.d};
}

}  // namespace interstice::dem
