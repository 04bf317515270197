// Who falls asleep, who wakes, and what a step does where grains sleep (sleepers.h).
#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

#include "dem/energy.h"
#include "dem/simulation.h"

namespace interstice::dem {
namespace {

/// Lists are made anew when of so many grains one fell asleep or woke.
constexpr std::size_t kTurnedOfAll = 8;

/// The springs of a group as they were.
template <class Real>
class KeptSprings {
 public:
  /// Either may be null.
  KeptSprings(void* sliding, void* rolling, std::size_t group) {
    void* const both[2] = {sliding, rolling};
    for (std::size_t i = 0; i < 2; ++i) {
      at_[i] = both[i] ? static_cast<Real*>(both[i]) + spring_index(group * kLanes, 0) : nullptr;
      for (std::size_t n = 0; at_[i] && n < kSpringReals; ++n) before_[i][n] = P::load(at_[i] + n * kLanes);
    }
  }
  void put_back(std::uint32_t lanes) const {
    const auto kept = P::M::from_bits(lanes);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t n = 0; at_[i] && n < kSpringReals; ++n)
        select(kept, before_[i][n], P::load(at_[i] + n * kLanes)).store(at_[i] + n * kLanes);
  }

 private:
  using P = simd::Pack<Real, kLanes>;
  Real* at_[2];
  P before_[2][kSpringReals];
};

}  // namespace

std::size_t Simulation::grains_asleep() const {
  const auto& rests = grains_.rests();
  return static_cast<std::size_t>(
      std::count_if(rests.begin(), rests.end(), [](const GrainRest& r) { return r.asleep(); }));
}

void Simulation::wake_all() {
  for (GrainRest& rest : grains_.rests())
    if (rest.asleep()) rest.checks = 0;
  survey_due_ = true;
}

std::vector<bool> Simulation::moving_walls() const {
  std::vector<bool> moves;
  for (const Vec3d& v : wall_velocities_) moves.push_back(dot(v, v) > 0);
  return moves;
}

/// Those of a block that are awake side by side: the others are left out by whole groups.
void Simulation::put_awake_first(std::vector<std::uint32_t>& order) const {
  for (std::size_t begin = 0; begin < order.size(); begin += kRowsPerBlock) {
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last =
        order.begin() + static_cast<std::ptrdiff_t>(std::min(order.size(), begin + kRowsPerBlock));
    std::stable_partition(first, last, [&](std::uint32_t slot) { return !grains_.rests()[slot].asleep(); });
  }
}

/// Between the begin of a step and its forces, with lists that hold.
void Simulation::tend_sleepers() {
  if (RestRule::is_check(step_ - 1)) {
    survey_due_ = survey_due_ || sleepers_.stale();
    turned_ += sleepers_.take_woken();
    fall_asleep();
    if (turned_ > grains_.size() / kTurnedOfAll) {  // now other pairs and other grains go together
      turned_ = 0;
      list_valid_ = false;
      sorted_at_ = -1;
    }
  }
  if (!survey_due_) return;
  sleepers_.survey(grains_.rests(), pair_contacts_, wall_contacts_, moving_walls());
  survey_due_ = false;
}

/// Grains that have stood still for long enough fall asleep when they are calm, unless they lean on a wall
/// that moves.
void Simulation::fall_asleep() {
  const std::vector<bool> moves = moving_walls();
  std::vector<GrainRest>& rests = grains_.rests();
  const auto rested = [&](std::size_t slot) {
    return rests[slot].calm && rests[slot].checks >= rest_->checks(grains_.site(slot).radius);
  };
  const auto undisturbed = [&](std::size_t slot) {
    return std::ranges::none_of(wall_contacts_.of(slot),
                                [&](const WallContact& w) { return w.touching() && moves[w.wall]; });
  };
  std::vector<std::size_t> falling;
  for (std::size_t s = 0; s < rests.size(); ++s)
    if (rested(s) && undisturbed(s)) falling.push_back(s);
  for (const std::size_t s : falling) {
    if (options_.energies) energies_[id_of(s)].stilled += kinetic_energy(grains_.row(s));
    grains_.halt(s);
    rests[s] = {{0, 0, 0}, 0, GrainRest::kJustAsleep, true};
    for (const Adjacent& e : pair_contacts_.of(s))
      if (pair_contacts_.touching(e.pair) && rests[e.slot].asleep())
        rests[e.slot].checks = GrainRest::kJustAsleep;
  }
  survey_due_ = survey_due_ || !falling.empty();
  turned_ += falling.size();
}

