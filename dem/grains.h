// The grains as the CPU back end keeps them: one row of two cache lines a grain, sorted in space. Only the
// back end knows this layout; everybody else copies columns (columns.h).
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"

namespace interstice::dem {

/// Velocities are those at the present time, or during a step those predicted for the step's end.
struct alignas(64) GrainRow {
  double x, y, z, radius;
  double vx, vy, vz, mass;
  double wx, wy, wz;
  double built_x, built_y, built_z;  // where it stood when the neighbour list was built
  std::int64_t id;
  std::uint16_t material;
  std::uint16_t padding = 0;
  std::int32_t layer = 0;

  Vec3d position() const { return {x, y, z}; }
  Vec3d velocity() const { return {vx, vy, vz}; }
  Vec3d spin() const { return {wx, wy, wz}; }
};
static_assert(sizeof(GrainRow) == 128);

/// The accelerations at the last full step, and what turns forces into them.
struct alignas(64) GrainMotion {
  Vec3d acceleration;  // [m/s^2]
  double inverse_mass;
  Vec3d angular;  // [rad/s^2]
  double inverse_inertia;
};

}  // namespace interstice::dem
