// In which order a step works on pairs and grains. Grains move on block by block right after the last of
// their pairs, while these are still in cache: pairs are listed by their earlier grain, so when the pairs of
// all grains up to a block's end are done, nothing needs the block's rows as they stand any more. Threads
// work on parts, ranges of whole blocks; pairs between two parts are done before any grain moves.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "dem/lanes.h"
#include "dem/neighbours.h"

namespace interstice::dem {

/// Rows that move on together.
inline constexpr std::size_t kRowsPerBlock = 256;
static_assert(kRowsPerBlock % kLanes == 0);

/// Ranges of blocks of rows.
struct Parts {
  std::size_t rows = 0;
  std::vector<std::size_t> first_block{0};  // and one past the last

  Parts() = default;
  Parts(std::size_t rows_, std::size_t count);

  std::size_t count() const { return first_block.size() - 1; }
  std::size_t blocks() const { return first_block.back(); }
  std::size_t begin_row(std::size_t block) const { return block * kRowsPerBlock; }
  std::size_t end_row(std::size_t block) const { return std::min(rows, (block + 1) * kRowsPerBlock); }
};

/// Groups of kLanes pairs: those shared by two parts (or far from each other in memory) first, then part by
/// part.
struct Sweep {
  Parts parts;
  std::size_t shared_groups = 0;
  std::size_t shared_quick = 0;          // the first shared group of quick pairs
  std::vector<std::size_t> quick;        // by block: the first group of its quick pairs, which come last
  std::vector<std::size_t> first_group;  // of each part
  std::vector<std::size_t> done_before;  // by block: groups before this one must be done before its rows move
  std::vector<std::size_t> front;        // by block: one past the last row that the groups up to there touch
  std::size_t widest = 0;                // rows from a block's begin to its front, at most
};

/// Where each pair goes in a list of groups, and the sweep over them. A group holds pairs of one part only
/// (or shared ones), so some places stay empty, at its end.
struct PairOrder {
  Sweep sweep;
  std::vector<std::uint32_t> place;  // of each pair
  std::size_t places = 0;            // a multiple of kLanes
};

/// Pairs in the order of what a step has to do with them: those that touch, those so near that most contacts
/// to come are among them, those that are only near, those of two sleepers; then the quick ones (rates.h)
/// that touch, are next to it or only near, which fill groups of their own.
struct PairClasses {
  static constexpr std::size_t kTouching = 0, kNext = 1, kNear = 2, kAsleep = 3, kQuick = 4, kCount = 7;

  std::array<std::size_t, kCount> end{};  // one past the last of each class

  std::size_t of(std::size_t k) const {
    std::size_t c = 0;
    while (c + 1 < kCount && k >= end[c]) ++c;
    return c;
  }
  bool is_quick(std::size_t k) const { return k >= end[kAsleep]; }
};

/// Pairs of rows farther apart than `farthest` are shared: they would keep in use all that lies between. With
/// 0 every pair is done before any grain moves.
PairOrder order_pairs(const std::vector<PairRef>& pairs, const PairClasses& classes, const Parts& parts,
                      std::size_t farthest);

}  // namespace interstice::dem
