// Walls and tools as the fields see them: volume that is neither powder nor void.
#pragma once

#include <vector>

#include "base/shapes.h"

namespace interstice::voxel {

struct Solids {
  std::vector<Shape> shapes;
  bool empty() const { return shapes.empty(); }
};

/// Volume [m^3] of the union of the solids inside `cell`. Exact for boxes and axis-aligned planes in any
/// number, and for one oblique plane (unit normal); where an oblique plane overlaps another solid inside the
/// cell, the sum of both, at most the cell.
double solid_volume(const Solids& solids, const Box& cell);

}  // namespace interstice::voxel
