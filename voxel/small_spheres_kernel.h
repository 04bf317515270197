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
template <class T>
using Tag = hn::CappedTag<T, kPlanes>;
template <class T>
using Vec = hn::Vec<Tag<T>>;

// Pairs of planes are worked on in vectors that may be longer than a row.
constexpr int kMostLanes = 16;
template <class T>
using WideTag = hn::CappedTag<T, kMostLanes>;

/// Calls body(k) for each vector of a row of planes.
template <class T, class Body>
HWY_INLINE void for_row(const Body& body) {
  const Tag<T> d;
  for (int k = 0; k < kPlanes; k += static_cast<int>(hn::Lanes(d))) body(k);
}

/// Between a row of doubles and one of T.
HWY_INLINE void store_as(Vec<double> v, double* to) { hn::Store(v, Tag<double>(), to); }
HWY_INLINE void store_as(Vec<double> v, float* to) {
  const hn::Rebind<float, Tag<double>> narrow;
  hn::Store(hn::DemoteTo(narrow, v), narrow, to);
}
HWY_INLINE Vec<double> load_double(const double* from) { return hn::Load(Tag<double>(), from); }
HWY_INLINE Vec<double> load_double(const float* from) {
  const hn::Rebind<float, Tag<double>> narrow;
  return hn::PromoteTo(Tag<double>(), hn::Load(narrow, from));
}

/// p(z) of quarter_angle.h; for single the Chebyshev fit of degree 4, good to 2.4e-9.
template <class D>
HWY_INLINE hn::Vec<D> angle_series(D d, hn::Vec<D> z) {
  const auto horner = [&](auto first, auto... rest) {
    hn::Vec<D> p = hn::Set(d, first);
    ((p = hn::MulAdd(p, z, hn::Set(d, rest))), ...);
    return p;
  };
  if constexpr (sizeof(hn::TFromD<D>) == 4)
    return horner(-0.064519282081217f, 0.107437314907911f, -0.142639555979846f, 0.199995404836490f,
                  -0.333333317611685f);
  else
    return horner(-0.019176887119062258989, 0.039231658295587191303, -0.050854497379402598613,
                  0.058581489128022098816, -0.066645114473819480001, 0.076921831908260865637,
                  -0.090909045781239018905, 0.11111111015256361727, -0.14285714284666542922,
                  0.19999999999995520678, -0.3333333333333333016);
}

/// quarter_angle() of quarter_angle.h, whole vectors at a time.
template <class D>
HWY_INLINE hn::Vec<D> angle(D d, hn::Vec<D> y, hn::Vec<D> x) {
  using T = hn::TFromD<D>;
  const auto steep = hn::Gt(y, x);
  const auto less = hn::Min(x, y), more = hn::Max(x, y);
  const auto turned = hn::Gt(less, hn::Mul(hn::Set(d, T(0.41421356237309504880)), more));  // tan(pi/8)
  const auto numerator = hn::IfThenElse(turned, hn::Sub(less, more), less);
  const auto t = hn::Div(numerator, hn::IfThenElse(turned, hn::Add(less, more), more));
  const auto z = hn::Mul(t, t);
  const auto series = hn::MulAdd(hn::Mul(t, z), angle_series(d, z), t);
  const auto acute = hn::Add(hn::IfThenElseZero(turned, hn::Set(d, T(0.78539816339744830962))), series);
  return hn::IfThenElse(steep, hn::Sub(hn::Set(d, T(1.57079632679489661923)), acute), acute);
}

/// W(a, b) / 2 for 0 <= a, b and a^2 + b^2 < 1.
template <class D>
HWY_INLINE hn::Vec<D> half_wedge(D d, hn::Vec<D> a, hn::Vec<D> b) {
  using T = hn::TFromD<D>;
  const auto three = hn::Set(d, T(3)), one = hn::Set(d, T(1));
  const auto a2 = hn::Mul(a, a), b2 = hn::Mul(b, b), ab = hn::Mul(a, b);
  const auto s = hn::Sqrt(hn::Max(hn::Sub(hn::Sub(one, a2), b2), hn::Zero(d)));
  const auto both = hn::MulAdd(ab, s, angle(d, s, ab));
  const auto first = hn::Mul(hn::Mul(a, hn::Sub(three, a2)), angle(d, s, b));
  const auto second = hn::Mul(hn::Mul(b, hn::Sub(three, b2)), angle(d, s, a));
  return hn::Mul(hn::Set(d, T(1.0 / 6)), hn::Sub(hn::Add(both, both), hn::Add(first, second)));
}

