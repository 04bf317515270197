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

/// Sums rows of ends as they lie, as many in a register as it holds, and turns only the sums into lanes.
template <class Real>
class RowSums {
 public:
  /// One end of every grain.
  void add(const Real* ends) {
    simd::unrolled<kPacks>([&](auto index) {
      constexpr int j = decltype(index)::value;
      sums_[j] += Rows::load(ends + j * kReals);
    });
  }
  /// One end of the grains whose bits are set.
  void add(const Real* ends, std::uint32_t which) {
    simd::unrolled<kPacks>([&](auto index) {
      constexpr int j = decltype(index)::value;
      const auto own = Rows::M::from_bits(reals_of(which >> (j * kEnds)));
      sums_[j] = select(own, sums_[j] + Rows::load(ends + j * kReals), sums_[j]);
    });
  }
  EndSums<simd::Pack<Real, kLanes>> lanes() const {
    alignas(64) Real rows[kLanes * kEndReals];
    for (int j = 0; j < kPacks; ++j) sums_[j].store(rows + j * kReals);
    simd::OctLoader<Real, kLanes> loader;
    simd::unrolled<kLanes>([&](auto lane) {
      constexpr int i = decltype(lane)::value;
      loader.template load<i>(rows + kEndReals * i);
    });
    const auto c = loader.columns();
    return {{c[0], c[1], c[2]}, {c[4], c[5], c[6]}};
  }

 private:
  static constexpr int kReals = 64 / sizeof(Real), kEnds = kReals / static_cast<int>(kEndReals),
                       kPacks = static_cast<int>(kLanes) / kEnds;
  using Rows = simd::Pack<Real, kReals>;
  /// A bit an end to a bit a number.
  static std::uint32_t reals_of(std::uint32_t ends) {
    if constexpr (kEnds == 1) return (ends & 1) * 0xff;
    return (ends & 1) * 0xff + (ends >> 1 & 1) * 0xff00;
  }

  Rows sums_[kPacks];
};

/// Sums each grain's ends in their order. `ends`: the ring; `count`: how many each grain has.
template <class Real>
EndSums<simd::Pack<Real, kLanes>> end_sums(const Real* ends, const EndRows& rows,
                                           const std::uint32_t* count) {
  RowSums<Real> sums;
  const Real* end = ends + kEndReals * rows.first;
  constexpr std::size_t rank = kEndReals * kLanes;
  for (std::uint32_t k = 0; k < rows.full; ++k, end += rank) sums.add(end);
  const auto has = simd::from_counts<float, kLanes>(count);
  for (std::uint32_t k = rows.full; k < rows.ranks; ++k, end += rank)
    sums.add(end, (has > simd::Pack<float, kLanes>(k)).bits());
  auto all = sums.lanes();
  if (rows.beyond > 0) add_rest(ends, rows, count, all);
  return all;
}

}  // namespace interstice::dem
