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

/// How long a grain has been at rest, or that it sleeps (sleepers.h).
struct GrainRest {
  /// Awake: where it stood at the first of the checks [m]; asleep: the torque on it since it and its
  /// neighbours fell asleep [N m].
  Vec3d reference{0, 0, 0};
  double push = 0;          // asleep: the speed that it would have picked up since it left balance [m/s]
  std::int32_t checks = 0;  // in a row that found it standing still
  bool calm = false;        // at the last check: slow and in balance

  /// Of a sleeper: since a step at which it was looked at, or not looked at yet.
  static constexpr std::int32_t kAsleep = -1, kJustAsleep = -2;
  bool asleep() const { return checks < 0; }
};

}  // namespace interstice::dem
