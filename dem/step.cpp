// What a step does with forces: pairs are evaluated by the kernels, then every grain collects what its
// contacts did, completes its velocities and (to spare a pass over memory) begins the next step.
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "base/parallel.h"
#include "dem/simulation.h"

namespace interstice::dem {
namespace {

constexpr std::size_t kGroupsPerTask = 64;
/// How far a grain may go in a step, in squared radii.
constexpr double kStepLimit = 0.25;

/// Force and torque on a grain; fourth lanes 0.
struct Collected {
  Four force, torque;
};

/// Sums what a grain's ends hold, in their order. Several at a time, of which those that are not its own
/// count nothing: loops as short as these would often be left by surprise.
inline Collected collect(const float* at, std::size_t ends) {
  using Eight = simd::Pack<double, 8>;
  Eight sum(0);
  for (std::size_t e = 0; e < ends; e += kEndsAtOnce) {
    for (std::size_t i = e; i < e + kEndsAtOnce; ++i) {
      const Eight end = simd::converted<double>(simd::Pack<float, 8>::load(at + kEndReals<float> * i));
      sum += select(Eight::M::from_bits(i < ends ? 255 : 0), end, Eight(0));
    }
  }
  return {lower_half(sum), upper_half(sum)};
}
inline Collected collect(const double* at, std::size_t ends) {
  Four force(0), torque(0);
  for (std::size_t e = 0; e < ends; e += kEndsAtOnce) {
    for (std::size_t i = e; i < e + kEndsAtOnce; ++i) {
      const double* end = at + kEndReals<double> * i;
      const auto own = Four::M::from_bits(i < ends ? 7 : 0);  // the fourth is a number of the next triple
      force += select(own, Four::load(end), Four(0));
      torque += select(own, Four::load(end + 3), Four(0));
    }
  }
  return {force, torque};
}

}  // namespace

/// A grain outside the domain: put back through a periodic face; true when it left through an open one.
template <class Real>
bool Simulation::wrap_or_leave(PairRow<Real>& row, GrainLabel& label) const {
  bool left = false;
  for (int axis = 0; axis < 3; ++axis) {
    double& p = axis == 0 ? row.x : axis == 1 ? row.y : row.z;
    const double lo = model_.domain.lo[axis], hi = model_.domain.hi[axis];
    if (p >= lo && p < hi) continue;
    if (model_.boundary[axis] == AxisBoundary::open) {
      left = true;
    } else {
      const double shift = p < lo ? hi - lo : lo - hi;
      p += shift;
      label.built[axis] += shift;
    }
  }
  return left;
}

template <class Real>
inline void Simulation::begin_row(PairRow<Real>& row, std::size_t i, const Four& velocity, const Four& spin,
                                  const Four& acceleration, const Four& angular, double dt,
                                  const Bounds& bounds, PassReport& report) {
  const Four step = begin_motion(row, grains_.motions()[i], velocity, spin, acceleration, angular, dt);
  const Four squared = step * step;
  // Three times too strict, to be sure without a sum.
  if ((squared <= Four(kStepLimit / 3 * (row.radius * row.radius))).bits() != 15) {
    const Vec3d s = three(squared);
    if (!(s.x + s.y + s.z <= kStepLimit * row.radius * row.radius) && report.broken < 0)
      report.broken = grains_.labels()[i].id;
  }
  report.step_squared = max_of(report.step_squared, squared);
  const Four position = Four::load(&row.x);
  if ((((position >= bounds.lo) & (position < bounds.hi)).bits() & 7) != 7)
    report.left |= wrap_or_leave(row, grains_.labels()[i]);
  if (options_.energies) {
    energies_[id_of(i)].gravity += grains_.labels()[i].mass * dot(model_.gravity, three(step));
  }
}

/// Calls body(block, begin, end) for every block, in the reference one after the other.
template <class Body>
void Simulation::for_blocks(const Blocks& blocks, const Body& body) const {
  if (!options_.reference) return for_each_block(blocks, body);
  for (std::size_t b = 0; b < blocks.count(); ++b) body(b, blocks.begin(b), blocks.end(b));
}

/// From present velocities and accelerations.
void Simulation::begin_step() {
  grains_.with_rows([&](auto& rows) {
    const Blocks blocks{grains_.size(), kRowsPerBlock};
    std::vector<PassReport> reports(blocks.count());
    const Bounds bounds{four(model_.domain.lo), four(model_.domain.hi)};
    for_blocks(blocks, [&](std::size_t b, std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const GrainMotion& m = grains_.motions()[i];
        const GrainAcceleration& a = grains_.accelerations()[i];
        begin_row(rows[i], i, four(m.velocity), four(m.spin), four(a.linear), four(a.angular), dt_, bounds,
                  reports[b]);
      }
    });
    take_report(reports);
  });
}

