// The exact sphere-box volume: against published and independently computed values, and against its own
// invariants.
#include "voxel/overlap.h"

#include <gtest/gtest.h>

#include <limits>
#include <map>

#include "tests/voxel/reference_volume.h"
#include "tests/voxel/support.h"
#include "voxel/sum.h"

namespace interstice::voxel::test {
namespace {

constexpr double kPi = std::numbers::pi;
const Box kUnit{{0, 0, 0}, {1, 1, 1}};

struct Published {
  Vec3d center;
  double radius, volume, tolerance;
};

// Unit-cube values that two independent methods agree on, to the digits they are given with.
const Published kPublished[] = {
    {{.1, .2, .3}, .5, 0.23063177534739580, 1e-16},
    {{.25, .5, .75}, .6, 0.52929913777873800, 2e-16},
    {{.5, .5, .5}, .7, 0.95923295689608, 1e-14},
    {{0, 0, 0}, .3, kPi * .027 / 6, 1e-17},
};

TEST(SphereBoxVolume, AgreesWithPublishedValues) {
  for (const Published& p : kPublished)
    EXPECT_NEAR(sphere_box_volume(p.center, p.radius, kUnit), p.volume, p.tolerance);
}

TEST(SphereBoxVolume, ShallowCap) {
  // cap of height .001; the centre's rounding alone moves the height by 1e-16, the volume by 6e-19 = 2e-13 of
  // it
  const double height = 1 - .999, cap = kPi * height * height * (3 - height) / 3;
  EXPECT_NEAR(sphere_box_volume({.5, .5, -.999}, 1, kUnit), cap, 1e-16);  // 1e-16 (R/h)^3 of the cube
}

TEST(SphereBoxVolume, ScalesFromNanometresToDecimetres) {
  for (const Published& p : kPublished)
    for (const double scale : {1e-9, 20e-9, 1e-6, 17.3e-6, 1e-3, .1}) {
      const Box box{{0, 0, 0}, {scale, scale, scale}};
      const double cell = scale * scale * scale;
      // scaled inputs carry their own rounding: some 1e-16 of the cell
      EXPECT_NEAR(sphere_box_volume(scale * p.center, scale * p.radius, box) / cell, p.volume, 5e-15)
          << scale;
    }
}

TEST(SphereBoxVolume, DoesNotDependOnTheDistanceFromTheOrigin) {
  const double h =
      0x1p-16;  // 15 um, a power of two: coordinates 1 km away still hold multiples of h/1024 exactly
  for (const double far : {0.0, 1024.0, -1024.0}) {
    const Vec3d origin{far, -far, far};
    for (const Vec3d c : {Vec3d{.125, .25, .375}, Vec3d{.5, .75, -.125}}) {
      const Box near{{0, 0, 0}, {h, h, h}};
      const Box away{origin, origin + near.hi};
      EXPECT_EQ(sphere_box_volume(origin + h * c, .625 * h, away), sphere_box_volume(h * c, .625 * h, near));
    }
  }
}

TEST(SphereBoxVolume, TouchingIsNothing) {
  EXPECT_EQ(sphere_box_volume({-.5, .5, .5}, .5, kUnit), 0);       // a face
  EXPECT_EQ(sphere_box_volume({-.375, -.5, .5}, .625, kUnit), 0);  // an edge, 3-4-5 triangle
  EXPECT_EQ(sphere_box_volume({-.25, -.5, -.5}, .75, kUnit), 0);   // a corner, 1-2-2-3
  EXPECT_EQ(sphere_box_volume({-20e-9, 0, 0}, 20e-9, {{0, 0, 0}, {1e-6, 1e-6, 1e-6}}), 0);
}

TEST(SphereBoxVolume, HalfAtAFaceQuarterAtAnEdgeEighthAtACorner) {
  for (const double r : {1e-9, 20e-9, 5e-6, .4}) {
    const double h = 2.5 * r, v = ball_volume(r);
    const Box box{{0, 0, 0}, {h, h, h}};
    // half an ulp from each of a handful of operations
    EXPECT_NEAR(sphere_box_volume({0, h / 2, h / 2}, r, box) / v, 0.5, 1e-15);
    EXPECT_NEAR(sphere_box_volume({h / 2, h, h / 2}, r, box) / v, 0.5, 1e-15);
    EXPECT_NEAR(sphere_box_volume({0, 0, h / 2}, r, box) / v, 0.25, 1e-15);
    EXPECT_NEAR(sphere_box_volume({h, h / 2, 0}, r, box) / v, 0.25, 1e-15);
    EXPECT_NEAR(sphere_box_volume({0, 0, 0}, r, box) / v, 0.125, 1e-15);
    EXPECT_NEAR(sphere_box_volume({h, 0, h}, r, box) / v, 0.125, 1e-15);
  }
}

TEST(SphereBoxVolume, WholeSphereAndWholeBox) {
  EXPECT_NEAR(sphere_box_volume({.5, .5, .5}, .25, kUnit), ball_volume(.25), 1e-17);  // one ulp of 0.065
  // sqrt(3)/2 = 0.866: the box is inside; its volume is exact but for scaling with R^3 and back
  EXPECT_DOUBLE_EQ(sphere_box_volume({.5, .5, .5}, .875, kUnit), 1);
  EXPECT_DOUBLE_EQ(sphere_box_volume({.5, .5, .5}, 1024, kUnit), 1);
  EXPECT_EQ(sphere_box_volume({.5, .5, .5}, 1, {{0, 0, 0}, {0, 1, 1}}), 0);  // a box without volume
}

TEST(SphereBoxVolume, InfiniteBoxes) {
  const double inf = std::numeric_limits<double>::infinity();
  const Box half{{-inf, -inf, 0}, {inf, inf, inf}};
  EXPECT_NEAR(sphere_box_volume({1, 2, 0}, 2, half), ball_volume(2) / 2, 1e-14);  // an ulp of 17
  const double h = .5;                                                            // a cap of height R - 1.5
  EXPECT_NEAR(sphere_box_volume({0, 0, -1.5}, 2, half), kPi * h * h * (6 - h) / 3, 4e-15);
}

TEST(SphereBoxVolume, RandomBoxesAgreeWithAdaptiveQuadrature) {
  for (std::uint64_t i = 0; i < 400; ++i) {
    Random random(7, i);
    const auto between = [&](double a, double b) { return random.uniform(a, b); };
    const Vec3d center{between(-.5, 1.5), between(-.5, 1.5), between(-.5, 1.5)};
    const Box box{{0, 0, 0}, {between(.2, 1.5), between(.2, 1.5), between(.2, 1.5)}};
    const double radius = between(.05, 1.5);
    // quadrature is good to about 1e-15 of the sphere, the closed form to a few 1e-16
    EXPECT_NEAR(sphere_box_volume(center, radius, box), reference_volume(center, radius, box),
                1e-14 * radius * radius * radius)
        << i;
  }
}

// Cells that the surface passes, at places that are hard for one formula or another: the poles, the equators,
// and anywhere.
TEST(SphereBoxVolume, SmallCellsOnTheSurfaceAgreeWithAdaptiveQuadrature) {
  for (const double ratio : {.3, 1., 3., 10., 45., 55., 200., 3e4})
    for (std::uint64_t i = 0; i < 60; ++i) {
      Random random(8, i);
      double u = random.uniform(-1, 1), angle = 2 * kPi * random.uniform();
      if (i % 3 == 1) u = random.uniform(-1, 1) / (ratio + 1);
      if (i % 6 == 1) angle = kPi / 2 * std::floor(2 * angle / kPi) + random.uniform(-1, 1) / (ratio + 1);
      if (i % 3 == 2) u = 1 - random.uniform() / (ratio * ratio + 1);
      const double s = std::sqrt(1 - u * u);
      const Vec3d on{ratio * s * std::cos(angle), ratio * s * std::sin(angle), ratio * u};
      const Vec3d lo = on - Vec3d{random.uniform(), random.uniform(), random.uniform()};
      const Box cell{lo, lo + Vec3d{1, 1, 1}};
      // stated: 1e-15 max(1, (R/h)^3) for the closed form; for large spheres about 1e-16 R/h, times the
      // factor that the reference's own extended-precision cancellation (1e-19 (R/h)^2) and both methods'
      // chords need
      const double tolerance = ratio < 50 ? 2e-15 * std::max(1., ratio * ratio * ratio)
                                          : 1e-13 + 4e-15 * ratio + 1e-18 * ratio * ratio;
      EXPECT_NEAR(sphere_box_volume({0, 0, 0}, ratio, cell), reference_volume({0, 0, 0}, ratio, cell),
                  tolerance)
          << "R/h " << ratio << ", case " << i;
    }
}

TEST(SphereBoxVolume, FlatAndLongBoxesAgreeWithAdaptiveQuadrature) {
  for (std::uint64_t i = 0; i < 60; ++i) {
    Random random(9, i);
    Vec3d size{random.uniform(.01, .05), random.uniform(.01, .05), random.uniform(.01, .05)};
    size[static_cast<int>(i % 3)] = 3;
    const Vec3d lo{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Box box{lo, lo + size};
    EXPECT_NEAR(sphere_box_volume({0, 0, 0}, 1, box), reference_volume({0, 0, 0}, 1, box), 2e-15) << i;
  }
}

TEST(SphereBoxVolume, PartsAddUpToTheWhole) {
  const Box whole{{-.2, -.1, .05}, {1.1, .8, 1.3}};
  for (std::uint64_t i = 0; i < 100; ++i) {
    Random random(10, i);
    const Vec3d cut{random.uniform(-.2, 1.1), random.uniform(-.1, .8), random.uniform(.05, 1.3)};
    const Vec3d center{random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
    const double radius = random.uniform(.05, 1.2);
    double sum = 0;
    for (int octant = 0; octant < 8; ++octant) {
      Box part = whole;
      for (int axis = 0; axis < 3; ++axis) (octant >> axis & 1 ? part.lo : part.hi)[axis] = cut[axis];
      sum += sphere_box_volume(center, radius, part);
    }
    // eight volumes, each some 1e-16 R^3 off
    EXPECT_NEAR(sum, sphere_box_volume(center, radius, whole),
                4e-15 * std::max(1., radius * radius * radius));
  }
}

TEST(SphereBoxVolume, InsideAndOutsideAddUpToTheSphere) {
  const double inf = std::numeric_limits<double>::infinity();
  const Box box{{0, 0, 0}, {1, 1.5, .7}};
  const double edges[3][4] = {{-inf, 0, 1, inf}, {-inf, 0, 1.5, inf}, {-inf, 0, .7, inf}};
  for (const double radius : {.3, 1., 7.}) {
    const Vec3d center{.9, .2, .5};
    double outside = 0;
    for (int c = 0; c < 27; ++c) {
      const int i = c % 3, j = c / 3 % 3, k = c / 9;
      if (c == 13) continue;
      outside += sphere_box_volume(
          center, radius,
          {{edges[0][i], edges[1][j], edges[2][k]}, {edges[0][i + 1], edges[1][j + 1], edges[2][k + 1]}});
    }
    const double whole = ball_volume(radius);
    EXPECT_NEAR(outside + sphere_box_volume(center, radius, box), whole, 2e-15 * whole);  // a sum of 27
  }
}

double total(const Lattice& lattice, const Vec3d& center, double radius) {
  CompensatedSum sum;
  const CellRange all = bounding_cells(lattice, place(lattice, center, radius));
  for_each_overlap(lattice, center, radius, all,
                   [&](std::int64_t, std::int64_t, std::int64_t, double volume) { sum.add(volume); });
  return sum.value();
}

TEST(ForEachOverlap, ConservesTheVolumeOfEverySphere) {
  for (const double far : {0., 1000.})
    for (const double ratio : {.0005, .01, .3, 1., 2.7, 9., 30., 60.})
      for (std::uint64_t i = 0; i < (ratio < 50 ? 20 : 1); ++i) {
        Random random(11, i);
        const double h = 17.3e-6, radius = ratio * h;
        const Lattice lattice{{far, far, far}, {h, h, h}, {1, 1, 1}};
        const Vec3d center = lattice.lo + h * Vec3d{random.uniform(), random.uniform(), random.uniform()};
        // the goal for a single sphere; measured: below 1e-15
        EXPECT_NEAR(total(lattice, center, radius) / ball_volume(radius), 1, 2e-15) << ratio;
      }
}

TEST(ForEachOverlap, ConservesOnCellsThatAreNotCubes) {
  const Lattice lattice{{-1, 2, 3}, {.3, .17, 2.5}, {1, 1, 1}};
  for (const double radius : {.05, .4, 1., 3.})
    EXPECT_NEAR(total(lattice, {-.9, 2.05, 3.1}, radius) / ball_volume(radius), 1, 2e-15);
}

TEST(ForEachOverlap, TotalDoesNotDependOnWhereTheLatticeStands) {
  const Vec3d center{3e-6, 5e-6, -2e-6};
  const double radius = 21e-6;
  for (const double shift : {0., 1e-6, 4.7e-6, 11.3e-6}) {
    const Lattice lattice{{shift, -shift, shift / 3}, {8e-6, 8e-6, 8e-6}, {1, 1, 1}};
    EXPECT_NEAR(total(lattice, center, radius) / ball_volume(radius), 1, 2e-15);
  }
}

TEST(ForEachOverlap, CellsAreTheBoxVolumes) {
  const double h = 17.3e-6;
  const Lattice lattice{{0, 0, 0}, {h, h, h}, {20, 20, 20}};
  for (const double ratio : {.4, 1.9, 6.}) {
    const Vec3d center{8.3 * h, 9.1 * h, 8.6 * h};
    std::map<std::array<std::int64_t, 3>, double> seen;
    for_each_overlap(
        lattice, center, ratio * h, all_cells(lattice), [&](auto i, auto j, auto k, double volume) {
          EXPECT_TRUE((seen.emplace(std::array{i, j, k}, volume).second)) << "a cell was visited twice";
        });
    for (std::int64_t i = 0; i < 20; ++i)
      for (std::int64_t j = 0; j < 20; ++j)
        for (std::int64_t k = 0; k < 20; ++k) {
          const Vec3d lo{h * static_cast<double>(i), h * static_cast<double>(j), h * static_cast<double>(k)};
          const double expected = reference_volume(center, ratio * h, {lo, lo + lattice.h});
          const auto found = seen.find({i, j, k});
          // 1e-15 (R/h)^3 of a cell as stated, and the rounding of the box's edges (1e-16 of 20 h)
          EXPECT_NEAR(found == seen.end() ? 0 : found->second / (h * h * h), expected / (h * h * h),
                      1e-14 + 1e-15 * ratio * ratio * ratio);
        }
  }
}

TEST(ForEachOverlap, ACellsNumberDoesNotDependOnTheRange) {
  const double h = 5e-6;
  const Lattice lattice{{0, 0, 0}, {h, h, h}, {30, 30, 30}};
  const Vec3d center{61e-6, 59e-6, 71e-6};
  const double radius = 37e-6;
  std::map<std::array<std::int64_t, 3>, double> all;
  for_each_overlap(lattice, center, radius, all_cells(lattice), [&](auto i, auto j, auto k, double v) {
    all[{i, j, k}] = v;
  });
  std::size_t compared = 0;
  for (const CellRange range : {CellRange{{3, 4, 5}, {14, 13, 29}}, CellRange{{12, 12, 12}, {13, 13, 20}}})
    for_each_overlap(lattice, center, radius, range, [&](auto i, auto j, auto k, double v) {
      EXPECT_EQ(v, (all[{i, j, k}]));
      ++compared;
    });
  EXPECT_GT(compared, 500u);
}

// The lattice turned and mirrored about the sphere: the same volumes in the turned cells.
TEST(ForEachOverlap, TurningAndMirroringTheGridChangesNothing) {
  const double h = 1;
  const Vec3d center{2.3, 2.9, 3.4};
  const Lattice lattice{{0, 0, 0}, {h, h, h}, {6, 6, 6}};
  for (int turn = 0; turn < 6; ++turn)
    for (int mirror = 0; mirror < 8; ++mirror) {
      const int order[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
      Vec3d turned;
      for (int axis = 0; axis < 3; ++axis) {
        const double c = center[order[turn][axis]];
        turned[axis] = mirror >> axis & 1 ? 6 - c : c;
      }
      std::map<std::array<std::int64_t, 3>, double> volumes;
      for_each_overlap(lattice, turned, 1.7, all_cells(lattice), [&](auto i, auto j, auto k, double v) {
        volumes[{i, j, k}] = v;
      });
      for_each_overlap(lattice, center, 1.7, all_cells(lattice), [&](auto i, auto j, auto k, double v) {
        const std::array<std::int64_t, 3> from{i, j, k};
        std::array<std::int64_t, 3> to;
        for (int axis = 0; axis < 3; ++axis) {
          const std::int64_t a = from[static_cast<std::size_t>(order[turn][axis])];
          to[static_cast<std::size_t>(axis)] = mirror >> axis & 1 ? 5 - a : a;
        }
        EXPECT_NEAR(volumes[to], v, 5e-15);  // 1e-16 R^3, and a mirrored centre's rounding
      });
    }
}

TEST(ForEachOverlap, CellsInsideAreExactlyFullAndCellsOutsideAreNotVisited) {
  const double h = .1;
  const Lattice lattice{{0, 0, 0}, {h, h, h}, {40, 40, 40}};
  const Vec3d center{2.03, 1.96, 2.01};
  std::int64_t full = 0;
  for_each_overlap(lattice, center, 1.5, all_cells(lattice), [&](auto i, auto j, auto k, double v) {
    double nearest = 0, farthest = 0;
    const std::array<std::int64_t, 3> cell{i, j, k};
    for (int axis = 0; axis < 3; ++axis) {
      const double lo = h * static_cast<double>(cell[static_cast<std::size_t>(axis)]) - center[axis],
                   hi = lo + h;
      const double in = lo > 0 ? lo : hi < 0 ? -hi : 0, out = std::max(std::abs(lo), std::abs(hi));
      nearest += in * in;
      farthest += out * out;
    }
    EXPECT_LT(nearest, 2.25 + 1e-14);
    if (farthest < 2.25 - 1e-14) {
      EXPECT_EQ(v, lattice.cell_volume());
      ++full;
    }
  });
  EXPECT_GT(full, 10'000);
}

// A periodic image is the sphere in another cell: the same bits.
TEST(PlacedSphere, MovingByWholeCellsKeepsTheBits) {
  const Lattice lattice{{1e-6, 2e-6, 3e-6}, {7e-6, 7e-6, 7e-6}, {10, 10, 10}};
  PlacedSphere sphere = place(lattice, {33.3e-6, 41e-6, 27e-6}, 12e-6);
  double here[27], there[27];
  exact_fractions(lattice, sphere, {{3, 4, 2}, {6, 7, 5}}, here);
  sphere.cell[0] += 10;
  sphere.cell[2] -= 10;
  exact_fractions(lattice, sphere, {{13, 4, -8}, {16, 7, -5}}, there);
  for (int c = 0; c < 27; ++c) EXPECT_EQ(here[c], there[c]);
}

}  // namespace
}  // namespace interstice::voxel::test
