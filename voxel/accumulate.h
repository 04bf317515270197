// From spheres and walls to the leaves of the field's grids. Cells are summed in regions that fit into a
// processor's own cache, so that a sphere is worked on once (or a little more often, at their borders), and
// then rounded to leaves, block by block.
#pragma once

#include <openvdb/openvdb.h>

#include <memory>
#include <vector>

#include "voxel/average.h"
#include "voxel/bins.h"
#include "voxel/channels.h"
#include "voxel/field.h"
#include "voxel/methods_kernel.h"
#include "voxel/union_overlaps.h"
#include "voxel/walls.h"

namespace interstice::voxel {

using Leaf = openvdb::FloatTree::LeafNodeType;
static_assert(Leaf::DIM == kBlock && Leaf::SIZE == kBlockCells);

/// Edge of a region in cells: four leaves.
inline constexpr std::int64_t kRegion = 4 * kBlock;

/// What a block contributes. Sums are over its cells, in shares of a cell.
struct BlockResult {
  std::array<std::int64_t, 3> block{0, 0, 0};
  bool wall_tile = false;   // nothing but wall: a tile, no leaves
  bool solid_tile = false;  // the same share of solid in every cell, no wall: a tile, no leaves
  float tile_share = 0;     // that share
  double solid = 0, wall = 0, written = 0;
  double deleted = 0;  // by FieldRequest::least_void
  double void_min = 1, void_max = 1;
  std::int64_t negative = 0;
  std::int64_t cells = 0, active = 0;  // active: cells with something in them
  std::unique_ptr<Leaf> solid_leaf, void_leaf, available_leaf;
  std::vector<std::unique_ptr<Leaf>> quantity_leaves;  // an output each
  std::vector<double> parts;                           // an output each: sum of part_of
};

/// What averages are taken from: shares, and the parts of the outputs (windowed_part_of) that are averaged.
struct DenseParts {
  DenseShares shares;
  std::vector<std::vector<double>> parts;  // an output each, indexed as the shares; empty where not averaged
};

/// What all regions share.
struct Accumulation {
  const SpheresView& spheres;
  const FieldRequest& request;
  const Bins& bins;                           // by regions
  const Solids& walls;                        // relative to the lattice
  const std::vector<WallBlock>& wall_blocks;  // by blocks
  const Channels& channels;
  DenseParts* dense = nullptr;           // where averages are taken from, or null
  const KernelSpread* kernel = nullptr;  // for Method::kernel; bins are then by its reach
  const Overlaps* overlaps = nullptr;    // for Overlap::united
};

/// One result per block that has something in it, in an order that depends on the lattice alone. Every voxel
/// sums over spheres in ascending order of index, in one thread: the same bits however many threads share the
/// regions.
std::vector<BlockResult> accumulate(const Accumulation& what);

}  // namespace interstice::voxel