/// The planes of the lattice normal to one axis, in units of the radius from the centre.
template <class T>
struct Planes {
  HWY_ALIGN T u[kPlanes];       // clamped to the ball
  HWY_ALIGN T size[kPlanes];    // |u|
  HWY_ALIGN T square[kPlanes];  // u^2
  HWY_ALIGN T sign[kPlanes];
  HWY_ALIGN T cap[kPlanes];       // a quarter of the ball beyond |u|
  HWY_ALIGN T nearest[kPlanes];   // squared distance of the cell above the plane from the centre,
  HWY_ALIGN T farthest[kPlanes];  // and of its farther side
};

/// `first`: of the planes, in cells from the sphere's own; `offset` of the centre in it. In double, whatever
/// T is: here large numbers are subtracted.
template <class T>
HWY_INLINE void set_planes(double first, double h, double offset, double inverse_radius, Planes<T>& p) {
  const Tag<double> d;
  const Vec<double> one = hn::Set(d, 1.0), zero = hn::Zero(d);
  for_row<double>([&](int k) {
    const auto edge = [&](double ahead) {
      const Vec<double> at = hn::Iota(d, first + k + ahead);
      return hn::Mul(hn::Sub(hn::Mul(at, hn::Set(d, h)), hn::Set(d, offset)), hn::Set(d, inverse_radius));
    };
    const Vec<double> lower = edge(0), upper = edge(1);
    const Vec<double> u = hn::Min(hn::Max(lower, hn::Neg(one)), one), size = hn::Abs(u),
                      left = hn::Sub(one, size);
    store_as(u, p.u + k);
    store_as(size, p.size + k);
    store_as(hn::Mul(u, u), p.square + k);
    store_as(hn::IfThenElseZero(hn::Ne(u, zero), hn::CopySign(one, u)), p.sign + k);
    const Vec<double> cap = hn::Mul(hn::Mul(left, left), hn::Add(hn::Set(d, 2.0), size));
    store_as(hn::Mul(hn::Set(d, std::numbers::pi / 12), cap), p.cap + k);
    const Vec<double> inner = hn::Max(hn::Max(lower, hn::Neg(upper)), zero);
    const Vec<double> outer = hn::Max(hn::Abs(lower), hn::Abs(upper));
    store_as(hn::Mul(inner, inner), p.nearest + k);
    store_as(hn::Mul(outer, outer), p.farthest + k);
  });
}

/// W / 2 for the pairs of planes of two axes, by the first one's rows.
template <class T>
struct Wedges {
  HWY_ALIGN T half[kPlanes][kPlanes];
};

/// The pairs that meet inside the ball, of all three tables: few (some 13 in all for a sphere of the cells'
/// size), so they are gathered first and worked on in one go.
template <class T>
struct LivePairs {
  static constexpr int kRoom = 3 * kPlanes * kPlanes + kMostLanes;
  HWY_ALIGN T a[kRoom];
  HWY_ALIGN T b[kRoom];
  HWY_ALIGN T at[kRoom];  // where it belongs, counted over the three tables
  std::size_t count = 0;
};

template <class T>
HWY_INLINE void gather(const Planes<T>& x, int rows, const Planes<T>& y, int table, LivePairs<T>& live) {
  const Tag<T> d;
  for (int i = 0; i < rows; ++i) {
    if (x.square[i] >= 1) continue;
    const Vec<T> room = hn::Set(d, 1 - x.square[i]);
    for_row<T>([&](int j) {
      const auto meets = hn::Lt(hn::Load(d, y.square + j), room);
      const std::size_t n = live.count;
      hn::CompressStore(hn::Set(d, x.size[i]), meets, d, live.a + n);
      hn::CompressStore(hn::Load(d, y.size + j), meets, d, live.b + n);
      live.count += hn::CompressStore(hn::Iota(d, static_cast<T>((table * kPlanes + i) * kPlanes + j)), meets,
                                      d, live.at + n);
    });
  }
}

template <class T>
HWY_INLINE void fill_wedges(const Planes<T>& x, int nx, const Planes<T>& y, int ny, const Planes<T>& z,
                            Wedges<T>* tables) {
  LivePairs<T> live;
  gather(x, nx + 1, y, 0, live);
  gather(y, ny + 1, z, 1, live);
  gather(x, nx + 1, z, 2, live);
  const int rows[3] = {nx + 1, ny + 1, nx + 1};
  const Tag<T> row;
  for (int t = 0; t < 3; ++t) {
    for (int i = 0; i < rows[t]; ++i)
      for_row<T>([&](int k) { hn::Store(hn::Zero(row), row, tables[t].half[i] + k); });
  }
  T* all = &tables[0].half[0][0];
  const WideTag<T> d;
  HWY_ALIGN T w[kMostLanes];
  const auto lanes = hn::Lanes(d);
  for (std::size_t p = 0; p < live.count; p += lanes) {
    hn::Store(half_wedge(d, hn::Load(d, live.a + p), hn::Load(d, live.b + p)), d, w);
    const std::size_t last = std::min(lanes, live.count - p);
    for (std::size_t l = 0; l < last; ++l) all[static_cast<std::size_t>(live.at[p + l])] = w[l];
  }
}

