// What a group of contacts reads of its grains and materials: rows of memory turned into lanes.
#pragma once

#include <cstddef>

#include "dem/kernels/geometry.h"
#include "dem/kernels/pair_geometry.h"
#include "dem/simd/transpose.h"

namespace interstice::dem {

/// A grain of each contact.
template <class P>
struct GrainRows {
  Vec3<simd::Pack<double, kLanes>> position;
  simd::Pack<double, kLanes> radius;  // as exact as the positions
  Vec3<P> velocity, spin;
  P mass;
};

/// The grains in the slots slot_at(0), slot_at(1), ...
template <class P, class SlotAt>
GrainRows<P> load_rows(const StepView& v, const SlotAt& slot_at) {
  using Real = RealOf<P>;
  using Row = PairRow<Real>;
  const auto* rows = static_cast<const std::byte*>(v.rows);
  simd::QuadLoader<double, kLanes> sites;
  simd::QuadLoader<Real, kLanes> velocities, spins;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    const std::byte* row = rows + sizeof(Row) * slot_at(i);
    sites.template load<i>(row);
    velocities.template load<i>(row + offsetof(Row, vx));
    spins.template load<i>(row + offsetof(Row, wx));
  });
  const auto s = sites.quad();
  const auto u = velocities.quad(), w = spins.quad();
  return {{s.a, s.b, s.c}, s.d, {u.a, u.b, u.c}, {w.a, w.b, w.c}, u.d};
}

/// The constants that constants_at(0), constants_at(1), ... name.
template <class Real, class ConstantsAt>
PairConstants<simd::Pack<Real, kLanes>> load_constants(const ConstantsAt& constants_at) {
  using Scalars = PairConstants<Real>;
  static_assert(sizeof(Scalars) == 12 * sizeof(Real), "three quads");
  simd::QuadLoader<Real, kLanes> first, second, third;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    const Scalars& c = constants_at(i);
    first.template load<i>(reinterpret_cast<const std::byte*>(&c.effective_modulus));
    second.template load<i>(reinterpret_cast<const std::byte*>(&c.friction));
    third.template load<i>(reinterpret_cast<const std::byte*>(&c.hamaker_constant));
  });
  const auto p = first.quad(), q = second.quad(), r = third.quad();
  return {p.a, p.b, p.c, p.d, q.a, q.b, q.c, q.d, r.a, r.b, r.c, r.d};
}

}  // namespace interstice::dem
