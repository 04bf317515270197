// Exact shares of the cells that small spheres fill, many spheres at a time: the closed form of overlap.h
// with whole rows of cells in one register, for the instruction set that the machine has (chosen at run
// time).
#pragma once

#include <cstdint>
#include <vector>

#include "voxel/overlap.h"
#include "voxel/precision.h"

namespace interstice::voxel {

/// Cells that a small sphere may touch along an axis, at most: eight planes, one vector register of AVX-512.
inline constexpr int kSmallCells = 7;

/// Does the sphere's bounding box span at most kSmallCells along each axis?
inline bool is_small(const CellRange& bounding) {
  return bounding.size(0) <= kSmallCells && bounding.size(1) <= kSmallCells &&
         bounding.size(2) <= kSmallCells;
}

/// Sums over a box of cells, as rows along z with room on both sides for what reaches beyond them.
class CellRows {
 public:
  static constexpr std::int64_t kRoom = 8;

  /// All zero, over `cells`.
  void reset(const CellRange& cells);

  const CellRange& cells() const { return cells_; }
  /// Cell (i, j, cells().lo[2]); the row goes on along z.
  double* row(std::int64_t i, std::int64_t j) {
    return values_.data() + ((i - cells_.lo[0]) * cells_.size(1) + (j - cells_.lo[1])) * stride_ + kRoom;
  }
  const double* row(std::int64_t i, std::int64_t j) const { return const_cast<CellRows*>(this)->row(i, j); }

 private:
  CellRange cells_;
  std::int64_t stride_ = 0;
  std::vector<double> values_;
};

/// A small sphere and its bounding box.
struct SmallSphere {
  PlacedSphere sphere;
  CellRange bounding;
};

/// Adds `weights[s]` times (1 where `weights` is null) the share of each cell that sphere s fills, sphere by
/// sphere in their order, to the rows; cells outside them are left out. Cubic lattices only.
void add_small_spheres(const Lattice& lattice, const SmallSphere* spheres, std::size_t count,
                       const double* weights, Precision precision, CellRows& rows);

/// The instruction set that add_small_spheres uses on this machine, as in "AVX3".
const char* small_spheres_target();

}  // namespace interstice::voxel
