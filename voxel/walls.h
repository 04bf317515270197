// The share of each cell that walls and tools take up, block by block.
#pragma once

#include <cstdint>
#include <vector>

#include "voxel/bins.h"
#include "voxel/solids.h"

namespace interstice::voxel {

/// A block that solids reach into.
struct WallBlock {
  std::uint64_t key = 0;
  bool full = false;  // one of the solids covers it
};

/// `solids` as seen from the lattice's lower corner, so that fractions are as accurate far from the origin.
Solids relative_to(const Solids& solids, const Lattice& lattice);

/// The blocks that `local` solids (see relative_to) reach into, ascending by key.
std::vector<WallBlock> wall_blocks(const Solids& local, const Lattice& lattice);

/// Writes the share of each cell taken by solids, 0 to 1, in exact_fractions' order. Shares closer to 0 or 1
/// than 1e-11, the rounding of a wall's coordinate, are 0 or 1: a wall that stands on a face of the lattice
/// stays there.
void wall_fractions(const Solids& local, const Lattice& lattice, const CellRange& block, double* fractions);

}  // namespace interstice::voxel
