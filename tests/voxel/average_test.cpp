// Averaged fields against windows summed directly, voxel by voxel.
#include "voxel/average.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include "base/error.h"
#include "tests/voxel/support.h"
#include "voxel/field.h"

namespace interstice::voxel::test {
namespace {

double value_at(const openvdb::FloatGrid::Ptr& grid, std::int64_t i, std::int64_t j, std::int64_t k) {
  return static_cast<double>(
      grid->tree().getValue({static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)}));
}

// Share of cell j [of n] inside a window of `cells` cells around the centre of cell i, over all periods.
double weight(std::int64_t i, std::int64_t j, std::int64_t n, double cells, bool periodic) {
  double sum = 0;
  for (int period = periodic ? -3 : 0; period <= (periodic ? 3 : 0); ++period) {
    const double lo = static_cast<double>(j + period * n), center = static_cast<double>(i) + .5;
    sum += std::max(0., std::min(lo + 1, center + cells / 2) - std::max(lo, center - cells / 2));
  }
  return sum;
}

struct Case {
  double length;  // in voxels
  std::array<bool, 3> periodic;
  bool walls;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.length << " voxels" << (c.periodic[0] ? ", periodic" : "") << (c.walls ? ", walls" : "");
}

class AgainstDirectWindows : public testing::TestWithParam<Case> {};

TEST_P(AgainstDirectWindows, EveryVoxel) {
  const Case& c = GetParam();
  const double h = 10e-6;
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {15 * h, 12 * h, 19 * h}}, h);
  request.periodic = c.periodic;
  request.average_length = c.length * h;
  const Spheres spheres = random_spheres(14, {{0, 0, 0}, {15 * h, 12 * h, 6 * h}}, 4e-6, 25e-6, 51);
  Solids walls;
  if (c.walls)
    walls.shapes = {Plane{{0, 0, 1.3 * h}, {0, 0, 1}}, Box{{6.5 * h, 3 * h, 0}, {9 * h, 20 * h, 8.2 * h}}};
  const Field field = compute_field(spheres.view(), walls, request);
  const auto& n = request.lattice.n;
  double largest = 0;
  for (std::int64_t i = 0; i < n[0]; ++i)
    for (std::int64_t j = 0; j < n[1]; ++j)
      for (std::int64_t k = 0; k < n[2]; ++k) {
        double solid = 0, available = 0;
        for (std::int64_t a = 0; a < n[0]; ++a) {
          const double wx = weight(i, a, n[0], c.length, c.periodic[0]);
          for (std::int64_t b = 0; wx > 0 && b < n[1]; ++b) {
            const double wxy = wx * weight(j, b, n[1], c.length, c.periodic[1]);
            for (std::int64_t d = 0; wxy > 0 && d < n[2]; ++d) {
              const double w = wxy * weight(k, d, n[2], c.length, c.periodic[2]);
              if (w == 0) continue;
              solid += w * value_at(field.solid_fraction, a, b, d);
              available += w * (c.walls ? value_at(field.available_fraction, a, b, d) : 1);
            }
          }
        }
        const double expected = available > 0 ? solid / available : 0;
        largest = std::max(largest, expected);
        // the reference sums floats (2^-24 of each); the result is a float; shares above 1 where grains sink
        // in walls
        ASSERT_NEAR(value_at(field.solid_fraction_averaged, i, j, k), expected, 2e-7 * (1 + expected))
            << i << " " << j << " " << k;
        ASSERT_NEAR(value_at(field.void_fraction_averaged, i, j, k), 1 - expected, 2e-7 * (1 + expected));
        const openvdb::Coord at(static_cast<int>(i), static_cast<int>(j), static_cast<int>(k));
        ASSERT_EQ(field.solid_fraction_averaged->tree().isValueOn(at), expected > 0);
      }
  EXPECT_GT(largest, .05);
}

