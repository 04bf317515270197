#include "voxel/mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "base/error.h"
#include "voxel/lattice.h"
#include "voxel/sum.h"
#include "voxel/text.h"

namespace interstice::voxel {

namespace {

std::string place_text(const Vec3d& p) {
  std::string text = "(";
  for (int axis = 0; axis < 3; ++axis) text += (axis ? ", " : "") + shown(p[axis], 6);
  return text + ") m";
}

bool before(const Vec3d& a, const Vec3d& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// The number of each corner of each triangle, the same for corners at the same place.
std::vector<std::array<std::uint32_t, 3>> numbered(const std::vector<Triangle>& triangles,
                                                   std::vector<Vec3d>& points) {
  for (const Triangle& triangle : triangles)
    for (const Vec3d& p : triangle) points.push_back(p);
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  std::vector<std::array<std::uint32_t, 3>> corners(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t)
    for (std::size_t c = 0; c < 3; ++c)
      corners[t][c] = static_cast<std::uint32_t>(
          std::lower_bound(points.begin(), points.end(), triangles[t][c], before) - points.begin());
  return corners;
}

struct Edge {
  std::uint32_t low, high;
  int turn;  // +1: its triangle goes from low to high
};

/// Every edge must belong to as many triangles that run along it as against it.
void check_closed(const std::vector<Triangle>& triangles) {
  std::vector<Vec3d> points;
  const auto corners = numbered(triangles, points);
  std::vector<Edge> edges;
  for (const auto& corner : corners)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::uint32_t a = corner[c], b = corner[(c + 1) % 3];
      edges.push_back(a < b ? Edge{a, b, 1} : Edge{b, a, -1});
    }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.turn < b.turn;
  });
  std::size_t open = 0, turned = 0, open_at = 0, turned_at = 0;
  for (std::size_t e = 0, end = 0; e < edges.size(); e = end) {
    int turns = 0;
    for (end = e; end < edges.size() && edges[end].low == edges[e].low && edges[end].high == edges[e].high;
         ++end)
      turns += edges[end].turn;
    if ((end - e) % 2 == 1) {
      if (open++ == 0) open_at = e;
    } else if (turns != 0 && turned++ == 0) {
      turned_at = e;
    }
  }
  const auto from_to = [&](std::size_t e) {
    return "from " + place_text(points[edges[e].low]) + " to " + place_text(points[edges[e].high]);
  };
  if (open > 0)
    throw InputError("the surface is not closed: " + std::to_string(open) +
                     " edges lack a neighbour, the first " + from_to(open_at) +
                     "; a closed surface is needed, whose corners agree in all digits; close or merge it "
                     "where it was made");
  if (turned > 0)
    throw InputError("the surface is not turned the same way everywhere: " + std::to_string(turned) +
                     " edges between triangles that face opposite sides, the first " + from_to(turned_at) +
                     "; all triangles must face outwards; unify the normals where it was made");
}

double volume_of(const std::vector<Triangle>& triangles, const Vec3d& origin) {
  CompensatedSum sum;
  for (const Triangle& t : triangles) sum.add(dot(t[0] - origin, cross(t[1] - origin, t[2] - origin)) / 6);
  return sum.value();
}

Box bounds_of(const std::vector<Triangle>& triangles) {
  Box box{triangles[0][0], triangles[0][0]};
  for (const Triangle& triangle : triangles)
    for (const Vec3d& p : triangle)
      for (int axis = 0; axis < 3; ++axis) {
        box.lo[axis] = std::min(box.lo[axis], p[axis]);
        box.hi[axis] = std::max(box.hi[axis], p[axis]);
      }
  return box;
}

struct Rectangles {
  std::int64_t i0, i1, j0, j1;  // inclusive
};

Rectangles under(const ShadowGrid& grid, double x0, double x1, double y0, double y1) {
  const auto at = [](double value, double lo, double h, std::int64_t n) {
    return std::clamp<std::int64_t>(floor_index((value - lo) / h), 0, n - 1);
  };
  return {at(x0, grid.lo.x, grid.hx, grid.nx), at(x1, grid.lo.x, grid.hx, grid.nx),
          at(y0, grid.lo.y, grid.hy, grid.ny), at(y1, grid.lo.y, grid.hy, grid.ny)};
}

Rectangles under(const ShadowGrid& grid, const Triangle& t) {
  return under(grid, std::min({t[0].x, t[1].x, t[2].x}), std::max({t[0].x, t[1].x, t[2].x}),
               std::min({t[0].y, t[1].y, t[2].y}), std::max({t[0].y, t[1].y, t[2].y}));
}

