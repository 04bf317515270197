// The union of overlapping spheres, against closed forms and quadrature that shares no code with it.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "tests/voxel/support.h"
#include "voxel/field.h"
#include "voxel/overlap.h"
#include "voxel/union_share.h"

namespace interstice::voxel::test {
namespace {

constexpr double kBox = 200e-6;

FieldRequest request_for(double voxel, Overlap overlap = Overlap::united) {
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {kBox, kBox, kBox}}, voxel);
  request.overlap = overlap;
  return request;
}

Field united(const Spheres& spheres, double voxel) {
  return compute_field(spheres.view(), {}, request_for(voxel));
}

double value(const Field& field, int i, int j, int k) {
  return static_cast<double>(field.solid_fraction->tree().getValue({i, j, k}));
}

/// Share of a cell in the union, from lines along x (the library integrates along z), n * n of them.
double united_share(const Spheres& spheres, const Vec3d& lo, double h, int n) {
  double sum = 0;
  std::vector<std::pair<double, double>> pieces;
  for (int p = 0; p < n; ++p)
    for (int q = 0; q < n; ++q) {
      const double y = lo.y + (p + 0.5) / n * h, z = lo.z + (q + 0.5) / n * h;
      pieces.clear();
      for (std::size_t s = 0; s < spheres.size(); ++s) {
        const double dy = y - spheres.y[s], dz = z - spheres.z[s];
        const double square = spheres.radius[s] * spheres.radius[s] - dy * dy - dz * dz;
        if (square <= 0) continue;
        const double from = std::max(lo.x, spheres.x[s] - std::sqrt(square));
        const double to = std::min(lo.x + h, spheres.x[s] + std::sqrt(square));
        if (from < to) pieces.emplace_back(from, to);
      }
      std::sort(pieces.begin(), pieces.end());
      double reached = lo.x;
      for (const auto& [from, to] : pieces) {
        sum += std::max(0.0, to - std::max(from, reached));
        reached = std::max(reached, to);
      }
    }
  return sum / n / n / h;
}

double lens_volume(double a, double b, double d) {  // as two caps, pi t^2 (3r - t) / 3
  const double x = (d * d + a * a - b * b) / (2 * d);
  const double s = a - x, t = b - (d - x);
  return std::numbers::pi / 3 * (s * s * (3 * a - s) + t * t * (3 * b - t));
}

TEST(Union, OfTwoEqualSpheresLosesTheLensOnce) {
  for (const double overlap : {1e-10, 1e-8, 1e-6, 8e-6, 29e-6, 55e-6})
    for (const double voxel : {7e-6, 17.3e-6, 61e-6, 200e-6}) {
      const double r = 30e-6, d = 2 * r - overlap;
      Spheres spheres;
      spheres.add({61.3e-6, 72.1e-6, 88.7e-6}, r);
      const Vec3d direction = (1 / std::sqrt(14.0)) * Vec3d{3, 2, 1};
      spheres.add(spheres.center(0) + d * direction, r);
      const Field field = united(spheres, voxel);
      const double pi = std::numbers::pi;
      const double lens = pi * (2 * r - d) * (2 * r - d) * (d * d + 4 * r * d) / (12 * d);
      EXPECT_NEAR(field.sums.overlap_volume, lens, 1e-10 * lens + 1e-16 * spheres.volume())
          << overlap << " " << voxel;
      EXPECT_NEAR(field.sums.solid_volume_field / (spheres.volume() - lens), 1, 1e-13)
          << overlap << " " << voxel;
    }
}

TEST(Union, OfUnequalSpheresToo) {
  for (const double small : {2e-6, 10e-6, 29e-6})
    for (const double depth :
         {0.01, 0.5, 1.0, 1.7, 1.99}) {  // of the small radius; beyond 1 its centre is inside
      const double r = 40e-6, d = r + small - depth * small;
      Spheres spheres;
      spheres.add({90e-6, 95e-6, 103e-6}, r);
      spheres.add(spheres.center(0) + (d / 3) * Vec3d{-1, 2, 2}, small);
      const Field field = united(spheres, 13e-6);
      const double lens = lens_volume(r, small, d);
      EXPECT_NEAR(field.sums.solid_volume_field / (spheres.volume() - lens), 1, 1e-12)
          << small << " " << depth;
    }
}

