#include "voxel/accumulate.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>
#include <optional>

#include "voxel/block_leaves.h"
#include "voxel/methods.h"
#include "voxel/small_spheres.h"

namespace interstice::voxel {

namespace {

constexpr std::size_t kNone = static_cast<std::size_t>(-1);

/// A region with spheres, walls, or both.
struct Task {
  std::uint64_t key;                          // of the region
  std::size_t bin = kNone;                    // of its spheres, or none
  std::size_t first_wall = 0, last_wall = 0;  // of its wall blocks, in Walled::blocks
};

/// The wall blocks, grouped by region.
struct Walled {
  struct Entry {
    std::uint64_t region, block;
    bool full;
  };
  std::vector<Entry> blocks;  // ascending by region, then by block
};

Walled by_region(const Lattice& lattice, const std::vector<WallBlock>& walls) {
  const BlockGrid blocks(lattice), regions(lattice, kRegion);
  Walled walled;
  for (const WallBlock& wall : walls) {
    std::array<std::int64_t, 3> at = blocks.block(wall.key);
    for (std::int64_t& b : at) b /= kRegion / kBlock;
    walled.blocks.push_back({regions.key(at), wall.key, wall.full});
  }
  std::stable_sort(walled.blocks.begin(), walled.blocks.end(),
                   [](const auto& a, const auto& b) { return a.region < b.region; });
  return walled;
}

std::vector<Task> merge(const Bins& bins, const Walled& walls) {
  std::vector<Task> tasks;
  std::size_t b = 0, w = 0;
  while (b < bins.keys.size() || w < walls.blocks.size()) {
    const bool bin =
        w == walls.blocks.size() || (b < bins.keys.size() && bins.keys[b] <= walls.blocks[w].region);
    Task task{bin ? bins.keys[b] : walls.blocks[w].region};
    if (bin) task.bin = b++;
    task.first_wall = w;
    while (w < walls.blocks.size() && walls.blocks[w].region == task.key) ++w;
    task.last_wall = w;
    tasks.push_back(task);
  }
  return tasks;
}

/// Sums over the cells of a region, kept from region to region by each thread.
struct Sums {
  CellRows rows;
  std::vector<SmallSphere> small;  // waiting to be added, in order
};

void add_waiting(const Accumulation& what, Sums& sums) {
  add_small_spheres(what.request.lattice, sums.small.data(), sums.small.size(), what.request.precision,
                    what.channels, sums.rows);
  sums.small.clear();
}

/// Any method, any size: leaf by leaf. `fill(cells, fractions)` gives the shares of some cells.
template <class Fill>
void add_by_blocks(const CellRange& touched, std::size_t sphere, const Channels& channels, CellRows& rows,
                   const Fill& fill) {
  double fractions[kBlockCells];
  std::array<std::int64_t, 3> at;
  const auto from = [](std::int64_t cell) { return cell / kBlock * kBlock; };
  for (at[0] = from(touched.lo[0]); at[0] < touched.hi[0]; at[0] += kBlock)
    for (at[1] = from(touched.lo[1]); at[1] < touched.hi[1]; at[1] += kBlock)
      for (at[2] = from(touched.lo[2]); at[2] < touched.hi[2]; at[2] += kBlock) {
        const CellRange cells = intersection(touched, {at, {at[0] + kBlock, at[1] + kBlock, at[2] + kBlock}});
        if (fill(cells, fractions)) add_shares(fractions, cells, sphere, channels, rows);
      }
}

void add_one(const Accumulation& what, std::size_t index, const PlacedSphere& sphere, const CellRange& cells,
             CellRows& rows) {
  const FieldRequest& request = what.request;
  const double scale = what.kernel ? what.kernel->scale[index] : 0;
  if (scale > 0) {
    const CellRange reached = kernel_cells(request.lattice, sphere, what.kernel->length);
    add_by_blocks(intersection(reached, cells), index, what.channels, rows,
                  [&](const CellRange& block, double* fractions) {
                    kernel_fractions(request.lattice, sphere, *what.kernel, scale, block, fractions);
                    return true;
                  });
    return;
  }
  const CellRange touched = intersection(bounding_cells(request.lattice, sphere), cells);
  add_by_blocks(touched, index, what.channels, rows, [&](const CellRange& block, double* fractions) {
    if (request.method != Method::centre && !touches(request.lattice, sphere, block)) return false;
    method_fractions(request, sphere, block, fractions);
    return true;
  });
}

void add_spheres(const Accumulation& what, std::size_t bin, const CellRange& cells, Sums& sums) {
  const Lattice& lattice = what.request.lattice;
  for (std::size_t e = what.bins.first[bin]; e < what.bins.first[bin + 1]; ++e) {
    const BinEntry& entry = what.bins.entries[e];
    const PlacedSphere sphere = moved(place(lattice, what.spheres, entry.sphere), lattice, entry.image);
    if (what.request.method == Method::exact) {
      const CellRange bounding = bounding_cells(lattice, sphere);
      if (is_small(bounding)) {
        sums.small.push_back({sphere, bounding, entry.sphere});
        continue;
      }
    }
    add_waiting(what, sums);  // spheres are added in ascending order
    add_one(what, entry.sphere, sphere, cells, sums.rows);
  }
  add_waiting(what, sums);
}

/// The walls' shares of a block's cells, in the leaf's own order.
void fill_walls(const Accumulation& what, const CellRange& cells, bool full, double* shares) {
  if (full) {
    std::fill_n(shares, kBlockCells, 1.0);
    return;
  }
  double fractions[kBlockCells];
  wall_fractions(what.walls, what.request.lattice, cells, fractions);
  const double* next = fractions;
  for (std::int64_t i = 0; i < cells.size(0); ++i)
    for (std::int64_t j = 0; j < cells.size(1); ++j)
      for (std::int64_t k = 0; k < cells.size(2); ++k) shares[(i * kBlock + j) * kBlock + k] = *next++;
}

/// What one number says of a whole range of cells: none, the same share in each, or neither.
enum class Filling { none, uniform, mixed };

Filling filling_of(const CellRows& solid, const CellRange& cells) {
  const std::int64_t z = cells.lo[2] - solid.cells().lo[2];
  const double first = solid.row(cells.lo[0], cells.lo[1])[z];
  for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i)
    for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j) {
      const double* row = solid.row(i, j) + z;
      for (std::int64_t k = 0; k < cells.size(2); ++k)
        if (row[k] != first) return Filling::mixed;
    }
  return first == 0 ? Filling::none : Filling::uniform;
}

