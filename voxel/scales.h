// How a void fraction depends on the length that it is averaged over: mean, spread and extremes over windows
// of growing length, from one voxel to the box.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "voxel/field.h"

namespace interstice::voxel {

inline constexpr std::int64_t kMostScaleCells = std::int64_t{1} << 27;  // of a box that a report is made of

/// One averaging length. Windows (averaging_window.h) are centred on voxels; those count whose centre lies at
/// least half the length away from the box's faces that are not periodic (so that cubes and spheres are
/// wholly inside) and that have at least half of their weight outside walls. Along an axis shorter than the
/// length a cube takes it whole, the others stand in its middle; a periodic axis goes on at the other side.
/// Spheres of more than 16 voxels' diameter stand on every voxel along z, on every eighth of a diameter along
/// x and y.
struct ScaleRow {
  double length = 0;         // [m], an odd number of voxels
  std::int64_t windows = 0;  // that count; neighbours overlap
  double independent = 0;    // how many fit side by side into the box
  double grains = 0;         // in a window, by volume: solid volume / volume-weighted mean grain
  double mean = 0, sd = 0;   // of the void fraction, population standard deviation over windows
  double min = 0, max = 0;   // of the void fraction
  double sd_random = 0;      // of as many grains placed independently: solid fraction / sqrt(grains)
  double sd_one_grain = 0;   // what one grain more or less changes: solid fraction / grains
};

/// Lengths are NaN where no row with at least kIndependent windows side by side has come to it.
struct ScaleReport {
  static constexpr double kIndependent = 8;
  WindowShape window = WindowShape::box;
  std::vector<ScaleRow> rows;  // ascending lengths
  double grain_volume = 0;     // [m^3] volume-weighted mean: sum of squared volumes / sum of volumes
  double median_diameter =
      0;  // [m] D50 by volume: half of the grains' volume is in smaller ones; 0 without grains
  double random_length = std::numeric_limits<double>::quiet_NaN();  // [m] from here on sd <= sd_random
  double many_grains_length =
      std::numeric_limits<double>::quiet_NaN();  // [m] from here on sd >= sd_one_grain
};

/// Throws InputError when the box has more than kMostScaleCells voxels. `spheres` are those that the field
/// was made of.
ScaleReport void_scales(const Field& field, const SpheresView& spheres, const std::array<bool, 3>& periodic,
                        WindowShape window = WindowShape::box);

}  // namespace interstice::voxel
