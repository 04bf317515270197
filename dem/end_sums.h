// What a group of grains collects of its ends (end_places.h).
#pragma once

#include "dem/contacts.h"
#include "dem/simd/transpose.h"

namespace interstice::dem {

/// Force [N] and torque [N m] on each grain of a group.
template <class P>
struct EndSums {
  Vec3<P> force, torque;
};

/// Adds the ends beyond those collected by lanes.
template <class Real>
void add_rest(const Real* ends, const EndRows& rows, const std::uint32_t* count,
              EndSums<simd::Pack<Real, kLanes>>& sums) {
  using P = simd::Pack<Real, kLanes>;
  P* const packs[6] = {&sums.force.x,  &sums.force.y,  &sums.force.z,
                       &sums.torque.x, &sums.torque.y, &sums.torque.z};
  Real columns[6][kLanes];
  for (std::size_t j = 0; j < 6; ++j) packs[j]->store(columns[j]);
  const Real* end = ends + kEndReals * rows.rest();
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    for (std::uint32_t k = rows.ranks; k < count[lane]; ++k, end += kEndReals)
      for (std::size_t j = 0; j < 6; ++j) columns[j][lane] += end[j < 3 ? j : j + 1];
  }
  for (std::size_t j = 0; j < 6; ++j) *packs[j] = P::load(columns[j]);
}

/// Sums each grain's ends in their order. `ends`: the ring; `count`: how many each grain has.
template <class Real>
EndSums<simd::Pack<Real, kLanes>> end_sums(const Real* ends, const EndRows& rows,
                                           const std::uint32_t* count) {
  using P = simd::Pack<Real, kLanes>;
  const P none(0);
  EndSums<P> sums{{none, none, none}, {none, none, none}};
  const P has = simd::from_counts<Real, kLanes>(count);
  const Real* end = ends + kEndReals * rows.first;
  for (std::uint32_t k = 0; k < rows.ranks; ++k, end += kEndReals * kLanes) {
    simd::QuadLoader<Real, kLanes> forces, torques;
    simd::unrolled<kLanes>([&](auto lane) {
      constexpr int i = decltype(lane)::value;
      const auto* at = reinterpret_cast<const std::byte*>(end + kEndReals * i);
      forces.template load<i>(at);
      torques.template load<i>(at + 4 * sizeof(Real));
    });
    const auto f = forces.quad(), t = torques.quad();
    const auto own = has > P(static_cast<Real>(k));
    sums.force = select(own, sums.force + Vec3<P>{f.a, f.b, f.c}, sums.force);
    sums.torque = select(own, sums.torque + Vec3<P>{t.a, t.b, t.c}, sums.torque);
  }
  if (rows.beyond > 0) add_rest(ends, rows, count, sums);
  return sums;
}

}  // namespace interstice::dem
