#include "voxel/overlap.h"

#include <algorithm>

#include "voxel/overlap_large.h"

namespace interstice::voxel {

namespace {

// Above this R^3 / (cell volume within the sphere's bounding box) corners cancel too much (error about 1e-10
// of a cell) and surface cells are integrated one by one.
constexpr double kLargeSphere = 125'000;

// The planes of a block that are normal to one axis, as seen from the sphere: coordinates in units of its
// radius.
struct Planes {
  int cells = 0;
  double edge[kBlock + 1];  // as given
  double u[kBlock + 1];     // clamped to the ball, [-1, 1]
  double square[kBlock + 1];
  double sign[kBlock + 1];
  double cap[kBlock + 1];                    // quarter of ball_cap(|u|)
  double nearest[kBlock], farthest[kBlock];  // squared distance from the centre over each cell
};

void finish(Planes& p) {
  for (int i = 0; i <= p.cells; ++i) {
    const double u = std::clamp(p.edge[i], -1.0, 1.0);
    p.u[i] = u;
    p.square[i] = u * u;
    p.sign[i] = u > 0 ? 1.0 : u < 0 ? -1.0 : 0.0;
    p.cap[i] = 0.25 * ball_cap(std::abs(u));
  }
  for (int i = 0; i < p.cells; ++i) {
    const double a = p.edge[i], b = p.edge[i + 1];
    const double inner = a > 0 ? a : b < 0 ? b : 0.0, outer = std::max(std::abs(a), std::abs(b));
    p.nearest[i] = inner * inner;
    p.farthest[i] = outer * outer;
  }
}

Planes planes_of(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& block, int axis) {
  Planes p;
  p.cells = static_cast<int>(block.size(axis));
  const std::int64_t first = block.lo[axis] - sphere.cell[axis];
  for (int i = 0; i <= p.cells; ++i)
    p.edge[i] = (static_cast<double>(first + i) * lattice.h[axis] - sphere.offset[axis]) / sphere.radius;
  finish(p);
  return p;
}

Planes planes_of(double lo, double hi) {
  Planes p;
  p.cells = 1;
  p.edge[0] = lo;
  p.edge[1] = hi;
  finish(p);
  return p;
}

struct PairTable {
  double half[kBlock + 1][kBlock + 1];  // W / 2

