// How far points are from a wall's surface, and in which direction: of one point, or of a point a lane.
#pragma once

#include "base/shapes.h"
#include "dem/contact/numeric.h"

namespace interstice::dem {

template <class T>
struct WallDistance {
  T distance;      // [m], negative inside the wall
  Vec3<T> normal;  // unit, from the wall to the point
};

/// The same vector for every lane.
template <class T>
Vec3<T> in_every_lane(const Vec3d& v) {
  return {T(v.x), T(v.y), T(v.z)};
}

template <class T>
WallDistance<T> wall_distance(const Plane& plane, const Vec3<T>& p) {
  const Vec3<T> normal = in_every_lane<T>(plane.normal);
  return {dot(p - in_every_lane<T>(plane.point), normal), normal};
}

/// From a point inside out through the nearest face (the first of them, so that ties are decided the same
/// way).
template <class T>
WallDistance<T> distance_from_inside(const Vec3<T>& lo, const Vec3<T>& hi, const Vec3<T>& p) {
  WallDistance<T> best{T(-1e300), {T(0), T(0), T(1)}};
  for (int axis = 0; axis < 3; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const T depth = side == 0 ? lo[axis] - p[axis] : p[axis] - hi[axis];
      Vec3<T> normal{T(0), T(0), T(0)};
      normal[axis] = T(side == 0 ? -1 : 1);
      const auto nearer = depth > best.distance;
      best = {select(nearer, depth, best.distance), select(nearer, normal, best.normal)};
    }
  }
  return best;
}

template <class T>
WallDistance<T> wall_distance(const Box& box, const Vec3<T>& p) {
  const Vec3<T> lo = in_every_lane<T>(box.lo), hi = in_every_lane<T>(box.hi);
  const Vec3<T> nearest{min_of(max_of(p.x, lo.x), hi.x), min_of(max_of(p.y, lo.y), hi.y),
                        min_of(max_of(p.z, lo.z), hi.z)};
  const Vec3<T> away = p - nearest;
  const T squared = dot(away, away), inverse = inverse_root_of(squared);
  const WallDistance<T> from_outside{squared * inverse, inverse * away};
  const auto outside = squared > T(0);
  if (everywhere(outside)) [[likely]]
    return from_outside;
  const WallDistance<T> inside = distance_from_inside(lo, hi, p);
  return {select(outside, from_outside.distance, inside.distance),
          select(outside, from_outside.normal, inside.normal)};
}

template <class T>
WallDistance<T> wall_distance(const Shape& shape, const Vec3<T>& p) {
  if (const auto* plane = std::get_if<Plane>(&shape)) return wall_distance(*plane, p);
  return wall_distance(std::get<Box>(shape), p);
}

}  // namespace interstice::dem
