// In which numbers the shares of cells are worked out.
#pragma once

namespace interstice::voxel {

/// `mixed`: places are brought to the lattice in double, and the shares that a sphere of at most
/// kSingleReach cells' radius has in cells are then worked out in single; sums stay in double.
enum class Precision { real64, mixed };

/// Largest R/h at which single is used: a share is then off by up to 5e-7 max(1, (R/h)^3) of a
/// cell, most by a tenth of that.
inline constexpr double kSingleReach = 3;

/// Void fractions below this are counted as negative; those above may be rounding.
inline constexpr double negative_below(Precision precision) {
  return precision == Precision::mixed ? -1e-5 : -1e-12;
}

}  // namespace interstice::voxel
