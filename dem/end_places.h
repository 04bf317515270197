// Where pairs put their forces for grains to collect: one place for each end of a pair. Grains collect kLanes
// at a time: first the first ends of a group of grains lie side by side, then the second ones, and so on, a
// grain's by ascending id of the partner, and after them what walls do to it. A grain with fewer ends than
// others of its group leaves places empty; one with many more has the rest of its ends in a row behind.
//
// As a sweep goes on, a grain's ends are written from when the first of its partners is worked on until it
// collects them. Only so many are in use at a time; in a ring they take the same small piece of memory step
// after step, which stays in cache.
#pragma once

#include <cstdint>
#include <vector>

#include "base/large_pages.h"
#include "dem/simd/transpose.h"
#include "dem/sweep.h"

namespace interstice::dem {

/// Where the two ends of a pair put their forces.
struct PairEnds {
  std::uint32_t a, b;
};

/// Of the places of a rank, that of a lane, and the reverse: an order in which sums of ends become lanes with
/// the fewest instructions (simd/transpose.h).
constexpr std::uint32_t place_of_lane(std::uint32_t lane) {
  return static_cast<std::uint32_t>(simd::place_of_row(static_cast<int>(lane)));
}
constexpr int lane_at(int place) {
  int lane = 0;
  while (simd::place_of_row(lane) != place) ++lane;
  return lane;
}

/// The places of a group of grains: `ranks` times kLanes from `first` on, and behind these, grain after
/// grain, the ends beyond, so many in all. Every grain has an end of the first `full` ranks.
struct EndRows {
  std::uint32_t first = 0, full = 0, ranks = 0, beyond = 0;

  std::uint32_t rest() const { return first + ranks * static_cast<std::uint32_t>(kLanes); }
};

/// An end of a pair shared by two parts, evaluated before any grain moves: kept apart, and brought into the
/// ring when its grain collects.
struct SharedEnd {
  std::uint32_t place, kept;
};

struct EndRing {
  std::vector<EndRows> rows;            // of each group of slots
  std::vector<std::uint32_t> count;     // ends of each slot, up to whole groups
  LargeVector<PairEnds> of_pair;        // of pairs shared by parts: their places in what is kept apart
  std::size_t places = 0;               // in all
  std::vector<std::uint32_t> nobodys;   // by block of rows: for empty places of lists; nobody reads it
  std::vector<SharedEnd> shared;        // by block of rows
  std::vector<std::uint32_t> of_block;  // the first of each block's, and one past the last
  std::size_t kept = 0;                 // places for shared pairs

  /// The place of a slot's end number `rank`.
  std::uint32_t place_of(std::uint32_t slot, std::uint32_t rank) const;
};

/// `first_end`: number of ends of pairs of all slots before each, and one past the last; `ends`: the number
/// of each pair's ends among them, both equal in empty places of the list; `further`: how many ends each slot
/// has beside.
EndRing make_ring(const Sweep& sweep, const LargeVector<PairRef>& pairs,
                  const std::vector<std::uint32_t>& first_end, const std::vector<PairEnds>& ends,
                  const std::vector<std::uint32_t>& further);

}  // namespace interstice::dem
