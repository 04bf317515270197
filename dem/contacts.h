// Which grains may touch which, and what a contact remembers. Results never depend on the order of these
// lists: a grain's forces are summed over its partners in the order of their ids.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <ranges>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "dem/contact/mindlin.h"
#include "dem/end_places.h"
#include "dem/grains.h"
#include "dem/neighbours.h"
#include "dem/reals.h"
#include "dem/sweep.h"

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
  std::uint32_t slot;  // the partner
  bool second;         // this grain is b
};

/// A bit a pair of a group.
struct GroupBits {
  std::uint16_t listed = 0;      // the others are empty places, filled with a copy of a listed pair
  std::uint16_t touching = 0;    // after the last step
  std::uint16_t attracting = 0;  // the same
};
static_assert(kLanes == 16);

/// Numbers at one end: force [N] and torque [N m], with a zero after each.
inline constexpr std::size_t kEndReals = 8;
/// Numbers of one spring: force [N] and stiffness [N/m].
inline constexpr std::size_t kSpringReals = 4;
/// Where a pair's numbers of its spring, and its force along an axis, lie: by group, number and lane.
constexpr std::size_t spring_index(std::size_t pair, std::size_t n) {
  return (pair / kLanes * kSpringReals + n) * kLanes + pair % kLanes;
}
constexpr std::size_t axis_index(std::size_t pair, std::size_t axis) {
  return (pair / kLanes * 3 + axis) * kLanes + pair % kLanes;
}

/// What the kernels see of the pairs. Springs: by group, number and lane; ends: by end and number; both in
/// the kernels' number type; null where not kept.
struct PairView {
  std::size_t groups;
  const PairRef* pairs;
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
  PairContacts(const KeptMemories& kept, Precision precision);

  /// Takes over a new list, its pairs in the order of their classes; states and springs move with them.
  /// `old_slot[s]` is where the grain now in slot s stood when the present list was made (or kNoSlot); empty:
  /// where it is.
  void replace(const std::vector<PairRef>& found, const PairClasses& classes,
               const std::vector<GrainSite>& sites, const std::vector<std::uint32_t>& old_slot,
               const Parts& parts);

  /// Places of pairs, listed and empty: the range of the indices below.
  std::size_t places() const { return pairs_.size(); }
  std::size_t listed() const { return listed_; }
  const PairRef& pair(std::size_t k) const { return pairs_[k]; }
  ContactState state(std::size_t k) const {
    const std::uint32_t bit = 1u << (k % kLanes);
    const GroupBits& g = bits_[k / kLanes];
    return g.touching & bit     ? ContactState::touching
           : g.attracting & bit ? ContactState::attracting
                                : ContactState::apart;
  }
  bool touching(std::size_t k) const { return state(k) == ContactState::touching; }
  Vec3d force(std::size_t k) const;                       // on a, in the last step [N]
  TangentialSpring<double> sliding(std::size_t k) const;  // zero unless touching
  TangentialSpring<double> rolling(std::size_t k) const;  // the same
  const PairHeat& heat(std::size_t k) const { return heat_[k]; }
  /// Makes a pair touch, with these springs (those that are not kept are left out).
  void set_touching(std::size_t k, const TangentialSpring<double>& sliding,
                    const TangentialSpring<double>& rolling);

  /// The pairs of the grain in `slot`, by ascending id of the partner; none for a grain added since the list
  /// was made.
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
  /// For a step after which forces are asked for; else force() is zero.
  void keep_forces(bool keep);
  /// What the kernels see of pairs shared by parts, and of those inside parts.
  PairView shared_view();
  PairView view();
  /// Where the grains of group g of slots collect.
  const EndRows& end_rows(std::size_t g) const { return ring_.rows[g]; }
  /// How many ends each slot has.
  const std::uint32_t* end_counts() const { return ring_.count.data(); }
  /// Brings forces of shared pairs to where the grains of a block collect them.
  void fetch_shared(std::size_t block);
  std::size_t bytes() const;

  static constexpr std::uint32_t kNoSlot = 0xffffffffu;

 private:
  bool is_listed(std::size_t k) const { return (bits_[k / kLanes].listed >> k % kLanes & 1) != 0; }
  void place_pairs(const std::vector<PairRef>& found, const PairOrder& order);
  std::vector<PairEnds> build_adjacency(const std::vector<GrainSite>& sites);

  KeptMemories kept_;
  Sweep sweep_;
  std::size_t listed_ = 0;
  LargeVector<PairRef> pairs_;
  std::vector<GroupBits> bits_;
  EndRing ring_;
  Reals sliding_, rolling_, forces_;
  Reals ring_forces_, kept_forces_;       // by ring_
  std::vector<std::uint32_t> first_end_;  // of each slot, and one past the last
  std::vector<PairHeat> heat_;
  std::vector<std::uint32_t> pair_of_end_;
};

/// A grain near a wall.
struct WallContact {
  std::uint32_t slot, wall;
  ContactState state = ContactState::apart;
  TangentialSpring<double> sliding, rolling;  // zero unless touching
  Vec3d force{0, 0, 0};                       // on the grain in the last step; zero while apart [N]

  bool touching() const { return state == ContactState::touching; }
};

/// What a contact with a wall did in a step beside its force.
struct WallEffect {
  Vec3d torque{0, 0, 0};  // on the grain [N m]
  double power = 0;       // of the wall's motion [W]; this and the heat only with energies
  PairHeat heat;
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

  /// Entries of the grains in slots before this one.
  std::size_t before(std::size_t slot) const { return first_[std::min(slot, first_.size() - 1)]; }

  std::size_t bytes() const;

  /// Lists the walls nearer than `reach` to each grain; memories move along as in PairContacts::replace.
  void replace(const std::vector<GrainSite>& sites, const std::vector<Shape>& walls, double reach,
               const std::vector<std::uint32_t>& old_slot);

 private:
  std::vector<std::uint32_t> first_{0};
};

}  // namespace interstice::dem
