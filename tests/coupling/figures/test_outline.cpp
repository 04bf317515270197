// Walls as outlines: cut by a slice, seen from a side. Expected areas are worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/figures/outline.h"
#include "coupling/figures/section.h"

namespace {

using namespace interstice;
using figures::Extent;
using figures::Outline;

double area(const std::vector<Outline>& outlines) {
  double sum = 0;
  for (const auto& o : outlines) {
    double twice = 0;
    for (std::size_t i = 0; i < o.size(); ++i) {
      const auto &p = o[i], &q = o[(i + 1) % o.size()];
      twice += p[0] * q[1] - q[0] * p[1];
    }
    sum += std::abs(twice) / 2;
  }
  return sum;
}

const Extent square{{0, 0}, {2, 2}};
const std::array<int, 2> yz{1, 2};

TEST(Outline, ABoxIsCutWhereTheSliceMeetsIt) {
  const std::vector<io::WallPose> box{{"box", Box{{0, 1, 1}, {1, 5, 5}}}};
  EXPECT_DOUBLE_EQ(area(figures::cut(box, 0, 0.5, yz, square)), 1.0);
  EXPECT_TRUE(figures::cut(box, 0, 1.5, yz, square).empty());
}

TEST(Outline, APlaneIsSolidBehindItsNormal) {
  const std::vector<io::WallPose> floor{{"floor", Plane{{0, 0, 0.5}, {0, 0, 1}}}};
  EXPECT_DOUBLE_EQ(area(figures::cut(floor, 0, 0, yz, square)), 1.0);  // 2 wide, 0.5 high
  const double s = std::sqrt(0.5);
  const std::vector<io::WallPose> ramp{{"ramp", Plane{{0, 1, 1}, {0, s, s}}}};
  EXPECT_NEAR(area(figures::cut(ramp, 0, 0, yz, square)), 2.0, 1e-12);  // half the square
}

TEST(Outline, SeenFromAboveAFloorIsNoOutline) {
  const std::vector<io::WallPose> walls{{"floor", Plane{{0, 0, 0}, {0, 0, 1}}},
                                        {"blade", Box{{1, 0, 7}, {3, 1, 9}}}};
  EXPECT_DOUBLE_EQ(area(figures::silhouette(walls, 2, {0, 1}, square)), 1.0);
}

TEST(Outline, TheExtentGrowsOnlyTowardsAWallThatClosesTheSide) {
  const std::vector<io::WallPose> walls{{"floor", Plane{{0, 0, 0}, {0, 0, 1}}},
                                        {"post", Box{{-1, 0, 0}, {1, 0.1, 9}}}};
  const Extent grown = figures::widened_to_walls(walls, 0, 0, yz, square, {0.5, 0.25});
  EXPECT_EQ(grown.lo, (figures::Point{0, -0.25}));
  EXPECT_EQ(grown.hi, (figures::Point{2, 2}));
}

// Polygons of 180 sides inscribed in a circle have 1 - (2 pi / 180)^2 / 6 = 0.9998 of its area.
TEST(Section, OfCurvedSolids) {
  const double pi = std::acos(-1.0);
  const Extent wide{{-9, -9}, {9, 9}};
  const auto cut_at = [&](const voxel::Solids& solids, double at, const Extent& extent) {
    return area(figures::sections(solids, 0, at, yz, extent));
  };
  const voxel::Solids ball{.balls = {{{1, 0, 0}, 2}}};
  EXPECT_NEAR(cut_at(ball, 1, wide) / (4 * pi), 1, 3e-4);
  EXPECT_NEAR(cut_at(ball, 2, wide) / (3 * pi), 1, 3e-4);
  EXPECT_EQ(cut_at(ball, 3.5, wide), 0);
  EXPECT_NEAR(cut_at(ball, 1, square) / pi, 1, 3e-4);  // a quarter of it
  const voxel::Solids across{.cylinders = {{{-1, 0, 0}, {1, 0, 0}, 2}}};
  EXPECT_NEAR(cut_at(across, 0.3, wide) / (4 * pi), 1, 3e-4);
  const voxel::Solids along{.cylinders = {{{0.1, -3, 1}, {0.1, 3, 1}, 2}}};
  EXPECT_NEAR(cut_at(along, 0.1, wide), 6 * 4, 1e-2);  // through its axis
  const double s = std::sqrt(0.5);
  const voxel::Solids oblique{.cylinders = {{{-9 * s, -9 * s, 0}, {9 * s, 9 * s, 0}, 2}}};
  EXPECT_NEAR(cut_at(oblique, 0, wide) / (4 * pi / s), 1, 3e-4);  // an ellipse
}

TEST(Section, OfASurface) {
  // a tetrahedron with legs of 4, and another beside it
  std::vector<voxel::Triangle> triangles;
  for (const double y : {0., 5.}) {
    const Vec3d o{0, y, 0}, a{4, y, 0}, b{0, y + 4, 0}, c{0, y, 4};
    for (const auto& t : {voxel::Triangle{o, b, a}, voxel::Triangle{o, a, c}, voxel::Triangle{o, c, b},
                          voxel::Triangle{a, b, c}})
      triangles.push_back(t);
  }
  const voxel::Solids solids{
      .meshes = {{std::make_shared<voxel::TriangleMesh>(voxel::closed_mesh(triangles)), {1, 0, 0}}}};
  const Extent wide{{-1, -1}, {19, 9}};
  const auto outlines = figures::sections(solids, 0, 2, yz, wide);  // at 1 of 4: legs of 3
  EXPECT_EQ(outlines.size(), 2u);
  EXPECT_NEAR(area(outlines), 9, 1e-12);
  EXPECT_NEAR(area(figures::sections(solids, 0, 2, yz, {{0, 0}, {1, 9}})), 2.5, 1e-12);  // clipped at y = 1
  EXPECT_TRUE(figures::sections(solids, 0, 0.5, yz, wide).empty());
}

}  // namespace