/// A block with the same share of solid in every cell, and no wall.
void set_solid_tile(double share, BlockResult& result) {
  result.solid_tile = true;
  result.tile_share = static_cast<float>(share);
  const auto cells = static_cast<double>(result.cells);
  result.solid = cells * share;
  result.written = cells * static_cast<double>(result.tile_share);
  result.active = result.cells;
  result.void_min = result.void_max = 1 - share;
  result.negative = 1 - share < -1e-12 ? result.cells : 0;
}

void fill_dense_wall(const CellRange& cells, DenseShares& dense) {
  const CellRange inside = intersection(cells, dense.range);
  for (std::int64_t i = inside.lo[0]; i < inside.hi[0]; ++i)
    for (std::int64_t j = inside.lo[1]; j < inside.hi[1]; ++j)
      for (std::int64_t k = inside.lo[2]; k < inside.hi[2]; ++k) dense.available[dense.index(i, j, k)] = 0;
}

/// Leaves a cell `share` of solid; what belongs to its spheres becomes less in proportion, and means over
/// them stay. `at` is the cell's channel 0.
void set_share(const Channels& channels, double share, std::int64_t plane, double* at) {
  const double factor = at[0] > 0 ? share / at[0] : 0.0;
  at[0] = share;
  for (int c = 1; c < channels.first_velocity(); ++c) at[c * plane] *= factor;
  if (channels.moment) at[(channels.first_velocity() + 3) * plane] *= factor;
}

/// Takes off what is counted more than once where spheres overlap.
void take_off_overlaps(const Overlaps& overlaps, std::uint64_t region, const Channels& channels,
                       CellRows& rows) {
  const OverlapRange range = overlaps_in(overlaps, region);
  for (const CellOverlap* cell = range.first; cell != range.last; ++cell) {
    double* at = rows.row(cell->cell[0], cell->cell[1]) + (cell->cell[2] - rows.cells().lo[2]);
    set_share(channels, at[0] - cell->share, rows.plane(), at);
  }
}

/// Deletes what solid leaves less void than `least` of what walls leave. Returns how much, in cells.
double delete_solid(double least, const CellRange& cells, const double* walls, const Channels& channels,
                    CellRows& rows) {
  double deleted = 0;
  for_rows(cells, [&](std::int64_t row, std::int64_t i, std::int64_t j) {
    double* solid = rows.row(i, j) + (cells.lo[2] - rows.cells().lo[2]);
    for (std::int64_t k = 0; k < cells.size(2); ++k) {
      const double most = (1 - least) * (walls ? 1 - walls[row * kBlock + k] : 1.0);
      if (solid[k] <= most) continue;
      deleted += solid[k] - most;
      set_share(channels, most, rows.plane(), solid + k);
    }
  });
  return deleted;
}

