#include "voxel/overlap.h"

#include <algorithm>
#include <type_traits>

#include "voxel/overlap_large.h"

namespace interstice::voxel {

namespace {

// Above this R^3 / (cell volume within the sphere's bounding box) corners cancel too much (error about 1e-10
// of a cell) and surface cells are integrated one by one.
constexpr double kLargeSphere = 125'000;

// Rows of corners and cells are padded to a multiple of four, so that compilers can work on whole rows at
// once.
constexpr int kPadded = 12;
static_assert(kPadded > kBlock);

// Calls body(std::integral_constant<int, N>) with the least such N that holds the planes of so many cells.
template <class Body>
void with_lanes(int cells, const Body& body) {
  if (cells < 4) return body(std::integral_constant<int, 4>());
  if (cells < 8) return body(std::integral_constant<int, 8>());
  body(std::integral_constant<int, kPadded>());
}

// The planes of a block that are normal to one axis, as seen from the sphere: coordinates in units of its
// radius. Padding repeats the last plane; cells between padded planes are never read.
struct Planes {
  int cells = 0;
  double edge[kPadded];  // as given
  double u[kPadded];     // clamped to the ball, [-1, 1]
  double square[kPadded];
  double sign[kPadded];
  double cap[kPadded];                         // quarter of ball_cap(|u|)
  double nearest[kPadded], farthest[kPadded];  // squared distance from the centre over each cell
};

template <int Lanes>
void finish(Planes& p) {
  for (int i = p.cells + 1; i < Lanes; ++i) p.edge[i] = p.edge[p.cells];
  for (int i = 0; i < Lanes; ++i) {
    const double u = std::clamp(p.edge[i], -1.0, 1.0);
    p.u[i] = u;
    p.square[i] = u * u;
    p.sign[i] = u > 0 ? 1.0 : u < 0 ? -1.0 : 0.0;
    p.cap[i] = 0.25 * ball_cap(std::abs(u));
  }
  for (int i = 0; i < Lanes; ++i) {
    const double a = p.edge[i], b = p.edge[std::min(i + 1, Lanes - 1)];
    const double inner = std::max({a, -b, 0.0}), outer = std::max(std::abs(a), std::abs(b));
    p.nearest[i] = inner * inner;
    p.farthest[i] = outer * outer;
  }
}

void finish(Planes& p) {
  with_lanes(p.cells, [&](auto lanes) { finish<lanes>(p); });
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

// W / 2 for all pairs of planes of two axes.
struct PairTable {
  double half[kBlock + 1][kPadded];
};

// Fills tables: the pairs of planes that meet inside the ball are few (some 13 for a sphere of the cells'
// size), so they are gathered first and worked on in one go.
class PairTables {
 public:
  PairTable xy, yz, xz;

  PairTables(const Planes& x, const Planes& y, const Planes& z) {
    gather(x, y, xy);
    gather(y, z, yz);
    gather(x, z, xz);
    double w[kMost];
    for (int p = 0; p < count_; ++p) w[p] = 0.5 * ball_wedge(a_[p], b_[p]);
    for (int p = 0; p < count_; ++p) *to_[p] = w[p];
  }

 private:
  static constexpr int kMost = 3 * (kBlock + 1) * (kBlock + 1);

  void gather(const Planes& a, const Planes& b, PairTable& table) {
    for (int i = 0; i <= a.cells; ++i) {
      std::fill_n(table.half[i], kPadded, 0.0);
      for (int j = 0; j <= b.cells; ++j) {
        if (a.square[i] + b.square[j] >= 1) continue;
        a_[count_] = std::abs(a.u[i]);
        b_[count_] = std::abs(b.u[j]);
        to_[count_++] = &table.half[i][j];
      }
    }
  }

  int count_ = 0;
  double a_[kMost], b_[kMost];
  double* to_[kMost];
};

// F along the row of corners (x_i, y_j, all z).
template <int Lanes>
void corner_row(const Planes& x, int i, const Planes& y, int j, const Planes& z, const PairTables& w,
                double* row) {
  const double square = x.square[i] + y.square[j], area = x.u[i] * y.u[j], sign = x.sign[i] * y.sign[j];
  const double outside = std::numbers::pi / 6 - (x.cap[i] + y.cap[j]) + w.xy.half[i][j];
  const double *yz = w.yz.half[j], *xz = w.xz.half[i];
  for (int k = 0; k < Lanes; ++k) {
    const double beyond = outside - z.cap[k] + (yz[k] + xz[k]);
    row[k] = square + z.square[k] <= 1 ? area * z.u[k] : sign * z.sign[k] * beyond;
  }
}

// Volumes of all cells by mixed differences of F, with rows of `Lanes` corners worked on at once.
template <int Lanes>
void closed_form(const Planes& x, const Planes& y, const Planes& z, double scale, double full, double* out) {
  const PairTables w(x, y, z);
  double corner[2][Lanes], face[2][kBlock][Lanes];
  for (int i = 0; i <= x.cells; ++i)
    for (int j = 0; j <= y.cells; ++j) {
      const double* row = corner[j % 2];
      const double* previous = corner[(j + 1) % 2];
      corner_row<Lanes>(x, i, y, j, z, w, corner[j % 2]);
      if (j == 0) continue;
      double* after = face[i % 2][j - 1];
      for (int k = 0; k + 1 < Lanes; ++k) after[k] = (row[k + 1] - previous[k + 1]) - (row[k] - previous[k]);
      if (i == 0) continue;
      const double* before = face[(i + 1) % 2][j - 1];
      const double nearest = x.nearest[i - 1] + y.nearest[j - 1],
                   farthest = x.farthest[i - 1] + y.farthest[j - 1];
      double volume[Lanes];
      for (int k = 0; k + 1 < Lanes; ++k) {
        const double bounded = std::min(std::max((after[k] - before[k]) * scale, 0.0), full);
        const double reached = nearest + z.nearest[k] >= 1 ? 0.0 : bounded;
        volume[k] = farthest + z.farthest[k] <= 1 ? full : reached;
      }
      for (int k = 0; k < z.cells; ++k) *out++ = volume[k];
    }
}

// The same for spheres that are large beside their cells: those that the surface passes, one by one.
void large_sphere(const Planes& x, const Planes& y, const Planes& z, double scale, double full, double* out) {
  for (int i = 0; i < x.cells; ++i)
    for (int j = 0; j < y.cells; ++j)
      for (int k = 0; k < z.cells; ++k, ++out) {
        if (x.nearest[i] + y.nearest[j] + z.nearest[k] >= 1) {
          *out = 0;
        } else if (x.farthest[i] + y.farthest[j] + z.farthest[k] <= 1) {
          *out = full;
        } else {
          const Vec3d lo{x.edge[i], y.edge[j], z.edge[k]}, hi{x.edge[i + 1], y.edge[j + 1], z.edge[k + 1]};
          *out = std::clamp(unit_ball_in_box(lo, hi) * scale, 0.0, full);
        }
      }
}

// Volumes in all cells between the planes, times `scale`; a cell inside the ball is exactly `full`.
void cell_volumes(const Planes& x, const Planes& y, const Planes& z, bool large, double scale, double full,
                  double* out) {
  if (large) return large_sphere(x, y, z, scale, full, out);
  with_lanes(z.cells, [&](auto lanes) { closed_form<lanes>(x, y, z, scale, full, out); });
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
