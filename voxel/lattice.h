// The cells that a field is computed on: an axis-aligned block of n.x * n.y * n.z cells.
#pragma once

#include <array>
#include <cstdint>

#include "base/shapes.h"

namespace interstice::voxel {

/// Cell (i, j, k) covers [lo.x + i*h.x, lo.x + (i+1)*h.x) and so on [m]. Fields use cubic cells; columns need not.
struct Lattice {
  Vec3d lo;
  Vec3d h;
  std::array<std::int64_t, 3> n{0, 0, 0};

  std::int64_t cells() const { return n[0] * n[1] * n[2]; }
  double cell_volume() const { return h.x * h.y * h.z; }
  Box box() const {
    return {lo, {lo.x + static_cast<double>(n[0]) * h.x, lo.y + static_cast<double>(n[1]) * h.y,
                 lo.z + static_cast<double>(n[2]) * h.z}};
  }
  Vec3d cell_center(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return {lo.x + (static_cast<double>(i) + 0.5) * h.x, lo.y + (static_cast<double>(j) + 0.5) * h.y,
            lo.z + (static_cast<double>(k) + 0.5) * h.z};
  }
};

/// Cubic cells of edge `voxel` over `box`; a box that is no multiple of the edge is extended upward.
/// Throws InputError for an edge or box that is not finite and positive, or more than 2^31 cells along an axis.
Lattice cubic_lattice(const Box& box, double voxel);

}  // namespace interstice::voxel
