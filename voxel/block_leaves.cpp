#include "voxel/block_leaves.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "voxel/methods.h"

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

/// Sums and extremes over the rows of a block, by cell of a row: eight at a time in one register.
struct RowSums {
  double solid[kBlock] = {}, wall[kBlock] = {}, written[kBlock] = {};
  double void_min[kBlock], void_max[kBlock];
  std::int64_t negative[kBlock] = {};

  RowSums() {
    std::fill_n(void_min, kBlock, std::numeric_limits<double>::infinity());
    std::fill_n(void_max, kBlock, -std::numeric_limits<double>::infinity());
  }
};

/// The leaves of one block in the making.
struct Leaves {
  float *solid, *empty, *available = nullptr;
  double least_void = 0;  // voxels with less count as negative
  std::uint8_t solid_on[kBlock * kBlock] = {}, any_on[kBlock * kBlock] = {}, wall_on[kBlock * kBlock] = {};
};

/// Bit k says whether number k is not zero.
template <class Count>
std::uint8_t nonzero(const double* numbers, Count count) {
  unsigned bits = 0;
  for (int k = 0; k < count; ++k) bits |= (numbers[k] != 0 ? 1u : 0u) << k;
  return static_cast<std::uint8_t>(bits);
}

/// One row of `cells` (a constant where there are eight): rounds it to the leaves and adds it to the sums.
/// `wall` is read where there are walls.
template <bool kWalls, class Count>
void finish_row(const double* solid, const double* wall, int row, Count cells, Leaves& leaves,
                RowSums& sums) {
  const int at = row * kBlock;
  float *solid_to = leaves.solid + at, *empty_to = leaves.empty + at;
  for (int k = 0; k < cells; ++k) {
    const double available = kWalls ? 1 - wall[k] : 1.0, empty = available - solid[k];
    const auto rounded = static_cast<float>(solid[k]);
    sums.solid[k] += solid[k];
    sums.written[k] += static_cast<double>(rounded);
    sums.void_min[k] = std::min(sums.void_min[k], empty);
    sums.void_max[k] = std::max(sums.void_max[k], empty);
    sums.negative[k] += empty < leaves.least_void ? 1 : 0;
    solid_to[k] = rounded;
    empty_to[k] = static_cast<float>(empty);
  }
  leaves.any_on[row] = leaves.solid_on[row] = nonzero(solid, cells);
  if constexpr (kWalls) {
    for (int k = 0; k < cells; ++k) {
      sums.wall[k] += wall[k];
      leaves.available[at + k] = static_cast<float>(1 - wall[k]);
    }
    leaves.wall_on[row] = nonzero(wall, cells);
    leaves.any_on[row] |= leaves.wall_on[row];
  }
}

template <bool kWalls>
void finish_rows(const CellRange& cells, const double* walls, const CellRows& rows, Leaves& leaves,
                 RowSums& sums) {
  for_rows(cells, [&](std::int64_t row, std::int64_t i, std::int64_t j) {
    const double *solid = sums_of_row(rows, cells, i, j), *wall = kWalls ? walls + row * kBlock : nullptr;
    if (cells.size(2) == kBlock)
      finish_row<kWalls>(solid, wall, static_cast<int>(row), std::integral_constant<int, kBlock>(), leaves,
                         sums);
    else
      finish_row<kWalls>(solid, wall, static_cast<int>(row), static_cast<int>(cells.size(2)), leaves, sums);
  });
}

/// Adds the sums of all eight up, in their order.
void add_up(const RowSums& sums, BlockResult& result) {
  result.void_min = *std::min_element(sums.void_min, sums.void_min + kBlock);
  result.void_max = *std::max_element(sums.void_max, sums.void_max + kBlock);
  for (int k = 0; k < kBlock; ++k) {
    result.solid += sums.solid[k];
    result.wall += sums.wall[k];
    result.written += sums.written[k];
    result.negative += sums.negative[k];
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
  Leaves leaves;
  leaves.least_void = negative_below(what.request.precision);
  leaves.solid = result.solid_leaf->buffer().data();
  leaves.empty = result.void_leaf->buffer().data();
  RowSums sums;
  if (walls) {
    result.available_leaf = new_leaf(cells, 1.0f);
    leaves.available = result.available_leaf->buffer().data();
    finish_rows<true>(cells, walls, rows, leaves, sums);
    set_active(*result.available_leaf, leaves.wall_on);
  } else {
    finish_rows<false>(cells, walls, rows, leaves, sums);
  }
  set_active(*result.solid_leaf, leaves.solid_on);
  set_active(*result.void_leaf, leaves.any_on);
  result.active = static_cast<std::int64_t>(result.void_leaf->onVoxelCount());
  add_up(sums, result);
  if (what.dense) keep_block(what, cells, walls, rows);
  for (const Output& output : what.channels.outputs) {
    result.quantity_leaves.push_back(new_leaf(cells, 0.0f));
    result.parts.push_back(finish_quantity(output, cells, rows, *result.quantity_leaves.back()));
  }
}

}  // namespace interstice::voxel