/// About as many rectangles as triangles.
ShadowGrid shadows_of(const std::vector<Triangle>& triangles, const Box& bounds) {
  ShadowGrid grid;
  grid.lo = bounds.lo;
  const Vec3d size = bounds.size();
  const double edge = std::sqrt(size.x * size.y / static_cast<double>(triangles.size()));
  const auto cut = [&](double length, double& h) {
    const auto n = std::clamp<std::int64_t>(edge > 0 ? floor_index(length / edge) : 1, 1, 4096);
    h = length > 0 ? length / static_cast<double>(n) : 1.0;
    return n;
  };
  grid.nx = cut(size.x, grid.hx);
  grid.ny = cut(size.y, grid.hy);
  grid.first.assign(static_cast<std::size_t>(grid.nx * grid.ny) + 1, 0);
  const auto for_each = [&](const auto& use) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      const Rectangles r = under(grid, triangles[t]);
      for (std::int64_t j = r.j0; j <= r.j1; ++j)
        for (std::int64_t i = r.i0; i <= r.i1; ++i) use(t, static_cast<std::size_t>(i + grid.nx * j));
    }
  };
  for_each([&](std::size_t, std::size_t rectangle) { ++grid.first[rectangle + 1]; });
  std::partial_sum(grid.first.begin(), grid.first.end(), grid.first.begin());
  grid.triangles.resize(grid.first.back());
  std::vector<std::size_t> next(grid.first.begin(), grid.first.end() - 1);
  for_each([&](std::size_t t, std::size_t rectangle) {
    grid.triangles[next[rectangle]++] = static_cast<std::uint32_t>(t);
  });
  return grid;
}

/// Part of a triangle: a convex polygon of three corners and one more for each of six cuts, and room for what
/// rounding adds.
struct Piece {
  std::array<Vec3d, 16> corners;
  std::size_t count = 0;

  void add(const Vec3d& p) { corners[count++] = p; }
};

/// The part of `piece` where side * (p[axis] - at) <= 0.
Piece part(const Piece& piece, int axis, double at, double side) {
  Piece kept;
  for (std::size_t c = 0; c < piece.count; ++c) {
    const Vec3d &p = piece.corners[c], &q = piece.corners[c + 1 < piece.count ? c + 1 : 0];
    const double here = side * (p[axis] - at), there = side * (q[axis] - at);
    if (here <= 0) kept.add(p);
    if ((here < 0 && there > 0) || (here > 0 && there < 0)) {
      Vec3d cut = p + (here / (here - there)) * (q - p);
      cut[axis] = at;
      kept.add(cut);
    }
  }
  return kept;
}

std::array<double, 2> range_of(const Piece& piece, int axis) {
  std::array<double, 2> range{INFINITY, -INFINITY};
  for (std::size_t c = 0; c < piece.count; ++c) {
    range[0] = std::min(range[0], piece.corners[c][axis]);
    range[1] = std::max(range[1], piece.corners[c][axis]);
  }
  return range;
}

/// Of the piece's shadow: signed area, and the integral of z over it.
std::array<double, 2> area_and_moment(const Piece& piece) {
  std::array<double, 2> sums{0, 0};
  const Vec3d& a = piece.corners[0];
  for (std::size_t c = 1; c + 1 < piece.count; ++c) {
    const Vec3d &b = piece.corners[c], &d = piece.corners[c + 1];
    const double area = 0.5 * ((b.x - a.x) * (d.y - a.y) - (d.x - a.x) * (b.y - a.y));
    sums[0] += area;
    sums[1] += area * (a.z + b.z + d.z) / 3;
  }
  return sums;
}

/// Adds what is under the piece, which lies over one column, to the column's cells, from z = 0 on.
void add_column(Piece piece, double h, std::int64_t n, double* volumes) {
  const auto [least, most] = range_of(piece, 2);
  if (least < 0) piece = part(piece, 2, 0, -1);
  const auto k0 = std::clamp<std::int64_t>(floor_index(least / h), 0, n);
  if (k0 > 0) {
    const double under = h * area_and_moment(piece)[0];
    for (std::int64_t k = 0; k < k0; ++k) volumes[k] += under;
  }
  for (std::int64_t k = k0; k < n && piece.count >= 3; ++k) {
    const double bottom = static_cast<double>(k) * h, top = bottom + h;
    Piece within = piece;
    if (most > top) {
      within = part(piece, 2, top, 1);
      piece = part(piece, 2, top, -1);
      volumes[k] += h * area_and_moment(piece)[0];
    } else {
      piece.count = 0;
    }
    const auto [area, moment] = area_and_moment(within);
    volumes[k] += moment - area * bottom;
  }
}

