// Grains at rest may sleep: they stand still, with the springs of their contacts as they are, until the
// forces on them leave balance. What lies between sleepers then is the same step after step and need not be
// worked on.
//
// A grain is *asleep* by its own history alone (GrainRest). A sleeper is *watched* while anything that may
// act on it can change; the others are left out of steps, with the pairs between them. Whom to watch follows
// from the lists; watching more changes no bits, only speed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "dem/contacts.h"
#include "dem/grains.h"
#include "dem/lanes.h"
#include "dem/wall_contacts.h"

namespace interstice::dem {

/// When a grain counts as at rest, and how far from balance a sleeper may be. Squares of lengths and the like
/// are compared, so that the same rounding decides everywhere.
class RestRule {
 public:
  /// `tolerance`: the share of its weight by which forces on a sleeper may be out of balance.
  RestRule(double tolerance, double gravity, double dt)
      : balance_(tolerance * gravity), gravity_(gravity), dt_(dt) {}

  static constexpr double kLargestTolerance = 0.1;
  /// Rest is looked for at every so many steps.
  static constexpr std::int64_t kStepsPerCheck = 64;
  static bool is_check(std::int64_t step) { return step % kStepsPerCheck == 0; }
  /// Sleepers are looked at every so many steps: a push needs more to pass through a grain.
  static constexpr std::int64_t kStepsPerLook = 8;
  static bool is_look(std::int64_t step) { return step % kStepsPerLook == 0; }

  /// Is a sleeper with this squared acceleration in balance [m^2/s^4]?
  bool in_balance(double squared) const { return squared <= balance_ * balance_; }
  /// Is a grain awake well inside that?
  bool is_calm(double squared) const { return in_balance(squared / (kCalm * kCalm)); }
  /// By the squared speed of its surface [m^2/s^2].
  bool is_slow(double squared, double radius) const {
    return squared <= square(kSlow) * 2 * radius * gravity_;
  }
  /// Does a sleeper wake that would have picked up this speed [m/s]?
  bool is_pushed(double speed, double radius) const {
    return !(speed <= kPush * std::sqrt(2 * radius * gravity_));
  }
  /// What this acceleration adds to it until the next look [m/s].
  double pushed_by(double acceleration) const {
    return acceleration * static_cast<double>(kStepsPerLook) * dt_;
  }
  /// Does a grain that went this far, squared, stand still [m^2]?
  static bool stands(double squared, double radius) { return squared <= square(kDrift * 2 * radius); }
  /// Checks in a row for which a grain must stand still: as long as it takes to fall by its diameter, or so.
  std::int32_t checks(double radius) const {
    const double enough = std::sqrt(2 * radius / gravity_) / (static_cast<double>(kStepsPerCheck) * dt_);
    return static_cast<std::int32_t>(std::clamp(std::ceil(enough), kFewestChecks, 1e9));
  }

 private:
  static constexpr double kCalm = 0.25, kDrift = 1e-3, kSlow = 1e-3, kPush = 3e-2, kFewestChecks = 8;
  static constexpr double square(double x) { return x * x; }

  double balance_, gravity_, dt_;  // [m/s^2], [m/s^2], [s]
};

/// Who sleeps and who is watched, by slots; which groups of pairs a step can spare. As of the last survey and
/// of those woken since.
class Sleepers {
 public:
  /// Anew from grains, lists, and which walls move.
  void survey(std::span<const GrainRest> rests, const PairContacts& pairs, const WallContacts& walls,
              const std::vector<bool>& wall_moves);
  /// Grains woke since the last call: those that touch them are watched from now on.
  void spread_waking(const PairContacts& pairs);
  /// While grains of several blocks move at once, each by one thread.
  void wake(std::size_t slot) {
    asleep_[slot / kLanes] = static_cast<std::uint16_t>(asleep_[slot / kLanes] & ~(1u << slot % kLanes));
    woken_[slot / kRowsPerBlock].push_back(static_cast<std::uint32_t>(slot));
  }

  /// By group of slots, a bit a lane. Lanes without a grain count as asleep.
  std::uint32_t asleep(std::size_t group) const { return asleep_[group]; }
  std::uint32_t watched(std::size_t group) const { return watched_[group]; }
  /// Is there nobody awake in the slots [begin, end), nor, where it counts, watched?
  bool idle(std::size_t begin, std::size_t end, bool looks) const;
  bool all_awake(std::size_t begin, std::size_t end) const;
  bool all_idle() const { return all_idle_; }  // since the last survey nobody can have woken
  bool asleep_at(std::size_t slot) const { return (asleep_[slot / kLanes] >> slot % kLanes & 1) != 0; }
  bool watched_at(std::size_t slot) const { return (watched_[slot / kLanes] >> slot % kLanes & 1) != 0; }
  /// Would a survey find less to watch?
  bool stale() const { return stale_; }
  /// How many woke since the last call.
  std::size_t take_woken() { return std::exchange(woken_count_, 0); }

  /// By group of pairs: has any an end awake (or watched, where it counts), and which join two sleepers?
  bool needed(std::size_t group, bool looks) const {
    return needed_[group] >= (looks ? kByWatched : kByAwake);
  }
  std::uint32_t frozen(std::size_t group) const { return frozen_[group]; }

  std::size_t bytes() const;

 private:
  static constexpr std::uint16_t kAll = 0xffff;
  static constexpr std::uint8_t kByWatched = 1, kByAwake = 2;
  static_assert(kLanes == 16);

  void watch(std::size_t slot) {
    watched_[slot / kLanes] = static_cast<std::uint16_t>(watched_[slot / kLanes] | 1u << slot % kLanes);
  }
  void watch_partners(std::span<const GrainRest> rests, const PairContacts& pairs);
  void spare_pairs(const PairContacts& pairs);

  std::vector<std::uint16_t> asleep_, watched_;    // by group of slots
  std::vector<std::uint16_t> frozen_;              // by group of pairs
  std::vector<std::uint8_t> needed_;               // the same
  std::vector<std::vector<std::uint32_t>> woken_;  // by block of rows
  std::size_t woken_count_ = 0;
  bool stale_ = false, all_idle_ = false;
};

}  // namespace interstice::dem