StepView Simulation::step_view(const PairView& pairs) const {
  return {grains_.row_data(),      search_space().period(), dt_,
          model_.slider_velocity,  constants_.data(),       constants_single_.data(),
          model_.materials.size(), only_material_,          pairs,
          walls_.data(),           wall_velocities_.data(), model_.walls.data()};
}

void Simulation::evaluate_and_move(bool begin_next) {
  if (!begin_next) grains_.accelerations().resize(grains_.size());
  pair_contacts_.keep_forces(!begin_next || options_.energies);
  grains_.with_rows([&](auto& rows) { evaluate_and_move(rows.data(), begin_next); });
  grains_.set_stepping(begin_next);
}

template <class Real>
void Simulation::evaluate_and_move(PairRow<Real>* rows, bool begin_next) {
  const StepView shared = step_view(pair_contacts_.shared_view()), view = step_view(pair_contacts_.view());
  const Sweep& sweep = pair_contacts_.sweep();
  std::vector<PassReport> reports(sweep.parts.blocks());
  for_blocks({sweep.shared_groups, kGroupsPerTask}, [&](std::size_t, std::size_t begin, std::size_t end) {
    kernels_.pairs(model_.laws, shared, begin, end);
  });
  if (options_.energies) count_inserted_contacts();

  const auto work_on = [&](std::size_t part) {
    std::size_t group = sweep.first_group[part];
    for (std::size_t b = sweep.parts.first_block[part]; b < sweep.parts.first_block[part + 1]; ++b) {
      kernels_.pairs(model_.laws, view, group, sweep.done_before[b]);
      group = sweep.done_before[b];
      pair_contacts_.fetch_shared(b);
      reports[b] = move_rows(rows, view, sweep.parts.begin_row(b), sweep.parts.end_row(b), begin_next);
    }
  };
  if (options_.reference || sweep.parts.count() == 1) {
    for (std::size_t p = 0; p < sweep.parts.count(); ++p) work_on(p);
  } else {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, sweep.parts.count(), 1),
        [&](const auto& range) {
          for (std::size_t p = range.begin(); p != range.end(); ++p) work_on(p);
        },
        tbb::simple_partitioner());
  }
  if (begin_next) take_report(reports);
}

template <class Real>
void Simulation::add_walls(const StepView& view, const PairRow<Real>& row, std::size_t i,
                           std::span<WallContact> walls, Four& force, Four& torque) {
  const auto d = [](Real value) { return static_cast<double>(value); };
  const WallGrain grain{row.position(),
                        {d(row.vx), d(row.vy), d(row.vz)},
                        {d(row.wx), d(row.wy), d(row.wz)},
                        row.radius,
                        d(row.mass),
                        row.material};
  WallTotals totals;
  kernels_.walls(model_.laws, view, grain, walls, totals);
  force += four(totals.force);
  torque += four(totals.torque);
  if (options_.energies) add_heat(i, totals);
}

/// Collects the forces of some grains, completes their velocities, and begins the next step.
template <class Real>
[[gnu::flatten]] Simulation::PassReport Simulation::move_rows(PairRow<Real>* rows, const StepView& view,
                                                              std::size_t begin, std::size_t end,
                                                              bool begin_next) {
  PassReport report;
  const std::uint32_t *ends = pair_contacts_.first_ends(), *places = pair_contacts_.ring_places();
  const Real* const end_forces = static_cast<const Real*>(view.pairs.end_forces);
  const Four gravity = four(model_.gravity);
  const Bounds bounds{four(model_.domain.lo), four(model_.domain.hi)};
  const double dt = dt_;
  GrainMotion* const motions = grains_.motions().data();
  for (std::size_t i = begin; i < end; ++i) {
    Collected sum = collect(end_forces + kEndReals<Real> * places[i], ends[i + 1] - ends[i]);
    const std::span<WallContact> walls = wall_contacts_.of(i);
    if (!walls.empty() || options_.energies) add_walls(view, rows[i], i, walls, sum.force, sum.torque);
    GrainMotion& m = motions[i];
    const Four acceleration = gravity + Four(m.inverse_mass) * sum.force;
    const Four angular = Four(m.inverse_inertia) * sum.torque;
    const Four velocity = half_step(first_three(Four::load(&m.velocity.x)), acceleration, 0.5 * dt);
    const Four spin = half_step(first_three(Four::load(&m.spin.x)), angular, 0.5 * dt);
    if (begin_next) {
      begin_row(rows[i], i, velocity, spin, acceleration, angular, dt, bounds, report);
    } else {
      put_three(velocity, &m.velocity.x);
      put_three(spin, &m.spin.x);
      grains_.accelerations()[i] = {three(acceleration), three(angular)};
    }
  }
  return report;
}

}  // namespace interstice::dem
