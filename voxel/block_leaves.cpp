#include "voxel/block_leaves.h"

#include <algorithm>

#include "voxel/methods.h"
#include "voxel/round_rows.h"

namespace interstice::voxel {

namespace {

std::unique_ptr<Leaf> new_leaf(const CellRange& cells, float background) {
  const openvdb::Coord origin(static_cast<int>(cells.lo[0]), static_cast<int>(cells.lo[1]),
                              static_cast<int>(cells.lo[2]));
  return std::make_unique<Leaf>(origin, background, false);
}

/// The active cells of a leaf, a byte a row of eight.
void set_active(Leaf& leaf, const std::uint8_t (&rows)[kBlock * kBlock]) {
  Leaf::NodeMaskType mask;
  for (int x = 0; x < kBlock; ++x) {
    std::uint64_t word = 0;
    for (int y = 0; y < kBlock; ++y) word |= static_cast<std::uint64_t>(rows[x * kBlock + y]) << (8 * y);
    mask.getWord<std::uint64_t>(static_cast<openvdb::Index>(x)) = word;
  }
  leaf.setValueMask(mask);
}

/// Adds the sums of all eight up, in their order.
void add_up(const RowSums& sums, BlockResult& result) {
  result.void_min = *std::min_element(sums.void_min, sums.void_min + kBlock);
  result.void_max = *std::max_element(sums.void_max, sums.void_max + kBlock);
  for (int k = 0; k < kBlock; ++k) {
    result.solid += sums.solid[k];
    result.wall += sums.wall[k];
    result.written += sums.written[k];
    result.negative += static_cast<std::int64_t>(sums.negative[k]);
  }
}

/// What averages are taken from, of one row.
void keep(const Channels& channels, const double* sums, std::int64_t plane, const double* wall,
          const CellRange& row, DenseParts& dense) {
  DenseShares& shares = dense.shares;
  const CellRange inside = intersection(row, shares.range);  // walls may reach beyond what averages look at
  for (std::int64_t k = inside.lo[2]; k < inside.hi[2] && !inside.empty(); ++k) {
    const std::size_t at = shares.index(row.lo[0], row.lo[1], k);
    const std::int64_t in_row = k - row.lo[2];
    shares.solid[at] = sums[in_row];
    if (!shares.available.empty() && wall) shares.available[at] = 1 - wall[in_row];
    for (std::size_t o = 0; o < dense.parts.size(); ++o)
      if (!dense.parts[o].empty())
        dense.parts[o][at] = windowed_part_of(channels.outputs[o], channels, sums + in_row, plane);
  }
}

void keep_block(const Accumulation& what, const CellRange& cells, const double* walls, const CellRows& rows) {
  for_rows(cells, [&](std::int64_t row, std::int64_t i, std::int64_t j) {
    const CellRange in_row{{i, j, cells.lo[2]}, {i + 1, j + 1, cells.hi[2]}};
    keep(what.channels, sums_of_row(rows, cells, i, j), rows.plane(), walls ? walls + row * kBlock : nullptr,
         in_row, *what.dense);
  });
}

/// Rounds one quantity of a block's cells to its leaf, with values where there is solid; a mask has them
/// where it is 1. Returns the sum of its parts.
double finish_quantity(const Output& output, const CellRange& cells, const CellRows& rows, Leaf& leaf) {
  float* values = leaf.buffer().data();
  std::uint8_t on[kBlock * kBlock] = {};
  const bool per_solid = output.quantity.per_solid, mask = output.reading == Reading::mask;
  const double sum = with_part_of(output, rows.plane(), [&](const auto& part) {
    double total = 0;
    for_rows(cells, [&](std::int64_t row, std::int64_t i, std::int64_t j) {
      const double* sums = sums_of_row(rows, cells, i, j);
      for (std::int64_t k = 0; k < cells.size(2); ++k) {
        const double own = part(sums + k);
        const bool has = sums[k] != 0 && !(mask && own == 0);
        on[row] |= static_cast<std::uint8_t>(has << k);
        total += has ? own : 0.0;
        values[row * kBlock + k] = has ? static_cast<float>(per_solid ? own / sums[k] : own) : 0.0f;
      }
    });
    return total;
  });
  set_active(leaf, on);
  return sum;
}

}  // namespace

void finish_block(const Accumulation& what, const CellRange& cells, const double* walls, const CellRows& rows,
                  BlockResult& result) {
  result.solid_leaf = new_leaf(cells, 0.0f);
  result.void_leaf = new_leaf(cells, 1.0f);
  LeafRows leaves;
  leaves.least_void = negative_below(what.request.precision);
  leaves.solid = result.solid_leaf->buffer().data();
  leaves.empty = result.void_leaf->buffer().data();
  if (walls) {
    result.available_leaf = new_leaf(cells, 1.0f);
    leaves.available = result.available_leaf->buffer().data();
  }
  RowSums sums;
  round_rows(
      {sums_of_row(rows, cells, cells.lo[0], cells.lo[1]),
       rows.stride_i(),
       rows.stride_j(),
       {static_cast<int>(cells.size(0)), static_cast<int>(cells.size(1)), static_cast<int>(cells.size(2))},
       walls},
      leaves, sums);
  set_active(*result.solid_leaf, leaves.solid_on);
  set_active(*result.void_leaf, leaves.any_on);
  if (walls) set_active(*result.available_leaf, leaves.wall_on);
  result.active = static_cast<std::int64_t>(result.void_leaf->onVoxelCount());
  add_up(sums, result);
  if (what.dense) keep_block(what, cells, walls, rows);
  for (const Output& output : what.channels.outputs) {
    result.quantity_leaves.push_back(new_leaf(cells, 0.0f));
    result.parts.push_back(finish_quantity(output, cells, rows, *result.quantity_leaves.back()));
  }
}

}  // namespace interstice::voxel
