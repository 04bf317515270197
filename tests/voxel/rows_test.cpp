// Rounding of a block's sums to leaves, beside one cell at a time; what lies beyond the lattice is not a
// number.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "voxel/round_rows.h"

namespace interstice::voxel {
namespace {

constexpr double kBeyond = std::numeric_limits<double>::quiet_NaN();

struct Given {
  int n[3];
  std::vector<double> solid, walls;  // rows of eight; beyond the lattice not numbers
};

Given random_block(int nx, int ny, int nz, unsigned seed) {
  Given given{{nx, ny, nz}, std::vector<double>(512, kBeyond), std::vector<double>(512, kBeyond)};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(-0.3, 1.1);
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) {
        const auto at = static_cast<std::size_t>((i * 8 + j) * 8 + k);
        given.solid[at] = std::max(share(random), 0.0);  // a fifth holds nothing
        given.walls[at] = std::max(share(random), 0.0) / 2;
      }
  return given;
}

void expect_as_cell_by_cell(const Given& given, bool walls) {
  std::vector<float> solid(512, -1), empty(512, -1), available(512, -1);
  LeafRows leaves;
  leaves.solid = solid.data(), leaves.empty = empty.data(), leaves.available = available.data();
  leaves.least_void = -0.05;
  RowSums sums;
  const int* n = given.n;
  round_rows({given.solid.data(), 64, 8, {n[0], n[1], n[2]}, walls ? given.walls.data() : nullptr}, leaves,
             sums);

  RowSums expected;
  for (int i = 0; i < n[0]; ++i)
    for (int j = 0; j < n[1]; ++j)
      for (int k = 0; k < 8; ++k) {
        const auto row = static_cast<std::size_t>(i * 8 + j), at = row * 8 + static_cast<std::size_t>(k);
        SCOPED_TRACE(testing::Message() << "cell " << i << ' ' << j << ' ' << k);
        const bool inside = k < n[2];
        const double s = inside ? given.solid[at] : 0, w = inside && walls ? given.walls[at] : 0;
        const double left = (1 - w) - s;
        ASSERT_EQ(solid[at], static_cast<float>(s));
        ASSERT_EQ(empty[at], static_cast<float>(left));
        ASSERT_EQ(available[at], walls ? static_cast<float>(1 - w) : -1);
        ASSERT_EQ(leaves.solid_on[row] >> k & 1, s != 0);
        ASSERT_EQ(leaves.wall_on[row] >> k & 1, w != 0);
        ASSERT_EQ(leaves.any_on[row] >> k & 1, s != 0 || w != 0);
        if (!inside) continue;
        expected.solid[k] += s, expected.wall[k] += w;
        expected.written[k] += static_cast<double>(static_cast<float>(s));
        expected.negative[k] += left < leaves.least_void;
        expected.void_min[k] = std::min(expected.void_min[k], left);
        expected.void_max[k] = std::max(expected.void_max[k], left);
      }
  for (int k = 0; k < 8; ++k) {  // the same sums in the same order: the same bits
    EXPECT_EQ(sums.solid[k], expected.solid[k]);
    EXPECT_EQ(sums.wall[k], expected.wall[k]);
    EXPECT_EQ(sums.written[k], expected.written[k]);
    EXPECT_EQ(sums.negative[k], expected.negative[k]);
    EXPECT_EQ(sums.void_min[k], expected.void_min[k]);
    EXPECT_EQ(sums.void_max[k], expected.void_max[k]);
  }
}

TEST(Rows, WholeBlocksAreRoundedAsCellByCell) {
  const Given given = random_block(8, 8, 8, 1);
  expect_as_cell_by_cell(given, false);
  expect_as_cell_by_cell(given, true);
}

TEST(Rows, NothingIsTakenFromBeyondTheLattice) {
  for (int nz = 1; nz < 8; ++nz) {
    const Given given = random_block(3, 5, nz, static_cast<unsigned>(nz));
    expect_as_cell_by_cell(given, false);
    expect_as_cell_by_cell(given, true);
  }
}

}  // namespace
}  // namespace interstice::voxel
