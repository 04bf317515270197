// Which grains may touch which, and what a contact remembers. Results never depend on the order of these
// lists: a grain's forces are summed over its partners in the order of their ids.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "dem/contact/mindlin.h"
#include "dem/grains.h"
#include "dem/neighbours.h"

namespace interstice::dem {

enum class ContactState : std::uint8_t {
  apart,
  attracting,  // a force across a gap (van der Waals)
  touching,    // in contact; with JKR until the neck tears
};

/// Which memories the laws keep: what they do not keep takes no space.
struct KeptMemories {
  bool sliding = false, rolling = false, heat = false;
};

/// What a pair did in the last step, kept until its grains have collected it.
struct PairResult {
  Vec3d force;     // on a [N]
  Vec3d torque_a;  // [N m]
  Vec3d torque_b;
};

/// What a pair turned into heat in the last step [J].
struct PairHeat {
  double damping = 0, sliding = 0, rolling = 0, adhesion = 0;

  PairHeat& operator+=(const PairHeat& o) {
    damping += o.damping, sliding += o.sliding, rolling += o.rolling, adhesion += o.adhesion;
    return *this;
  }
};

/// One end of a pair, as a grain sees it.
struct Adjacent {
  std::uint32_t pair;
  std::uint32_t slot : 31;   // the partner
  std::uint32_t second : 1;  // this grain is b
};

class PairContacts {
 public:
  explicit PairContacts(const KeptMemories& kept) : kept_(kept) {}

  std::vector<PairRef> pairs;
  std::vector<ContactState> state;                // after the last step
  std::vector<TangentialSpring<double>> sliding;  // zero unless touching; empty unless kept
  std::vector<TangentialSpring<double>> rolling;  // the same
  std::vector<PairResult> results;                // valid unless apart
  std::vector<PairHeat> heat;                     // empty unless kept

  bool touching(std::size_t k) const { return state[k] == ContactState::touching; }

  /// Takes over a new list; states and springs move with their pairs. `old_slot[s]` is where the
  /// grain now in slot s stood when the present list was made (or kNoSlot).
  void replace(std::vector<PairRef> new_pairs, const std::vector<GrainRow>& rows,
               const std::vector<std::uint32_t>& old_slot);

  /// The pairs of the grain in `slot`, by ascending id of the partner; none for a grain added since the list
  /// was made.
  std::span<const Adjacent> of(std::size_t slot) const {
    if (slot + 1 >= first_.size()) return {};
    return {adjacent_.data() + first_[slot], adjacent_.data() + first_[slot + 1]};
  }

  std::size_t bytes() const;

  static constexpr std::uint32_t kNoSlot = 0xffffffffu;

 private:
  void build_adjacency(const std::vector<GrainRow>& rows);

  KeptMemories kept_;
  std::vector<std::uint32_t> first_;  // per slot
  std::vector<Adjacent> adjacent_;
  std::vector<std::int64_t> partner_id_;  // beside adjacent_: survives a change of slots
};

/// A grain near a wall.
struct WallContact {
  std::uint32_t wall;
  ContactState state = ContactState::apart;
  TangentialSpring<double> sliding, rolling;  // zero unless touching
  Vec3d force;                                // on the grain, valid unless apart [N]

  bool touching() const { return state == ContactState::touching; }
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

  std::size_t bytes() const;

  /// Lists the walls nearer than `reach` to each grain; memories move along as in PairContacts::replace.
  void replace(const std::vector<GrainRow>& rows, const std::vector<Shape>& walls, double reach,
               const std::vector<std::uint32_t>& old_slot);

 private:
  std::vector<std::uint32_t> first_{0};
};

}  // namespace interstice::dem