  PairTable(const Planes& a, const Planes& b) {
    for (int i = 0; i <= a.cells; ++i)
      for (int j = 0; j <= b.cells; ++j) half[i][j] = 0.5 * ball_wedge(std::abs(a.u[i]), std::abs(b.u[j]));
  }
};

// Difference over y and z of F on the plane x = u_i: what the cells to its left and right share.
void plane_difference(const Planes& x, int i, const Planes& y, const Planes& z, const PairTable& xy,
                      const PairTable& yz, const PairTable& xz, double* difference) {
  double corner[2][kBlock + 1];
  for (int j = 0; j <= y.cells; ++j) {
    double* row = corner[j % 2];
    const double* previous = corner[(j + 1) % 2];
    const double square = x.square[i] + y.square[j], area = x.u[i] * y.u[j], sign = x.sign[i] * y.sign[j];
    const double outside = std::numbers::pi / 6 - (x.cap[i] + y.cap[j]) + xy.half[i][j];
    for (int k = 0; k <= z.cells; ++k) {
      const double beyond = outside - z.cap[k] + (yz.half[j][k] + xz.half[i][k]);
      row[k] = square + z.square[k] <= 1 ? area * z.u[k] : sign * z.sign[k] * beyond;
    }
    if (j > 0)
      for (int k = 0; k < z.cells; ++k)
        *difference++ = (row[k + 1] - previous[k + 1]) - (row[k] - previous[k]);
  }
}

// Cells with none of the sphere's surface in them are 0 or `full`; of the others, surface(i, j, k, &value).
template <class Surface>
void for_cells(const Planes& x, const Planes& y, const Planes& z, double full, double* out,
               const Surface& surface) {
  for (int i = 0; i < x.cells; ++i)
    for (int j = 0; j < y.cells; ++j)
      for (int k = 0; k < z.cells; ++k, ++out) {
        if (x.nearest[i] + y.nearest[j] + z.nearest[k] >= 1)
          *out = 0;
        else if (x.farthest[i] + y.farthest[j] + z.farthest[k] <= 1)
          *out = full;
        else
          surface(i, j, k, *out);
      }
}

// Volumes in all cells between the planes, times `scale`; a cell inside the ball is exactly `full`.
void cell_volumes(const Planes& x, const Planes& y, const Planes& z, bool large, double scale, double full,
                  double* out) {
  const auto bounded = [&](double unit_volume) { return std::clamp(unit_volume * scale, 0.0, full); };
  if (large) {
    for_cells(x, y, z, full, out, [&](int i, int j, int k, double& value) {
      value = bounded(
          unit_ball_in_box({x.edge[i], y.edge[j], z.edge[k]}, {x.edge[i + 1], y.edge[j + 1], z.edge[k + 1]}));
    });
    return;
  }
  const PairTable xy(x, y), yz(y, z), xz(x, z);
  double plane[2][kBlock * kBlock];
  const int cells = y.cells * z.cells;
  plane_difference(x, 0, y, z, xy, yz, xz, plane[0]);
  for (int i = 0; i < x.cells; ++i) {
    const double* before = plane[i % 2];
    double* after = plane[(i + 1) % 2];
    plane_difference(x, i + 1, y, z, xy, yz, xz, after);
    for (int c = 0; c < cells; ++c) out[i * cells + c] = after[c] - before[c];
  }
  for_cells(x, y, z, full, out, [&](int, int, int, double& value) { value = bounded(value); });
}

bool is_large(double radius, const Vec3d& edges) {
  double within = 1;  // in units of the radius; edges beyond the ball do not count
  for (int axis = 0; axis < 3; ++axis) within *= std::min(edges[axis] / radius, 2.0);
  return within * kLargeSphere < 1;
}

double one_box(const Planes& x, const Planes& y, const Planes& z, double radius) {
  const auto width = [](const Planes& p) { return p.edge[1] - p.edge[0]; };
  const Vec3d edges{width(x), width(y), width(z)};
  if (!(edges.x > 0 && edges.y > 0 && edges.z > 0)) return 0;
  double value = 0;
  cell_volumes(x, y, z, is_large(1.0, edges), 1.0, edges.x * edges.y * edges.z, &value);
  return value * (radius * radius * radius);
}

}  // namespace

PlacedSphere place(const Lattice& lattice, const Vec3d& center, double radius) {
  PlacedSphere sphere;
  sphere.radius = radius;
  const Vec3d local = center - lattice.lo;
  for (int axis = 0; axis < 3; ++axis) {
    sphere.cell[axis] = floor_index(local[axis] / lattice.h[axis]);
    sphere.offset[axis] = std::fma(-static_cast<double>(sphere.cell[axis]), lattice.h[axis], local[axis]);
  }
  return sphere;
}

CellRange bounding_cells(const Lattice& lattice, const PlacedSphere& sphere) {
  CellRange range;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = lattice.h[axis], at = sphere.offset[axis];
    range.lo[axis] = sphere.cell[axis] + floor_index((at - sphere.radius) / h);
    range.hi[axis] = sphere.cell[axis] + floor_index((at + sphere.radius) / h) + 1;
  }
  return range;
}

bool touches(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& range) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = lattice.h[axis], at = sphere.offset[axis];
    const double below = static_cast<double>(range.lo[axis] - sphere.cell[axis]) * h - at;
    const double above = at - static_cast<double>(range.hi[axis] - sphere.cell[axis]) * h;
    const double distance = std::max({below, above, 0.0});
    squared += distance * distance;
  }
  return squared < sphere.radius * sphere.radius;
}

double sphere_box_volume(const Vec3d& center, double radius, const Box& box) {
  const Vec3d lo = box.lo - center, hi = box.hi - center;
  return one_box(planes_of(lo.x / radius, hi.x / radius), planes_of(lo.y / radius, hi.y / radius),
                 planes_of(lo.z / radius, hi.z / radius), radius);
}

double sphere_range_volume(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& range) {
  const auto planes = [&](int axis) {
    const auto edge = [&](std::int64_t i) {
      return (static_cast<double>(i - sphere.cell[axis]) * lattice.h[axis] - sphere.offset[axis]) /
             sphere.radius;
    };
    return planes_of(edge(range.lo[axis]), edge(range.hi[axis]));
  };
  return one_box(planes(0), planes(1), planes(2), sphere.radius);
}

void exact_fractions(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& block,
                     double* fractions) {
  const double r = sphere.radius;
  const double scale = (r / lattice.h.x) * (r / lattice.h.y) * (r / lattice.h.z);
  cell_volumes(planes_of(lattice, sphere, block, 0), planes_of(lattice, sphere, block, 1),
               planes_of(lattice, sphere, block, 2), is_large(r, lattice.h), scale, 1.0, fractions);
}

}  // namespace interstice::voxel