/// One sphere's planes, wedges and steps.
template <class T>
struct Ball {
  Planes<T> x, y, z;
  Wedges<T> wedges[3];                                  // xy, yz, xz
  HWY_ALIGN T step[kPlanes][kSmallCells][2 * kPlanes];  // of F from one plane of y to the next; rows have
                                                        // room to be read one ahead
  int nx, ny, nz;
};

template <class T>
HWY_INLINE void fill_steps(Ball<T>& ball) {
  const Tag<T> d;
  HWY_ALIGN T corner[kPlanes];  // F along the row before
  const Planes<T>&x = ball.x, &y = ball.y, &z = ball.z;
  for (int i = 0; i <= ball.nx; ++i) {
    for (int j = 0; j <= ball.ny; ++j) {
      const Vec<T> square = hn::Set(d, x.square[i] + y.square[j]), area = hn::Set(d, x.u[i] * y.u[j]);
      const Vec<T> sign = hn::Set(d, x.sign[i] * y.sign[j]);
      const Vec<T> outside = hn::Set(
          d, static_cast<T>(std::numbers::pi / 6) - (x.cap[i] + y.cap[j]) + ball.wedges[0].half[i][j]);
      for_row<T>([&](int k) {
        const Vec<T> wedge =
            hn::Add(hn::Load(d, ball.wedges[1].half[j] + k), hn::Load(d, ball.wedges[2].half[i] + k));
        const Vec<T> beyond = hn::Add(hn::Sub(outside, hn::Load(d, z.cap + k)), wedge);
        const auto within = hn::Le(hn::Add(square, hn::Load(d, z.square + k)), hn::Set(d, T(1)));
        const Vec<T> f = hn::IfThenElse(within, hn::Mul(area, hn::Load(d, z.u + k)),
                                        hn::Mul(hn::Mul(sign, hn::Load(d, z.sign + k)), beyond));
        if (j > 0) hn::Store(hn::Sub(f, hn::Load(d, corner + k)), d, ball.step[i][j - 1] + k);
        hn::Store(f, d, corner + k);
      });
    }
  }
}

