// What the passes of a step have in common: loops over blocks and parts, and what is looked at when a group
// of grains has moved. Members of Simulation, for the files that hold its passes.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <bit>

#include "base/parallel.h"
#include "dem/path_left.h"
#include "dem/simulation.h"

namespace interstice::dem {

/// Groups of shared pairs that a thread takes at a time.
inline constexpr std::size_t kGroupsPerTask = 64;
/// How far a grain may go in a step, in squared radii.
inline constexpr double kStepLimit = 0.25;

/// Calls body(block, begin, end) for every block, in the reference one after the other.
template <class Body>
void Simulation::for_blocks(const Blocks& blocks, const Body& body) const {
  if (!options_.reference) return for_each_block(blocks, body);
  for (std::size_t b = 0; b < blocks.count(); ++b) body(b, blocks.begin(b), blocks.end(b));
}

/// Calls work(block, group, last) for the blocks of rows of every part in their order: `group` is the first
/// group of pairs that no block before has done, `last` says whether it is the last of its part.
template <class Work>
void Simulation::for_parts(const Work& work) const {
  const Sweep& sweep = pair_contacts_.sweep();
  const auto work_on = [&](std::size_t part) {
    std::size_t group = sweep.first_group[part];
    const std::size_t end = sweep.parts.first_block[part + 1];
    for (std::size_t b = sweep.parts.first_block[part]; b < end; ++b) {
      work(b, group, b + 1 == end);
      group = sweep.done_before[b];
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
}

/// Rows that the pairs of the block after `block` are the first to touch: they follow each other in memory,
/// but are not touched in that order.
template <class Real>
MemoryAhead Simulation::rows_ahead(const PairRow<Real>* rows, std::size_t block, bool last) const {
  const std::vector<std::size_t>& front = pair_contacts_.sweep().front;
  const auto at = [&](std::size_t row) { return reinterpret_cast<const char*>(rows + row); };
  return {at(front[block]), at(front[last ? block : block + 1])};
}

/// Numbers of a kept acceleration, one after the other.
inline constexpr std::size_t kAccelerationReals = sizeof(GrainAcceleration) / sizeof(double);

/// As lanes what is kept of a group between steps.
inline Pull load_accelerations(const std::vector<GrainAcceleration>& kept, std::size_t group) {
  double columns[kAccelerationReals][kLanes] = {};
  const std::size_t first = group * kLanes, end = std::min(kept.size(), first + kLanes);
  for (std::size_t slot = first; slot < end; ++slot) {
    const GrainAcceleration& a = kept[slot];
    std::size_t column = 0;
    for (const Vec3d* v : {&a.linear, &a.angular})
      for (int axis = 0; axis < 3; ++axis) columns[column++][slot - first] = (*v)[axis];
  }
  const auto at = [&](std::size_t i) { return load(columns[i], columns[i + 1], columns[i + 2]); };
  return {at(0), at(3)};
}
inline void store_accelerations(const Pull& now, std::size_t group, std::vector<GrainAcceleration>& kept) {
  double columns[kAccelerationReals][kLanes];
  std::size_t column = 0;
  for (const Vec3<Each>* v : {&now.linear, &now.angular}) {
    store(*v, columns[column], columns[column + 1], columns[column + 2]);
    column += 3;
  }
  const std::size_t first = group * kLanes, end = std::min(kept.size(), first + kLanes);
  for (std::size_t slot = first; slot < end; ++slot) {
    const auto at = [&](std::size_t i) {
      return Vec3d{columns[i][slot - first], columns[i + 1][slot - first], columns[i + 2][slot - first]};
    };
    kept[slot] = {at(0), at(3)};
  }
}

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

/// Has everyone in these lanes gone a sane way, and within reach of the lists?
inline void Simulation::look_at_moved(const GroupStep& moved, std::size_t group, std::uint32_t lanes,
                                      PassReport& report) {
  const std::size_t first = group * kLanes;
  const Each squared = dot(moved.step, moved.step);
  const std::uint32_t broken =
      lanes & ~(squared <= Each(kStepLimit) * (moved.radius * moved.radius)).bits();  // or no number
  if (broken != 0 && report.broken < 0)
    report.broken = grains_.labels()[first + static_cast<std::size_t>(std::countr_zero(broken))].id;
  const Lengths left = path_left_after(Lengths::load(&path_left_[first]), squared);
  left.store(&path_left_[first]);
  report.strayed |= ((left < Lengths(0)).bits() & lanes) != 0;
}

/// Puts those in these lanes back that crossed a periodic face, and reports those that left.
template <class Real>
inline void Simulation::look_for_leavers(PairRow<Real>* rows, const GroupStep& moved, std::size_t group,
                                         std::uint32_t lanes, PassReport& report) {
  const std::size_t first = group * kLanes;
  const Vec3d &lo = model_.domain.lo, &hi = model_.domain.hi;
  const Vec3<Each>& p = moved.position;
  const auto inside = (p.x >= Each(lo.x)) & (p.x < Each(hi.x)) & (p.y >= Each(lo.y)) & (p.y < Each(hi.y)) &
                      (p.z >= Each(lo.z)) & (p.z < Each(hi.z));
  for (std::uint32_t out = lanes & ~inside.bits(); out != 0; out &= out - 1) {
    const std::size_t slot = first + static_cast<std::size_t>(std::countr_zero(out));
    report.left |= wrap_or_leave(rows[slot], grains_.labels()[slot]);
  }
}

}  // namespace interstice::dem