TEST(Union, OfTwoSpheresCellByCell) {
  Spheres spheres;
  spheres.add({88e-6, 101e-6, 95e-6}, 31e-6);
  spheres.add({117e-6, 110e-6, 104e-6}, 24e-6);
  const double h = 20e-6;
  const Field field = united(spheres, h);
  int both = 0;
  for (int i = 2; i < 8; ++i)
    for (int j = 2; j < 8; ++j)
      for (int k = 2; k < 8; ++k) {
        const double expected = united_share(spheres, {i * h, j * h, k * h}, h, 600);
        EXPECT_NEAR(value(field, i, j, k), expected, 2e-6) << i << j << k;
        both += expected > 0;
      }
  EXPECT_GT(both, 30);
}

TEST(Union, OfTwoSpheresOnAnAxisSlabBySlab) {
  // between planes x = const the union is a body of revolution whose volume is a polynomial
  const double r = 31e-6, a = 81.3e-6, b = 122.9e-6, y = 97.7e-6, z = 104.9e-6, rim = 0.5 * (a + b);
  Spheres spheres;
  spheres.add({a, y, z}, r);
  spheres.add({b, y, z}, r);
  const auto up_to = [&](double x) {  // the union's volume left of x
    const auto ball = [&](double d) { return std::numbers::pi * (r * r * d - d * d * d / 3); };
    const double first = ball(std::clamp(x, a - r, rim) - a) - ball(-r);
    const double second = ball(std::clamp(x, rim, b + r) - b) - ball(rim - b);
    return first + second;
  };
  for (const double h : {20e-6, 13.1e-6}) {
    const Field field = united(spheres, h);
    for (int i = 0; i < field.lattice.n[0]; ++i) {
      double slab = 0;
      for (int j = 0; j < field.lattice.n[1]; ++j)
        for (int k = 0; k < field.lattice.n[2]; ++k) slab += value(field, i, j, k);
      EXPECT_NEAR(slab, (up_to((i + 1) * h) - up_to(i * h)) / (h * h * h), 5e-7) << h << " " << i;
    }
  }
}

TEST(Union, OfThreeMutuallyOverlappingSpheres) {
  for (const double spread : {8e-6, 14e-6, 18.5e-6, 24e-6}) {
    Spheres spheres;
    for (int s = 0; s < 3; ++s) {
      const double angle = 0.3 + 2 * std::numbers::pi / 3 * s;
      spheres.add({101e-6 + spread * std::cos(angle), 97e-6 + spread * std::sin(angle), (98 + 3 * s) * 1e-6},
                  (21 + 2 * s) * 1e-6);
    }
    const double h = 25e-6;
    const Field field = united(spheres, h);
    for (int i = 1; i < 7; ++i)
      for (int j = 1; j < 7; ++j)
        for (int k = 1; k < 7; ++k)
          EXPECT_NEAR(value(field, i, j, k), united_share(spheres, {i * h, j * h, k * h}, h, 500), 1e-5)
              << spread << ": " << i << j << k;
  }
}

TEST(Union, OfARowOfSpheresOnOneAxis) {
  // the union of balls with centres on a line is a body of revolution: pi times the integral of the largest
  // squared radius
  Spheres spheres;
  const double r = 25e-6;
  for (int s = 0; s < 5; ++s) spheres.add({(60 + 13.0 * s) * 1e-6, 100e-6, 100e-6}, r);
  long double volume = 0;
  const int steps = 2'000'000;
  for (int n = 0; n < steps; ++n) {
    const double x = 30e-6 + (n + 0.5) / steps * 120e-6;
    double largest = 0;
    for (const double c : spheres.x) largest = std::max(largest, r * r - (x - c) * (x - c));
    volume += static_cast<long double>(largest);
  }
  volume *= std::numbers::pi_v<long double> * 120e-6L / steps;
  for (const double voxel : {9e-6, 30e-6, 200e-6}) {
    const Field field = united(spheres, voxel);
    EXPECT_NEAR(field.sums.solid_volume_field / static_cast<double>(volume), 1, 1e-6) << voxel;
    EXPECT_GE(field.sums.void_min, -1e-6);
  }
}

