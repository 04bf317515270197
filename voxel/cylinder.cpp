#include "voxel/cylinder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "voxel/quadrature.h"

namespace interstice::voxel {

namespace {

constexpr double kTolerance = 1e-10;  // of a cell, for oblique cylinders
constexpr double kNoise = 1e-13;      // of a cell: finer than this is rounding of areas

double cross(const Point2& a, const Point2& b) { return a.x * b.y - a.y * b.x; }
double dot(const Point2& a, const Point2& b) { return a.x * b.x + a.y * b.y; }

/// A cell's corner as the cylinder sees it: distance along its axis, and place across.
struct Corner {
  double along = 0;
  Point2 across;
};

/// The edges of a cell as pairs of corners; corner c lies at the upper end of axis a where bit a of c is set.
constexpr std::array<std::array<int, 2>, 12> kEdges{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

/// The section of a cell across the cylinder, between two neighbouring heights of the cell's corners: its
/// corners move along edges of the cell.
class Sections {
 public:
  Sections(const std::array<Corner, 8>& corners, double lo, double hi) {
    for (const auto& [a, b] : kEdges) {
      const bool rises = corners[a].along <= corners[b].along;
      const Corner &low = corners[rises ? a : b], &high = corners[rises ? b : a];
      if (low.along <= lo && high.along >= hi && high.along > low.along) edges_[count_++] = {low, high};
    }
    const double middle = 0.5 * (lo + hi);
    at(middle);
    Point2 centre;
    for (std::size_t e = 0; e < count_; ++e) centre.x += polygon_[e].x, centre.y += polygon_[e].y;
    const double n = static_cast<double>(std::max<std::size_t>(count_, 1));
    const auto angle = [&](const Edge& edge) {
      const Point2 p = edge.at(middle);
      return std::atan2(p.y - centre.y / n, p.x - centre.x / n);
    };
    std::sort(edges_.begin(), edges_.begin() + static_cast<std::ptrdiff_t>(count_),
              [&](const Edge& a, const Edge& b) { return angle(a) < angle(b); });
  }

  std::span<const Point2> at(double along) {
    for (std::size_t e = 0; e < count_; ++e) polygon_[e] = edges_[e].at(along);
    return {polygon_.data(), count_};
  }

 private:
  struct Edge {
    Corner low, high;
    Point2 at(double along) const {
      const double t = (along - low.along) / (high.along - low.along);
      return {low.across.x + t * (high.across.x - low.across.x),
              low.across.y + t * (high.across.y - low.across.y)};
    }
  };
  std::size_t count_ = 0;
  std::array<Edge, 12> edges_;
  std::array<Point2, 12> polygon_;
};

/// In units of the cell's largest edge.
double oblique_volume(const Cylinder& cylinder, const Box& cell) {
  const Vec3d size = cell.size();
  const double scale = 1 / std::max({size.x, size.y, size.z});
  const Vec3d span = cylinder.to - cylinder.from;
  const double length = norm(span);
  const Vec3d axis = (1 / length) * span;
  // across: away from the axis that the cylinder leans to least
  const Vec3d a{std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)};
  const Vec3d helper = a.x <= a.y && a.x <= a.z ? Vec3d{1, 0, 0}
                       : a.y <= a.z             ? Vec3d{0, 1, 0}
                                                : Vec3d{0, 0, 1};
  const Vec3d across = interstice::cross(axis, helper);
  const Vec3d u = (1 / norm(across)) * across, v = interstice::cross(axis, u);
  std::array<Corner, 8> corners;
  std::array<double, 8> heights;
  for (int c = 0; c < 8; ++c) {
    const Vec3d at =
        Vec3d{c & 1 ? cell.hi.x : cell.lo.x, c & 2 ? cell.hi.y : cell.lo.y, c & 4 ? cell.hi.z : cell.lo.z} -
        cylinder.from;
    corners[c] = {scale * interstice::dot(at, axis),
                  {scale * interstice::dot(at, u), scale * interstice::dot(at, v)}};
    heights[c] = corners[c].along;
  }
  std::sort(heights.begin(), heights.end());
  double volume = 0;
  for (std::size_t c = 0; c + 1 < heights.size(); ++c) {
    const double lo = std::max(heights[c], 0.0), hi = std::min(heights[c + 1], scale * length);
    if (!(hi > lo)) continue;
    Sections sections(corners, heights[c], heights[c + 1]);
    const auto area = [&](double along) {
      return disc_polygon_area(scale * cylinder.radius, sections.at(along));
    };
    volume += integrate(area, lo, hi, kTolerance * scale * scale * scale * cell.volume(), kNoise);
  }
  return volume / (scale * scale * scale);
}

}  // namespace

double disc_polygon_area(double radius, std::span<const Point2> polygon) {
  double twice = 0;
  for (std::size_t e = 0; e < polygon.size(); ++e) {
    const Point2 &p = polygon[e], &q = polygon[(e + 1) % polygon.size()];
    const Point2 d{q.x - p.x, q.y - p.y};
    const double turn = cross(p, d), along = dot(p, d), square = dot(d, d);
    if (square == 0) continue;
    // from a fraction `from` of the edge to a fraction `to`, as seen from the origin
    const auto sector = [&](double from, double to) {
      const double angle =
          std::atan2((to - from) * turn, dot(p, p) + (from + to) * along + from * to * square);
      return radius * radius * angle;
    };
    const double length = std::sqrt(square), reach = (radius * length - std::abs(turn));
    const double half = reach > 0 ? std::sqrt(reach * (radius * length + std::abs(turn))) : 0;
    const double enter = std::clamp((-along - half) / square, 0.0, 1.0),
                 leave = std::clamp((-along + half) / square, 0.0, 1.0);
    if (reach <= 0 || enter >= leave) {
      twice += sector(0, 1);
      continue;
    }
    twice += (leave - enter) * turn;
    if (enter > 0) twice += sector(0, enter);
    if (leave < 1) twice += sector(leave, 1);
  }
  return 0.5 * twice;
}

int parallel_axis(const Cylinder& cylinder) {
  const Vec3d span = cylinder.to - cylinder.from;
  for (int axis = 0; axis < 3; ++axis)
    if (span[(axis + 1) % 3] == 0 && span[(axis + 2) % 3] == 0) return axis;
  return -1;
}

double cylinder_volume(const Cylinder& cylinder, const Box& cell) {
  const int axis = parallel_axis(cylinder);
  if (axis < 0) return std::clamp(oblique_volume(cylinder, cell), 0.0, cell.volume());
  const double lo = std::max(cell.lo[axis], std::min(cylinder.from[axis], cylinder.to[axis]));
  const double hi = std::min(cell.hi[axis], std::max(cylinder.from[axis], cylinder.to[axis]));
  if (!(hi > lo)) return 0;
  const int a = (axis + 1) % 3, b = (axis + 2) % 3;
  const Vec3d low = cell.lo - cylinder.from, high = cell.hi - cylinder.from;
  const std::array<Point2, 4> rectangle{
      {{low[a], low[b]}, {high[a], low[b]}, {high[a], high[b]}, {low[a], high[b]}}};
  const double area = disc_polygon_area(cylinder.radius, rectangle);
  return std::clamp(area, 0.0, (high[a] - low[a]) * (high[b] - low[b])) * (hi - lo);
}

bool contains(const Cylinder& cylinder, const Vec3d& point) { return distance(cylinder, point) == 0; }

Box bounds_of(const Cylinder& cylinder) {
  const Vec3d span = cylinder.to - cylinder.from;
  const double square = interstice::dot(span, span);
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    // how far the rim of an end reaches along the axis
    const double rim =
        cylinder.radius * std::sqrt(std::max(0.0, 1 - span[axis] * span[axis] / square)) * (1 + 1e-12);
    box.lo[axis] = std::min(cylinder.from[axis], cylinder.to[axis]) - rim;
    box.hi[axis] = std::max(cylinder.from[axis], cylinder.to[axis]) + rim;
  }
  return box;
}

double distance(const Cylinder& cylinder, const Vec3d& point) {
  const Vec3d span = cylinder.to - cylinder.from, at = point - cylinder.from;
  const double length = norm(span), along = interstice::dot(at, span) / length;
  const double across = std::sqrt(std::max(0.0, interstice::dot(at, at) - along * along));
  const double beyond = std::max({-along, along - length, 0.0});
  const double beside = std::max(across - cylinder.radius, 0.0);
  return std::sqrt(beyond * beyond + beside * beside);
}

}  // namespace interstice::voxel
