// Compiled once per instruction set: foreach_target.h includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "voxel/round_rows.cpp"
#include <hwy/foreach_target.h>
// The line above must come first.
#include <hwy/highway.h>

#include "voxel/round_rows.h"

HWY_BEFORE_NAMESPACE();
namespace interstice::voxel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using RowTag = hn::CappedTag<double, kBlock>;
using Numbers = hn::Vec<RowTag>;

HWY_INLINE void add_to(Numbers numbers, double* sums) {
  const RowTag d;
  hn::StoreU(hn::Add(hn::LoadU(d, sums), numbers), d, sums);
}

/// Bit k says whether number k is not zero.
HWY_INLINE unsigned nonzero(Numbers numbers) {
  const RowTag d;
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, hn::Ne(numbers, hn::Zero(d)), bits);
  return bits[0];
}

/// As many cells as a register holds, beginning with cell k of row `row`. Cells beyond the lattice are void.
template <bool kWalls>
HWY_INLINE void round_cells(const BlockRows& rows, const double* solid, int row, int k, LeafRows& leaves,
                            RowSums& sums) {
  const RowTag d;
  const hn::Rebind<float, RowTag> narrow;
  const Numbers one = hn::Set(d, 1.0);
  const int at = row * kBlock + k;
  const auto inside = hn::Lt(hn::Iota(d, k), hn::Set(d, rows.n[2]));
  const Numbers share = hn::IfThenElseZero(inside, hn::LoadU(d, solid + k));
  Numbers available = one;
  if constexpr (kWalls) {
    const Numbers taken = hn::IfThenElseZero(inside, hn::LoadU(d, rows.walls + at));
    available = hn::Sub(one, taken);
    hn::StoreU(hn::DemoteTo(narrow, available), narrow, leaves.available + at);
    add_to(taken, sums.wall + k);
    leaves.wall_on[row] = static_cast<std::uint8_t>(leaves.wall_on[row] | (nonzero(taken) << k));
  }
  const Numbers empty = hn::Sub(available, share);
  const auto rounded = hn::DemoteTo(narrow, share);
  hn::StoreU(rounded, narrow, leaves.solid + at);
  hn::StoreU(hn::DemoteTo(narrow, empty), narrow, leaves.empty + at);
  leaves.solid_on[row] = static_cast<std::uint8_t>(leaves.solid_on[row] | (nonzero(share) << k));
  add_to(share, sums.solid + k);
  add_to(hn::PromoteTo(d, rounded), sums.written + k);
  const auto negative = hn::And(inside, hn::Lt(empty, hn::Set(d, leaves.least_void)));
  add_to(hn::IfThenElseZero(negative, one), sums.negative + k);
  const Numbers low = hn::LoadU(d, sums.void_min + k), high = hn::LoadU(d, sums.void_max + k);
  hn::StoreU(hn::IfThenElse(inside, hn::Min(low, empty), low), d, sums.void_min + k);
  hn::StoreU(hn::IfThenElse(inside, hn::Max(high, empty), high), d, sums.void_max + k);
}

template <bool kWalls>
HWY_INLINE void round_all(const BlockRows& rows, LeafRows& leaves, RowSums& sums) {
  for (int i = 0; i < rows.n[0]; ++i)
    for (int j = 0; j < rows.n[1]; ++j) {
      const double* solid = rows.solid + i * rows.stride_i + j * rows.stride_j;
      const int row = i * kBlock + j;
      for (int k = 0; k < kBlock; k += static_cast<int>(hn::Lanes(RowTag())))
        round_cells<kWalls>(rows, solid, row, k, leaves, sums);
      leaves.any_on[row] = leaves.solid_on[row] | leaves.wall_on[row];
    }
}

void round_block(const BlockRows& rows, LeafRows& leaves, RowSums& sums) {
  if (rows.walls)
    round_all<true>(rows, leaves, sums);
  else
    round_all<false>(rows, leaves, sums);
}

}  // namespace interstice::voxel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace interstice::voxel {

HWY_EXPORT(round_block);

void round_rows(const BlockRows& rows, LeafRows& leaves, RowSums& sums) {
  HWY_DYNAMIC_DISPATCH(round_block)(rows, leaves, sums);
}

}  // namespace interstice::voxel
#endif
