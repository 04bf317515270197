// Walls and tools as the fields see them: volume that is neither powder nor void.
#pragma once

#include <vector>

#include "base/shapes.h"
#include "voxel/cylinder.h"
#include "voxel/mesh.h"

namespace interstice::voxel {

/// A solid ball.
struct Ball {
  Vec3d center;
  double radius = 0;  // [m]
};

struct Solids {
  std::vector<Shape> shapes = {};
  std::vector<Ball> balls = {};
  std::vector<Cylinder> cylinders = {};
  std::vector<MeshSolid> meshes = {};

  bool empty() const { return shapes.empty() && balls.empty() && cylinders.empty() && meshes.empty(); }
};

/// Calls visit(solid) for each Plane, Box, Ball, Cylinder and MeshSolid.
template <class Visit>
void for_each_solid(const Solids& solids, const Visit& visit) {
  for (const Shape& shape : solids.shapes) std::visit(visit, shape);
  for (const Ball& ball : solids.balls) visit(ball);
  for (const Cylinder& cylinder : solids.cylinders) visit(cylinder);
  for (const MeshSolid& mesh : solids.meshes) visit(mesh);
}

/// `solids` moved by `offset` [m].
Solids translated(const Solids& solids, const Vec3d& offset);

/// Volume [m^3] of the union of the solids inside `cell`. Exact for boxes and axis-aligned planes in any
/// number, and for one oblique plane (unit normal), ball, mesh or cylinder (an oblique one to 1e-9 of the
/// cell); where one of these overlaps another solid inside the cell, the sum of both, at most the cell.
double solid_volume(const Solids& solids, const Box& cell);

}  // namespace interstice::voxel
