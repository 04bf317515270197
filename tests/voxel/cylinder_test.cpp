// Cylinders and balls in cells: closed forms, and an integration that has nothing in common with the
// library's.
#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>

#include "tests/voxel/reference_volume.h"
#include "tests/voxel/support.h"
#include "voxel/solids.h"
#include "voxel/walls.h"

namespace interstice::voxel::test {
namespace {

constexpr double kPi = std::numbers::pi;

Box cube(const Vec3d& lo, double edge) { return {lo, lo + Vec3d{edge, edge, edge}}; }

double in_cell(const Cylinder& cylinder, const Box& cell) {
  return solid_volume({.cylinders = {cylinder}}, cell);
}

/// By lines along z through a grid of points: exact lengths along each line.
double by_lines(const Cylinder& cylinder, const Box& cell, int n) {
  const Vec3d span = cylinder.to - cylinder.from, size = cell.size();
  const double length = norm(span);
  const Vec3d w = (1 / length) * span;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const Vec3d p = Vec3d{cell.lo.x + (i + .5) / n * size.x, cell.lo.y + (j + .5) / n * size.y, cell.lo.z} -
                      cylinder.from;
      double lo = 0, hi = size.z;
      // the ends: 0 <= p.w + z w.z <= length
      if (w.z != 0) {
        const double a = -dot(p, w) / w.z, b = (length - dot(p, w)) / w.z;
        lo = std::max(lo, std::min(a, b)), hi = std::min(hi, std::max(a, b));
      } else if (dot(p, w) < 0 || dot(p, w) > length) {
        continue;
      }
      // the mantle: |p + z e|^2 - ((p + z e).w)^2 <= R^2
      const double qa = 1 - w.z * w.z, qb = p.z - dot(p, w) * w.z,
                   qc = dot(p, p) - dot(p, w) * dot(p, w) - cylinder.radius * cylinder.radius;
      if (qa < 1e-14) {
        if (qc > 0) continue;
      } else {
        const double square = qb * qb - qa * qc;
        if (square <= 0) continue;
        lo = std::max(lo, (-qb - std::sqrt(square)) / qa), hi = std::min(hi, (-qb + std::sqrt(square)) / qa);
      }
      sum += std::max(0., hi - lo);
    }
  return sum * size.x * size.y / n / n;
}

TEST(Cylinder, ClosedForms) {
  const Cylinder upright{{0, 0, 0}, {0, 0, 2}, 1};
  EXPECT_DOUBLE_EQ(in_cell(upright, {{-3, -3, -3}, {3, 3, 3}}), 2 * kPi);
  EXPECT_DOUBLE_EQ(in_cell(upright, {{0, 0, 1.5}, {3, 3, 9}}), kPi / 8);  // a quarter, clipped by an end
  // a segment beyond x = c: acos(c) - c sqrt(1 - c^2)
  EXPECT_NEAR(in_cell(upright, {{.6, -2, 0}, {2, 2, 1}}), std::acos(.6) - .6 * .8, 1e-15);
  EXPECT_DOUBLE_EQ(in_cell(upright, cube({-.1, -.1, .1}, .2)), .008);  // wholly inside
  EXPECT_EQ(in_cell(upright, cube({.8, .8, .1}, .2)), 0);              // beside it
  EXPECT_EQ(in_cell(upright, cube({0, 0, 2}, .2)), 0);                 // above it
  for (int axis = 0; axis < 3; ++axis) {
    Cylinder lying{{.3, .3, .3}, {.3, .3, .3}, .25};
    lying.to[axis] = -.7;  // either end first
    EXPECT_NEAR(in_cell(lying, cube({-1, -1, -1}, 2)), kPi / 16, 1e-15);
  }
}

TEST(Cylinder, ObliqueOnesHaveTheirWholeVolume) {
  // over all cells of a grid around it: pi R^2 H. What 20^3 cells each within 1e-9 can miss: far below 1e-8
  for (std::uint64_t i = 0; i < 10; ++i) {
    Random random(31, i);
    const Vec3d from{random.uniform(), random.uniform(), random.uniform()};
    const Vec3d span{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Cylinder cylinder{from, from + span, random.uniform(.05, .7)};
    double sum = 0;
    const double h = .2;
    for (int a = -10; a < 15; ++a)
      for (int b = -10; b < 15; ++b)
        for (int c = -10; c < 15; ++c) sum += in_cell(cylinder, cube({a * h, b * h, c * h}, h));
    const double whole = kPi * cylinder.radius * cylinder.radius * norm(span);
    EXPECT_NEAR(sum, whole, 1e-8 * h * h * h * 1000) << i;
    EXPECT_NEAR(in_cell(cylinder, {{-9, -9, -9}, {9, 9, 9}}) / whole, 1, 1e-6);  // one large cell: 1e-9 of it
  }
}

TEST(Cylinder, ObliqueOnesAgreeWithLinesThroughTheCell) {
  for (std::uint64_t i = 0; i < 40; ++i) {
    Random random(32, i);
    const auto point = [&] {
      return Vec3d{random.uniform(-1, 2), random.uniform(-1, 2), random.uniform(-1, 2)};
    };
    const Cylinder cylinder{point(), point(), random.uniform(.1, 2)};
    const Box cell = cube({0, 0, 0}, 1);
    // midpoints of 400^2 lines across kinks: some 1e-5
    EXPECT_NEAR(in_cell(cylinder, cell), by_lines(cylinder, cell, 400), 1e-4) << i;
  }
}

TEST(Cylinder, ObliqueErrorsAreBelowTheBoundInASliceThatHasAClosedForm) {
  // A cylinder of radius R about the line y = z, x = c, long enough to leave the cell sideways: in planes
  // x = const it is a strip of half width s = sqrt(R^2 - (x - c)^2) about the diagonal of the unit square,
  // whose area is 1 - (1 - sqrt(2) s)^2 where that is below 1.
  using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
  const double w = std::sqrt(.5);
  for (const double radius : {.05, .3, .9, 4., 600.}) {
    for (const double depth : {-.2, .1, .5, .9}) {  // how far it reaches into the cell
      const double c = depth - radius;
      const Cylinder cylinder{{c, -2000 * w, -2000 * w}, {c, 2000 * w, 2000 * w}, radius};
      const auto area = [&](double x) {
        const double s = std::sqrt(std::max(0., (radius - (x - c)) * (radius + (x - c)))),
                     rest = std::max(0., 1 - std::sqrt(2.) * s);
        return 1 - rest * rest;
      };
      double expected = 0;
      const double from = std::max(0., c - radius), to = std::min(1., c + radius);
      // x = c + sqrt(R^2 - 1/2): from here on the strip no longer covers the square
      const double kink = radius * radius > .5 ? c + std::sqrt(radius * radius - .5) : c;
      const auto piece = [&](double lo, double hi) {
        if (!(hi > lo)) return;
        // x = hi - (hi - lo) t^2 takes the square root at the far end away
        expected += Rule::integrate(
            [&](double t) { return area(hi - (hi - lo) * t * t) * 2 * t * (hi - lo); }, 0., 1., 8, 1e-13);
      };
      piece(from, std::clamp(kink, from, std::max(from, to)));
      piece(std::clamp(kink, from, std::max(from, to)), to);
      EXPECT_NEAR(in_cell(cylinder, cube({0, 0, 0}, 1)), expected, 1e-9) << radius << ' ' << depth;
    }
  }
}

TEST(Cylinder, KeepsItsDigitsWhereItIsMuchLargerThanTheCell) {
  // R = 10 mm over cells of 17 um and 1 um: a thin slice of a nearly flat wall, against the area by Green's
  // theorem in long double
  for (const double h : {17e-6, 1e-6}) {
    const double radius = 10e-3;
    const Cylinder roller{{0, -1, radius}, {0, 1, radius}, radius};
    for (int i = -3; i < 4; ++i) {
      const Box cell = cube({i * h + .3 * h, 0, 0}, h);
      const auto under = [&](long double x) {  // of z = R - sqrt(R^2 - x^2)
        const long double r = radius, q = std::sqrt(r * r - x * x);
        return r * x - .5L * (x * q + r * r * std::asin(x / r));
      };
      const long double below = under(cell.hi.x) - under(cell.lo.x);
      const double expected = static_cast<double>((static_cast<long double>(h) * h - below) / (h * h));
      // 1e-16 R/h for each of some corners
      EXPECT_NEAR(in_cell(roller, cell) / cell.volume(), expected, 1e-15 * radius / h) << h << ' ' << i;
    }
  }
}

TEST(Cylinder, ABallIsItsClosedForm) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    Random random(33, i);
    const Vec3d center{random.uniform(-1, 2), random.uniform(-1, 2), random.uniform(-1, 2)};
    const double radius = random.uniform(.1, 1.5);
    const Box cell = cube({0, 0, 0}, 1);
    EXPECT_NEAR(solid_volume({.balls = {{center, radius}}}, cell), reference_volume(center, radius, cell),
                1e-14);
  }
}