/// Frozen pairs keep their springs: evaluated or not, they are the same.
template <class Real>
void Simulation::evaluate_frozen(const StepView& view, std::size_t group) {
  const KeptSprings<Real> springs(view.pairs.sliding, view.pairs.rolling, group);
  kernels_.pairs(model_.laws, view, group, group + 1, {});
  springs.put_back(sleepers_.frozen(group) & view.pairs.bits[group].touching);
}

template <class Real>
void Simulation::evaluate_needed(const StepView& view, std::size_t begin, std::size_t end,
                                 const MemoryAhead& ahead) {
  constexpr std::size_t most = 64;  // groups at once
  for (std::size_t group = begin; group < end;) {
    if (!is_needed(group)) {
      ++group;
    } else if (sleepers_.frozen(group) != 0) {
      evaluate_frozen<Real>(view, group++);
    } else {
      const std::size_t first = group++;
      while (group < std::min(end, first + most) && is_needed(group) && sleepers_.frozen(group) == 0) ++group;
      kernels_.pairs(model_.laws, view, first, group, ahead.share(first - begin, group - begin, end - begin));
    }
  }
}

/// Does a sleeper's contact with a wall at rest keep its springs?
bool Simulation::is_frozen(std::size_t slot, std::size_t wall) const {
  return rest_ && sleepers_.asleep_at(slot) && dot(wall_velocities_[wall], wall_velocities_[wall]) == 0;
}

/// Does nobody ask in this step what walls do to the grain in `slot`?
bool Simulation::is_left_out(std::size_t slot) const {
  return !watch_all_ && sleepers_.asleep_at(slot) && !(looks_ && sleepers_.watched_at(slot));
}

/// Where a group has contacts that are left out or frozen, these stay as they are.
template <class Real>
void Simulation::evaluate_needed_walls(const StepView& view, std::size_t begin, std::size_t end) {
  const WallView& w = view.near_walls;
  for (std::size_t group = begin; group < end; ++group) {
    std::uint32_t left_out = 0, frozen = 0;
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
      const std::uint32_t slot = w.slots[group * kLanes + lane], wall = w.walls[group * kLanes + lane];
      left_out |= static_cast<std::uint32_t>(is_left_out(slot)) << lane;
      frozen |= static_cast<std::uint32_t>(is_frozen(slot, wall)) << lane;
    }
    if (left_out == kAllLanes) continue;
    const GroupBits before = w.bits[group];
    const KeptSprings<Real> springs(w.sliding, w.rolling, group);
    kernels_.walls(model_.laws, view, group, group + 1);
    GroupBits& now = w.bits[group];
    const auto stays = [&](std::uint16_t old, std::uint16_t fresh) {
      return static_cast<std::uint16_t>((old & left_out) | (fresh & ~left_out));
    };
    now.touching = stays(before.touching, now.touching);
    now.attracting = stays(before.attracting, now.attracting);
    springs.put_back(left_out | (frozen & now.touching));
  }
}