INSTANTIATE_TEST_SUITE_P(
    Windows, AgainstDirectWindows,
    testing::Values(Case{3, {false, false, false}, false}, Case{4, {false, false, false}, false},
                    Case{2.7, {false, false, false}, false}, Case{5.4, {true, true, false}, false},
                    Case{.5, {false, false, false}, false}, Case{12, {true, true, true}, false},
                    Case{9.3, {false, false, false}, true}, Case{3, {true, true, false}, true},
                    Case{6.2, {true, true, false}, true}, Case{40, {false, false, false}, true}));

TEST(Average, APackingAveragedOverItsPeriodIsUniform) {
  // a window of one period holds the whole cell wherever it stands
  Spheres spheres;
  const double cell = 40e-6;
  spheres.add({3e-6, 1e-6, 7e-6}, cell / 2);
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {cell, cell, cell}}, cell / 9);
  request.periodic = {true, true, true};
  request.average_length = cell;
  const Field field = compute_field(spheres.view(), {}, request);
  EXPECT_EQ(field.solid_fraction_averaged->activeVoxelCount(), 729u);
  for (auto it = field.solid_fraction_averaged->cbeginValueOn(); it; ++it)
    ASSERT_NEAR(it.getValue(), std::numbers::pi / 6, 6e-8);  // a float
  request.average_length = 3 * cell;                         // at most one period
  const Field wider = compute_field(spheres.view(), {}, request);
  for (auto it = wider.solid_fraction_averaged->cbeginValueOn(); it; ++it)
    ASSERT_NEAR(it.getValue(), std::numbers::pi / 6, 6e-8);
}

TEST(Average, AUniformFieldStaysUniformUpToItsEdges) {
  // a sphere that fills the box: what the window holds of the box is full everywhere
  Spheres spheres;
  spheres.add({0, 0, 0}, 1);
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {1e-4, 1e-4, 1e-4}}, 1e-5);
  request.average_length = 47e-6;
  const Field field = compute_field(spheres.view(), {}, request);
  EXPECT_EQ(field.solid_fraction_averaged->activeVoxelCount(), 1000u);
  for (auto it = field.solid_fraction_averaged->cbeginValueOn(); it; ++it) ASSERT_FLOAT_EQ(it.getValue(), 1);
}

TEST(Average, ActiveOnlyAroundTheSpheres) {
  Spheres spheres;
  spheres.add({1e-3, 1e-3, 1e-3}, 20e-6);
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {.05, .05, .05}}, 5e-6);  // 10^12 voxels
  request.average_length = 50e-6;
  const Field field = compute_field(spheres.view(), {}, request);
  const std::uint64_t active = field.solid_fraction_averaged->activeVoxelCount();
  EXPECT_GT(active, 1000u);
  EXPECT_LT(active, 8000u);
}

TEST(Average, RefusesMoreThanItsMemory) {
  Spheres spheres;
  spheres.add({1e-6, 1e-6, 1e-6}, 1e-6);
  spheres.add({999e-6, 999e-6, 999e-6}, 1e-6);
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {1e-3, 1e-3, 1e-3}}, 1e-6);  // 10^9 voxels between the two
  request.average_length = 5e-6;
  EXPECT_THROW(compute_field(spheres.view(), {}, request), InputError);
  request.average_length = 0;
  EXPECT_NO_THROW(compute_field(spheres.view(), {}, request));
}

TEST(Average, NothingToAverage) {
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {1e-4, 1e-4, 1e-4}}, 1e-5);
  request.average_length = 30e-6;
  const Field field = compute_field({}, {}, request);
  ASSERT_TRUE(field.solid_fraction_averaged && field.void_fraction_averaged);
  EXPECT_EQ(field.void_fraction_averaged->activeVoxelCount(), 0u);
  EXPECT_EQ(field.void_fraction_averaged->background(), 1);
}

}  // namespace
}  // namespace interstice::voxel::test
