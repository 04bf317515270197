// One moment of a set of particles, as every reader gives it and every writer takes it: SI units, columns.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/shapes.h"

namespace interstice::io {

/// A wall as it stood at the frame's time.
struct WallPose {
  std::string name;
  Shape shape;
};

/// Columns of equal length (or empty where the source has none; x, y, z and radius are always there).
struct ParticleFrame {
  double time = std::numeric_limits<double>::quiet_NaN();  // [s]; NaN where the source does not say
  std::int64_t step = -1;                                  // -1 where the source does not say
  std::vector<std::int64_t> id;
  std::vector<double> x, y, z;     // [m]
  std::vector<double> radius;      // [m]
  std::vector<double> vx, vy, vz;  // [m/s]
  std::vector<double> wx, wy, wz;  // [rad/s]
  std::vector<double> density;     // [kg/m^3]
  std::vector<std::int32_t> material, layer, bonded;
  std::vector<double> coordination;           // contacts of each grain
  std::array<std::vector<double>, 6> stress;  // xx yy zz xy yz xz, mean over the grain, tension positive [Pa]
  std::optional<Box> bounds;                  // the source's own simulation box
  std::array<bool, 3> periodic{false, false, false};
  std::vector<WallPose> walls;

  std::size_t size() const { return x.size(); }
};

}  // namespace interstice::io
