// The kernel of small_spheres.cpp, in the namespace of one instruction set. In units of the sphere's radius
// the volume in a box is the mixed difference over its corners of F(a, b, c), the volume of the unit ball in
// [0, a] x [0, b] x [0, c] (docs/PHYSICS.md has the formulas); eight corners along z are one row.

#if defined(INTERSTICE_SMALL_SPHERES_KERNEL) == defined(HWY_TARGET_TOGGLE)
#ifdef INTERSTICE_SMALL_SPHERES_KERNEL
#undef INTERSTICE_SMALL_SPHERES_KERNEL
#else
#define INTERSTICE_SMALL_SPHERES_KERNEL
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "voxel/small_spheres.h"

HWY_BEFORE_NAMESPACE();
namespace interstice::voxel::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kPlanes = kSmallCells + 1;
using Tag = hn::CappedTag<double, kPlanes>;
using Vec = hn::Vec<Tag>;

/// Calls body(k) for each vector of a row of planes.
template <class Body>
HWY_INLINE void for_row(const Body& body) {
  const Tag d;
  for (int k = 0; k < kPlanes; k += static_cast<int>(hn::Lanes(d))) body(k);
}

/// quarter_angle() of quarter_angle.h, whole vectors at a time.
HWY_INLINE Vec angle(Vec y, Vec x) {
  const Tag d;
  const auto steep = hn::Gt(y, x);
  const Vec less = hn::Min(x, y), more = hn::Max(x, y);
  const auto turned = hn::Gt(less, hn::Mul(hn::Set(d, 0.41421356237309504880), more));  // tan(pi/8)
  const Vec numerator = hn::IfThenElse(turned, hn::Sub(less, more), less);
  const Vec t = hn::Div(numerator, hn::IfThenElse(turned, hn::Add(less, more), more));
  const Vec z = hn::Mul(t, t);
  Vec p = hn::Set(d, -0.019176887119062258989);
  for (const double c :
       {0.039231658295587191303, -0.050854497379402598613, 0.058581489128022098816, -0.066645114473819480001,
        0.076921831908260865637, -0.090909045781239018905, 0.11111111015256361727, -0.14285714284666542922,
        0.19999999999995520678, -0.3333333333333333016}) {
    p = hn::MulAdd(p, z, hn::Set(d, c));
  }
  const Vec series = hn::MulAdd(hn::Mul(t, z), p, t);
  const Vec acute = hn::Add(hn::IfThenElseZero(turned, hn::Set(d, 0.78539816339744830962)), series);
  return hn::IfThenElse(steep, hn::Sub(hn::Set(d, 1.57079632679489661923), acute), acute);
}

/// W(a, b) / 2 for 0 <= a, b and a^2 + b^2 < 1.
HWY_INLINE Vec half_wedge(Vec a, Vec b) {
  const Tag d;
  const Vec three = hn::Set(d, 3.0), one = hn::Set(d, 1.0);
  const Vec a2 = hn::Mul(a, a), b2 = hn::Mul(b, b), ab = hn::Mul(a, b);
  const Vec s = hn::Sqrt(hn::Max(hn::Sub(hn::Sub(one, a2), b2), hn::Zero(d)));
  const Vec both = hn::MulAdd(ab, s, angle(s, ab));
  const Vec first = hn::Mul(hn::Mul(a, hn::Sub(three, a2)), angle(s, b));
  const Vec second = hn::Mul(hn::Mul(b, hn::Sub(three, b2)), angle(s, a));
  return hn::Mul(hn::Set(d, 1.0 / 6), hn::Sub(hn::Add(both, both), hn::Add(first, second)));
}

/// The planes of the lattice normal to one axis, in units of the radius from the centre.
struct Planes {
  HWY_ALIGN double u[kPlanes];       // clamped to the ball
  HWY_ALIGN double size[kPlanes];    // |u|
  HWY_ALIGN double square[kPlanes];  // u^2
  HWY_ALIGN double sign[kPlanes];
  HWY_ALIGN double cap[kPlanes];       // a quarter of the ball beyond |u|
  HWY_ALIGN double nearest[kPlanes];   // squared distance of the cell above the plane from the centre,
  HWY_ALIGN double farthest[kPlanes];  // and of its farther side
};

