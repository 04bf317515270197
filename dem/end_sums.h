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

/// Sums rows of ends as they lie, as many in a register as it holds, and turns only the sums into lanes.
template <class Real>
class RowSums {
 public:
  /// How many ends each grain has.
  explicit RowSums(const std::uint32_t* count) : count_(simd::from_counts<Real, kLanes>(count)) {
    count_.store(each_);
  }
  /// One end of every grain.
  void add(const Real* ends) {
    simd::unrolled<kPacks>([&](auto index) {
      constexpr int j = decltype(index)::value;
      sums_[j] += Rows::load(ends + j * kReals);
    });
  }
  /// End number `rank` of the grains that have it.
  void add(const Real* ends, std::uint32_t rank) {
    simd::unrolled<kPacks>([&](auto index) {
      constexpr int j = decltype(index)::value;
      const auto own = count_of<j>() > Rows(rank);
      sums_[j] = select(own, sums_[j] + Rows::load(ends + j * kReals), sums_[j]);
    });
  }
  /// The ends beyond those collected by ranks: of each grain's `count` the first `taken`.
  void add_rest(const Real* end, std::uint32_t ranks, const std::uint32_t* count,
                const std::uint32_t* taken) {
    alignas(64) Real rows[kLanes * kEndReals];
    simd::unrolled<kPacks>([&](auto index) {
      constexpr int j = decltype(index)::value;
      simd::store_in_pieces(sums_[j], rows + j * kReals);
    });
    for (std::uint32_t lane = 0; lane < kLanes; ++lane) {
      if (count[lane] <= ranks) continue;
      Real* const at = rows + kEndReals * place_of_lane(lane);
      End sum = End::load(at);
      for (std::uint32_t k = ranks; k < taken[lane]; ++k) sum += End::load(end + kEndReals * (k - ranks));
      sum.store(at);
      end += kEndReals * (count[lane] - ranks);
    }
    simd::unrolled<kPacks>([&](auto index) {
      constexpr int j = decltype(index)::value;
      sums_[j] = Rows::load(rows + j * kReals);
    });
  }
  EndSums<simd::Pack<Real, kLanes>> lanes() const {
    simd::OctLoader<Real, kLanes> rows;
    rows.take(sums_);
    const auto c = rows.columns();
    return {{c[0], c[1], c[2]}, {c[4], c[5], c[6]}};
  }

 private:
  static constexpr int kReals = 64 / sizeof(Real), kEnds = kReals / static_cast<int>(kEndReals),
                       kPacks = static_cast<int>(kLanes) / kEnds;
  using Rows = simd::Pack<Real, kReals>;
  using End = simd::Pack<Real, static_cast<int>(kEndReals)>;
  /// By number of pack j, how many ends its grain has.
  template <int j>
  Rows count_of() const {
    if constexpr (kEnds == 1) {
      return Rows(each_[lane_at(j)]);  // from memory: registers are scarce
    } else {
      return simd::halves_of<lane_at(2 * j), lane_at(2 * j + 1), kReals>(count_);
    }
  }

  simd::Pack<Real, kLanes> count_;
  alignas(64) Real each_[kLanes];
  Rows sums_[kPacks];
};

/// Sums each grain's ends in their order. `ends`: the ring; `count`: how many each grain has.
template <class Real>
EndSums<simd::Pack<Real, kLanes>> end_sums(const Real* ends, const EndRows& rows,
                                           const std::uint32_t* count) {
  RowSums<Real> sums(count);
  const Real* end = ends + kEndReals * rows.first;
  constexpr std::size_t rank = kEndReals * kLanes;
  for (std::uint32_t k = 0; k < rows.full; ++k, end += rank) sums.add(end);
  for (std::uint32_t k = rows.full; k < rows.ranks; ++k, end += rank) sums.add(end, k);
  if (rows.beyond > 0) sums.add_rest(ends + kEndReals * rows.rest(), rows.ranks, count, count);
  return sums.lanes();
}

/// Sums the first ends of each grain: `taken` of its `count`, nowhere more than `most`.
template <class Real>
EndSums<simd::Pack<Real, kLanes>> end_sums(const Real* ends, const EndRows& rows, const std::uint32_t* count,
                                           const std::uint32_t* taken, std::uint32_t most) {
  RowSums<Real> sums(taken);
  const Real* end = ends + kEndReals * rows.first;
  const std::uint32_t ranks = std::min(rows.ranks, most);
  for (std::uint32_t k = 0; k < ranks; ++k, end += kEndReals * kLanes) sums.add(end, k);
  if (most > rows.ranks) sums.add_rest(ends + kEndReals * rows.rest(), rows.ranks, count, taken);
  return sums.lanes();
}

}  // namespace interstice::dem
