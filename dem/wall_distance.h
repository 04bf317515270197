// How far a point is from a wall's surface, and in which direction.
#pragma once

#include <cmath>

#include "base/shapes.h"

namespace interstice::dem {

struct WallDistance {
  double distance;  // [m], negative inside the wall
  Vec3d normal;     // unit, from the wall to the point
};

inline WallDistance wall_distance(const Plane& plane, const Vec3d& p) {
  return {plane.distance(p), plane.normal};
}

inline WallDistance wall_distance(const Box& box, const Vec3d& p) {
  const Vec3d away = p - box.nearest(p);
  const double d2 = dot(away, away);
  if (d2 > 0) {
    const double d = std::sqrt(d2);
    return {d, (1 / d) * away};
  }
  // The centre is inside: out through the nearest face (the first of them, so that ties are decided the same
  // way).
  WallDistance best{-1e300, {0, 0, 1}};
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const double depth = side == 0 ? box.lo[axis] - p[axis] : p[axis] - box.hi[axis];
      if (depth > best.distance) {
        best.distance = depth;
        best.normal = {0, 0, 0};
        best.normal[axis] = side == 0 ? -1 : 1;
      }
    }
  }
  return best;
}

inline WallDistance wall_distance(const Shape& shape, const Vec3d& p) {
  if (const auto* plane = std::get_if<Plane>(&shape)) return wall_distance(*plane, p);
  return wall_distance(std::get<Box>(shape), p);
}

}  // namespace interstice::dem
