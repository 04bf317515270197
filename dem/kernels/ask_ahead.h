// What a group of pairs asks for so that later groups need not wait for memory.
#pragma once

#include <algorithm>

#include "dem/ask_for.h"
#include "dem/kernels/kernels.h"
#include "dem/simd/transpose.h"
#include "dem/springs.h"

namespace interstice::dem {

/// Memory to be asked for, a piece a group: much at once would wait for each other. (MemoryAhead::share would
/// do, but divides for every group, which costs up to 3 %.)
class Pieces {
 public:
  Pieces(const MemoryAhead& ahead, std::size_t pieces)
      : line_(ahead.begin),
        end_(ahead.end),
        piece_((static_cast<std::size_t>(end_ - line_) + pieces * kCacheLine - 1) / (pieces * kCacheLine) *
               kCacheLine) {}
  MemoryAhead next() {
    const char* const begin = line_;
    line_ += std::min(piece_, static_cast<std::size_t>(end_ - line_));
    return {begin, line_};
  }

 private:
  const char* line_;
  const char* end_;
  std::size_t piece_;
};

/// Asks for the rows of a later group's pairs. Earlier ones follow each other in memory: where a row takes
/// more than one line they are left out.
template <class Real>
[[gnu::always_inline]] inline void ask_for_rows(const StepView& v, std::size_t group) {
  using Row = PairRow<Real>;
  constexpr std::size_t ahead = 6;  // as far as memory takes
  const PairOffsets* const pairs = v.pairs.rows + std::min(group + ahead, v.pairs.groups - 1) * kLanes;
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const PairOffsets rows = pairs[lane];
    if constexpr (sizeof(Row) <= kCacheLine) {
      ask_for(simd::row_at<Row>(v.rows, rows.a)), ask_for(simd::row_at<Row>(v.rows, rows.b));
    } else {
      ask_for(simd::row_at<Row>(v.rows, std::max(rows.a, rows.b)));
    }
  }
}

/// Asks for what is listed of a later group, and its springs.
template <class Real, class L>
[[gnu::always_inline]] inline void ask_for_lists(const L& laws, const PairView& pairs, std::size_t group) {
  constexpr std::size_t ahead = 8;  // 4 to 32 serve alike
  const std::size_t first = std::min(group + ahead, pairs.groups - 1) * kLanes,
                    spring = spring_index(first, 0);
  ask_for_once(pairs.rows + first, kLanes);
  ask_for_once(pairs.ends + first, kLanes);
  if (laws.tangential == TangentialLaw::mindlin)
    ask_for_once(static_cast<const Real*>(pairs.sliding) + spring, kSpringReals * kLanes);
  if (laws.rolling == RollingLaw::epsd2)
    ask_for_once(static_cast<const Real*>(pairs.rolling) + spring, kSpringReals * kLanes);
}

/// Asks for a piece of memory, and for what a later group needs.
template <class Real, class L>
[[gnu::always_inline]] inline void ask_ahead(const L& laws, const StepView& v, std::size_t group,
                                             const MemoryAhead& piece) {
  ask_for(piece.begin, piece.end);
  if (v.pairs.scattered) ask_for_rows<Real>(v, group);
  if (v.pairs.beyond_caches) ask_for_lists<Real>(laws, v.pairs, group);
}

}  // namespace interstice::dem
