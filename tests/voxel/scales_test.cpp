// Void fraction against averaging length.
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "tests/voxel/support.h"
#include "voxel/scales.h"

namespace interstice::voxel::test {
namespace {

FieldRequest request_for(const Box& box, double voxel) {
  FieldRequest request;
  request.lattice = cubic_lattice(box, voxel);
  return request;
}

/// Statistics by brute force, cube by cube.
struct Statistics {
  std::int64_t cubes = 0;
  double mean = 0, sd = 0, min = 2, max = -2;
};

Statistics by_hand(const Field& field, std::int64_t edge, const std::array<bool, 3>& periodic) {
  const auto& n = field.lattice.n;
  std::array<std::int64_t, 3> size, starts;
  for (std::size_t a = 0; a < 3; ++a) {
    size[a] = std::min(edge, n[a]);
    starts[a] = edge >= n[a] ? 1 : periodic[a] ? n[a] : n[a] - edge + 1;
  }
  std::vector<double> values;
  for (std::int64_t i = 0; i < starts[0]; ++i)
    for (std::int64_t j = 0; j < starts[1]; ++j)
      for (std::int64_t k = 0; k < starts[2]; ++k) {
        double solid = 0, available = 0;
        for (std::int64_t p = 0; p < size[0]; ++p)
          for (std::int64_t q = 0; q < size[1]; ++q)
            for (std::int64_t r = 0; r < size[2]; ++r) {
              const openvdb::Coord at(static_cast<int>((i + p) % n[0]), static_cast<int>((j + q) % n[1]),
                                      static_cast<int>((k + r) % n[2]));
              solid += static_cast<double>(field.solid_fraction->tree().getValue(at));
              available += field.available_fraction
                               ? static_cast<double>(field.available_fraction->tree().getValue(at))
                               : 1.0;
            }
        if (available >= 0.5 * static_cast<double>(size[0] * size[1] * size[2]))
          values.push_back(1 - solid / available);
      }
  Statistics s;
  s.cubes = static_cast<std::int64_t>(values.size());
  for (const double v : values) s.mean += v, s.min = std::min(s.min, v), s.max = std::max(s.max, v);
  s.mean /= static_cast<double>(values.size());
  for (const double v : values) s.sd += (v - s.mean) * (v - s.mean);
  s.sd = std::sqrt(s.sd / static_cast<double>(values.size()));
  return s;
}

void expect_as_by_hand(const Spheres& spheres, const Solids& solids, FieldRequest request) {
  const Field field = compute_field(spheres.view(), solids, request);
  const ScaleReport report = void_scales(field, spheres.view(), request.periodic);
  const double h = field.lattice.h.x;
  ASSERT_GE(report.rows.size(), 5u);
  EXPECT_NEAR(report.rows.front().length, h, 1e-18);
  EXPECT_GE(report.rows.back().length, 200e-6 - 1e-12);
  for (const ScaleRow& row : report.rows) {
    const Statistics s = by_hand(field, std::llround(row.length / h), request.periodic);
    EXPECT_EQ(row.windows, s.cubes) << row.length;
    EXPECT_NEAR(row.mean, s.mean, 1e-10) << row.length;
    EXPECT_NEAR(row.sd, s.sd, 1e-8) << row.length;
    EXPECT_NEAR(row.min, s.min, 1e-10) << row.length;
    EXPECT_NEAR(row.max, s.max, 1e-10) << row.length;
  }
}

TEST(Scales, AreWhatCubesCountedOneByOneGive) {
  const Box box{{0, 0, 0}, {200e-6, 160e-6, 60e-6}};
  const Spheres spheres = random_spheres(60, box, 5e-6, 15e-6, 8);
  expect_as_by_hand(spheres, {}, request_for(box, 10e-6));
  FieldRequest request = request_for(box, 10e-6);
  request.periodic = {true, true, false};
  expect_as_by_hand(spheres, {}, request);
  Solids solids;
  solids.shapes.push_back(Box{{-1, -1, -1}, {1, 1, 13e-6}});
  solids.shapes.push_back(Box{{60e-6, -1, -1}, {92e-6, 1, 1}});
  expect_as_by_hand(spheres, solids, request_for(box, 10e-6));
}

TEST(Scales, OfGrainsPlacedIndependentlyAreTheRandomOnes) {
  // what sd_random promises: independent grains, cubes well above a grain
  const Box box{{0, 0, 0}, {1e-3, 1e-3, 1e-3}};
  const Spheres spheres = random_spheres(30000, box, 5e-6, 15e-6, 11);
  FieldRequest request = request_for(box, 10e-6);
  request.periodic = {true, true, true};
  const Field field = compute_field(spheres.view(), {}, request);
  const ScaleReport report = void_scales(field, spheres.view(), request.periodic);
  int checked = 0;
  for (const ScaleRow& row : report.rows) {
    if (row.length < 150e-6 || row.independent < 30) continue;
    EXPECT_NEAR(row.sd / row.sd_random, 1, 0.12) << row.length;
    ++checked;
  }
  EXPECT_GE(checked, 2);
  // the volume-weighted grain: for radii even in [5, 15] um, 4 pi/3 <r^6> / <r^3>
  const double mean3 = (std::pow(15., 4) - std::pow(5., 4)) / 40,
               mean6 = (std::pow(15., 7) - std::pow(5., 7)) / 70;
  EXPECT_NEAR(report.grain_volume / (ball_volume(1e-6) * mean6 / mean3), 1, 0.02);
}

TEST(Scales, OfACrystalFallFasterThanRandom) {
  const Box box{{0, 0, 0}, {320e-6, 320e-6, 320e-6}};
  Spheres spheres;
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < 16; ++j)
      for (int k = 0; k < 16; ++k) spheres.add({(i + .5) * 20e-6, (j + .5) * 20e-6, (k + .5) * 20e-6}, 10e-6);
  FieldRequest request = request_for(box, 4e-6);
  request.periodic = {true, true, true};
  const Field field = compute_field(spheres.view(), {}, request);
  const ScaleReport report = void_scales(field, spheres.view(), request.periodic);
  EXPECT_LE(report.random_length, 40e-6);
  EXPECT_TRUE(std::isnan(report.many_grains_length));  // a crystal's cube never differs by a grain at random
  // five cells are one lattice constant: every cube holds the same
  for (const ScaleRow& row : report.rows)
    if (std::llround(row.length / 4e-6) == 5) {
      EXPECT_LT(row.sd, 1e-6);
    }
}

TEST(Scales, OfOtherWindowsAreTheirAveragesStatistics) {
  // against averaged grids of the same window, at the centres that count
  const Box box{{0, 0, 0}, {150e-6, 130e-6, 170e-6}};
  const Spheres spheres = random_spheres(80, box, 5e-6, 15e-6, 8);
  for (const WindowShape shape : {WindowShape::sphere, WindowShape::gaussian})
    for (const bool periodic : {false, true}) {
      FieldRequest request = request_for(box, 10e-6);
      request.periodic = {periodic, periodic, false};
      const Field field = compute_field(spheres.view(), {}, request);
      const ScaleReport report = void_scales(field, spheres.view(), request.periodic, shape);
      for (const std::int64_t edge : {1, 3, 5, 7}) {
        request.average_length = static_cast<double>(edge) * 10e-6;
        request.average_window = shape;
        const Field averaged = compute_field(spheres.view(), {}, request);
        const std::int64_t margin = edge / 2, side = periodic ? 0 : margin;
        double sum = 0, squares = 0, count = 0, least = 2;
        for (std::int64_t i = side; i < 15 - side; ++i)
          for (std::int64_t j = side; j < 13 - side; ++j)
            for (std::int64_t k = margin; k < 17 - margin; ++k) {
              const double v = static_cast<double>(averaged.void_fraction_averaged->tree().getValue(
                  {static_cast<int>(i), static_cast<int>(j), static_cast<int>(k)}));
              sum += v, squares += v * v, ++count, least = std::min(least, v);
            }
        const auto row = std::find_if(report.rows.begin(), report.rows.end(), [&](const ScaleRow& r) {
          return std::llround(r.length / 10e-6) == edge;
        });
        ASSERT_NE(row, report.rows.end());
        EXPECT_EQ(static_cast<double>(row->windows), count) << edge;
        EXPECT_NEAR(row->mean, sum / count, 2e-7) << edge;  // averaged grids are floats
        EXPECT_NEAR(row->sd, std::sqrt(squares / count - sum / count * (sum / count)), 2e-6) << edge;
        EXPECT_NEAR(row->min, least, 2e-7) << edge;
      }
    }
}

TEST(Scales, OfIndependentGrainsAreTheRandomOnesOverAnyWindow) {
  // sd_random takes a Gaussian for the box of like spread and a sphere for its volume; grains of a finite
  // size add to a window's own, which at ten grains' diameters is a few percent, as much again by the places
  // of the grains
  const Box box{{0, 0, 0}, {1e-3, 1e-3, 1e-3}};
  const Spheres spheres = random_spheres(30000, box, 5e-6, 15e-6, 11);
  FieldRequest request = request_for(box, 12.5e-6);
  request.periodic = {true, true, true};
  const Field field = compute_field(spheres.view(), {}, request);
  for (const WindowShape shape : {WindowShape::sphere, WindowShape::gaussian}) {
    int checked = 0;
    for (const ScaleRow& row : void_scales(field, spheres.view(), request.periodic, shape).rows) {
      if (row.length < 150e-6 || row.independent < 30) continue;
      EXPECT_NEAR(row.sd / row.sd_random, 1, 0.12) << name_of(shape) << ' ' << row.length;
      ++checked;
    }
    EXPECT_GE(checked, 2);
  }
}

TEST(Scales, RefuseWhatDoesNotFit) {
  Spheres spheres;
  spheres.add({1e-6, 1e-6, 1e-6}, 1e-6);
  const FieldRequest request = request_for({{0, 0, 0}, {1e-3, 1e-3, 1e-3}}, 1e-6);
  const Field field = compute_field(spheres.view(), {}, request);
  EXPECT_THROW(void_scales(field, spheres.view(), request.periodic), InputError);
}

TEST(Scales, OfAnEmptyBox) {
  Spheres spheres;
  const FieldRequest request = request_for({{0, 0, 0}, {1e-4, 1e-4, 1e-4}}, 1e-5);
  const Field field = compute_field(spheres.view(), {}, request);
  const ScaleReport report = void_scales(field, spheres.view(), request.periodic);
  for (const ScaleRow& row : report.rows) {
    EXPECT_EQ(row.mean, 1);
    EXPECT_EQ(row.sd, 0);
    EXPECT_EQ(row.grains, 0);
  }
}

}  // namespace
}  // namespace interstice::voxel::test