/// One block of a region whose cells are summed. Nothing when it is empty.
void compute_block(const Accumulation& what, const std::array<std::int64_t, 3>& block,
                   const Walled::Entry* wall, bool spheres, CellRows& rows,
                   std::vector<BlockResult>& results) {
  const CellRange cells = block_cells(what.request.lattice, block);
  const Filling filling = spheres ? filling_of(rows, cells) : Filling::none;
  const bool solid = filling != Filling::none;
  if (!solid && !wall) return;
  BlockResult& result = results.emplace_back();
  result.block = block;
  result.cells = cells.cells();
  if (wall && wall->full && !solid && result.cells == kBlockCells) {
    result.wall_tile = true;
    result.wall = kBlockCells;
    result.active = kBlockCells;
    result.void_min = result.void_max = 0;
    if (what.dense) fill_dense_wall(cells, what.dense->shares);
    return;
  }
  double shares[kBlockCells];
  if (wall) fill_walls(what, cells, wall->full, shares);
  if (what.request.least_void > 0)
    result.deleted =
        delete_solid(what.request.least_void, cells, wall ? shares : nullptr, what.channels, rows);
  if (filling == Filling::uniform && !wall && !what.dense && what.channels.none() &&
      result.cells == kBlockCells) {
    set_solid_tile(*sums_of_row(rows, cells, cells.lo[0], cells.lo[1]), result);
    return;
  }
  finish_block(what, cells, wall ? shares : nullptr, rows, result);
}

/// How many spheres cover the whole region, if spheres that do so are all that reach into it; else nothing.
std::optional<int> covering(const Accumulation& what, std::size_t bin, const CellRange& cells) {
  const Lattice& lattice = what.request.lattice;
  int covers = 0;
  for (std::size_t e = what.bins.first[bin]; e < what.bins.first[bin + 1]; ++e, ++covers) {
    const BinEntry& entry = what.bins.entries[e];
    if (what.spheres.radius[entry.sphere] < static_cast<double>(kRegion / 2) * lattice.h.x) return {};
    const PlacedSphere sphere = moved(place(lattice, what.spheres, entry.sphere), lattice, entry.image);
    if (!covers_range(lattice, sphere, cells)) return {};
  }
  return covers;
}

/// A region that is filled throughout: tiles, without looking at its cells.
std::vector<BlockResult> fill_region(const CellRange& cells, int covers) {
  std::vector<BlockResult> results;
  std::array<std::int64_t, 3> b;
  for (b[0] = cells.lo[0] / kBlock; b[0] * kBlock < cells.hi[0]; ++b[0])
    for (b[1] = cells.lo[1] / kBlock; b[1] * kBlock < cells.hi[1]; ++b[1])
      for (b[2] = cells.lo[2] / kBlock; b[2] * kBlock < cells.hi[2]; ++b[2]) {
        BlockResult& result = results.emplace_back();
        result.block = b;
        result.cells = kBlockCells;
        set_solid_tile(covers, result);
      }
  return results;
}

std::vector<BlockResult> compute_region(const Accumulation& what, const Walled& walled, const Task& task,
                                        Sums& sums) {
  const Lattice& lattice = what.request.lattice;
  const std::array<std::int64_t, 3> region = BlockGrid(lattice, kRegion).block(task.key);
  const CellRange cells = block_cells(lattice, region, kRegion);
  const bool tiles = what.request.method == Method::exact && !what.overlaps && !what.dense &&
                     what.channels.none() && task.bin != kNone && task.first_wall == task.last_wall &&
                     cells.cells() == kRegion * kRegion * kRegion;
  if (tiles) {
    if (const auto covers = covering(what, task.bin, cells)) return fill_region(cells, *covers);
  }
  sums.rows.reset(cells, what.channels.count());
  if (task.bin != kNone) add_spheres(what, task.bin, cells, sums);
  if (what.overlaps) take_off_overlaps(*what.overlaps, task.key, what.channels, sums.rows);
  const BlockGrid grid(lattice);
  std::vector<BlockResult> results;
  std::size_t wall = task.first_wall;
  std::array<std::int64_t, 3> b;
  for (b[0] = cells.lo[0] / kBlock; b[0] * kBlock < cells.hi[0]; ++b[0])
    for (b[1] = cells.lo[1] / kBlock; b[1] * kBlock < cells.hi[1]; ++b[1])
      for (b[2] = cells.lo[2] / kBlock; b[2] * kBlock < cells.hi[2]; ++b[2]) {
        const bool walls = wall < task.last_wall && walled.blocks[wall].block == grid.key(b);
        compute_block(what, b, walls ? &walled.blocks[wall] : nullptr, task.bin != kNone, sums.rows, results);
        wall += walls;
      }
  return results;
}

}  // namespace

std::vector<BlockResult> accumulate(const Accumulation& what) {
  const Walled walled = by_region(what.request.lattice, what.wall_blocks);
  const std::vector<Task> tasks = merge(what.bins, walled);
  std::vector<std::vector<BlockResult>> regions(tasks.size());
  tbb::enumerable_thread_specific<Sums> sums;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tasks.size(), 1), [&](const auto& range) {
    for (std::size_t t = range.begin(); t != range.end(); ++t)
      regions[t] = compute_region(what, walled, tasks[t], sums.local());
  });
  std::vector<BlockResult> results;
  for (auto& region : regions) std::move(region.begin(), region.end(), std::back_inserter(results));
  return results;
}

}  // namespace interstice::voxel
