#include "voxel/walls.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"

namespace interstice::voxel {

namespace {

constexpr double kRounding = 1e-11;
constexpr double kInsideOut = 1e-6;  // of a block: less solid than none

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

Cover cover_of(const Ball& ball, const Box& box) {
  double nearest = 0, farthest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = box.lo[axis] - ball.center[axis], above = ball.center[axis] - box.hi[axis];
    const double outside = std::max({below, above, 0.0}), far = std::max(std::abs(below), std::abs(above));
    nearest += outside * outside;
    farthest += far * far;
  }
  const double square = ball.radius * ball.radius;
  return nearest >= square ? Cover::none : farthest <= square ? Cover::all : Cover::some;
}

Cover cover_of(const Cylinder& cylinder, const Box& box) {
  if (distance(cylinder, box.center()) >= 0.5 * norm(box.size())) return Cover::none;
  for (int corner = 0; corner < 8; ++corner)
    if (!contains(cylinder, {corner & 1 ? box.hi.x : box.lo.x, corner & 2 ? box.hi.y : box.lo.y,
                             corner & 4 ? box.hi.z : box.lo.z}))
      return Cover::some;
  return Cover::all;
}

Cover cover_of(const MeshSolid& mesh, const Box& box) {
  double volume = 0;
  add_mesh_volumes(mesh, box.lo, box.size(), {1, 1, 1}, &volume);
  const double share = volume / box.volume();
  if (share < -kInsideOut)
    throw InputError(
        "a mesh has a part that is turned inside out and no part around it; outer surfaces must face "
        "outwards, "
        "those of cavities inwards; turn it round where it was made");
  return share < kRounding / kBlockCells       ? Cover::none
         : share > 1 - kRounding / kBlockCells ? Cover::all
                                               : Cover::some;
}

/// Where a solid may be.
Box reach_of(const Plane&) { return {{-INFINITY, -INFINITY, -INFINITY}, {INFINITY, INFINITY, INFINITY}}; }
Box reach_of(const Box& box) { return box; }
Box reach_of(const Ball& ball) {
  const Vec3d r{ball.radius, ball.radius, ball.radius};
  return {ball.center - r, ball.center + r};
}
Box reach_of(const Cylinder& cylinder) { return bounds_of(cylinder); }
Box reach_of(const MeshSolid& mesh) { return mesh.bounds(); }

CellRange blocks_within(const Box& reach, const Lattice& lattice, const BlockGrid& grid) {
  CellRange blocks;
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = lattice.h[axis] * kBlock;
    blocks.lo[axis] = std::max<std::int64_t>(0, floor_index(reach.lo[axis] / edge));
    blocks.hi[axis] = std::min(grid.n[axis], floor_index(reach.hi[axis] / edge) + 1);
  }
  return blocks;
}

/// The solids that reach into a box.
Solids those_near(const Solids& solids, const Box& box) {
  Solids near;
  const auto keep = [&](const auto& all, auto& kept) {
    for (const auto& solid : all)
      if (cover_of(solid, box) != Cover::none) kept.push_back(solid);
  };
  for (const Shape& shape : solids.shapes)
    if (std::visit([&](const auto& solid) { return cover_of(solid, box); }, shape) != Cover::none)
      near.shapes.push_back(shape);
  keep(solids.balls, near.balls);
  keep(solids.cylinders, near.cylinders);
  return near;
}

}  // namespace

Solids relative_to(const Solids& solids, const Lattice& lattice) { return translated(solids, -lattice.lo); }

std::vector<WallBlock> wall_blocks(const Solids& local, const Lattice& lattice) {
  const BlockGrid grid(lattice);
  std::vector<WallBlock> found;
  for_each_solid(local, [&](const auto& solid) {
    const CellRange blocks = blocks_within(reach_of(solid), lattice, grid);
    if (blocks.empty()) return;
    std::vector<std::vector<WallBlock>> planes(static_cast<std::size_t>(blocks.size(0)));
    for_each_block({planes.size(), 1}, [&](std::size_t plane, std::size_t, std::size_t) {
      std::array<std::int64_t, 3> b{blocks.lo[0] + static_cast<std::int64_t>(plane), 0, 0};
      for (b[1] = blocks.lo[1]; b[1] < blocks.hi[1]; ++b[1])
        for (b[2] = blocks.lo[2]; b[2] < blocks.hi[2]; ++b[2]) {
          const Cover cover = cover_of(solid, local_box(lattice, block_cells(lattice, b)));
          if (cover != Cover::none) planes[plane].push_back({grid.key(b), cover == Cover::all});
        }
    });
    for (const auto& plane : planes) found.insert(found.end(), plane.begin(), plane.end());
  });
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
  const Solids near = those_near(local, around);
  std::fill_n(fractions, block.cells(), 0.0);
  for (const MeshSolid& mesh : local.meshes)
    add_mesh_volumes(mesh, around.lo, lattice.h, {block.size(0), block.size(1), block.size(2)}, fractions);
  for (std::int64_t i = block.lo[0]; i < block.hi[0]; ++i)
    for (std::int64_t j = block.lo[1]; j < block.hi[1]; ++j)
      for (std::int64_t k = block.lo[2]; k < block.hi[2]; ++k, ++fractions) {
        const Box box = local_box(lattice, {{i, j, k}, {i + 1, j + 1, k + 1}});
        const double volume = *fractions + (near.empty() ? 0.0 : solid_volume(near, box));
        const double share = volume / box.volume();
        *fractions = share < kRounding ? 0.0 : share > 1 - kRounding ? 1.0 : share;
      }
}

}  // namespace interstice::voxel