/// `first`: of the planes, in cells from the sphere's own; `offset` of the centre in it.
HWY_INLINE void set_planes(double first, double h, double offset, double inverse_radius, Planes& p) {
  const Tag d;
  const Vec one = hn::Set(d, 1.0), zero = hn::Zero(d);
  for_row([&](int k) {
    const auto edge = [&](double ahead) {
      const Vec at = hn::Iota(d, first + k + ahead);
      return hn::Mul(hn::Sub(hn::Mul(at, hn::Set(d, h)), hn::Set(d, offset)), hn::Set(d, inverse_radius));
    };
    const Vec lower = edge(0), upper = edge(1);
    const Vec u = hn::Min(hn::Max(lower, hn::Neg(one)), one), size = hn::Abs(u), left = hn::Sub(one, size);
    hn::Store(u, d, p.u + k);
    hn::Store(size, d, p.size + k);
    hn::Store(hn::Mul(u, u), d, p.square + k);
    hn::Store(hn::IfThenElseZero(hn::Ne(u, zero), hn::CopySign(one, u)), d, p.sign + k);
    const Vec cap = hn::Mul(hn::Mul(left, left), hn::Add(hn::Set(d, 2.0), size));
    hn::Store(hn::Mul(hn::Set(d, std::numbers::pi / 12), cap), d, p.cap + k);
    const Vec inner = hn::Max(hn::Max(lower, hn::Neg(upper)), zero);
    const Vec outer = hn::Max(hn::Abs(lower), hn::Abs(upper));
    hn::Store(hn::Mul(inner, inner), d, p.nearest + k);
    hn::Store(hn::Mul(outer, outer), d, p.farthest + k);
  });
}

/// W / 2 for the pairs of planes of two axes, by the first one's rows.
struct Wedges {
  HWY_ALIGN double half[kPlanes][kPlanes];
};

/// The pairs that meet inside the ball, of all three tables: few (some 13 in all for a sphere of the cells'
/// size), so they are gathered first and worked on in one go.
struct LivePairs {
  HWY_ALIGN double a[3 * kPlanes * kPlanes + kPlanes];
  HWY_ALIGN double b[3 * kPlanes * kPlanes + kPlanes];
  HWY_ALIGN double at[3 * kPlanes * kPlanes + kPlanes];  // where it belongs, counted over the three tables
  std::size_t count = 0;
};

HWY_INLINE void gather(const Planes& x, int rows, const Planes& y, int table, LivePairs& live) {
  const Tag d;
  for (int i = 0; i < rows; ++i) {
    if (x.square[i] >= 1) continue;
    const Vec room = hn::Set(d, 1 - x.square[i]);
    for_row([&](int j) {
      const auto meets = hn::Lt(hn::Load(d, y.square + j), room);
      const std::size_t n = live.count;
      hn::CompressStore(hn::Set(d, x.size[i]), meets, d, live.a + n);
      hn::CompressStore(hn::Load(d, y.size + j), meets, d, live.b + n);
      live.count +=
          hn::CompressStore(hn::Iota(d, (table * kPlanes + i) * kPlanes + j), meets, d, live.at + n);
    });
  }
}

HWY_INLINE void fill_wedges(const Planes& x, int nx, const Planes& y, int ny, const Planes& z,
                            Wedges* tables) {
  const Tag d;
  LivePairs live;
  gather(x, nx + 1, y, 0, live);
  gather(y, ny + 1, z, 1, live);
  gather(x, nx + 1, z, 2, live);
  const int rows[3] = {nx + 1, ny + 1, nx + 1};
  for (int t = 0; t < 3; ++t) {
    for (int i = 0; i < rows[t]; ++i)
      for_row([&](int k) { hn::Store(hn::Zero(d), d, tables[t].half[i] + k); });
  }
  double* all = &tables[0].half[0][0];
  HWY_ALIGN double w[kPlanes];
  const auto lanes = hn::Lanes(d);
  for (std::size_t p = 0; p < live.count; p += lanes) {
    hn::Store(half_wedge(hn::Load(d, live.a + p), hn::Load(d, live.b + p)), d, w);
    const std::size_t last = std::min(lanes, live.count - p);
    for (std::size_t l = 0; l < last; ++l) all[static_cast<std::size_t>(live.at[p + l])] = w[l];
  }
}

/// One sphere's planes, wedges and corners.
struct Ball {
  Planes x, y, z;
  Wedges wedges[3];                                        // xy, yz, xz
  HWY_ALIGN double corner[kPlanes][kPlanes][2 * kPlanes];  // F; rows have room to be read one ahead
  int nx, ny, nz;
};

HWY_INLINE void fill_corners(Ball& ball) {
  const Tag d;
  const Planes &x = ball.x, &y = ball.y, &z = ball.z;
  for (int i = 0; i <= ball.nx; ++i) {
    for (int j = 0; j <= ball.ny; ++j) {
      const Vec square = hn::Set(d, x.square[i] + y.square[j]), area = hn::Set(d, x.u[i] * y.u[j]);
      const Vec sign = hn::Set(d, x.sign[i] * y.sign[j]);
      const Vec outside =
          hn::Set(d, std::numbers::pi / 6 - (x.cap[i] + y.cap[j]) + ball.wedges[0].half[i][j]);
      for_row([&](int k) {
        const Vec wedge =
            hn::Add(hn::Load(d, ball.wedges[1].half[j] + k), hn::Load(d, ball.wedges[2].half[i] + k));
        const Vec beyond = hn::Add(hn::Sub(outside, hn::Load(d, z.cap + k)), wedge);
        const auto within = hn::Le(hn::Add(square, hn::Load(d, z.square + k)), hn::Set(d, 1.0));
        const Vec f = hn::IfThenElse(within, hn::Mul(area, hn::Load(d, z.u + k)),
                                     hn::Mul(hn::Mul(sign, hn::Load(d, z.sign + k)), beyond));
        hn::Store(f, d, ball.corner[i][j] + k);
      });
    }
  }
}

