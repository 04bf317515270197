#include "voxel/walls.h"

#include <algorithm>
#include <cmath>

namespace interstice::voxel {

namespace {

constexpr double kRounding = 1e-11;

enum class Cover { none, some, all };

Box local_box(const Lattice& lattice, const CellRange& cells) {
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = static_cast<double>(cells.lo[axis]) * lattice.h[axis];
    box.hi[axis] = static_cast<double>(cells.hi[axis]) * lattice.h[axis];
  }
  return box;
}

Cover cover_of(const Plane& plane, const Box& box) {
  const Vec3d half = 0.5 * box.size();
  const double reach = std::abs(plane.normal.x) * half.x + std::abs(plane.normal.y) * half.y +
                       std::abs(plane.normal.z) * half.z;
  const double distance = plane.distance(box.center());
  return distance >= reach ? Cover::none : distance <= -reach ? Cover::all : Cover::some;
}

Cover cover_of(const Box& solid, const Box& box) {
  Cover cover = Cover::all;
  for (int axis = 0; axis < 3; ++axis) {
    if (solid.hi[axis] <= box.lo[axis] || solid.lo[axis] >= box.hi[axis]) return Cover::none;
    if (solid.lo[axis] > box.lo[axis] || solid.hi[axis] < box.hi[axis]) cover = Cover::some;
  }
  return cover;
}

Cover cover_of(const Shape& shape, const Box& box) {
  return std::visit([&](const auto& solid) { return cover_of(solid, box); }, shape);
}

// Blocks that may hold something of the shape: a box's own, all for a plane.
CellRange candidate_blocks(const Shape& shape, const Lattice& lattice, const BlockGrid& grid) {
  CellRange blocks{{0, 0, 0}, grid.n};
  if (const auto* box = std::get_if<Box>(&shape))
    for (int axis = 0; axis < 3; ++axis) {
      const double edge = lattice.h[axis] * kBlock;
      blocks.lo[axis] = std::max<std::int64_t>(0, floor_index(box->lo[axis] / edge));
      blocks.hi[axis] = std::min(grid.n[axis], floor_index(box->hi[axis] / edge) + 1);
    }
  return blocks;
}

}  // namespace

Solids relative_to(const Solids& solids, const Lattice& lattice) {
  Solids local;
  for (const Shape& shape : solids.shapes) local.shapes.push_back(translated(shape, -lattice.lo));
  return local;
}

std::vector<WallBlock> wall_blocks(const Solids& local, const Lattice& lattice) {
  const BlockGrid grid(lattice);
  std::vector<WallBlock> found;
  for (const Shape& shape : local.shapes) {
    const CellRange blocks = candidate_blocks(shape, lattice, grid);
    std::array<std::int64_t, 3> b;
    for (b[0] = blocks.lo[0]; b[0] < blocks.hi[0]; ++b[0])
      for (b[1] = blocks.lo[1]; b[1] < blocks.hi[1]; ++b[1])
        for (b[2] = blocks.lo[2]; b[2] < blocks.hi[2]; ++b[2]) {
          const Cover cover = cover_of(shape, local_box(lattice, block_cells(lattice, b)));
          if (cover != Cover::none) found.push_back({grid.key(b), cover == Cover::all});
        }
  }
  std::sort(found.begin(), found.end(), [](const WallBlock& a, const WallBlock& b) {
    return a.key != b.key ? a.key < b.key : a.full > b.full;
  });
  found.erase(std::unique(found.begin(), found.end(),
                          [](const WallBlock& a, const WallBlock& b) { return a.key == b.key; }),
              found.end());
  return found;
}

void wall_fractions(const Solids& local, const Lattice& lattice, const CellRange& block, double* fractions) {
  const Box around = local_box(lattice, block);
  Solids near;
  for (const Shape& shape : local.shapes)
    if (cover_of(shape, around) != Cover::none) near.shapes.push_back(shape);
  CellRange cell;
  for (std::int64_t i = block.lo[0]; i < block.hi[0]; ++i)
    for (std::int64_t j = block.lo[1]; j < block.hi[1]; ++j)
      for (std::int64_t k = block.lo[2]; k < block.hi[2]; ++k) {
        cell = {{i, j, k}, {i + 1, j + 1, k + 1}};
        const Box box = local_box(lattice, cell);
        const double share = near.empty() ? 0.0 : solid_volume(near, box) / box.volume();
        *fractions++ = share < kRounding ? 0.0 : share > 1 - kRounding ? 1.0 : share;
      }
}

}  // namespace interstice::voxel
