// Solids bounded by triangles, and the volume that they take up in cells: exactly, since a polyhedron's
// volume over a column of cells is a sum over the triangles' shadows.
//
// Let a closed surface be turned outwards. Over a rectangle of the xy plane, the solid between the heights z0
// and z1 has the volume
//
//   sum over triangles of the integral of (min(z, z1) - z0)^+ dA,
//
// A counted positive where the triangle looks up, negative where it looks down. A triangle is cut into pieces
// along the faces of the cells, on which the integrand is linear. No ray is cast, so no ray can slip through
// an edge; sums are as good as rounding, about 1e-16 (triangle's length / cell's edge) of a cell.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/shapes.h"

namespace interstice::voxel {

using Triangle = std::array<Vec3d, 3>;

/// The triangles over a grid of rectangles of the xy plane.
struct ShadowGrid {
  Vec3d lo;
  double hx = 1, hy = 1;
  std::int64_t nx = 1, ny = 1;
  std::vector<std::size_t> first;  // of rectangle i + nx * j in `triangles`
  std::vector<std::uint32_t> triangles;
};

/// A closed surface, turned outwards.
struct TriangleMesh {
  std::vector<Triangle> triangles;  // [m]
  Box bounds;
  double volume = 0;  // [m^3]
  ShadowGrid shadows;
};

/// Checks triangles [m] and makes them a mesh. Corners belong together where they are the same to the bit;
/// triangles without area are dropped; a surface that is turned inwards altogether is turned round. Throws
/// InputError where the surface has an edge, so no inside, or where neighbours are turned differently.
TriangleMesh closed_mesh(std::vector<Triangle> triangles);

/// A mesh where it stands.
struct MeshSolid {
  std::shared_ptr<const TriangleMesh> mesh;
  Vec3d at;  // [m] added to its corners

  Box bounds() const { return {mesh->bounds.lo + at, mesh->bounds.hi + at}; }
};

/// The triangles (by number, ascending) whose shadows may reach into the rectangle of the xy plane [m, as the
/// mesh's corners are].
void triangles_over(const TriangleMesh& mesh, double x0, double x1, double y0, double y1,
                    std::vector<std::uint32_t>& numbers);

/// Adds the volumes [m^3] of the solid in n[0] x n[1] x n[2] cells of edges `h` [m] from `lo` [m] on, last
/// axis fastest. Where the surface runs through itself, places count as often as it winds around them.
void add_mesh_volumes(const MeshSolid& solid, const Vec3d& lo, const Vec3d& h,
                      const std::array<std::int64_t, 3>& n, double* volumes);

}  // namespace interstice::voxel
