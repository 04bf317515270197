// Shapes that walls and tools are made of. All lengths in metres.
#pragma once

#include <algorithm>
#include <variant>

#include "base/vec3.h"

namespace interstice {

/// An axis-aligned box [lo, hi].
struct Box {
  Vec3d lo, hi;

  Vec3d size() const { return hi - lo; }
  Vec3d center() const { return 0.5 * (lo + hi); }
  double volume() const {
    const Vec3d s = size();
    return s.x * s.y * s.z;
  }
  bool contains(const Vec3d& p) const {  // half open, so that neighbouring boxes share no point
    return p.x >= lo.x && p.x < hi.x && p.y >= lo.y && p.y < hi.y && p.z >= lo.z && p.z < hi.z;
  }
  /// The point of the box that is nearest to p.
  Vec3d nearest(const Vec3d& p) const {
    return {std::clamp(p.x, lo.x, hi.x), std::clamp(p.y, lo.y, hi.y), std::clamp(p.z, lo.z, hi.z)};
  }
  bool operator==(const Box&) const = default;
};

/// A half-space of solid: the plane through `point`, solid on the side opposite to the unit `normal`.
struct Plane {
  Vec3d point, normal;

  /// Signed distance [m], positive in the open (not solid) side.
  double distance(const Vec3d& p) const { return dot(p - point, normal); }
  bool operator==(const Plane&) const = default;
};

using Shape = std::variant<Plane, Box>;

/// `shape` moved by `offset` [m].
inline Shape translated(const Shape& shape, const Vec3d& offset) {
  if (const auto* plane = std::get_if<Plane>(&shape)) return Plane{plane->point + offset, plane->normal};
  const Box& box = std::get<Box>(shape);
  return Box{box.lo + offset, box.hi + offset};
}

}  // namespace interstice
