// What a group of contacts reads of its grains and materials: rows of memory turned into lanes.
#pragma once

#include <cstddef>

#include "dem/kernels/geometry.h"
#include "dem/kernels/pair_geometry.h"
#include "dem/simd/transpose.h"

namespace interstice::dem {

/// What the laws read of a grain of each contact, besides its place.
template <class P>
struct GrainRows {
  Vec3<P> velocity;
  P inverse_mass;
  Vec3<P> spin;
  P radius;
};

template <class P>
using RowLoader = simd::OctLoader<RealOf<P>, kLanes>;

template <class P>
GrainRows<P> grain_rows(const RowLoader<P>& loader) {
  const auto c = loader.columns();
  return {{c[0], c[1], c[2]}, c[3], {c[4], c[5], c[6]}, c[7]};
}

/// What the laws read of a group of pairs, in two parts: the places are needed of all groups, the rest where
/// grains touch. Each part finds the rows by itself: to keep their addresses costs more.
template <class P>
PairSites<P> load_pair_sites(const StepView& v, const Periods& periods, std::size_t group) {
  using Row = PairRow<RealOf<P>>;
  const PairOffsets* const pairs = v.pairs.rows + group * kLanes;
  simd::QuadLoader<kLanes> apart;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    apart.template load_difference<i>(&simd::row_at<Row>(v.rows, pairs[i].a)->x,
                                      &simd::row_at<Row>(v.rows, pairs[i].b)->x);
  });
  const auto c = apart.columns();
  return pair_sites<P>(Vec3<Doubles>{c[0], c[1], c[2]}, c[3], periods);
}

template <class P>
struct PairRows {
  GrainRows<P> a, b;
};

template <class P>
PairRows<P> load_pair_rows(const StepView& v, std::size_t group) {
  using Row = PairRow<RealOf<P>>;
  const PairOffsets* pairs = v.pairs.rows + group * kLanes;
#if defined(__GNUC__)
  asm("" : "+r"(pairs));  // or gcc keeps 32 addresses in vector registers, dearer than loading them again
#endif
  RowLoader<P> of_a, of_b;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    of_a.template load<i>(&simd::row_at<Row>(v.rows, pairs[i].a)->vx);
    of_b.template load<i>(&simd::row_at<Row>(v.rows, pairs[i].b)->vx);
  });
  return {grain_rows<P>(of_a), grain_rows<P>(of_b)};
}

/// The constants that constants_at(0), constants_at(1), ... name.
template <class P, class ConstantsAt>
PairConstants<P> load_constants(const ConstantsAt& constants_at) {
  using Scalars = PairConstants<RealOf<P>>;
  static_assert(sizeof(Scalars) == 12 * sizeof(RealOf<P>), "eight, and the last eight");
  simd::OctLoader<RealOf<P>, kLanes> first, last;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    const Scalars& c = constants_at(i);
    first.template load<i>(&c.effective_modulus);
    last.template load<i>(&c.friction);
  });
  const auto p = first.columns(), q = last.columns();
  return {p[0], p[1], p[2], p[3], q[0], q[1], q[2], q[3], q[4], q[5], q[6], q[7]};
}

}  // namespace interstice::dem
