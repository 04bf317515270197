// Volume of walls in a cell: hand values, and a union against counting points.
#include "voxel/solids.h"

#include <gtest/gtest.h>

#include "tests/voxel/support.h"

namespace interstice::voxel::test {
namespace {

const Box kUnit{{0, 0, 0}, {1, 1, 1}};

bool inside(const Shape& shape, const Vec3d& p) {
  if (const auto* plane = std::get_if<Plane>(&shape)) return plane->distance(p) < 0;
  return std::get<Box>(shape).contains(p);
}

// Share of n^3 points in the union.
double counted(const Solids& solids, const Box& cell, int n) {
  std::int64_t in = 0;
  const Vec3d step = (1. / n) * cell.size();
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (int k = 0; k < n; ++k) {
        const Vec3d p = cell.lo + Vec3d{(i + .5) * step.x, (j + .5) * step.y, (k + .5) * step.z};
        for (const Shape& shape : solids.shapes)
          if (inside(shape, p)) {
            ++in;
            break;
          }
      }
  return static_cast<double>(in) / (static_cast<double>(n) * n * n) * cell.volume();
}

Plane through(const Vec3d& point, const Vec3d& direction) {
  return {point, (1 / norm(direction)) * direction};
}

TEST(SolidVolume, NothingAndEverything) {
  EXPECT_EQ(solid_volume({}, kUnit), 0);
  EXPECT_EQ(solid_volume({{Box{{-1, -1, -1}, {2, 2, 2}}}}, kUnit), 1);
  EXPECT_EQ(solid_volume({{Box{{1, 0, 0}, {2, 1, 1}}}}, kUnit), 0);
  EXPECT_EQ(solid_volume({{Plane{{0, 0, 0}, {0, 0, 1}}}}, kUnit), 0);   // solid below the cell
  EXPECT_EQ(solid_volume({{Plane{{0, 0, 0}, {0, 0, -1}}}}, kUnit), 1);  // solid above its floor
}

TEST(SolidVolume, UnionsCountOnce) {
  const Box a{{-1, -1, -1}, {.5, 2, 2}}, b{{-1, -1, -1}, {2, .5, 2}};
  EXPECT_DOUBLE_EQ(solid_volume({{a, a}}, kUnit), .5);
  EXPECT_DOUBLE_EQ(solid_volume({{a, b}}, kUnit), .75);
  EXPECT_DOUBLE_EQ(solid_volume({{a, b, Plane{{0, 0, .5}, {0, 0, 1}}}}, kUnit), .875);
}

TEST(SolidVolume, ObliquePlanesHandValues) {
  // corner tetrahedra of legs a: a^3/6, and complements; half by symmetry. Rounding of a sum of six pyramids:
  // 1e-15.
  EXPECT_NEAR(solid_volume({{through({.5, 0, 0}, {1, 1, 1})}}, kUnit), .125 / 6, 1e-15);
  EXPECT_NEAR(solid_volume({{through({.5, 0, 0}, {-1, -1, -1})}}, kUnit), 1 - .125 / 6, 1e-15);
  EXPECT_NEAR(solid_volume({{through({.5, .5, .5}, {3, -2, 1})}}, kUnit), .5, 1e-15);
  // a 45 degree ramp: a triangular prism
  EXPECT_NEAR(solid_volume({{through({.25, 0, 0}, {1, 0, 1})}}, kUnit), .25 * .25 / 2, 1e-15);
  // nearly axis-aligned: a wedge of mean height 0.3
  EXPECT_NEAR(solid_volume({{through({.5, .5, .3}, {1e-9, -1e-12, 1})}}, kUnit), .3, 1e-15);
  // a plane away from the cell
  EXPECT_EQ(solid_volume({{through({3, 3, 3}, {1, 1, 1})}}, kUnit), 1);
  EXPECT_EQ(solid_volume({{through({3, 3, 3}, {-1, -1, -1})}}, kUnit), 0);
}

TEST(SolidVolume, BothSidesOfAnObliquePlaneMakeTheCell) {
  const Box cell{{3e-6, -2e-6, 1e-3}, {20e-6, 15e-6, 1.02e-3}};
  for (std::uint64_t i = 0; i < 200; ++i) {
    Random random(21, i);
    const Vec3d n{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Vec3d p{random.uniform(0, 20e-6), random.uniform(0, 15e-6), random.uniform(1e-3, 1.02e-3)};
    const double a = solid_volume({{through(p, n)}}, cell), b = solid_volume({{through(p, -n)}}, cell);
    EXPECT_NEAR((a + b) / cell.volume(), 1, 1e-14);  // rounding of twelve pyramids
  }
}

TEST(SolidVolume, ObliquePlanesAgreeWithCounting) {
  for (std::uint64_t i = 0; i < 20; ++i) {
    Random random(22, i);
    const Vec3d n{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const Solids solids{{through({random.uniform(), random.uniform(), random.uniform()}, n)}};
    EXPECT_NEAR(solid_volume(solids, kUnit), counted(solids, kUnit, 60), 1e-3);  // points: a few 1e-4 at 60
  }
}

TEST(SolidVolume, UnionsOfManyBoxesAndPlanesAgreeWithCounting) {
  const Box cell{{0, 0, 0}, {2e-5, 1e-5, 3e-5}};
  for (std::uint64_t i = 0; i < 20; ++i) {
    Random random(23, i);
    Solids solids;
    for (int b = 0; b < 5; ++b) {
      Box box;
      for (int axis = 0; axis < 3; ++axis) {
        // faces halfway between the counted points, so that counting is exact
        const double size = cell.hi[axis] / 40, lo = std::floor(random.uniform(-10, 40));
        box.lo[axis] = size * lo;
        box.hi[axis] = size * (lo + std::floor(random.uniform(1, 25)));
      }
      solids.shapes.emplace_back(box);
    }
    if (i % 2) solids.shapes.emplace_back(Plane{{0, cell.hi.y / 40 * 37, 0}, {0, -1, 0}});
    EXPECT_NEAR(solid_volume(solids, cell) / cell.volume(), counted(solids, cell, 40) / cell.volume(), 1e-13)
        << i;  // rounding of faces at multiples of 1/40
  }
}

TEST(SolidVolume, AnObliquePlaneAndABoxAddUpToAtMostTheCell) {
  const Plane half = through({.5, .5, .5}, {1, 1, 1});
  EXPECT_NEAR(solid_volume({{half, Box{{.9, .9, .9}, {2, 2, 2}}}}, kUnit), .5 + .001, 1e-15);
  EXPECT_EQ(solid_volume({{half, Box{{-1, -1, -1}, {2, 2, .75}}}}, kUnit), 1);
}

}  // namespace
}  // namespace interstice::voxel::test
