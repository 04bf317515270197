// Window sums of boxes and Gaussians, one axis after the other.
#pragma once

#include <array>
#include <vector>

#include "voxel/average.h"

namespace interstice::voxel {

/// Replaces each cell's value by the sum over the window centred on it, along z, then y, then x. A box's sums
/// are differences of prefix sums, at a cost that does not depend on its length; a Gaussian's cost grows with
/// its reach.
void sum_over_axes(std::vector<double>& values, const CellRange& range,
                   const std::array<AxisWindow, 3>& window);

/// The sum of the weights of a window centred on cell `i` over the cells of the axis.
double axis_weight_inside(const AxisWindow& window, std::int64_t i, std::int64_t n);

}  // namespace interstice::voxel
