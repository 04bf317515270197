// What a step does with forces: pairs are evaluated by the kernels, then every grain collects what its
// contacts did, completes its velocities and (to spare a pass over memory) begins the next step.
#include "base/parallel.h"
#include "dem/ask_for.h"
#include "dem/end_sums.h"
#include "dem/flatten.h"
#include "dem/simulation.h"
#include "dem/step_loops.h"

namespace interstice::dem {

/// The motion of a group this far ahead is asked for: memory takes longer than one group to move.
inline constexpr std::size_t kGroupsAhead = 4;

/// Begins the step of a group of grains.
template <class Real>
inline void Simulation::begin_group(PairRow<Real>* rows, std::size_t group, const GroupState& now,
                                    PassReport& report) {
  const std::size_t first = group * kLanes;
  const std::uint32_t filled = grains_.filled_lanes(group);
  const GroupStep moved = begin_motion(rows + first, grains_.motions()[group], now, dt_);
  look_at_moved(moved, group, filled, report);
  look_for_leavers(rows, moved, group, filled, report);
  if (options_.energies) {
    const Vec3<Each> step = moved.step;  // a copy: what is handed on by reference has to be in memory
    add_lifting(first, step);
  }
}

/// From present velocities and accelerations.
void Simulation::begin_step() {
  const bool two = options_.rates.two();
  if (two) {
    update_lists();  // who takes part in beats follows from them
    slow_.resize(groups_for(grains_.size()));
  } else {
    path_left_.resize(groups_for(grains_.size()) * kLanes, 0);  // grains may have come since lists were made
  }
  grains_.with_rows([&](auto& rows) {
    const Blocks blocks{grains_.size(), kRowsPerBlock};
    std::vector<PassReport> reports(blocks.count());
    for_blocks(blocks, [&](std::size_t b, std::size_t begin, std::size_t end) {
      for (std::size_t g = begin / kLanes; g < groups_for(end); ++g) {
        const GroupMotion& m = grains_.motions()[g];
        const Vec3<Each> v = load(m.vx, m.vy, m.vz), w = load(m.wx, m.wy, m.wz);
        const Pull a = load_accelerations(grains_.accelerations(), g);
        if (two) {
          const Pull slow = load_accelerations(grains_.slow_accelerations(), g);
          const RatedState now{v, w, a.linear, a.angular, slow.linear, slow.angular};
          begin_group_rated(rows.data(), g, now, reports[b]);
        } else {
          begin_group(rows.data(), g, {v, w, a.linear, a.angular}, reports[b]);
        }
      }
    });
    take_report(reports);
  });
}

StepView Simulation::step_view(const PairView& pairs) {
  return {grains_.row_data(),       grains_.materials().data(),
          search_space().period(),  dt_,
          model_.slider_velocity,   constants_.data(),
          constants_single_.data(), model_.materials.size(),
          only_material_,           pairs,
          wall_contacts_.view(),    walls_.data(),
          wall_velocities_.data(),  model_.walls.data()};
}

void Simulation::evaluate_and_move(bool begin_next) {
  if (!begin_next) grains_.keep_accelerations();
  pair_contacts_.memories().keep_forces(!begin_next || options_.energies);
  wall_contacts_.memories().keep_forces(!begin_next || options_.energies);
  grains_.with_rows([&](auto& rows) {
    if (!rest_) return evaluate_and_move<false>(rows.data(), begin_next);
    looks_ = RestRule::is_look(step_);
    watch_all_ = (looks_ && doubt_) || !begin_next || options_.energies || options_.reference;
    doubt_ = doubt_ && !looks_;
    evaluate_and_move<true>(rows.data(), begin_next);
    sleepers_.spread_waking(pair_contacts_);
  });
  grains_.set_stepping(begin_next);
}

/// Can a step leave out the slots [begin, end), because all there sleep and nothing stirs near them?
bool Simulation::spares(std::size_t begin, std::size_t end) const {
  return !watch_all_ && sleepers_.idle(begin, end, looks_);
}

template <bool kSleep, class Real>
void Simulation::evaluate_and_move(PairRow<Real>* rows, bool begin_next) {
  if (kSleep && !watch_all_ && sleepers_.all_idle()) return take_report({});
  const StepView shared = step_view(pair_contacts_.shared_view()), view = step_view(pair_contacts_.view());
  const Sweep& sweep = pair_contacts_.sweep();
  std::vector<PassReport> reports(sweep.parts.blocks());
  for_blocks({sweep.shared_groups, kGroupsPerTask}, [&](std::size_t, std::size_t begin, std::size_t end) {
    if constexpr (kSleep) return evaluate_needed<Real>(shared, begin, end, {});
    kernels_.pairs(model_.laws, shared, begin, end, {});
  });
  if (options_.energies) count_inserted_contacts();

  for_parts([&](std::size_t b, std::size_t group, bool last) {
    const MemoryAhead ahead = rows_ahead(rows, b, last);
    wall_contacts_.ask(b + 1);
    if constexpr (kSleep) {
      evaluate_needed<Real>(view, group, sweep.done_before[b], ahead);
    } else {
      kernels_.pairs(model_.laws, view, group, sweep.done_before[b], ahead);
    }
    const std::size_t begin = sweep.parts.begin_row(b), end = sweep.parts.end_row(b);
    if (kSleep && spares(begin, end)) return;
    pair_contacts_.fetch_shared(b);
    const std::size_t near = wall_contacts_.first_group(b), near_end = wall_contacts_.first_group(b + 1);
    if constexpr (kSleep) {
      evaluate_needed_walls<Real>(view, near, near_end);
    } else {
      kernels_.walls(model_.laws, view, near, near_end);
    }
    reports[b] = begin_next ? move_rows<kSleep, true>(rows, view, begin, end)
                            : move_rows<kSleep, false>(rows, view, begin, end);
  });
  if (begin_next) take_report(reports);
}

/// Collects the forces of some grains, completes their velocities, and begins the next step or keeps how they
/// stand. (Known when it is compiled: what is kept goes through memory, and would in every step.)
template <bool kSleep, bool kBeginNext, class Real>
INTERSTICE_FLATTEN Simulation::PassReport Simulation::move_rows(PairRow<Real>* rows, const StepView& view,
                                                                std::size_t begin, std::size_t end) {
  PassReport report;
  const auto* const ends = static_cast<const Real*>(view.pairs.end_forces);
  const Vec3<Each> gravity = all_of(model_.gravity);
  for (std::size_t g = begin / kLanes; g < groups_for(end); ++g) {
    if (kSleep && spares(g * kLanes, (g + 1) * kLanes)) continue;
    const auto sums = end_sums(ends, pair_contacts_.ends_of(g));
    const Vec3<Each> force = simd::converted<double>(sums.force),
                     torque = simd::converted<double>(sums.torque);
    if (options_.energies) add_heat(g);
    GroupMotion& m = grains_.motions()[g];
    ask_for(&m + kGroupsAhead);
    GroupState now;
    now.acceleration = multiply_add(Each::load(m.inverse_mass), force, gravity);
    now.angular = Each::load(m.inverse_inertia) * torque;
    now.velocity = half_step(load(m.vx, m.vy, m.vz), now.acceleration, 0.5 * dt_);
    now.spin = half_step(load(m.wx, m.wy, m.wz), now.angular, 0.5 * dt_);
    if constexpr (kSleep) judge_rest(rows, g, torque, now);
    if constexpr (kBeginNext) {
      begin_group(rows, g, now, report);
    } else {
      end_group(g, now.velocity, now.spin, {now.acceleration, now.angular});
    }
  }
  return report;
}

/// Keeps the present velocities and accelerations of a group.
void Simulation::end_group(std::size_t group, const Vec3<Each>& velocity, const Vec3<Each>& spin,
                           const Pull& acceleration) {
  GroupMotion& m = grains_.motions()[group];
  store(velocity, m.vx, m.vy, m.vz);
  store(spin, m.wx, m.wy, m.wz);
  store_accelerations(acceleration, group, grains_.accelerations());
}

}  // namespace interstice::dem