/// The shares of the cells of row (i, j), into `share`; zero beyond the sphere's last cell.
template <class T>
HWY_INLINE void row_shares(const Ball<T>& ball, int i, int j, T scale, T* share) {
  const Tag<T> d;
  const T near_xy = ball.x.nearest[i] + ball.y.nearest[j], far_xy = ball.x.farthest[i] + ball.y.farthest[j];
  const Vec<T> zero = hn::Zero(d), one = hn::Set(d, T(1));
  for_row<T>([&](int k) {
    const auto face = [&](int ahead) {
      return hn::Sub(hn::LoadU(d, ball.step[i + 1][j] + k + ahead),
                     hn::LoadU(d, ball.step[i][j] + k + ahead));
    };
    const Vec<T> volume = hn::Mul(hn::Sub(face(1), face(0)), hn::Set(d, scale));
    const auto reached = hn::Lt(hn::Add(hn::Set(d, near_xy), hn::Load(d, ball.z.nearest + k)), one);
    const auto inside = hn::Le(hn::Add(hn::Set(d, far_xy), hn::Load(d, ball.z.farthest + k)), one);
    const Vec<T> bounded = hn::IfThenElseZero(reached, hn::Min(hn::Max(volume, zero), one));
    const auto cell = hn::Lt(hn::Iota(d, static_cast<T>(k)), hn::Set(d, static_cast<T>(ball.nz)));
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

/// Adds `part` of the way to a sphere's velocity to the running means at `at`, and to the second moment
/// behind them what that leaves: `before` is the share of the spheres before it (channels.h).
HWY_INLINE void add_velocity(const Channels& channels, std::size_t sphere, Vec<double> part,
                             Vec<double> before, std::int64_t plane, double* at) {
  const Tag<double> d;
  Vec<double> squared = hn::Zero(d);
  for (std::size_t axis = 0; axis < 3; ++axis, at += plane) {
    const Vec<double> mean = hn::LoadU(d, at), ahead = hn::Sub(hn::Set(d, channels.v[axis][sphere]), mean);
    hn::StoreU(hn::MulAdd(part, ahead, mean), d, at);
    squared = hn::MulAdd(ahead, ahead, squared);
  }
  if (channels.moment) hn::StoreU(hn::MulAdd(hn::Mul(part, before), squared, hn::LoadU(d, at)), d, at);
}

/// Adds a row of shares to all channels; `row` is that of channel 0.
template <class T>
HWY_INLINE void add_row(const T* shares, std::size_t sphere, const Channels& channels, std::int64_t plane,
                        double* row) {
  const Tag<double> d;
  for_row<double>([&](int k) {
    const Vec<double> share = load_double(shares + k), before = hn::LoadU(d, row + k);
    const Vec<double> after = hn::Add(before, share);
    hn::StoreU(after, d, row + k);
    if (channels.only_shares()) return;
    double* at = row + k + plane;
    const double* weights = channels.weights_of(sphere);
    for (int c = 0; c < channels.linear; ++c, at += plane)
      hn::StoreU(hn::MulAdd(hn::Set(d, weights[c]), share, hn::LoadU(d, at)), d, at);
    if (channels.groups > 0 && channels.group[sphere] >= 0) {
      double* own = at + channels.group[sphere] * plane;
      hn::StoreU(hn::Add(hn::LoadU(d, own), share), d, own);
    }
    if (!channels.velocity) return;
    const auto some = hn::Gt(share, hn::Zero(d));
    const Vec<double> part = hn::IfThenElseZero(some, hn::Div(share, after));
    add_velocity(channels, sphere, part, before, plane, at + channels.groups * plane);
  });
}

template <class T>
HWY_INLINE void set_ball(const Lattice& lattice, const SmallSphere& small, Ball<T>& ball) {
  const PlacedSphere& sphere = small.sphere;
  const CellRange& bounding = small.bounding;
  const auto first = [&](int axis) { return static_cast<double>(bounding.lo[axis] - sphere.cell[axis]); };
  const double inverse = 1 / sphere.radius, h = lattice.h.x;
  set_planes(first(0), h, sphere.offset.x, inverse, ball.x);
  set_planes(first(1), h, sphere.offset.y, inverse, ball.y);
  set_planes(first(2), h, sphere.offset.z, inverse, ball.z);
  ball.nx = static_cast<int>(bounding.size(0)), ball.ny = static_cast<int>(bounding.size(1));
  ball.nz = static_cast<int>(bounding.size(2));
  fill_wedges(ball.x, ball.nx, ball.y, ball.ny, ball.z, ball.wedges);
  fill_steps(ball);
}

template <class T>
HWY_INLINE void add_sphere(const Lattice& lattice, const SmallSphere& small, const Channels& channels,
                           Ball<T>& ball, CellRows& rows) {
  set_ball(lattice, small, ball);
  const CellRange &bounding = small.bounding, &cells = rows.cells();
  const double cells_across = small.sphere.radius / lattice.h.x;
  const T scale = static_cast<T>(cells_across * cells_across * cells_across);
  const Span xs = span_of(bounding, cells, 0), ys = span_of(bounding, cells, 1);
  for (int i = xs.first; i < xs.last; ++i) {
    for (int j = ys.first; j < ys.last; ++j) {
      HWY_ALIGN T share[kPlanes];
      row_shares(ball, i, j, scale, share);
      double* row = rows.row(bounding.lo[0] + i, bounding.lo[1] + j) + (bounding.lo[2] - cells.lo[2]);
      add_row(share, small.index, channels, rows.plane(), row);
    }
  }
}

void add_spheres(const Lattice& lattice, const SmallSphere* spheres, std::size_t count, Precision precision,
                 const Channels& channels, CellRows& rows) {
  Ball<double> ball;
  Ball<float> single;
  const double reach = precision == Precision::mixed ? kSingleReach * lattice.h.x : 0;
  for (std::size_t s = 0; s < count; ++s) {
    if (spheres[s].sphere.radius <= reach)
      add_sphere(lattice, spheres[s], channels, single, rows);
    else
      add_sphere(lattice, spheres[s], channels, ball, rows);
  }
}

void add_block(const double* shares, const CellRange& block, std::size_t sphere, const Channels& channels,
               CellRows& rows) {
  static_assert(kPlanes >= kBlock && CellRows::kRoom >= kPlanes);
  HWY_ALIGN double row[kPlanes] = {};
  const auto nz = static_cast<int>(block.size(2));
  for (std::int64_t i = block.lo[0]; i < block.hi[0]; ++i)
    for (std::int64_t j = block.lo[1]; j < block.hi[1]; ++j) {
      for (int k = 0; k < nz; ++k) row[k] = *shares++;
      add_row(row, sphere, channels, rows.plane(), rows.row(i, j) + (block.lo[2] - rows.cells().lo[2]));
    }
}

const char* target_name() { return hwy::TargetName(HWY_TARGET); }

}  // namespace interstice::voxel::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