TEST(Union, OfIdenticalAndNestedSpheresIsTheOutermost) {
  Spheres one, many;
  one.add({90e-6, 110e-6, 95e-6}, 35e-6);
  for (int copy = 0; copy < 3; ++copy) many.add(one.center(0), 35e-6);
  many.add({92e-6, 108e-6, 97e-6}, 20e-6);   // inside
  many.add({92e-6, 108e-6, 97e-6}, 8e-6);    // inside that
  many.add({115e-6, 110e-6, 95e-6}, 10e-6);  // touching from inside
  const Field expected = united(one, 12e-6), field = united(many, 12e-6);
  for (int i = 0; i < 17; ++i)
    for (int j = 0; j < 17; ++j)
      for (int k = 0; k < 17; ++k) ASSERT_EQ(value(field, i, j, k), value(expected, i, j, k));
  EXPECT_NEAR(field.sums.overlap_volume / (many.volume() - one.volume()), 1, 1e-12);
  EXPECT_NEAR(field.sums.solid_volume_field / one.volume(), 1, 1e-12);
}

TEST(Union, LeavesCellsWithoutOverlapBitForBit) {
  const Spheres spheres = random_spheres(120, {{0, 0, 0}, {kBox, kBox, kBox}}, 4e-6, 20e-6, 5);
  const double h = 9.1e-6;
  const Field sum = compute_field(spheres.view(), {}, request_for(h, Overlap::sum));
  const Field field = united(spheres, h);
  int apart = 0, changed = 0;
  for (int i = 0; i < field.lattice.n[0]; ++i)
    for (int j = 0; j < field.lattice.n[1]; ++j)
      for (int k = 0; k < field.lattice.n[2]; ++k) {
        // how many spheres reach into the cell; with two or more they may share a place
        int reaching = 0;
        for (std::size_t s = 0; s < spheres.size(); ++s)
          reaching += touches(field.lattice, place(field.lattice, spheres.center(s), spheres.radius[s]),
                              {{i, j, k}, {i + 1, j + 1, k + 1}});
        const double a = value(sum, i, j, k), b = value(field, i, j, k);
        if (reaching < 2) {
          ASSERT_EQ(a, b);
        }
        ASSERT_LE(b, a);
        ASSERT_LE(b, 1 + 1e-5);
        apart += reaching == 1, changed += a != b;
      }
  EXPECT_GT(apart, 500);
  EXPECT_GT(changed, 500);
}

TEST(Union, OfACrowdStaysWithinItsBound) {
  const Spheres spheres =
      random_spheres(60, {{80e-6, 80e-6, 80e-6}, {120e-6, 120e-6, 120e-6}}, 4e-6, 12e-6, 9);
  const double h = 25e-6;
  const Field field = united(spheres, h);
  for (int i = 2; i < 6; ++i)
    for (int j = 2; j < 6; ++j)
      for (int k = 2; k < 6; ++k)
        EXPECT_NEAR(value(field, i, j, k), united_share(spheres, {i * h, j * h, k * h}, h, 400), 1e-3);
}

TEST(Union, ReachesAcrossPeriodicFaces) {
  Spheres inner, across;
  inner.add({100e-6, 100e-6, 100e-6}, 30e-6);
  inner.add({140e-6, 110e-6, 100e-6}, 25e-6);
  across.add({190e-6, 100e-6, 195e-6}, 30e-6);
  across.add({30e-6, 110e-6, 195e-6}, 25e-6);
  FieldRequest request = request_for(10e-6);
  request.periodic = {true, false, true};
  const Field a = compute_field(inner.view(), {}, request), b = compute_field(across.view(), {}, request);
  EXPECT_NEAR(b.sums.overlap_volume / a.sums.overlap_volume, 1, 1e-9);
  EXPECT_NEAR(b.sums.solid_volume_field / a.sums.solid_volume_field, 1, 1e-9);
}

TEST(Union, OfASphereThatOverlapsItsOwnImage) {
  Spheres spheres;
  spheres.add({3e-6, 100e-6, 100e-6}, 60e-6);
  FieldRequest request = request_for(10e-6);
  request.lattice = cubic_lattice({{0, 0, 0}, {100e-6, kBox, kBox}}, 10e-6);
  request.periodic = {true, false, false};
  const Field field = compute_field(spheres.view(), {}, request);
  EXPECT_NEAR(field.sums.overlap_volume / lens_volume(60e-6, 60e-6, 100e-6), 1, 1e-7);
}

