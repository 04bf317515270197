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
  static constexpr int kReals = 64 / sizeof(Real), kEnds = kReals / static_cast<int>(kEndReals),
                       kPacks = static_cast<int>(kLanes) / kEnds;

  /// How many ends the grain at each place has.
  explicit RowSums(const std::uint32_t* count) : count_(simd::from_counts<Real, kLanes>(count)) {
    count_.store(each_);
  }
  /// End number `rank` of the grains of the first `packs` registers: those of the first `whole` have one, of
  /// the others some.
  template <int whole, int packs>
  void add(const Real* ends, std::uint32_t rank) {
    simd::unrolled<packs>([&](auto index) {
      constexpr int j = decltype(index)::value;
      const Rows sum = sums_[j] + Rows::load(ends + j * kReals);
      if constexpr (j < whole) {
        sums_[j] = sum;
      } else {
        sums_[j] = select(count_of<j>() > Rows(rank), sum, sums_[j]);
      }
    });
  }
  EndSums<simd::Pack<Real, kLanes>> lanes(const EndRows& rows) const {
    simd::OctLoader<Real, kLanes> loader;
    loader.take(sums_);
    const auto c = loader.columns();
    const auto in_lanes = [&](const auto& column) { return simd::permuted(column, rows.column_of.data()); };
    return {{in_lanes(c[0]), in_lanes(c[1]), in_lanes(c[2])},
            {in_lanes(c[4]), in_lanes(c[5]), in_lanes(c[6])}};
  }

 private:
  using Rows = simd::Pack<Real, kReals>;
  /// By number of pack j, how many ends its grain has.
  template <int j>
  Rows count_of() const {
    if constexpr (kEnds == 1) {
      return Rows(each_[j]);  // from memory: registers are scarce
    } else {
      return simd::halves_of<2 * j, 2 * j + 1, kReals>(count_);
    }
  }

  simd::Pack<Real, kLanes> count_;
  alignas(64) Real each_[kLanes];
  Rows sums_[kPacks];
};

/// Sums each grain's ends in their order. `ends`: the ring.
template <class Real>
EndSums<simd::Pack<Real, kLanes>> end_sums(const Real* ends, const GroupEnds& group) {
  using Sums = RowSums<Real>;
  constexpr int all = Sums::kPacks, half = all / 2;
  Sums sums(group.count);
  const Real* const first = ends + kEndReals * group.rows.first;
  const auto at = [&](std::uint32_t rank) { return first + kEndReals * group.rank_begin[rank]; };
  std::uint32_t rank = 0;
  for (; rank < group.count[kLanes - 1]; ++rank) sums.template add<all, all>(at(rank), rank);
  for (; rank < group.count[kLanes / 2 - 1]; ++rank) sums.template add<half, all>(at(rank), rank);
  for (; rank < group.count[Sums::kEnds]; ++rank) sums.template add<0, half>(at(rank), rank);
  for (; rank < group.count[0]; ++rank) sums.template add<0, 1>(at(rank), rank);
  return sums.lanes(group.rows);
}

/// Sums the first ends of each grain: `taken` by place, nowhere more than `most`.
template <class Real>
EndSums<simd::Pack<Real, kLanes>> end_sums(const Real* ends, const GroupEnds& group,
                                           const std::uint32_t* taken, std::uint32_t most) {
  using Sums = RowSums<Real>;
  Sums sums(taken);
  const Real* const first = ends + kEndReals * group.rows.first;
  for (std::uint32_t rank = 0; rank < most; ++rank)
    sums.template add<0, Sums::kPacks>(first + kEndReals * group.rank_begin[rank], rank);
  return sums.lanes(group.rows);
}

}  // namespace interstice::dem
