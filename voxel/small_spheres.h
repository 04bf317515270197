// Exact shares of the cells that small spheres fill, many spheres at a time: the closed form of overlap.h
// with whole rows of cells in one register, for the instruction set that the machine has (chosen at run
// time).
#pragma once

#include <cstdint>
#include <vector>

#include "voxel/channels.h"
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

/// Sums over a box of cells, as rows along z with room on both sides for what reaches beyond them; one such
/// box a channel (channels.h).
class CellRows {
 public:
  static constexpr std::int64_t kRoom = 8;

  /// All zero, over `cells`.
  void reset(const CellRange& cells, int channels = 1);

  const CellRange& cells() const { return cells_; }
  /// From a number of one channel to the same cell's in the next.
  std::int64_t plane() const { return plane_; }
  /// From a row to the next along x, and along y.
  std::int64_t stride_i() const { return cells_.size(1) * stride_; }
  std::int64_t stride_j() const { return stride_; }
  /// Cell (i, j, cells().lo[2]) of channel 0; the row goes on along z.
  double* row(std::int64_t i, std::int64_t j) {
    return values_.data() + ((i - cells_.lo[0]) * cells_.size(1) + (j - cells_.lo[1])) * stride_ + kRoom;
  }
  const double* row(std::int64_t i, std::int64_t j) const { return const_cast<CellRows*>(this)->row(i, j); }

 private:
  CellRange cells_;
  std::int64_t stride_ = 0, plane_ = 0;
  std::vector<double> values_;
};

/// A small sphere, its bounding box, and which of all spheres it is.
struct SmallSphere {
  PlacedSphere sphere;
  CellRange bounding;
  std::size_t index = 0;
};

/// Adds the share of each cell that a sphere fills, sphere by sphere in their order, to the rows' channels;
/// cells outside the rows are left out. Cubic lattices only.
void add_small_spheres(const Lattice& lattice, const SmallSphere* spheres, std::size_t count,
                       Precision precision, const Channels& channels, CellRows& rows);

/// The same of shares that are known, of the cells of a block inside the rows, in exact_fractions' order.
void add_shares(const double* shares, const CellRange& block, std::size_t sphere, const Channels& channels,
                CellRows& rows);

/// The instruction set that add_small_spheres uses on this machine, as in "AVX3".
const char* small_spheres_target();

}  // namespace interstice::voxel
