#include "voxel/touch.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace interstice::voxel {

namespace {

double squared(const Vec3d& v) { return dot(v, v); }

double squared_to_segment(const Vec3d& a, const Vec3d& b, const Vec3d& p) {
  const Vec3d along = b - a;
  const double length = squared(along);
  const double at = length > 0 ? std::clamp(dot(p - a, along) / length, 0.0, 1.0) : 0.0;
  return squared(p - (a + at * along));
}

/// Straight down onto the triangle where that is the nearest point, else to the nearest of its edges.
double squared_to_triangle(const Triangle& t, const Vec3d& p) {
  const Vec3d normal = cross(t[1] - t[0], t[2] - t[0]);
  bool over = squared(normal) > 0;
  double nearest = INFINITY;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3d &a = t[c], &b = t[(c + 1) % 3];
    over = over && dot(cross(b - a, p - a), normal) >= 0;
    nearest = std::min(nearest, squared_to_segment(a, b, p));
  }
  if (!over) return nearest;
  const double height = dot(p - t[0], normal);
  return std::min(nearest, height * height / squared(normal));
}

/// Of a point that is further from the surface than `far`: by the solid's volume in a cube around it that the
/// surface does not reach.
bool inside(const MeshSolid& solid, const Vec3d& point, double far) {
  const Vec3d edge{far, far, far};
  double volume = 0;
  add_mesh_volumes(solid, point - 0.5 * edge, edge, {1, 1, 1}, &volume);
  return volume > 0.5 * far * far * far;
}

}  // namespace

bool within_reach(const Plane& plane, const Vec3d& center, double reach) {
  return plane.distance(center) <= reach;
}

bool within_reach(const Box& box, const Vec3d& center, double reach) {
  return squared(center - box.nearest(center)) <= reach * reach;
}

bool within_reach(const Ball& ball, const Vec3d& center, double reach) {
  return norm(center - ball.center) <= ball.radius + reach;
}

bool within_reach(const Cylinder& cylinder, const Vec3d& center, double reach) {
  return distance(cylinder, center) <= reach;
}

bool within_reach(const MeshSolid& solid, const Vec3d& center, double reach) {
  if (!within_reach(solid.bounds(), center, reach)) return false;
  const TriangleMesh& mesh = *solid.mesh;
  const Vec3d at = center - solid.at;
  thread_local std::vector<std::uint32_t> near;
  triangles_over(mesh, at.x - reach, at.x + reach, at.y - reach, at.y + reach, near);
  for (const std::uint32_t t : near)
    if (squared_to_triangle(mesh.triangles[t], at) <= reach * reach) return true;
  return inside(solid, center, reach);
}

}  // namespace interstice::voxel