TEST(Union, CountsOnlyWhatLiesInTheBox) {
  Spheres spheres;  // the lens is cut in half by the face x = 0
  spheres.add({0, 100e-6, 100e-6}, 30e-6);
  spheres.add({0, 140e-6, 100e-6}, 30e-6);
  const Field field = united(spheres, 20e-6);
  EXPECT_NEAR(field.sums.overlap_volume / (0.5 * lens_volume(30e-6, 30e-6, 40e-6)), 1, 1e-7);
}

TEST(Union, TakesMassOffWithTheLens) {
  Spheres spheres;
  spheres.add({90e-6, 100e-6, 100e-6}, 30e-6);
  spheres.add({130e-6, 100e-6, 100e-6}, 30e-6);
  spheres.density = {8000, 8000};
  const Field field = united(spheres, 20e-6);
  for (auto voxel = field.mass_density->cbeginValueOn(); voxel; ++voxel)
    ASSERT_NEAR(*voxel, 8000 * field.solid_fraction->tree().getValue(voxel.getCoord()), 1e-2);
}

TEST(Union, IsTheSameForAnyNumberOfThreads) {
  const Spheres spheres = random_spheres(400, {{0, 0, 0}, {kBox, kBox, kBox}}, 3e-6, 9e-6, 6);
  std::array<Field, 2> fields;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    fields[threads - 1] = united(spheres, 11e-6);
  }
  EXPECT_EQ(fields[0].sums.solid_volume_field, fields[1].sums.solid_volume_field);
  EXPECT_EQ(fields[0].sums.overlap_volume, fields[1].sums.overlap_volume);
}

TEST(Union, GoesWithTheExactMethodAlone) {
  FieldRequest request = request_for(20e-6);
  request.method = Method::centre;
  Spheres spheres;
  spheres.add({100e-6, 100e-6, 100e-6}, 20e-6);
  EXPECT_THROW(compute_field(spheres.view(), {}, request), InputError);
}

TEST(Lens, ItsBoundsHoldItTightly) {
  for (int n = 0; n < 200; ++n) {
    Random random(31, static_cast<std::uint64_t>(n));
    const CellBall a{{0.1, -0.2, 0.3}, 1};
    const double r = random.uniform(0.05, 1.5);
    const Vec3d v{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double d = random.uniform(std::abs(1 - r), 1 + r);
    const CellBall b{a.center + (d / norm(v)) * v, r};
    if (meeting(a, b) != Meeting::lens) continue;
    const Lens lens = lens_of(a, b);
    // supporting points by iteration: along each axis no point of both balls lies beyond, and some come near
    Vec3d lo{9, 9, 9}, hi{-9, -9, -9};
    for (int p = 0; p < 60; ++p)
      for (int q = 0; q < 120; ++q) {
        const double polar = std::numbers::pi * (p + 0.5) / 60, round = std::numbers::pi * q / 60;
        const Vec3d at{std::sin(polar) * std::cos(round), std::sin(polar) * std::sin(round), std::cos(polar)};
        for (const auto& [own, other] : {std::pair{a, b}, std::pair{b, a}}) {
          const Vec3d point = own.center + own.radius * at;
          if (norm(point - other.center) > other.radius) continue;
          EXPECT_LE(norm(point - lens.rim_center), lens.outer_radius * (1 + 1e-12) + 1e-12);
          for (int axis = 0; axis < 3; ++axis)
            lo[axis] = std::min(lo[axis], point[axis]), hi[axis] = std::max(hi[axis], point[axis]);
        }
      }
    for (int axis = 0; axis < 3; ++axis) {
      if (lo[axis] > hi[axis]) continue;
      EXPECT_GE(lo[axis], lens.lo[axis] - 1e-12);
      EXPECT_LE(hi[axis], lens.hi[axis] + 1e-12);
      EXPECT_LE(lo[axis] - lens.lo[axis], 0.12);
      EXPECT_LE(lens.hi[axis] - hi[axis], 0.12);
    }
  }
}

}  // namespace
}  // namespace interstice::voxel::test
