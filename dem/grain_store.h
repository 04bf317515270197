// The grains as the CPU back end keeps them, sorted in space. What the pair loop reads of a grain lies in one
// row (a cache line in mixed precision), 32 bytes loaded at once (simd/transpose.h); what only the grain's
// own motion needs lies beside it, and what a step does not need at all lies apart.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "base/large_pages.h"
#include "dem/grains.h"
#include "dem/lanes.h"
#include "dem/reals.h"

namespace interstice::dem {

/// What pairs read, in the number type of the forces; velocities as predicted for the step's end.
template <class Real>
struct alignas(16 * sizeof(Real) > 64 ? 32 : 64) PairRow {
  double x, y, z, exact_radius;  // [m]
  Real vx, vy, vz, inverse_mass;
  Real wx, wy, wz, radius;

  Vec3d position() const { return {x, y, z}; }
};
static_assert(sizeof(PairRow<float>) == 64 && sizeof(PairRow<double>) == 96);

/// In doubles, from one row to the next.
constexpr std::uint32_t row_stride(Precision precision) {
  return (precision == Precision::mixed ? sizeof(PairRow<float>) : sizeof(PairRow<double>)) / sizeof(double);
}

/// Between steps the present velocities; while steps follow each other, those half a step back.
struct GrainMotion {
  Vec3d velocity;  // [m/s]
  double inverse_mass;
  Vec3d spin;  // [rad/s]
  double inverse_inertia;
};

/// Motion of a group of grains, number by number.
struct alignas(64) GroupMotion {
  double vx[kLanes], vy[kLanes], vz[kLanes], inverse_mass[kLanes];
  double wx[kLanes], wy[kLanes], wz[kLanes], inverse_inertia[kLanes];

  GrainMotion at(std::size_t lane) const {
    return {{vx[lane], vy[lane], vz[lane]},
            inverse_mass[lane],
            {wx[lane], wy[lane], wz[lane]},
            inverse_inertia[lane]};
  }
  void set(std::size_t lane, const GrainMotion& m) {
    vx[lane] = m.velocity.x, vy[lane] = m.velocity.y, vz[lane] = m.velocity.z;
    wx[lane] = m.spin.x, wy[lane] = m.spin.y, wz[lane] = m.spin.z;
    inverse_mass[lane] = m.inverse_mass, inverse_inertia[lane] = m.inverse_inertia;
  }
};

/// At the present time, kept between steps only.
struct GrainAcceleration {
  Vec3d linear, angular;  // [m/s^2], [rad/s^2]
};

struct GrainLabel {
  Vec3d built;  // where the grain stood when the neighbour list was built
  double mass;  // [kg]
  std::uint32_t id;
  std::int32_t layer;
};

class GrainStore {
 public:
  /// `rests`: does it keep how long grains have been at rest? `two_rates`: what accelerates grains in whole
  /// steps apart from what does in beats (rates.h)?
  GrainStore(Precision precision, bool rests, bool two_rates)
      : single_(precision == Precision::mixed), keeps_rests_(rests), two_rates_(two_rates) {}

  std::size_t size() const { return labels_.size(); }
  void clear();
  void add(const GrainRow& grain, const GrainAcceleration& acceleration,
           const GrainAcceleration& slow_acceleration = {{0, 0, 0}, {0, 0, 0}});
  /// Slot s gets what stood in slot order[s]; slots that are not named are dropped.
  void take(std::span<const std::uint32_t> order);

  /// Calls body(rows) with the rows in their number type: of whole groups, the last of them filled with rows
  /// of zeros.
  template <class Body>
  auto with_rows(const Body& body) {
    return single_ ? body(singles_) : body(doubles_);
  }
  template <class Body>
  auto with_rows(const Body& body) const {
    return single_ ? body(singles_) : body(doubles_);
  }
  const void* row_data() const {
    return single_ ? static_cast<const void*>(singles_.data()) : doubles_.data();
  }
  /// Which lanes of a group hold grains.
  std::uint32_t filled_lanes(std::size_t group) const {
    const std::size_t grains = std::min(size() - group * kLanes, kLanes);
    return (1u << grains) - 1;
  }
  /// By group of slots.
  LargeVector<GroupMotion>& motions() { return motions_; }
  std::vector<GrainLabel>& labels() { return labels_; }
  const std::vector<GrainLabel>& labels() const { return labels_; }
  const std::vector<std::uint16_t>& materials() const { return materials_; }
  /// With two rates those of beats.
  std::vector<GrainAcceleration>& accelerations() { return accelerations_; }
  const std::vector<GrainAcceleration>& accelerations() const { return accelerations_; }
  /// With two rates those of whole steps, otherwise none.
  std::vector<GrainAcceleration>& slow_accelerations() { return slow_accelerations_; }
  const std::vector<GrainAcceleration>& slow_accelerations() const { return slow_accelerations_; }
  /// Makes room for the accelerations of all grains.
  void keep_accelerations();

  /// By slot; none unless kept.
  std::vector<GrainRest>& rests() { return rests_; }
  const std::vector<GrainRest>& rests() const { return rests_; }
  /// Takes the motion of a grain away.
  void halt(std::size_t slot);

  /// While steps follow each other velocities are those of the pair rows.
  void set_stepping(bool stepping);

  GrainRow row(std::size_t slot) const;
  GrainSite site(std::size_t slot) const;
  std::vector<GrainSite> sites() const;
  std::size_t bytes() const;

 private:
  bool single_, keeps_rests_, two_rates_;
  bool stepping_ = false;
  LargeVector<PairRow<float>> singles_;
  LargeVector<PairRow<double>> doubles_;
  LargeVector<GroupMotion> motions_;
  std::vector<GrainLabel> labels_;
  std::vector<std::uint16_t> materials_;
  std::vector<GrainAcceleration> accelerations_, slow_accelerations_;  // empty while steps follow each other
  std::vector<GrainRest> rests_;
};

}  // namespace interstice::dem
