// What contacts of a group of kLanes remember from step to step, beside their springs (springs.h); the store
// of both is contact_memories.h.
#pragma once

#include <cstdint>

#include "dem/lanes.h"

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

/// What a contact turned into heat in the last step [J].
struct PairHeat {
  double damping = 0, sliding = 0, rolling = 0, adhesion = 0;

  PairHeat& operator+=(const PairHeat& o) {
    damping += o.damping, sliding += o.sliding, rolling += o.rolling, adhesion += o.adhesion;
    return *this;
  }
};

/// A bit a contact of a group.
struct GroupBits {
  std::uint16_t listed = 0;      // the others are empty places, filled with a copy of a listed contact
  std::uint16_t touching = 0;    // after the last step
  std::uint16_t attracting = 0;  // the same

  bool is_listed(std::size_t lane) const { return (listed >> lane & 1) != 0; }
  ContactState state(std::size_t lane) const {
    return (touching >> lane & 1) != 0     ? ContactState::touching
           : (attracting >> lane & 1) != 0 ? ContactState::attracting
                                           : ContactState::apart;
  }
  void list(std::size_t lane) { listed = with(listed, lane); }
  void touch(std::size_t lane) { touching = with(touching, lane); }
  /// Takes over the state of a contact of a former list.
  void inherit(std::size_t lane, const GroupBits& old, std::size_t old_lane) {
    if ((old.touching >> old_lane & 1) != 0) touch(lane);
    if ((old.attracting >> old_lane & 1) != 0) attracting = with(attracting, lane);
  }

 private:
  static std::uint16_t with(std::uint16_t bits, std::size_t lane) {
    return static_cast<std::uint16_t>(bits | 1u << lane);
  }
};
static_assert(kLanes == 16);

}  // namespace interstice::dem
