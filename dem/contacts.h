// Which grains may touch which, and what their contacts remember. Results never depend on the order of these
// lists: a grain's forces are summed over its partners in the order of their ids.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "dem/contact_memories.h"
#include "dem/end_places.h"
#include "dem/grains.h"
#include "dem/neighbours.h"
#include "dem/rates.h"
#include "dem/sweep.h"

namespace interstice::dem {

/// One end of a pair, as a grain sees it.
struct Adjacent {
  std::uint32_t pair;
  std::uint32_t slot;  // the partner
  bool second;         // this grain is b
};

/// Where the rows of a pair's grains begin, in doubles from the first row.
struct PairOffsets {
  std::uint32_t a, b;
};

/// What the kernels see of the pairs. Springs: by group, number and lane; ends: by end and number; both in
/// the kernels' number type; null where not kept.
struct PairView {
  std::size_t groups;
  bool beyond_caches;  // lists and springs are so long that they come from memory every step
  bool scattered;      // rows of pairs come from beyond the second cache
  const PairRef* pairs;
  const PairOffsets* rows;
  const PairEnds* ends;
  GroupBits* bits;
  void* sliding;
  void* rolling;
  void* end_forces;
  void* forces;  // on the first grains, by group, axis and lane; null unless asked for
  PairHeat* heat;
};

class PairContacts {
 public:
  PairContacts(const KeptMemories& kept, Precision precision, const Rates& rates = {});

  /// Takes over a new list, its pairs in the order of their classes; states and springs move with them.
  /// `old_slot[s]` is where the grain now in slot s stood when the present list was made (or kNoSlot); empty:
  /// where it is. `farthest`: as order_pairs takes it. `further_ends`: how many ends each grain has beside
  /// those of its pairs.
  void replace(const std::vector<PairRef>& found, const PairClasses& classes,
               const std::vector<GrainSite>& sites, const std::vector<std::uint32_t>& old_slot,
               const Parts& parts, std::size_t farthest, const std::vector<std::uint32_t>& further_ends);

  /// Places of pairs, listed and empty: the range of the indices below.
  std::size_t places() const { return pairs_.size(); }
  std::size_t listed() const { return listed_; }
  const PairRef& pair(std::size_t k) const { return pairs_[k]; }
  bool touching(std::size_t k) const { return memories_.state(k) == ContactState::touching; }
  /// Of pairs by place; forces are those on a.
  ContactMemories& memories() { return memories_; }
  const ContactMemories& memories() const { return memories_; }

  /// The pairs of the grain in `slot`, quick ones first, each by ascending id of the partner; none for a
  /// grain added since the list was made.
  auto of(std::size_t slot) const {
    const auto known =
        slot + 1 < first_end_.size()
            ? std::span(pair_of_end_).subspan(first_end_[slot], first_end_[slot + 1] - first_end_[slot])
            : std::span<const std::uint32_t>();
    return known | std::views::transform([this, slot](std::uint32_t pair) {
             const bool second = pairs_[pair].b == slot;
             return Adjacent{pair, second ? pairs_[pair].a : pairs_[pair].b, second};
           });
  }
  const Sweep& sweep() const { return sweep_; }
  /// What the kernels see of pairs shared by parts, and of those inside parts.
  PairView shared_view();
  PairView view();
  /// What the grains of group g of slots collect.
  GroupEnds ends_of(std::size_t g) const {
    return {ring_.rows[g], ring_.rank_begin.data() + ring_.rows[g].ranks, &ring_.count[g * kLanes]};
  }
  /// Where a slot's column of ends stands in its group, counted from the first group's first.
  std::size_t stand(std::size_t slot) const { return ring_.stand(slot); }
  /// How many ends a slot has.
  std::uint32_t end_count(std::size_t slot) const { return ring_.count[ring_.stand(slot)]; }
  /// Where the further ends of the grain in `slot` lie, and one that nobody collects, as EndRing::of_pair.
  std::uint32_t further_end(std::size_t slot, std::uint32_t rank) const {
    return end_stride(precision_) *
           ring_.place_of(static_cast<std::uint32_t>(slot), first_end_[slot + 1] - first_end_[slot] + rank);
  }
  std::uint32_t nobodys_end(std::size_t block) const { return end_stride(precision_) * ring_.nobodys[block]; }
  /// Brings forces of shared pairs to where the grains of a block collect them, and asks for those of the
  /// next block: they lie anywhere.
  void fetch_shared(std::size_t block);
  std::size_t bytes() const;

  static constexpr std::uint32_t kNoSlot = 0xffffffffu;

 private:
  void place_pairs(const std::vector<PairRef>& found, const PairOrder& order);
  std::vector<PairEnds> build_adjacency(const std::vector<GrainSite>& sites);

  Precision precision_;
  ContactMemories memories_;
  Rates rates_;
  Sweep sweep_;
  std::size_t listed_ = 0;
  LargeVector<PairRef> pairs_;
  LargeVector<PairOffsets> row_offsets_;  // of pairs_
  EndRing ring_;
  Reals ring_forces_, kept_forces_;       // by ring_
  std::vector<std::uint32_t> first_end_;  // of each slot, and one past the last
  std::vector<std::uint32_t> pair_of_end_;
};

}  // namespace interstice::dem
