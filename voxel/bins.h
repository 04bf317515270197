// Which spheres (and which of their periodic images) touch which block of cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "voxel/lattice.h"
#include "voxel/overlap.h"
#include "voxel/spheres.h"

namespace interstice::voxel {

/// The blocks of edge^3 cells that a lattice is made of; the last along an axis may be shorter.
struct BlockGrid {
  std::array<std::int64_t, 3> n{0, 0, 0};

  explicit BlockGrid(const Lattice& lattice, std::int64_t edge = kBlock) {
    for (int axis = 0; axis < 3; ++axis) n[axis] = (lattice.n[axis] + edge - 1) / edge;
  }
  std::uint64_t key(const std::array<std::int64_t, 3>& b) const {
    return static_cast<std::uint64_t>((b[0] * n[1] + b[1]) * n[2] + b[2]);
  }
  std::array<std::int64_t, 3> block(std::uint64_t key) const {
    const auto k = static_cast<std::int64_t>(key);
    return {k / (n[1] * n[2]), k / n[2] % n[1], k % n[2]};
  }
  std::int64_t blocks() const { return n[0] * n[1] * n[2]; }
};

/// The cells of a block, clipped to the lattice.
inline CellRange block_cells(const Lattice& lattice, const std::array<std::int64_t, 3>& block,
                             std::int64_t edge = kBlock) {
  CellRange cells;
  for (int axis = 0; axis < 3; ++axis) {
    cells.lo[axis] = block[axis] * edge;
    cells.hi[axis] = std::min(cells.lo[axis] + edge, lattice.n[axis]);
  }
  return cells;
}

/// The sphere, moved by `image` times the lattice's own size.
struct BinEntry {
  std::uint32_t sphere = 0;
  std::array<std::int32_t, 3> image{0, 0, 0};
};

/// entries[first[b]] to entries[first[b + 1] - 1] touch block keys[b]; keys ascend, and in a block spheres
/// ascend.
struct Bins {
  std::vector<std::uint64_t> keys;
  std::vector<std::size_t> first;
  std::vector<BinEntry> entries;
  CellRange reached;  // the cells within all spheres' bounding boxes, clipped to the lattice
};

/// The images of a sphere that reach into the lattice: image 0 alone along axes that are not periodic.
struct ImageRange {
  std::array<std::int32_t, 3> lo{0, 0, 0}, hi{0, 0, 0};  // inclusive; empty where hi < lo
};
ImageRange images_of(const Lattice& lattice, const PlacedSphere& sphere, const std::array<bool, 3>& periodic);

inline PlacedSphere moved(PlacedSphere sphere, const Lattice& lattice,
                          const std::array<std::int32_t, 3>& image) {
  for (int axis = 0; axis < 3; ++axis) sphere.cell[axis] += image[axis] * lattice.n[axis];
  return sphere;
}

inline PlacedSphere place(const Lattice& lattice, const SpheresView& spheres, std::size_t s) {
  return place(lattice, {spheres.x[s], spheres.y[s], spheres.z[s]}, spheres.radius[s]);
}

/// Into blocks of edge^3 cells.
Bins bin_spheres(const SpheresView& spheres, const Lattice& lattice, const std::array<bool, 3>& periodic,
                 std::int64_t edge = kBlock);

/// Throws InputError naming up to ten spheres whose position is not finite, whose radius is not finite and
/// positive, whose density (where given) is not finite and positive, or that are larger than 64 periods of a
/// periodic axis.
void check_spheres(const SpheresView& spheres, const Lattice& lattice, const std::array<bool, 3>& periodic);

}  // namespace interstice::voxel
