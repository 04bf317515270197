#include "voxel/accumulate.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "voxel/methods.h"

namespace interstice::voxel {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

struct Task {
  std::uint64_t key;
  std::size_t bin = kNone;  // of the spheres, or none
  bool wall = false, full = false;
};

std::vector<Task> merge(const Bins& bins, const std::vector<WallBlock>& walls) {
  std::vector<Task> tasks;
  tasks.reserve(bins.keys.size() + walls.size());
  std::size_t b = 0, w = 0;
  while (b < bins.keys.size() || w < walls.size()) {
    const bool take_bin = b < bins.keys.size() && (w == walls.size() || bins.keys[b] <= walls[w].key);
    const bool take_wall = w < walls.size() && (b == bins.keys.size() || walls[w].key <= bins.keys[b]);
    Task task{take_bin ? bins.keys[b] : walls[w].key};
    if (take_bin) task.bin = b++;
    if (take_wall) {
      task.wall = true;
      task.full = walls[w++].full;
    }
    tasks.push_back(task);
  }
  return tasks;
}

// Shares of the cells of one block, in the leaf's own order.
struct Shares {
  double solid[kBlockCells];
  double mass[kBlockCells];  // [kg/m^3], only where asked for
  double wall[kBlockCells];
};

void add_spheres(const Accumulation& what, std::size_t bin, const CellRange& cells, Shares& shares) {
  const Lattice& lattice = what.request.lattice;
  double fractions[kBlockCells];
  for (std::size_t e = what.bins.first[bin]; e < what.bins.first[bin + 1]; ++e) {
    const BinEntry& entry = what.bins.entries[e];
    const PlacedSphere sphere = moved(place(lattice, what.spheres, entry.sphere), lattice, entry.image);
    const CellRange touched = intersection(bounding_cells(lattice, sphere), cells);
    if (touched.empty()) continue;
    method_fractions(what.request, sphere, touched, fractions);
    const double density = !what.mass             ? 0
                           : what.spheres.density ? what.spheres.density[entry.sphere]
                                                  : what.request.density;
    const double* next = fractions;
    const auto nz = touched.size(2);
    for (std::int64_t i = touched.lo[0]; i < touched.hi[0]; ++i)
      for (std::int64_t j = touched.lo[1]; j < touched.hi[1]; ++j, next += nz) {
        const std::int64_t row =
            ((i - cells.lo[0]) * kBlock + (j - cells.lo[1])) * kBlock + touched.lo[2] - cells.lo[2];
        for (std::int64_t k = 0; k < nz; ++k) shares.solid[row + k] += next[k];
        if (what.mass)
          for (std::int64_t k = 0; k < nz; ++k) shares.mass[row + k] += density * next[k];
      }
  }
}

void add_walls(const Accumulation& what, const CellRange& cells, Shares& shares) {
  double fractions[kBlockCells];
  wall_fractions(what.walls, what.request.lattice, cells, fractions);
  const double* next = fractions;
  for (std::int64_t i = 0; i < cells.size(0); ++i)
    for (std::int64_t j = 0; j < cells.size(1); ++j)
      for (std::int64_t k = 0; k < cells.size(2); ++k) shares.wall[(i * kBlock + j) * kBlock + k] = *next++;
}

std::unique_ptr<Leaf> new_leaf(const CellRange& cells, float background) {
  const openvdb::Coord origin(static_cast<int>(cells.lo[0]), static_cast<int>(cells.lo[1]),
                              static_cast<int>(cells.lo[2]));
  return std::make_unique<Leaf>(origin, background, false);
}

// Walls may reach beyond the part of the lattice that averages look at.
void keep(std::int64_t i, std::int64_t j, std::int64_t k, double solid, double available,
          DenseShares& dense) {
  if (!dense.range.contains(i, j, k)) return;
  const std::size_t at = dense.index(i, j, k);
  dense.solid[at] = solid;
  if (!dense.available.empty()) dense.available[at] = available;
}

// Rounds the shares to leaves and adds up what the field's sums need, in double.
void finish(const Accumulation& what, const Task& task, const CellRange& cells, const Shares& shares,
            BlockResult& result) {
  const bool spheres = task.bin != kNone;
  if (spheres) result.solid_leaf = new_leaf(cells, 0.0f);
  if (spheres && what.mass) result.mass_leaf = new_leaf(cells, 0.0f);
  if (task.wall) result.available_leaf = new_leaf(cells, 1.0f);
  result.void_leaf = new_leaf(cells, 1.0f);
  bool first = true;
  for (std::int64_t i = 0; i < cells.size(0); ++i)
    for (std::int64_t j = 0; j < cells.size(1); ++j)
      for (std::int64_t k = 0; k < cells.size(2); ++k) {
        const auto at = static_cast<openvdb::Index>((i * kBlock + j) * kBlock + k);
        const double solid = spheres ? shares.solid[at] : 0, wall = task.wall ? shares.wall[at] : 0;
        const double available = 1 - wall, empty = available - solid;
        result.void_min = first ? empty : std::min(result.void_min, empty);
        result.void_max = first ? empty : std::max(result.void_max, empty);
        first = false;
        if (solid == 0 && wall == 0) continue;
        ++result.active;
        result.solid += solid;
        result.wall += wall;
        result.negative += empty < -1e-12;
        result.void_leaf->setValueOn(at, static_cast<float>(empty));
        if (solid > 0) {
          const auto rounded = static_cast<float>(solid);
          result.written += static_cast<double>(rounded);
          result.solid_leaf->setValueOn(at, rounded);
          if (what.mass) result.mass_leaf->setValueOn(at, static_cast<float>(shares.mass[at]));
        }
        if (wall > 0) result.available_leaf->setValueOn(at, static_cast<float>(available));
        if (what.dense)
          keep(cells.lo[0] + i, cells.lo[1] + j, cells.lo[2] + k, solid, available, *what.dense);
      }
}

void fill_dense_wall(const CellRange& cells, DenseShares& dense) {
  const CellRange inside = intersection(cells, dense.range);
  for (std::int64_t i = inside.lo[0]; i < inside.hi[0]; ++i)
    for (std::int64_t j = inside.lo[1]; j < inside.hi[1]; ++j)
      for (std::int64_t k = inside.lo[2]; k < inside.hi[2]; ++k) dense.available[dense.index(i, j, k)] = 0;
}

BlockResult compute_block(const Accumulation& what, const BlockGrid& grid, const Task& task) {
  const Lattice& lattice = what.request.lattice;
  BlockResult result;
  result.block = grid.block(task.key);
  const CellRange cells = block_cells(lattice, result.block);
  result.cells = cells.cells();
  if (task.full && task.bin == kNone && result.cells == kBlockCells) {
    result.wall_tile = true;
    result.wall = kBlockCells;
    result.active = kBlockCells;
    result.void_min = result.void_max = 0;
    if (what.dense) fill_dense_wall(cells, *what.dense);
    return result;
  }
  Shares shares;
  if (task.bin != kNone) {
    std::fill_n(shares.solid, kBlockCells, 0.0);
    if (what.mass) std::fill_n(shares.mass, kBlockCells, 0.0);
    add_spheres(what, task.bin, cells, shares);
  }
  if (task.wall && task.full)
    std::fill_n(shares.wall, kBlockCells, 1.0);
  else if (task.wall)
    add_walls(what, cells, shares);
  finish(what, task, cells, shares, result);
  return result;
}

}  // namespace

std::vector<BlockResult> accumulate(const Accumulation& what) {
  const BlockGrid grid(what.request.lattice);
  const std::vector<Task> tasks = merge(what.bins, what.wall_blocks);
  std::vector<BlockResult> results(tasks.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tasks.size(), 4), [&](const auto& range) {
    for (std::size_t t = range.begin(); t != range.end(); ++t)
      results[t] = compute_block(what, grid, tasks[t]);
  });
  return results;
}

}  // namespace interstice::voxel