/// Wakes those of the watched on which forces have been out of balance for too long, or on which the torque
/// has changed: as rolling friction that goes by the spin vanishes with it, only the change counts.
template <class Real>
void Simulation::wake_disturbed(const PairRow<Real>* rows, std::size_t group, std::uint32_t watched,
                                const Vec3<Each>& torque, const GroupState& now) {
  const std::size_t first = group * kLanes;
  double pushes[kLanes], torques[3][kLanes];
  dot(now.acceleration, now.acceleration).store(pushes);
  store(torque, torques[0], torques[1], torques[2]);
  for (; watched != 0; watched &= watched - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(watched));
    GrainRest& rest = grains_.rests()[first + lane];
    const double radius = rows[first + lane].radius;
    const Vec3d present{torques[0][lane], torques[1][lane], torques[2][lane]};
    if (rest.checks == GrainRest::kJustAsleep) rest.reference = present, rest.checks = GrainRest::kAsleep;
    const Vec3d turning = (grains_.motions()[group].inverse_mass[lane] / radius) * (present - rest.reference);
    const double off = std::max(pushes[lane], dot(turning, turning));
    rest.push = rest_->in_balance(off) ? 0 : rest.push + rest_->pushed_by(std::sqrt(off));
    if (!rest_->is_pushed(rest.push, radius)) continue;
    rest = {};
    sleepers_.wake(first + lane);
  }
}

/// Counts for how many checks in a row grains have stood still, and sees whether they are calm now.
template <class Real>
void Simulation::count_rest(const PairRow<Real>* rows, std::size_t group, const GroupState& now) {
  const auto squares = [](const Vec3<Each>& v) { return dot(v, v); };
  double speeds[kLanes], spins[kLanes], pushes[kLanes], turns[kLanes];
  squares(now.velocity).store(speeds), squares(now.spin).store(spins);
  squares(now.acceleration).store(pushes), squares(now.angular).store(turns);
  std::uint32_t awake = grains_.filled_lanes(group) & ~sleepers_.asleep(group);
  for (; awake != 0; awake &= awake - 1) {
    const auto lane = static_cast<std::size_t>(std::countr_zero(awake));
    const PairRow<Real>& row = rows[group * kLanes + lane];
    GrainRest& rest = grains_.rests()[group * kLanes + lane];
    const double squared = row.radius * row.radius;
    const Vec3d gone = row.position() - rest.reference;
    if (rest.checks == 0 || !RestRule::stands(dot(gone, gone), row.radius)) {
      rest = {row.position(), 0, 1, false};
    } else {
      rest.checks = std::min(rest.checks, 1 << 30) + 1;
    }
    rest.calm = rest_->is_slow(speeds[lane] + squared * spins[lane], row.radius) &&
                rest_->is_calm(pushes[lane] + 0.16 * squared * turns[lane]);
  }
}

/// Judges a group of grains by the forces of the present step; sleepers get no motion.
template <class Real>
void Simulation::judge_rest(const PairRow<Real>* rows, std::size_t group, const Vec3<Each>& torque,
                            GroupState& now) {
  const std::uint32_t watched = !looks_      ? 0
                                : watch_all_ ? sleepers_.asleep(group) & grains_.filled_lanes(group)
                                             : sleepers_.watched(group);
  if (watched != 0) wake_disturbed(rows, group, watched, torque, now);
  if (sleepers_.asleep(group) != 0) {
    const auto asleep = Each::M::from_bits(sleepers_.asleep(group));
    const Vec3<Each> none = all_of({0, 0, 0});
    for (Vec3<Each>* v : {&now.velocity, &now.spin, &now.acceleration, &now.angular})
      *v = select(asleep, none, *v);
  }
  if (RestRule::is_check(step_)) count_rest(rows, group, now);
}

template void Simulation::evaluate_needed<float>(const StepView&, std::size_t, std::size_t,
                                                 const MemoryAhead&);
template void Simulation::evaluate_needed<double>(const StepView&, std::size_t, std::size_t,
                                                  const MemoryAhead&);
template void Simulation::evaluate_needed_walls<float>(const StepView&, std::size_t, std::size_t);
template void Simulation::evaluate_needed_walls<double>(const StepView&, std::size_t, std::size_t);
template void Simulation::judge_rest(const PairRow<float>*, std::size_t, const Vec3<Each>&, GroupState&);
template void Simulation::judge_rest(const PairRow<double>*, std::size_t, const Vec3<Each>&, GroupState&);

}  // namespace interstice::dem
