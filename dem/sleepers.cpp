#include "dem/sleepers.h"

#include <algorithm>
#include <bit>

namespace interstice::dem {

bool Sleepers::idle(std::size_t begin, std::size_t end, bool looks) const {
  for (std::size_t g = begin / kLanes; g < groups_for(end); ++g)
    if (asleep_[g] != kAll || (looks && watched_[g] != 0)) return false;
  return true;
}

bool Sleepers::all_awake(std::size_t begin, std::size_t end) const {
  for (std::size_t g = begin / kLanes; g < groups_for(end); ++g)
    if (asleep_[g] != 0) return false;
  return true;
}

void Sleepers::survey(std::span<const GrainRest> rests, const PairContacts& pairs, const WallContacts& walls,
                      const std::vector<bool>& wall_moves) {
  asleep_.assign(groups_for(rests.size()), kAll);
  watched_.assign(asleep_.size(), 0);
  woken_.assign(rests.size() / kRowsPerBlock + 1, {});
  stale_ = false;
  for (std::size_t s = 0; s < rests.size(); ++s) {
    if (!rests[s].asleep()) {
      asleep_[s / kLanes] = static_cast<std::uint16_t>(asleep_[s / kLanes] & ~(1u << s % kLanes));
    } else if (rests[s].checks == GrainRest::kJustAsleep || rests[s].push > 0) {
      watch(s);
      stale_ = true;
    }
  }
  for (std::size_t k = 0; k < walls.places(); ++k)
    if (wall_moves[walls.wall(k)] && asleep_at(walls.slot(k))) watch(walls.slot(k));
  watch_partners(rests, pairs);
  all_idle_ = idle(0, rests.size(), true);
  spare_pairs(pairs);
}

/// The partners of those that are awake, or that fell asleep and were not looked at since.
void Sleepers::watch_partners(std::span<const GrainRest> rests, const PairContacts& pairs) {
  std::vector<std::uint8_t> stirs(rests.size()), heard(rests.size(), 0);
  for (std::size_t s = 0; s < rests.size(); ++s) stirs[s] = rests[s].checks != GrainRest::kAsleep;
  for (std::size_t k = 0; k < pairs.places(); ++k) {  // empty places repeat a listed pair
    const PairRef& pair = pairs.pair(k);
    heard[pair.a] |= stirs[pair.b];
    heard[pair.b] |= stirs[pair.a];
  }
  for (std::size_t s = 0; s < rests.size(); ++s)
    if (heard[s] && asleep_at(s)) watch(s);
}

/// Pairs of two sleepers are frozen; those of which neither is watched are not needed.
void Sleepers::spare_pairs(const PairContacts& pairs) {
  const std::size_t groups = pairs.places() / kLanes;
  needed_.assign(groups, 0);
  frozen_.assign(groups, 0);
  for (std::size_t k = 0; k < pairs.places(); ++k) {
    const PairRef& pair = pairs.pair(k);
    const bool both = asleep_at(pair.a) && asleep_at(pair.b);
    frozen_[k / kLanes] = static_cast<std::uint16_t>(frozen_[k / kLanes] | unsigned{both} << k % kLanes);
    std::uint8_t& needed = needed_[k / kLanes];
    if (!both) needed = kByAwake;
    if (watched_at(pair.a) || watched_at(pair.b)) needed = std::max(needed, kByWatched);
  }
}

void Sleepers::spread_waking(const PairContacts& pairs) {
  const auto need_all_of = [&](std::size_t slot, std::uint8_t by) {
    for (const Adjacent& e : pairs.of(slot))
      needed_[e.pair / kLanes] = std::max(needed_[e.pair / kLanes], by);
  };
  for (std::vector<std::uint32_t>& block : woken_) {
    woken_count_ += block.size();
    for (const std::uint32_t slot : block) {
      stale_ = true;
      watched_[slot / kLanes] = static_cast<std::uint16_t>(watched_[slot / kLanes] & ~(1u << slot % kLanes));
      need_all_of(slot, kByAwake);
      for (const Adjacent& e : pairs.of(slot)) {
        std::uint16_t& frozen = frozen_[e.pair / kLanes];
        frozen = static_cast<std::uint16_t>(frozen & ~(1u << e.pair % kLanes));
        if (!asleep_at(e.slot) || watched_at(e.slot)) continue;
        watch(e.slot);
        need_all_of(e.slot, kByWatched);
      }
    }
    block.clear();
  }
}

std::size_t Sleepers::bytes() const {
  return (asleep_.capacity() + watched_.capacity() + frozen_.capacity()) * sizeof(std::uint16_t) +
         needed_.capacity();
}

}  // namespace interstice::dem
