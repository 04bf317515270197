// The cells that a field is computed on: an axis-aligned block of n.x * n.y * n.z cells.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/shapes.h"

namespace interstice::voxel {

/// Cell (i, j, k) covers [lo.x + i*h.x, lo.x + (i+1)*h.x) and so on [m]. Fields use cubic cells; columns need
/// not.
struct Lattice {
  Vec3d lo;
  Vec3d h;
  std::array<std::int64_t, 3> n{0, 0, 0};

  std::int64_t cells() const { return n[0] * n[1] * n[2]; }
  double cell_volume() const { return h.x * h.y * h.z; }
  Box box() const {
    return {lo,
            {lo.x + static_cast<double>(n[0]) * h.x, lo.y + static_cast<double>(n[1]) * h.y,
             lo.z + static_cast<double>(n[2]) * h.z}};
  }
  Vec3d cell_center(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return {lo.x + (static_cast<double>(i) + 0.5) * h.x, lo.y + (static_cast<double>(j) + 0.5) * h.y,
            lo.z + (static_cast<double>(k) + 0.5) * h.z};
  }
};

/// Cells [lo, hi) along each axis.
struct CellRange {
  std::array<std::int64_t, 3> lo{0, 0, 0}, hi{0, 0, 0};

  std::int64_t size(int axis) const { return hi[axis] - lo[axis]; }
  bool empty() const { return hi[0] <= lo[0] || hi[1] <= lo[1] || hi[2] <= lo[2]; }
  bool contains(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return i >= lo[0] && i < hi[0] && j >= lo[1] && j < hi[1] && k >= lo[2] && k < hi[2];
  }
  std::int64_t cells() const { return empty() ? 0 : size(0) * size(1) * size(2); }
};

/// The cells that are in both.
inline CellRange intersection(const CellRange& a, const CellRange& b) {
  CellRange both;
  for (int axis = 0; axis < 3; ++axis) {
    both.lo[axis] = std::max(a.lo[axis], b.lo[axis]);
    both.hi[axis] = std::min(a.hi[axis], b.hi[axis]);
  }
  return both;
}

/// All cells of a lattice.
inline CellRange all_cells(const Lattice& lattice) { return {{0, 0, 0}, lattice.n}; }

/// Cubic cells of edge `voxel` over `box`; a box that is no multiple of the edge is extended upward.
/// Throws InputError for an edge or box that is not finite and positive, or more than 2^31 cells along an
/// axis.
Lattice cubic_lattice(const Box& box, double voxel);

/// Throws InputError unless edges are finite and positive and the numbers of cells are what a field can
/// index: 1 to 2^31 - 16 along an axis, at most 2^62 in all.
void check_lattice(const Lattice& lattice);

/// floor(value) as an index, kept within +-2^60 so that no coordinate, however absurd, overflows.
inline std::int64_t floor_index(double value) {
  return static_cast<std::int64_t>(std::floor(std::min(std::max(value, -0x1p60), 0x1p60)));
}

/// Index of the cell along `axis` that holds the coordinate `at` [m]: on a face (within 1e-9 of a cell), the
/// cell above it; on the lattice's upper face, its last cell. Throws InputError when `at` is outside the
/// lattice.
std::int64_t cell_along(const Lattice& lattice, int axis, double at);

}  // namespace interstice::voxel
