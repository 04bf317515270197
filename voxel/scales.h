// How a void fraction depends on the length that it is averaged over: mean, spread and extremes over cubes of
// growing edge, from one voxel to the box.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "voxel/field.h"

namespace interstice::voxel {

inline constexpr std::int64_t kMostScaleCells = std::int64_t{1} << 27;  // of a box that a report is made of

/// One averaging length. Cubes are centred on voxels; those count that lie wholly inside the box (an axis
/// shorter than the cube is taken whole, a periodic one goes on at the other side) and have at least half of
/// their volume outside walls.
struct ScaleRow {
  double length = 0;        // [m], an odd number of voxels
  std::int64_t cubes = 0;   // that count; neighbours overlap
  double independent = 0;   // how many fit side by side into the box
  double grains = 0;        // in a cube, by volume: solid volume / volume-weighted mean grain
  double mean = 0, sd = 0;  // of the void fraction, population standard deviation over cubes
  double min = 0, max = 0;  // of the void fraction
  double sd_random = 0;     // of as many grains placed independently: solid fraction / sqrt(grains)
  double sd_one_grain = 0;  // what one grain more or less changes: solid fraction / grains
};

/// Lengths are NaN where no row with at least kIndependent cubes side by side has come to it.
struct ScaleReport {
  static constexpr double kIndependent = 8;
  std::vector<ScaleRow> rows;  // ascending lengths
  double grain_volume = 0;     // [m^3] volume-weighted mean: sum of squared volumes / sum of volumes
  double random_length = std::numeric_limits<double>::quiet_NaN();  // [m] from here on sd <= sd_random
  double many_grains_length =
      std::numeric_limits<double>::quiet_NaN();  // [m] from here on sd >= sd_one_grain
};

/// Throws InputError when the box has more than kMostScaleCells voxels. `spheres` are those that the field
/// was made of.
ScaleReport void_scales(const Field& field, const SpheresView& spheres, const std::array<bool, 3>& periodic);

}  // namespace interstice::voxel
