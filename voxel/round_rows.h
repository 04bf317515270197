// Rounds the sums of a block's cells to the floats of OpenVDB's leaves, rows of eight at a time, for the
// instruction set that the machine has (chosen at run time).
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "voxel/overlap.h"

namespace interstice::voxel {

/// Sums and extremes over the rows of a block, by cell of a row.
struct RowSums {
  double solid[kBlock] = {}, wall[kBlock] = {}, written[kBlock] = {};
  double negative[kBlock] = {};  // how many
  double void_min[kBlock], void_max[kBlock];

  RowSums() {
    std::fill_n(void_min, kBlock, std::numeric_limits<double>::infinity());
    std::fill_n(void_max, kBlock, -std::numeric_limits<double>::infinity());
  }
};

/// The numbers of one block's leaves in the making, and its active cells, a byte a row of eight.
struct LeafRows {
  float *solid = nullptr, *empty = nullptr, *available = nullptr;  // 512 each; available with walls only
  double least_void = 0;                                           // voxels with less count as negative
  std::uint8_t solid_on[kBlock * kBlock] = {}, any_on[kBlock * kBlock] = {}, wall_on[kBlock * kBlock] = {};
};

/// The sums over a block's cells: row (i, j) of n[0] x n[1] begins at i * stride_i + j * stride_j, and eight
/// numbers can be read of each, of which n[2] count. `walls`: their shares in the leaf's order, or null.
struct BlockRows {
  const double* solid;
  std::int64_t stride_i, stride_j;
  int n[3];
  const double* walls = nullptr;
};

/// Rounds all rows to the leaves and adds them to the sums.
void round_rows(const BlockRows& rows, LeafRows& leaves, RowSums& sums);

}  // namespace interstice::voxel
