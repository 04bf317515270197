// A grain as others see it. How the CPU back end keeps it: grain_store.h.
#pragma once

#include <cstdint>

#include "base/vec3.h"

namespace interstice::dem {

/// Where a grain is and how large: what a search for neighbours needs.
struct GrainSite {
  double x, y, z, radius;
  std::int64_t id;

  Vec3d position() const { return {x, y, z}; }
};

/// One grain, whole. Velocities are those at the present time; while a step is worked on, those predicted for
/// its end, in the number type of the forces.
struct GrainRow {
  double x, y, z, radius;
  double vx, vy, vz, mass;
  double wx, wy, wz;
  std::int64_t id;
  std::int32_t layer;
  std::uint16_t material;

  Vec3d position() const { return {x, y, z}; }
  Vec3d velocity() const { return {vx, vy, vz}; }
  Vec3d spin() const { return {wx, wy, wz}; }
};

}  // namespace interstice::dem
