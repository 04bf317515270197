// From the sums over a block's cells to OpenVDB's leaves: rounded to float, with what the field's own sums
// need added up in double.
#pragma once

#include <cstdint>

#include "voxel/accumulate.h"
#include "voxel/small_spheres.h"

namespace interstice::voxel {

/// Calls visit(row, i, j) for the rows of a block's cells, numbered as in a leaf.
template <class Visit>
void for_rows(const CellRange& cells, const Visit& visit) {
  for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i)
    for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j)
      visit((i - cells.lo[0]) * kBlock + (j - cells.lo[1]), i, j);
}

/// Where the sums of row (i, j) begin that belong to a block's cells.
inline const double* sums_of_row(const CellRows& rows, const CellRange& cells, std::int64_t i,
                                 std::int64_t j) {
  return rows.row(i, j) + (cells.lo[2] - rows.cells().lo[2]);
}

/// Rounds the sums of a block's cells to leaves, and keeps them for averages where asked for. `walls`: the
/// walls' shares in a leaf's order, or null.
void finish_block(const Accumulation& what, const CellRange& cells, const double* walls, const CellRows& rows,
                  BlockResult& result);

}  // namespace interstice::voxel
