#include "coupling/figures/outline.h"

#include <fmt/format.h>

#include <cmath>
#include <variant>

namespace interstice::figures {
namespace {

/// Sutherland and Hodgman 1974: what of a convex polygon lies where a*x + b*y <= c.
Outline clipped(const Outline& polygon, double a, double b, double c) {
  Outline result;
  const auto excess = [&](const Point& p) { return a * p[0] + b * p[1] - c; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point& from = polygon[i];
    const Point& to = polygon[(i + 1) % polygon.size()];
    const double at_from = excess(from), at_to = excess(to);
    if (at_from <= 0) result.push_back(from);
    if ((at_from < 0 && at_to > 0) || (at_from > 0 && at_to < 0)) {
      const double t = at_from / (at_from - at_to);
      result.push_back({from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])});
    }
  }
  return result;
}

double area(const Outline& polygon) {
  double twice = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    twice += p[0] * q[1] - q[0] * p[1];
  }
  return std::abs(twice) / 2;
}

Outline corners(const Extent& e) { return {e.lo, {e.hi[0], e.lo[1]}, e.hi, {e.lo[0], e.hi[1]}}; }

/// The rectangle of `box` in the figure's axes, inside `extent`; empty where they do not meet.
Outline rectangle(const Box& box, std::array<int, 2> axes, const Extent& extent) {
  Extent r;
  for (std::size_t k = 0; k < 2; ++k) {
    r.lo[k] = std::max(extent.lo[k], box.lo[axes[k]]);
    r.hi[k] = std::min(extent.hi[k], box.hi[axes[k]]);
    if (!(r.lo[k] < r.hi[k])) return {};
  }
  return corners(r);
}

/// The solid side of `plane` on the flat section axis = at: n_h*h + n_v*v <= n.p - n_axis*at.
Outline section(const Plane& plane, int axis, double at, std::array<int, 2> axes, const Extent& extent) {
  const double c = dot(plane.normal, plane.point) - plane.normal[axis] * at;
  return clipped(corners(extent), plane.normal[axes[0]], plane.normal[axes[1]], c);
}

void keep(std::vector<Outline>& outlines, Outline outline, const Extent& extent) {
  const double least = 1e-9 * extent.width() * extent.height();
  if (outline.size() >= 3 && area(outline) > least) outlines.push_back(std::move(outline));
}

double solid_share(const std::vector<Outline>& outlines, const Extent& strip) {
  double covered = 0;
  for (const auto& outline : outlines) covered += area(outline);
  return std::min(1.0, covered / (strip.width() * strip.height()));
}

/// Whether most of what is open just inside a side is solid just outside it. (A wall that only runs on across
/// the side closes nothing.)
bool closes(double inside, double outside) {
  return 1 - inside > 1e-6 && outside - inside > 0.5 * (1 - inside);
}

std::string path_of(const Outline& outline, Point scale) {
  std::string path;
  for (std::size_t i = 0; i <= outline.size(); ++i) {
    const Point& p = outline[i % outline.size()];
    path += fmt::format("{} {:.7g},{:.7g}", i == 0 ? "from" : " to", p[0] * scale[0], p[1] * scale[1]);
  }
  return path;
}

}  // namespace

Outline clipped(const Outline& polygon, const Extent& extent) {
  Outline inside = clipped(polygon, 1, 0, extent.hi[0]);
  inside = clipped(inside, -1, 0, -extent.lo[0]);
  inside = clipped(inside, 0, 1, extent.hi[1]);
  return clipped(inside, 0, -1, -extent.lo[1]);
}

std::vector<Outline> cut(const std::vector<io::WallPose>& walls, int axis, double at, std::array<int, 2> axes,
                         const Extent& extent) {
  std::vector<Outline> outlines;
  for (const auto& wall : walls) {
    if (const auto* plane = std::get_if<Plane>(&wall.shape)) {
      keep(outlines, section(*plane, axis, at, axes, extent), extent);
    } else if (const auto& box = std::get<Box>(wall.shape); box.lo[axis] <= at && at <= box.hi[axis]) {
      keep(outlines, rectangle(box, axes, extent), extent);
    }
  }
  return outlines;
}

std::vector<Outline> silhouette(const std::vector<io::WallPose>& walls, int axis, std::array<int, 2> axes,
                                const Extent& extent) {
  std::vector<Outline> outlines;
  for (const auto& wall : walls) {
    if (const auto* plane = std::get_if<Plane>(&wall.shape)) {
      if (std::abs(plane->normal[axis]) > 1e-9) continue;
      keep(outlines, section(*plane, axis, 0, axes, extent), extent);
    } else {
      keep(outlines, rectangle(std::get<Box>(wall.shape), axes, extent), extent);
    }
  }
  return outlines;
}

Extent widened_to_walls(const std::vector<io::WallPose>& walls, int axis, double at, std::array<int, 2> axes,
                        const Extent& extent, Point margin) {
  Extent result = extent;
  for (std::size_t k = 0; k < 2; ++k) {
    const auto share = [&](double lo, double hi) {
      Extent strip = extent;
      strip.lo[k] = lo;
      strip.hi[k] = hi;
      return solid_share(cut(walls, axis, at, axes, strip), strip);
    };
    const double lo = extent.lo[k], hi = extent.hi[k], by = margin[k];
    if (closes(share(lo, lo + by), share(lo - by, lo))) result.lo[k] = lo - by;
    if (closes(share(hi - by, hi), share(hi, hi + by))) result.hi[k] = hi + by;
  }
  return result;
}

std::string hatched(const std::vector<Outline>& outlines, Point scale) {
  std::string commands;
  for (const auto& outline : outlines) {
    const std::string path = path_of(outline, scale);
    commands += fmt::format(
        "set object polygon {} front fillcolor rgb '#dcdcdc' fillstyle solid 1.0 noborder\n", path);
    commands += fmt::format(
        "set object polygon {} front fillcolor rgb '#8c8c8c' fillstyle transparent pattern 4 border lc rgb "
        "'#303030'\n",
        path);
  }
  return commands;
}

std::string edges(const std::vector<Outline>& outlines, Point scale) {
  std::string commands;
  for (const auto& outline : outlines) {
    commands +=
        fmt::format("set object polygon {} front fillstyle empty border lc rgb '#202020' linewidth 1.6\n",
                    path_of(outline, scale));
  }
  return commands;
}

}  // namespace interstice::figures
