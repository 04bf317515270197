// Steps at two rates (rates.h). A step works on all that acts, and moves slow grains to its end, those that
// take part in beats to the end of the first; the other beats work on what quick grains touch alone.
//
// With h the length of a beat, n beats a step, q and s the accelerations of a grain by what acts in beats and
// in whole steps, the step from t begins with u = v(t) + (q + n s) h/2 and ends with the same half kick. In
// between a grain that nothing quick touches keeps u: it goes n times h u whether it moves beat by beat or at
// once.
#include <algorithm>

#include "dem/end_sums.h"
#include "dem/flatten.h"
#include "dem/simulation.h"
#include "dem/step_loops.h"

namespace interstice::dem {
namespace {

template <class P>
Pull widened(const EndSums<P>& sums) {
  return {simd::converted<double>(sums.force), simd::converted<double>(sums.torque)};
}

/// What a force and gravity do to a group.
Pull accelerations(const GroupMotion& m, const Pull& force, const Vec3<Each>& gravity) {
  return {multiply_add(Each::load(m.inverse_mass), force.linear, gravity),
          Each::load(m.inverse_inertia) * force.angular};
}

/// Gravity acts on quick grains in beats, on the others in whole steps.
Vec3<Each> gravity_on(std::uint32_t lanes, const Vec3d& gravity) {
  return select(Each::M::from_bits(lanes), all_of(gravity), all_of({0, 0, 0}));
}

}  // namespace

StepView Simulation::beat_view(const PairView& pairs) {
  StepView view = step_view(pairs);
  view.dt = beat_;
  return view;
}

/// How much of a reach is kept for the rest of a step, in which lists stay as they are: what the fastest goes
/// in two [m].
double Simulation::reserve() const {
  if (!options_.rates.two()) return 0;
  double fastest = fastest_wall();
  for (std::size_t s = 0; s < grains_.size(); ++s) fastest = std::max(fastest, speed_of(s));
  return 2 * dt_ * fastest;
}

/// From the present lists.
void Simulation::note_quick_slots(const std::vector<GrainSite>& sites) {
  const std::size_t groups = groups_for(sites.size());
  quick_.ends.assign(groups * kLanes, 0);
  quick_.most.assign(groups, 0);
  quick_.quick.assign(groups, 0);
  quick_.beating.assign(groups, 0);
  const auto is_quick = [&](std::size_t slot) { return options_.rates.is_quick(sites[slot].radius); };
  for (std::size_t s = 0; s < sites.size(); ++s) {
    const std::size_t g = s / kLanes;
    const auto lane = static_cast<std::uint16_t>(1u << s % kLanes);
    std::uint32_t& ends = quick_.ends[pair_contacts_.stand(s)];
    if (is_quick(s)) {
      ends = pair_contacts_.end_count(s);
      quick_.quick[g] |= lane;
    } else {
      for (const Adjacent& e : pair_contacts_.of(s)) ends += is_quick(e.slot);
    }
    if (ends > 0 || is_quick(s)) quick_.beating[g] |= lane;
    quick_.most[g] = std::max(quick_.most[g], ends);
  }
}

/// Those of a block that move in beats side by side, quick grains first: whole groups are left out of beats.
void Simulation::put_beating_first(std::vector<std::uint32_t>& order) const {
  std::vector<bool> beat(static_cast<std::size_t>(next_id_), false);
  for (std::size_t s = 0; s < built_ids_.size() && s / kLanes < quick_.beating.size(); ++s)
    beat[built_ids_[s]] = (quick_.beating[s / kLanes] >> s % kLanes & 1) != 0;
  const auto rank = [&](std::uint32_t slot) {
    return options_.rates.is_quick(grains_.site(slot).radius) ? 0 : beat[id_of(slot)] ? 1 : 2;
  };
  for (std::size_t begin = 0; begin < order.size(); begin += kRowsPerBlock) {
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last =
        order.begin() + static_cast<std::ptrdiff_t>(std::min(order.size(), begin + kRowsPerBlock));
    std::stable_sort(first, last, [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
  }
}

void Simulation::evaluate_and_move_rated(bool begin_next) {
  if (!begin_next) grains_.keep_accelerations();
  pair_contacts_.memories().keep_forces(!begin_next);
  wall_contacts_.memories().keep_forces(!begin_next);
  slow_.resize(groups_for(grains_.size()));
  grains_.with_rows([&](auto& rows) { evaluate_and_move_rated(rows.data(), begin_next); });
  grains_.set_stepping(begin_next);
}

template <class Real>
void Simulation::evaluate_and_move_rated(PairRow<Real>* rows, bool begin_next) {
  const StepView view = step_view(pair_contacts_.view()), quick = beat_view(pair_contacts_.view());
  const StepView shared = step_view(pair_contacts_.shared_view()),
                 shared_quick = beat_view(pair_contacts_.shared_view());
  const Sweep& sweep = pair_contacts_.sweep();
  std::vector<PassReport> reports(sweep.parts.blocks());
  for_blocks({sweep.shared_groups, kGroupsPerTask}, [&](std::size_t, std::size_t begin, std::size_t end) {
    const std::size_t border = std::clamp(sweep.shared_quick, begin, end);
    kernels_.pairs(model_.laws, shared, begin, border, {});
    kernels_.pairs(model_.laws, shared_quick, border, end, {});
  });
  for_parts([&](std::size_t b, std::size_t group, bool last) {
    wall_contacts_.ask(b + 1);
    kernels_.pairs(model_.laws, view, group, sweep.quick[b], rows_ahead(rows, b, last));
    kernels_.pairs(model_.laws, quick, sweep.quick[b], sweep.done_before[b], {});
    pair_contacts_.fetch_shared(b);
    kernels_.walls(model_.laws, view, wall_contacts_.first_group(b), wall_contacts_.first_quick(b));
    kernels_.walls(model_.laws, quick, wall_contacts_.first_quick(b), wall_contacts_.first_group(b + 1));
    const std::size_t begin = sweep.parts.begin_row(b), end = sweep.parts.end_row(b);
    reports[b] = begin_next ? move_rows_rated<true>(rows, view, begin, end)
                            : move_rows_rated<false>(rows, view, begin, end);
  });
  if (begin_next) take_report(reports);
}

/// Collects all forces of some grains, completes their velocities, and begins the next step or keeps how they
/// stand.
template <bool kBeginNext, class Real>
INTERSTICE_FLATTEN Simulation::PassReport Simulation::move_rows_rated(PairRow<Real>* rows,
                                                                      const StepView& view, std::size_t begin,
                                                                      std::size_t end) {
  PassReport report;
  const auto* const ends = static_cast<const Real*>(view.pairs.end_forces);
  for (std::size_t g = begin / kLanes; g < groups_for(end); ++g) {
    const GroupEnds own = pair_contacts_.ends_of(g);
    const Pull all = widened(end_sums(ends, own));
    Pull quick{all_of({0, 0, 0}), all_of({0, 0, 0})};
    if (quick_.most[g] > 0) quick = widened(end_sums(ends, own, &quick_.ends[g * kLanes], quick_.most[g]));
    const GroupMotion& m = grains_.motions()[g];
    const Pull q = accelerations(m, quick, gravity_on(quick_.quick[g], model_.gravity)),
               s = accelerations(m, {all.linear - quick.linear, all.angular - quick.angular},
                                 gravity_on(~quick_.quick[g], model_.gravity));
    const Each beats(options_.rates.beats);
    const double half = 0.5 * beat_;
    RatedState now{{}, {}, q.linear, q.angular, s.linear, s.angular};
    now.velocity = half_step(load(m.vx, m.vy, m.vz), multiply_add(beats, s.linear, q.linear), half);
    now.spin = half_step(load(m.wx, m.wy, m.wz), multiply_add(beats, s.angular, q.angular), half);
    if constexpr (kBeginNext) {
      begin_group_rated(rows, g, now, report);
    } else {
      end_group(g, now.velocity, now.spin, q);
      store_accelerations(s, g, grains_.slow_accelerations());
    }
  }
  return report;
}

/// Begins the step of a group: those that take part in beats go one, the others all.
template <class Real>
void Simulation::begin_group_rated(PairRow<Real>* rows, std::size_t group, const RatedState& now,
                                   PassReport& report) {
  const std::size_t first = group * kLanes;
  const std::uint32_t filled = grains_.filled_lanes(group), beating = quick_.beating[group];
  const double half = 0.5 * beat_;
  const Each beats(options_.rates.beats);
  const Vec3<Each> all = multiply_add(beats, now.slow, now.quick),
                   all_angular = multiply_add(beats, now.slow_angular, now.quick_angular);
  const Vec3<Each> u = half_step(now.velocity, all, half), w = half_step(now.spin, all_angular, half);
  GroupMotion& m = grains_.motions()[group];
  store(u, m.vx, m.vy, m.vz);
  store(w, m.wx, m.wy, m.wz);
  store(now.slow, slow_[group].linear[0], slow_[group].linear[1], slow_[group].linear[2]);
  store(now.slow_angular, slow_[group].angular[0], slow_[group].angular[1], slow_[group].angular[2]);

  GroupStep moved = load_sites(rows + first);
  const auto in_beats = Each::M::from_bits(beating);
  const Vec3<Each> step = Each(beat_) * u;
  moved.position = moved.position + step;
  for (int beat = 1; beat < options_.rates.beats && (filled & ~beating) != 0; ++beat)
    moved.position = select(in_beats, moved.position, moved.position + step);
  moved.step = select(in_beats, step, beats * step);
  store_rows(moved, half_step(u, select(in_beats, now.quick, all), half),
             half_step(w, select(in_beats, now.quick_angular, all_angular), half), Each::load(m.inverse_mass),
             rows + first, AllLanes());
  look_at_moved(moved, group, filled, report);
  look_for_leavers(rows, moved, group, filled & ~beating, report);
}

template void Simulation::begin_group_rated(PairRow<float>*, std::size_t, const RatedState&, PassReport&);
template void Simulation::begin_group_rated(PairRow<double>*, std::size_t, const RatedState&, PassReport&);

/// The beats after the first.
void Simulation::finish_beats() {
  const int beats = options_.rates.beats;
  for (int beat = 1; beat < beats; ++beat) {
    place_walls(beat);
    grains_.with_rows([&](auto& rows) { work_on_beat(rows.data(), beat + 1 == beats); });
  }
  remove_leavers();
}

template <class Real>
void Simulation::work_on_beat(PairRow<Real>* rows, bool last) {
  const StepView view = beat_view(pair_contacts_.view()), shared = beat_view(pair_contacts_.shared_view());
  const Sweep& sweep = pair_contacts_.sweep();
  std::vector<PassReport> reports(sweep.parts.blocks());
  for_blocks({sweep.shared_groups - sweep.shared_quick, kGroupsPerTask},
             [&](std::size_t, std::size_t begin, std::size_t end) {
               kernels_.pairs(model_.laws, shared, sweep.shared_quick + begin, sweep.shared_quick + end, {});
             });
  for_parts([&](std::size_t b, std::size_t, bool) {
    kernels_.pairs(model_.laws, view, sweep.quick[b], sweep.done_before[b], {});
    pair_contacts_.fetch_shared(b);
    kernels_.walls(model_.laws, view, wall_contacts_.first_quick(b), wall_contacts_.first_group(b + 1));
    for (std::size_t g = sweep.parts.begin_row(b) / kLanes; g < groups_for(sweep.parts.end_row(b)); ++g)
      if (quick_.beating[g] != 0) beat_group(rows, view, g, last, reports[b]);
  });
  take_report(reports);
}

/// Moves those of a group that take part in beats by one.
template <class Real>
INTERSTICE_FLATTEN void Simulation::beat_group(PairRow<Real>* rows, const StepView& view, std::size_t group,
                                               bool last, PassReport& report) {
  const auto* const ends = static_cast<const Real*>(view.pairs.end_forces);
  const std::size_t first = group * kLanes;
  const std::uint32_t beating = quick_.beating[group];
  const auto in_beats = Each::M::from_bits(beating);
  const Pull force =
      widened(end_sums(ends, pair_contacts_.ends_of(group), &quick_.ends[first], quick_.most[group]));
  GroupMotion& m = grains_.motions()[group];
  const Pull q = accelerations(m, force, gravity_on(quick_.quick[group], model_.gravity));
  const double half = 0.5 * beat_;
  const Vec3<Each> before = load(m.vx, m.vy, m.vz), spin_before = load(m.wx, m.wy, m.wz);
  const Vec3<Each> u = half_step(half_step(before, q.linear, half), q.linear, half),
                   w = half_step(half_step(spin_before, q.angular, half), q.angular, half);
  store(select(in_beats, u, before), m.vx, m.vy, m.vz);
  store(select(in_beats, w, spin_before), m.wx, m.wy, m.wz);

  GroupStep moved = load_sites(rows + first);
  moved.step = select(in_beats, Each(beat_) * u, all_of({0, 0, 0}));
  moved.position = moved.position + moved.step;
  Pull ahead = q;  // that of the half step to come
  if (last) {
    const GroupPull& slow = slow_[group];
    const Each beats(options_.rates.beats);
    ahead.linear = multiply_add(beats, load(slow.linear[0], slow.linear[1], slow.linear[2]), q.linear);
    ahead.angular = multiply_add(beats, load(slow.angular[0], slow.angular[1], slow.angular[2]), q.angular);
  }
  store_rows(moved, half_step(u, ahead.linear, half), half_step(w, ahead.angular, half),
             Each::load(m.inverse_mass), rows + first, SomeLanes{beating});
  look_at_moved(moved, group, beating, report);
  if (last) look_for_leavers(rows, moved, group, beating, report);
}

}  // namespace interstice::dem
