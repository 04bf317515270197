// The grains as everybody outside the back end sees them: columns in the order of ascending id.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"

namespace interstice::dem {

struct GrainColumns {
  std::vector<std::int64_t> id;
  std::vector<double> x, y, z, radius, mass;   // [m], [kg]
  std::vector<double> vx, vy, vz, wx, wy, wz;  // [m/s], [rad/s]
  std::vector<std::int32_t> material, layer;
};

/// A grain to be added.
struct NewGrain {
  Vec3d position;  // [m]
  double radius = 0;
  Vec3d velocity{0, 0, 0};
  Vec3d spin{0, 0, 0};
  std::uint16_t material = 0;
  std::int32_t layer = 0;
};

}  // namespace interstice::dem
