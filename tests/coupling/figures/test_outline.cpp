// Walls as outlines: cut by a slice, seen from a side. Expected areas are worked out by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/figures/outline.h"

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

}  // namespace
