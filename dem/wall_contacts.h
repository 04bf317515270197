// Which grains are near which walls, and what their contacts remember. Like pairs, kLanes at a time: a group
// holds contacts of grains of one block of rows (sweep.h), wall by wall, those of quick grains (rates.h) in
// groups of their own, and is worked on right before these move. What a wall does to a grain is collected
// with the ends of the grain's pairs, after them.
#pragma once

#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

#include "base/shapes.h"
#include "dem/contact_memories.h"
#include "dem/grains.h"
#include "dem/rates.h"

namespace interstice::dem {

class PairContacts;

/// A grain near a wall.
struct WallContact {
  std::uint32_t slot = 0, wall = 0;
  ContactState state = ContactState::apart;
  TangentialSpring<double> sliding, rolling;  // zero unless touching
  Vec3d force{0, 0, 0};                       // on the grain, in the last step [N]
  PairHeat heat;                              // this and the power only with energies
  double power = 0;                           // of the wall's motion [W]

  bool touching() const { return state == ContactState::touching; }
};

/// What the kernels see of contacts with walls, by group and lane: springs and forces as in PairView.
struct WallView {
  const std::uint32_t* slots;
  const std::uint32_t* rows;  // where the grains' rows begin, in doubles from the first
  const std::uint32_t* walls;
  const std::uint32_t* ends;  // as EndRing::of_pair
  GroupBits* bits;
  void* sliding;
  void* rolling;
  void* forces;  // on the grains; null unless asked for
  PairHeat* heat;
  double* power;
};

class WallContacts {
 public:
  WallContacts(const KeptMemories& kept, Precision precision, const Rates& rates = {});

  /// Lists the walls nearer than `reach` to each grain, which has a reach of its own as well: the radius in
  /// `reaching`. Memories move along as in PairContacts::replace.
  void replace(const std::vector<GrainSite>& sites, const std::vector<GrainSite>& reaching,
               const std::vector<Shape>& walls, double reach, const std::vector<std::uint32_t>& old_slot);
  /// Has them put their forces where the grains collect them.
  void place_ends(const PairContacts& pairs);

  /// Places of contacts, listed and empty, and what is in them.
  std::size_t places() const { return slots_.size(); }
  std::uint32_t slot(std::size_t k) const { return slots_[k]; }
  std::uint32_t wall(std::size_t k) const { return walls_[k]; }
  WallContact at(std::size_t k) const;
  /// By place; forces are those on the grains.
  ContactMemories& memories() { return memories_; }
  /// The first group of a block's grains; of one past the last block, how many there are.
  std::size_t first_group(std::size_t block) const { return first_group_[block]; }
  /// Of these the first of quick grains, which come last.
  std::size_t first_quick(std::size_t block) const { return first_quick_[block]; }

  /// The places of the grain in `slot`, by wall; none for a grain added since the list was made.
  std::span<const std::uint32_t> places_of(std::size_t slot) const {
    if (slot + 1 >= first_.size()) return {};
    return {place_.data() + first_[slot], place_.data() + first_[slot + 1]};
  }
  /// The walls near that grain.
  auto of(std::size_t slot) const {
    return places_of(slot) | std::views::transform([this](std::uint32_t k) { return at(k); });
  }
  WallView view();
  /// Asks for what is kept of a block's contacts: there are few, far from each other in memory.
  void ask(std::size_t block) const;
  std::size_t bytes() const;

 private:
  /// A contact as it is found.
  struct Found {
    std::uint32_t slot, wall;
  };
  struct FoundInBlock {
    std::vector<Found> slow, quick;
  };
  using FoundByBlock = std::vector<FoundInBlock>;

  void place(const FoundByBlock& found, std::size_t slots);

  Precision precision_;
  ContactMemories memories_;
  Rates rates_;
  std::vector<std::uint32_t> slots_, row_offsets_, walls_, ends_;  // by place
  std::vector<double> power_;
  std::vector<std::uint32_t> first_group_{0};  // by block
  std::vector<std::uint32_t> first_quick_;     // the same
  std::vector<std::uint32_t> first_{0};        // of each slot in place_, and one past the last
  std::vector<std::uint32_t> place_;           // by slot, then by wall
};

}  // namespace interstice::dem
