#include "coupling/figures/section.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace interstice::figures {
namespace {

constexpr int kSides = 180;  // of a circle

struct CutPlane {
  int axis;
  double at;
  std::array<int, 2> axes;

  bool above(const Vec3d& p) const { return p[axis] >= at; }
  /// Where the line from p to q meets the plane; the same bits from q to p.
  Point meet(Vec3d p, Vec3d q) const {
    if (above(p)) std::swap(p, q);
    const double t = (at - p[axis]) / (q[axis] - p[axis]);
    return {p[axes[0]] + t * (q[axes[0]] - p[axes[0]]), p[axes[1]] + t * (q[axes[1]] - p[axes[1]])};
  }
};

/// The corners of a convex figure, in turn (A. M. Andrew, Inf. Process. Lett. 9, 1979, 216).
Outline hull(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return {};
  Outline outline;
  const auto chain = [&](const auto& from, const auto& to) {
    const std::size_t base = outline.size();
    for (auto p = from; p != to; ++p) {
      while (outline.size() >= base + 2) {
        const Point &a = outline[outline.size() - 2], &b = outline.back();
        if ((b[0] - a[0]) * ((*p)[1] - a[1]) - (b[1] - a[1]) * ((*p)[0] - a[0]) > 0) break;
        outline.pop_back();
      }
      outline.push_back(*p);
    }
    outline.pop_back();  // the other chain begins with it
  };
  chain(points.begin(), points.end());
  chain(points.rbegin(), points.rend());
  return outline;
}

Outline section_of(const voxel::Ball& ball, const CutPlane& plane) {
  const double off = plane.at - ball.center[plane.axis], square = ball.radius * ball.radius - off * off;
  Outline outline;
  for (int s = 0; s < kSides && square > 0; ++s) {
    const double angle = 2 * std::numbers::pi * s / kSides, r = std::sqrt(square);
    outline.push_back(
        {ball.center[plane.axes[0]] + r * std::cos(angle), ball.center[plane.axes[1]] + r * std::sin(angle)});
  }
  return outline;
}

Outline section_of(const voxel::Cylinder& cylinder, const CutPlane& plane) {
  const Vec3d span = cylinder.to - cylinder.from, axis = (1 / norm(span)) * span;
  const Vec3d helper = std::abs(axis.x) < 0.7 ? Vec3d{1, 0, 0} : Vec3d{0, 1, 0};
  const Vec3d side = cross(axis, helper), u = (1 / norm(side)) * side, v = cross(axis, u);
  const auto rim = [&](int s) {
    const double angle = 2 * std::numbers::pi * (s % kSides) / kSides;
    return cylinder.radius * (std::cos(angle) * u + std::sin(angle) * v);
  };
  std::vector<Point> points;
  const auto add = [&](const Vec3d& p, const Vec3d& q) {
    if (plane.above(p) != plane.above(q)) points.push_back(plane.meet(p, q));
  };
  for (int s = 0; s < kSides; ++s) {
    const Vec3d here = rim(s), next = rim(s + 1);
    add(cylinder.from + here, cylinder.to + here);
    add(cylinder.from + here, cylinder.from + next);
    add(cylinder.to + here, cylinder.to + next);
  }
  return hull(std::move(points));
}

/// Each triangle's cut leads from the edge on which its border rises through the plane to that on which it
/// falls, where the neighbour's begins.
std::vector<Outline> sections_of(const voxel::MeshSolid& solid, const CutPlane& plane) {
  std::multimap<Point, Point> next;
  for (const voxel::Triangle& triangle : solid.mesh->triangles) {
    std::optional<Point> from, to;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3d p = triangle[c] + solid.at, q = triangle[(c + 1) % 3] + solid.at;
      if (plane.above(p) == plane.above(q)) continue;
      (plane.above(q) ? from : to) = plane.meet(p, q);
    }
    if (from && to && *from != *to) next.emplace(*from, *to);
  }
  std::vector<Outline> outlines;
  while (!next.empty()) {
    Outline outline;
    for (auto step = next.begin(); step != next.end();) {
      outline.push_back(step->first);
      const Point to = step->second;
      next.erase(step);
      step = next.find(to);
    }
    outlines.push_back(std::move(outline));
  }
  return outlines;
}

}  // namespace

std::vector<Outline> sections(const voxel::Solids& solids, int axis, double at, std::array<int, 2> axes,
                              const Extent& extent) {
  std::vector<io::WallPose> walls;
  for (const Shape& shape : solids.shapes) walls.push_back({"", shape});
  std::vector<Outline> outlines = cut(walls, axis, at, axes, extent);
  const CutPlane plane{axis, at, axes};
  const auto keep = [&](const Outline& whole) {
    Outline outline = clipped(whole, extent);
    if (outline.size() >= 3) outlines.push_back(std::move(outline));
  };
  for (const voxel::Ball& ball : solids.balls) keep(section_of(ball, plane));
  for (const voxel::Cylinder& cylinder : solids.cylinders) keep(section_of(cylinder, plane));
  for (const voxel::MeshSolid& mesh : solids.meshes)
    for (const Outline& outline : sections_of(mesh, plane)) keep(outline);
  return outlines;
}

}  // namespace interstice::figures