/// Of a triangle as seen from the cells' lower corner.
void add_triangle(const Triangle& triangle, const Vec3d& h, const std::array<std::int64_t, 3>& n,
                  double* volumes) {
  Piece whole;
  for (const Vec3d& p : triangle) whole.add(p);
  if (range_of(whole, 2)[1] <= 0) return;
  const auto cells = [&](const Piece& piece, int axis) {
    const auto [lo, hi] = range_of(piece, axis);
    return std::array<std::int64_t, 2>{std::max<std::int64_t>(0, floor_index(lo / h[axis])),
                                       std::min(n[axis] - 1, floor_index(hi / h[axis]))};
  };
  const auto slab = [&](const Piece& piece, int axis, std::int64_t i) {
    const auto [lo, hi] = range_of(piece, axis);
    const double from = static_cast<double>(i) * h[axis], to = static_cast<double>(i + 1) * h[axis];
    Piece kept = lo < from ? part(piece, axis, from, -1) : piece;
    return hi > to ? part(kept, axis, to, 1) : kept;
  };
  const auto [i0, i1] = cells(whole, 0);
  for (std::int64_t i = i0; i <= i1; ++i) {
    const Piece strip = slab(whole, 0, i);
    if (strip.count < 3) continue;
    const auto [j0, j1] = cells(strip, 1);
    for (std::int64_t j = j0; j <= j1; ++j) {
      const Piece piece = slab(strip, 1, j);
      if (piece.count >= 3) add_column(piece, h.z, n[2], volumes + (i * n[1] + j) * n[2]);
    }
  }
}

}  // namespace

TriangleMesh closed_mesh(std::vector<Triangle> triangles) {
  std::erase_if(triangles, [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  if (triangles.empty()) throw InputError("a surface without triangles; at least four are needed");
  check_closed(triangles);
  TriangleMesh mesh;
  mesh.bounds = bounds_of(triangles);
  mesh.volume = volume_of(triangles, mesh.bounds.center());
  if (mesh.volume < 0) {
    for (Triangle& t : triangles) std::swap(t[1], t[2]);
    mesh.volume = -mesh.volume;
  }
  mesh.shadows = shadows_of(triangles, mesh.bounds);
  mesh.triangles = std::move(triangles);
  return mesh;
}

void triangles_over(const TriangleMesh& mesh, double x0, double x1, double y0, double y1,
                    std::vector<std::uint32_t>& numbers) {
  const ShadowGrid& grid = mesh.shadows;
  const Rectangles r = under(grid, x0, x1, y0, y1);
  numbers.clear();
  for (std::int64_t j = r.j0; j <= r.j1; ++j)
    for (std::int64_t i = r.i0; i <= r.i1; ++i) {
      const auto rectangle = static_cast<std::size_t>(i + grid.nx * j);
      numbers.insert(numbers.end(),
                     grid.triangles.begin() + static_cast<std::ptrdiff_t>(grid.first[rectangle]),
                     grid.triangles.begin() + static_cast<std::ptrdiff_t>(grid.first[rectangle + 1]));
    }
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

void add_mesh_volumes(const MeshSolid& solid, const Vec3d& lo, const Vec3d& h,
                      const std::array<std::int64_t, 3>& n, double* volumes) {
  const TriangleMesh& mesh = *solid.mesh;
  const Vec3d shift = solid.at - lo;
  Vec3d size;
  for (int axis = 0; axis < 3; ++axis) {
    size[axis] = static_cast<double>(n[axis]) * h[axis];
    if (mesh.bounds.hi[axis] + shift[axis] <= 0 || mesh.bounds.lo[axis] + shift[axis] >= size[axis]) return;
  }
  thread_local std::vector<std::uint32_t> near;
  triangles_over(mesh, -shift.x, size.x - shift.x, -shift.y, size.y - shift.y, near);
  for (const std::uint32_t t : near) {
    Triangle triangle = mesh.triangles[t];
    for (Vec3d& p : triangle) p += shift;
    add_triangle(triangle, h, n, volumes);
  }
}

}  // namespace interstice::voxel
