// Which grains may touch which, and what a contact remembers. Results never depend on the order of these
// lists: a grain's forces are summed over its partners in the order of their ids.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "dem/grains.h"
#include "dem/neighbours.h"

namespace interstice::dem {

/// What a pair did in the last step, kept until its grains have collected it.
struct PairResult {
  Vec3d force;     // on a [N]
  Vec3d torque_a;  // [N m]
  Vec3d torque_b;
};

/// One end of a pair, as a grain sees it.
struct Adjacent {
  std::uint32_t pair;
  std::uint32_t slot : 31;   // the partner
  std::uint32_t second : 1;  // this grain is b
};

class PairContacts {
 public:
  std::vector<PairRef> pairs;
  std::vector<std::uint8_t> touching;  // after the last step
  std::vector<Vec3d> spring;           // tangential displacement [m]; zero unless touching
  std::vector<PairResult> results;     // valid where touching

  /// Takes over a new list; springs of pairs that are touching move with them. `old_slot[s]` is where the
  /// grain now in slot s stood when the present list was made (or kNoSlot).
  void replace(std::vector<PairRef> new_pairs, const std::vector<GrainRow>& rows,
               const std::vector<std::uint32_t>& old_slot);

  /// The pairs of the grain in `slot`, by ascending id of the partner; none for a grain added since the list
  /// was made.
  std::span<const Adjacent> of(std::size_t slot) const {
    if (slot + 1 >= first_.size()) return {};
    return {adjacent_.data() + first_[slot], adjacent_.data() + first_[slot + 1]};
  }

  static constexpr std::uint32_t kNoSlot = 0xffffffffu;

 private:
  void build_adjacency(const std::vector<GrainRow>& rows);

  std::vector<std::uint32_t> first_;  // per slot
  std::vector<Adjacent> adjacent_;
  std::vector<std::int64_t> partner_id_;  // beside adjacent_: survives a change of slots
};

/// A grain near a wall.
struct WallContact {
  std::uint32_t wall;
  std::uint8_t touching;
  Vec3d spring;  // [m]; zero unless touching
  Vec3d force;   // on the grain, valid where touching [N]
};

class WallContacts {
 public:
  std::vector<WallContact> entries;  // by slot, then by wall

  /// The walls near the grain in `slot`; none for a grain added since the list was made.
  std::span<WallContact> of(std::size_t slot) {
    if (slot + 1 >= first_.size()) return {};
    return {entries.data() + first_[slot], entries.data() + first_[slot + 1]};
  }
  std::span<const WallContact> of(std::size_t slot) const {
    if (slot + 1 >= first_.size()) return {};
    return {entries.data() + first_[slot], entries.data() + first_[slot + 1]};
  }

  /// Lists the walls within `skin` of each grain; springs move along as in PairContacts::replace.
  void replace(const std::vector<GrainRow>& rows, const std::vector<Shape>& walls, double skin,
               const std::vector<std::uint32_t>& old_slot);

 private:
  std::vector<std::uint32_t> first_{0};
};

}  // namespace interstice::dem