/// Sum of the shares of all cells of the lattice, by blocks as fields take them.
double sum_of_shares(const Solids& solids, const Lattice& lattice) {
  const Solids local = relative_to(solids, lattice);
  const BlockGrid grid(lattice);
  double sum = 0;
  for (const WallBlock& block : wall_blocks(local, lattice)) {
    const CellRange cells = block_cells(lattice, grid.block(block.key));
    double shares[kBlockCells];
    wall_fractions(local, lattice, cells, shares);
    for (std::int64_t c = 0; c < cells.cells(); ++c) {
      if (block.full) {
        EXPECT_EQ(shares[c], 1);
      }
      sum += shares[c];
    }
  }
  return sum;
}

TEST(Cylinder, BlocksLoseNothing) {
  // blocks are found to be empty, full or neither by tests of their own
  const Lattice lattice = cubic_lattice({{-40e-6, -45e-6, 10e-6}, {460e-6, 405e-6, 370e-6}}, 10e-6);
  const Cylinder oblique{{50e-6, 60e-6, 90e-6}, {300e-6, 250e-6, 250e-6}, 70e-6};
  const double volume = kPi * 70e-6 * 70e-6 * norm(oblique.to - oblique.from);
  EXPECT_NEAR(sum_of_shares({.cylinders = {oblique}}, lattice) * 1e-15 / volume, 1, 1e-8);
  const Cylinder lying{{50e-6, 200e-6, 190e-6}, {430e-6, 200e-6, 190e-6}, 170e-6};
  EXPECT_NEAR(sum_of_shares({.cylinders = {lying}}, lattice) * 1e-15 / (kPi * 170e-6 * 170e-6 * 380e-6), 1,
              1e-12);
  const Ball ball{{200e-6, 190e-6, 190e-6}, 175e-6};
  EXPECT_NEAR(sum_of_shares({.balls = {ball}}, lattice) * 1e-15 / ball_volume(175e-6), 1, 1e-12);
}

}  // namespace
}  // namespace interstice::voxel::test
