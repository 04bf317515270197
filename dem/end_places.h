// Where pairs put their forces for grains to collect: one place for each end of a pair. Grains collect kLanes
// at a time: first the first ends of a group of grains lie side by side, then the second ones, and so on, a
// grain's by ascending id of the partner, and after them what walls do to it. Those with most ends stand
// first, so that the ends of a rank lie side by side without gaps.
//
// As a sweep goes on, a grain's ends are written from when the first of its partners is worked on until it
// collects them. Only so many are in use at a time; in a ring they take the same small piece of memory step
// after step, which stays in cache.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem/reals.h"
#include "dem/simd/transpose.h"
#include "dem/sweep.h"

namespace interstice::dem {

/// Of the two ends of a pair.
struct PairEnds {
  std::uint32_t a, b;
};

/// Numbers at one end: force [N] and torque [N m], with a zero after each.
inline constexpr std::size_t kEndReals = 8;
/// In doubles, from one end to the next.
constexpr std::uint32_t end_stride(Precision precision) {
  return static_cast<std::uint32_t>(kEndReals * real_bytes(precision) / sizeof(double));
}

/// Sums of ends become lanes with the fewest instructions in an order of its own (simd/transpose.h): the
/// column into which the sum at a place of the group turns, and the reverse.
constexpr std::uint32_t place_of_column(std::uint32_t column) {
  return static_cast<std::uint32_t>(simd::place_of_row(static_cast<int>(column)));
}
constexpr std::uint32_t column_of_place(std::uint32_t place) {
  std::uint32_t column = 0;
  while (place_of_column(column) != place) ++column;
  return column;
}

/// The places of a group of grains: from `first` on, rank by rank.
struct EndRows {
  std::uint32_t first = 0, ranks = 0;            // of the ring's rank_begin
  std::array<std::uint8_t, kLanes> column_of{};  // each lane
};

/// What a group collects: its places, and by place how many ends there are.
struct GroupEnds {
  const EndRows& rows;
  const std::uint32_t* rank_begin;
  const std::uint32_t* count;
};

/// An end of a pair shared by two parts, evaluated before any grain moves: kept apart, and brought into the
/// ring when its grain collects.
struct SharedEnd {
  std::uint32_t place, kept;
};

struct EndRing {
  std::vector<EndRows> rows;              // of each group of slots
  std::vector<std::uint32_t> count;       // by group and place: ends of a grain, most first
  std::vector<std::uint32_t> rank_begin;  // of each rank of each group, from the group's first place on
  // Where pairs put their forces, in doubles from the ring's begin, or for pairs shared by parts from that of
  // what is kept apart.
  LargeVector<PairEnds> of_pair;
  std::size_t places = 0;               // in all
  std::vector<std::uint32_t> nobodys;   // by block of rows: for empty places of lists; nobody reads it
  std::vector<SharedEnd> shared;        // by block of rows
  std::vector<std::uint32_t> of_block;  // the first of each block's, and one past the last
  std::size_t kept = 0;                 // places for shared pairs

  /// Where a slot stands in its group.
  std::size_t stand(std::size_t slot) const {
    return slot / kLanes * kLanes + place_of_column(rows[slot / kLanes].column_of[slot % kLanes]);
  }
  /// The place of a slot's end number `rank`.
  std::uint32_t place_of(std::uint32_t slot, std::uint32_t rank) const {
    const EndRows& own = rows[slot / kLanes];
    return own.first + rank_begin[own.ranks + rank] + place_of_column(own.column_of[slot % kLanes]);
  }
};

/// `first_end`: number of ends of pairs of all slots before each, and one past the last; `ends`: the number
/// of each pair's ends among them, both equal in empty places of the list; `further`: how many ends each slot
/// has beside.
EndRing make_ring(const Sweep& sweep, const LargeVector<PairRef>& pairs,
                  const std::vector<std::uint32_t>& first_end, const std::vector<PairEnds>& ends,
                  const std::vector<std::uint32_t>& further, Precision precision);

}  // namespace interstice::dem