/// The shares of the cells of row (i, j), into `share`; zero beyond the sphere's last cell.
HWY_INLINE void row_shares(const Ball& ball, int i, int j, double scale, double* share) {
  const Tag d;
  const double near_xy = ball.x.nearest[i] + ball.y.nearest[j],
               far_xy = ball.x.farthest[i] + ball.y.farthest[j];
  const Vec zero = hn::Zero(d), one = hn::Set(d, 1.0);
  for_row([&](int k) {
    const auto face = [&](int ahead) {
      const Vec upper = hn::Sub(hn::LoadU(d, ball.corner[i + 1][j + 1] + k + ahead),
                                hn::LoadU(d, ball.corner[i + 1][j] + k + ahead));
      const Vec lower = hn::Sub(hn::LoadU(d, ball.corner[i][j + 1] + k + ahead),
                                hn::LoadU(d, ball.corner[i][j] + k + ahead));
      return hn::Sub(upper, lower);
    };
    const Vec volume = hn::Mul(hn::Sub(face(1), face(0)), hn::Set(d, scale));
    const auto reached = hn::Lt(hn::Add(hn::Set(d, near_xy), hn::Load(d, ball.z.nearest + k)), one);
    const auto inside = hn::Le(hn::Add(hn::Set(d, far_xy), hn::Load(d, ball.z.farthest + k)), one);
    const Vec bounded = hn::IfThenElseZero(reached, hn::Min(hn::Max(volume, zero), one));
    const auto cell = hn::Lt(hn::Iota(d, k), hn::Set(d, ball.nz));
    hn::Store(hn::IfThenElseZero(cell, hn::IfThenElse(inside, one, bounded)), d, share + k);
  });
}

/// What of the bounding box lies in the rows, along one axis.
struct Span {
  int first, last;
};
HWY_INLINE Span span_of(const CellRange& bounding, const CellRange& cells, int axis) {
  return {static_cast<int>(std::max<std::int64_t>(cells.lo[axis] - bounding.lo[axis], 0)),
          static_cast<int>(std::min(cells.hi[axis], bounding.hi[axis]) - bounding.lo[axis])};
}

void add_spheres(const Lattice& lattice, const SmallSphere* spheres, std::size_t count, const double* weights,
                 CellRows& rows) {
  const Tag d;
  Ball ball;
  const double h = lattice.h.x;
  for (std::size_t s = 0; s < count; ++s) {
    const PlacedSphere& sphere = spheres[s].sphere;
    const CellRange &bounding = spheres[s].bounding, &cells = rows.cells();
    const auto first = [&](int axis) { return static_cast<double>(bounding.lo[axis] - sphere.cell[axis]); };
    const double inverse = 1 / sphere.radius, cells_across = sphere.radius / h;
    set_planes(first(0), h, sphere.offset.x, inverse, ball.x);
    set_planes(first(1), h, sphere.offset.y, inverse, ball.y);
    set_planes(first(2), h, sphere.offset.z, inverse, ball.z);
    ball.nx = static_cast<int>(bounding.size(0)), ball.ny = static_cast<int>(bounding.size(1));
    ball.nz = static_cast<int>(bounding.size(2));
    fill_wedges(ball.x, ball.nx, ball.y, ball.ny, ball.z, ball.wedges);
    fill_corners(ball);
    const double scale = cells_across * cells_across * cells_across;
    const Vec weight = hn::Set(d, weights ? weights[s] : 1.0);
    const Span xs = span_of(bounding, cells, 0), ys = span_of(bounding, cells, 1);
    for (int i = xs.first; i < xs.last; ++i) {
      for (int j = ys.first; j < ys.last; ++j) {
        HWY_ALIGN double share[kPlanes];
        row_shares(ball, i, j, scale, share);
        double* row = rows.row(bounding.lo[0] + i, bounding.lo[1] + j) + (bounding.lo[2] - cells.lo[2]);
        for_row([&](int k) {
          hn::StoreU(hn::MulAdd(weight, hn::Load(d, share + k), hn::LoadU(d, row + k)), d, row + k);
        });
      }
    }
  }
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace interstice::voxel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
