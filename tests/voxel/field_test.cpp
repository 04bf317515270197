// Whole fields: known packings, conservation, and what must not change a single bit.
#include "voxel/field.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <limits>

#include "base/error.h"
#include "tests/voxel/support.h"
#include "voxel/overlap.h"

namespace interstice::voxel::test {
namespace {

constexpr double kPi = std::numbers::pi;

FieldRequest request_for(const Box& box, double voxel) {
  FieldRequest request;
  request.lattice = cubic_lattice(box, voxel);
  return request;
}

float value_at(const openvdb::FloatGrid::Ptr& grid, int i, int j, int k) {
  return grid->tree().getValue(openvdb::Coord(i, j, k));
}

// The same values and the same active voxels, bit for bit.
void expect_same_bits(const openvdb::FloatGrid::Ptr& a, const openvdb::FloatGrid::Ptr& b) {
  ASSERT_EQ(a == nullptr, b == nullptr);
  if (!a) return;
  ASSERT_EQ(a->activeVoxelCount(), b->activeVoxelCount());
  ASSERT_TRUE(a->tree().hasSameTopology(b->tree()));
  for (auto it = a->cbeginValueOn(); it; ++it) ASSERT_EQ(it.getValue(), b->tree().getValue(it.getCoord()));
}

void expect_same_bits(const Field& a, const Field& b) {
  expect_same_bits(a.solid_fraction, b.solid_fraction);
  expect_same_bits(a.void_fraction, b.void_fraction);
  expect_same_bits(a.available_fraction, b.available_fraction);
  expect_same_bits(a.mass_density, b.mass_density);
  expect_same_bits(a.solid_fraction_averaged, b.solid_fraction_averaged);
  expect_same_bits(a.void_fraction_averaged, b.void_fraction_averaged);
  EXPECT_EQ(a.sums.solid_volume_particles, b.sums.solid_volume_particles);
  EXPECT_EQ(a.sums.solid_volume_field, b.sums.solid_volume_field);
  EXPECT_EQ(a.sums.written_solid_volume, b.sums.written_solid_volume);
  EXPECT_EQ(a.sums.available_volume, b.sums.available_volume);
  EXPECT_EQ(a.sums.mass, b.sums.mass);
  EXPECT_EQ(a.sums.void_min, b.sums.void_min);
  EXPECT_EQ(a.sums.void_max, b.sums.void_max);
}

void expect_conserved(const FieldSums& sums) {
  EXPECT_NEAR(sums.solid_volume_field / sums.solid_volume_particles, 1, 1e-12);   // the contract
  EXPECT_NEAR(sums.written_solid_volume / sums.solid_volume_particles, 1, 1e-6);  // the contract, for floats
}

struct Packing {
  const char* name;
  std::vector<Vec3d> sites;  // in units of the cell
  double radius;             // in units of the cell
  double fraction;
};

// Packings of touching spheres: exact solid fractions.
std::vector<Packing> packings() {
  return {
      {"SC", {{0, 0, 0}}, .5, kPi / 6},
      {"BCC", {{0, 0, 0}, {.5, .5, .5}}, std::sqrt(3) / 4, kPi * std::sqrt(3) / 8},
      {"FCC", {{0, 0, 0}, {.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}}, std::sqrt(2) / 4, kPi * std::sqrt(2) / 6}};
}

TEST(Packings, PeriodicCellsHaveTheirExactSolidFraction) {
  const double cell = 40e-6;
  for (const Packing& packing : packings())
    for (const int divisions : {1, 3, 7, 16})
      for (const Vec3d shift : {Vec3d{0, 0, 0}, Vec3d{.123, .456, .789}, Vec3d{-17, 5, 2.5}}) {
        Spheres spheres;
        for (const Vec3d& site : packing.sites) spheres.add(cell * (site + shift), packing.radius * cell);
        FieldRequest request = request_for({{0, 0, 0}, {cell, cell, cell}}, cell / divisions);
        request.periodic = {true, true, true};
        const FieldSums sums = compute_field(spheres.view(), {}, request).sums;
        const double volume =
            request.lattice.box().hi.x * request.lattice.box().hi.y * request.lattice.box().hi.z;
        EXPECT_NEAR(sums.solid_volume_field / volume, packing.fraction, 1e-12)
            << packing.name;  // the contract
        EXPECT_NEAR(sums.solid_volume_particles / volume, packing.fraction, 1e-12) << packing.name;
        EXPECT_EQ(sums.particles, static_cast<std::int64_t>(packing.sites.size()));
      }
}

TEST(Packings, TouchingSpheresNeverOverfillAVoxel) {
  const double cell = 40e-6;
  for (const Packing& packing : packings()) {
    Spheres spheres;
    for (const Vec3d& site : packing.sites) spheres.add(cell * site, packing.radius * cell);
    FieldRequest request = request_for({{0, 0, 0}, {cell, cell, cell}}, cell / 24);
    request.periodic = {true, true, true};
    const FieldSums sums = compute_field(spheres.view(), {}, request).sums;
    EXPECT_EQ(sums.negative_voxels, 0);
    EXPECT_GE(sums.void_min, -1e-12);  // R/h = 12: 1e-16 * 12^3 a sphere
    EXPECT_LE(sums.void_max, 1);
  }
}

TEST(ComputeField, ConservesTheVolumeInsideTheBox) {
  const Spheres spheres = bed();
  for (const double voxel : {2.1e-6, 17.3e-6, 400e-6})
    for (const bool periodic : {false, true}) {
      FieldRequest request = request_for(bed_box(), voxel);
      request.periodic = {periodic, periodic, false};
      const FieldSums sums = compute_field(spheres.view(), {}, request).sums;
      expect_conserved(sums);
      double expected = 0;  // the same by boxes of the spheres' own
      const Box box = request.lattice.box();
      const Vec3d size = box.size();
      for (std::size_t s = 0; s < spheres.size(); ++s)
        for (int image = 0; image < 9; ++image) {
          const int mx = image % 3 - 1, my = image / 3 - 1;
          if (!periodic && image != 4) continue;
          expected += sphere_box_volume(spheres.center(s) + Vec3d{mx * size.x, my * size.y, 0},
                                        spheres.radius[s], box);
        }
      EXPECT_NEAR(sums.solid_volume_particles / expected, 1, 1e-12);  // images moved by rounded lengths
    }
}

TEST(ComputeField, EveryVoxelIsTheSumOfItsSpheres) {
  const Spheres spheres = bed(120);
  FieldRequest request = request_for(bed_box(), 17.3e-6);
  request.density = 8200;
  const Field field = compute_field(spheres.view(), {}, request);
  const Lattice& lattice = field.lattice;
  for (int i = 0; i < lattice.n[0]; ++i)
    for (int j = 0; j < lattice.n[1]; ++j)
      for (int k = 0; k < lattice.n[2]; ++k) {
        const Vec3d lo = lattice.cell_center(i, j, k) - 0.5 * lattice.h;
        double solid = 0;
        for (std::size_t s = 0; s < spheres.size(); ++s)
          solid += sphere_box_volume(spheres.center(s), spheres.radius[s], {lo, lo + lattice.h});
        solid /= lattice.cell_volume();
        // grids hold floats: 2^-24 of the value
        EXPECT_NEAR(value_at(field.solid_fraction, i, j, k), solid, 1e-12 + 6e-8 * solid);
        EXPECT_NEAR(value_at(field.void_fraction, i, j, k), 1 - solid, 1e-12 + 6e-8 * std::abs(1 - solid));
        EXPECT_NEAR(value_at(field.mass_density, i, j, k), 8200 * solid, 1e-8 + 6e-8 * 8200 * solid);
      }
}

TEST(ComputeField, TheNumberOfThreadsChangesNothing) {
  Spheres spheres = bed(2000);
  for (std::size_t s = 0; s < spheres.size(); ++s) spheres.density.push_back(2000 + static_cast<double>(s));
  const Solids walls{{Box{{50e-6, 0, 0}, {81e-6, 300e-6, 77e-6}}, Plane{{0, 0, 11e-6}, {0, .6, .8}}}};
  FieldRequest request = request_for(bed_box(), 4.9e-6);
  request.periodic = {true, true, false};
  request.average_length = 41e-6;
  const auto compute = [&](int threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                      static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    return arena.execute([&] { return compute_field(spheres.view(), walls, request); });
  };
  const Field one = compute(1);
  EXPECT_GT(one.solid_fraction->activeVoxelCount(), 1000u);
  for (const int threads : {2, 3}) expect_same_bits(one, compute(threads));
}

TEST(ComputeField, AMovedGrainChangesOnlyTheCellsItTouches) {
  Spheres spheres = bed(400);
  const FieldRequest request = request_for(bed_box(), 6e-6);
  const Field before = compute_field(spheres.view(), {}, request);
  const std::size_t moved = 137;
  const Vec3d from = spheres.center(moved), to = from + Vec3d{11e-6, -7e-6, 4e-6};
  spheres.x[moved] = to.x;
  spheres.y[moved] = to.y;
  spheres.z[moved] = to.z;
  const Field after = compute_field(spheres.view(), {}, request);
  const Lattice& lattice = request.lattice;
  const CellRange a = bounding_cells(lattice, place(lattice, from, spheres.radius[moved]));
  const CellRange b = bounding_cells(lattice, place(lattice, to, spheres.radius[moved]));
  std::int64_t changed = 0;
  for (int i = 0; i < lattice.n[0]; ++i)
    for (int j = 0; j < lattice.n[1]; ++j)
      for (int k = 0; k < lattice.n[2]; ++k) {
        const bool same =
            value_at(before.solid_fraction, i, j, k) == value_at(after.solid_fraction, i, j, k) &&
            value_at(before.void_fraction, i, j, k) == value_at(after.void_fraction, i, j, k);
        if (!same) {
          ++changed;
          EXPECT_TRUE(a.contains(i, j, k) || b.contains(i, j, k)) << i << " " << j << " " << k;
        }
      }
  EXPECT_GT(changed, 0);
}

TEST(ComputeField, NothingInAnEmptyBox) {
  const Field field = compute_field({}, {}, request_for(bed_box(), 10e-6));
  EXPECT_EQ(field.sums.particles, 0);
  EXPECT_EQ(field.sums.solid_volume_field, 0);
  EXPECT_EQ(field.sums.void_min, 1);
  EXPECT_EQ(field.sums.void_max, 1);
  EXPECT_EQ(field.solid_fraction->activeVoxelCount(), 0u);
  EXPECT_EQ(field.void_fraction->activeVoxelCount(), 0u);
  EXPECT_EQ(value_at(field.void_fraction, 3, 2, 1), 1);
  EXPECT_EQ(value_at(field.solid_fraction, 3, 2, 1), 0);
  EXPECT_FALSE(field.available_fraction || field.mass_density || field.void_fraction_averaged);
}

TEST(ComputeField, OneSphere) {
  Spheres spheres;
  spheres.add({31e-6, 29e-6, 33e-6}, 20e-6);
  const FieldRequest request = request_for({{0, 0, 0}, {64e-6, 64e-6, 64e-6}}, 4e-6);
  const Field field = compute_field(spheres.view(), {}, request);
  EXPECT_EQ(field.sums.particles, 1);
  EXPECT_NEAR(field.sums.solid_volume_field / ball_volume(20e-6), 1, 2e-15);      // the goal for one sphere
  EXPECT_NEAR(field.sums.solid_volume_particles / ball_volume(20e-6), 1, 1e-15);  // the closed form itself
  EXPECT_EQ(value_at(field.solid_fraction, 7, 7, 8), 1);
  EXPECT_EQ(value_at(field.void_fraction, 7, 7, 8), 0);
  EXPECT_EQ(field.sums.void_min, 0);
  EXPECT_EQ(field.sums.void_max, 1);
}

TEST(ComputeField, ASphereLargerThanTheBoxFillsIt) {
  Spheres spheres;
  spheres.add({0, 0, 0}, 1);
  for (const Vec3d& lo : {Vec3d{0, 0, 0}, Vec3d{-.5, .1, .2}}) {
    const FieldRequest request = request_for({lo, lo + Vec3d{1e-3, 1e-3, 1e-3}}, 50e-6);
    const FieldSums sums = compute_field(spheres.view(), {}, request).sums;
    EXPECT_NEAR(sums.solid_volume_field, 1e-9, 1e-9 * 1e-12);
    EXPECT_NEAR(sums.solid_volume_particles, 1e-9, 1e-9 * 1e-12);
    EXPECT_EQ(sums.void_min, 0);
    EXPECT_EQ(sums.void_max, 0);
  }
}

// The surface of a sphere 20,000 voxels in radius: no cancellation may be left in the voxels that it cuts.
TEST(ComputeField, AHugeSphereCutsTheBox) {
  Spheres spheres;
  spheres.add({0, 0, -1}, 1);
  const FieldRequest request = request_for({{-.5e-3, -.5e-3, -.5e-3}, {.5e-3, .5e-3, .5e-3}}, 50e-6);
  const FieldSums sums = compute_field(spheres.view(), {}, request).sums;
  // below z = 1 - sqrt(1 - x^2 - y^2): half the box, less the mean of (x^2 + y^2)/2 (next order: 1e-14 of the
  // box)
  const double expected = 1e-9 * .5 - 1e-6 * (1e-6 / 12);
  EXPECT_NEAR(sums.solid_volume_field / expected, 1,
              1e-10);  // some 1e-16 R/h of a voxel, from z rounded near 1
  EXPECT_NEAR(sums.solid_volume_particles / expected, 1, 1e-10);
  EXPECT_GE(sums.void_min, 0);
  EXPECT_LE(sums.void_max, 1);
}

TEST(ComputeField, TheInsideOfAGiantIsTiles) {
  const double h = 1e-5, r = 150.3 * h, side = 310 * h;
  const std::vector<double> x{0.5 * side + 0.3 * h}, y{0.5 * side}, z{0.5 * side}, radius{r};
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {side, side, side}}, h);
  const Field field = compute_field({1, x.data(), y.data(), z.data(), radius.data(), nullptr}, {}, request);
  EXPECT_NEAR(field.sums.solid_volume_field / (4.0 / 3 * std::numbers::pi * r * r * r), 1, 1e-12);
  const auto& tree = field.solid_fraction->tree();
  EXPECT_EQ(tree.getValue(openvdb::Coord(155, 155, 155)), 1.0f);
  EXPECT_EQ(tree.getValue(openvdb::Coord(0, 0, 0)), 0.0f);
  EXPECT_EQ(field.void_fraction->tree().getValue(openvdb::Coord(155, 155, 155)), 0.0f);
  // Leaves stand on the surface only: 4 pi r^2 cells, an eighth of which fit along each edge of a leaf, and
  // at most a few leaves thick.
  const double surface_leaves = 4 * std::numbers::pi * 150.3 * 150.3 / 64;
  EXPECT_LT(static_cast<double>(tree.leafCount()), 2.5 * surface_leaves);
  EXPECT_GT(tree.activeTileCount(), 0u);
}

TEST(ComputeField, VoxelLargerThanTheBox) {
  const Spheres spheres = bed(50);
  const FieldRequest request = request_for(bed_box(), 1e-3);
  const Field field = compute_field(spheres.view(), {}, request);
  EXPECT_EQ(field.lattice.cells(), 1);
  expect_conserved(field.sums);
  // the voxel reaches upward beyond the box: spheres across the lower faces are cut off there, and only there
  EXPECT_LT(field.sums.solid_volume_particles, spheres.volume());
  EXPECT_GT(field.sums.solid_volume_particles, .5 * spheres.volume());
}

TEST(ComputeField, OneKilometreFromTheOrigin) {
  const double h = 0x1p-16;  // coordinates 1 km away hold multiples of h/1024 exactly
  Spheres near, far;
  for (std::size_t s = 0; s < 100; ++s) {
    Random random(31, s);
    const auto coordinate = [&] { return h / 1024 * std::floor(10240 * random.uniform()); };
    const Vec3d center{coordinate(), coordinate(), coordinate()};
    const double radius = random.uniform(.2, 2) * h;
    near.add(center, radius);
    far.add(center + Vec3d{1024, -1024, 1024}, radius);
  }
  const Field a = compute_field(near.view(), {}, request_for({{0, 0, 0}, {10 * h, 10 * h, 10 * h}}, h));
  const Field b = compute_field(
      far.view(), {}, request_for({{1024, -1024, 1024}, {1024 + 10 * h, -1024 + 10 * h, 1024 + 10 * h}}, h));
  expect_same_bits(a, b);
}

TEST(ComputeField, AnOverlapOfTwoSpheresCountsTwice) {
  const double r = 10e-6, d = 12e-6;
  Spheres spheres;
  spheres.add({20e-6, 20e-6, 20e-6}, r);
  spheres.add({20e-6 + d, 20e-6, 20e-6}, r);
  const FieldSums sums =
      compute_field(spheres.view(), {}, request_for({{0, 0, 0}, {5e-5, 4e-5, 4e-5}}, .5e-6)).sums;
  EXPECT_NEAR(sums.solid_volume_field / (2 * ball_volume(r)), 1, 1e-12);
  EXPECT_EQ(sums.void_min, -1);  // voxels wholly in both, reported as they are
  // the lens of voxels below zero: kPi (2r-d)^2 (d^2+4dr)/(12 d), to about a voxel layer of its surface
  const double lens = kPi * (2 * r - d) * (2 * r - d) * (d * d + 4 * d * r) / (12 * d);
  EXPECT_NEAR(static_cast<double>(sums.negative_voxels) * .125e-18 / lens, 1, .25);
}

TEST(ComputeField, SparseWhereThereIsNothing) {
  Spheres spheres;
  spheres.add({1e-3, 1e-3, 1e-3}, 20e-6);
  const Field field =
      compute_field(spheres.view(), {}, request_for({{0, 0, 0}, {.1, .1, .1}}, 5e-6));  // 8e12 voxels
  EXPECT_LE(field.solid_fraction->tree().leafCount(), 27u);
  EXPECT_LE(field.void_fraction->tree().leafCount(), 27u);
  EXPECT_LT(field.void_fraction->memUsage(), 1'000'000u);
  EXPECT_NEAR(field.sums.solid_volume_field / ball_volume(20e-6), 1, 2e-15);
}

TEST(ComputeField, OnlyVoxelsWithSomethingInThemAreActive) {
  Spheres spheres = bed(20);
  const Field field = compute_field(spheres.view(), {}, request_for(bed_box(), 5e-6));
  for (auto it = field.solid_fraction->cbeginValueOn(); it; ++it) ASSERT_GT(it.getValue(), 0);
  EXPECT_EQ(field.solid_fraction->activeVoxelCount(), field.void_fraction->activeVoxelCount());
  for (auto it = field.solid_fraction->cbeginValueOff(); it; ++it) ASSERT_EQ(it.getValue(), 0);
  for (auto it = field.void_fraction->cbeginValueOff(); it; ++it) ASSERT_EQ(it.getValue(), 1);
  const auto box = field.void_fraction->evalActiveVoxelBoundingBox();
  EXPECT_GE(box.min(), openvdb::Coord(0, 0, 0));
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_LT(box.max()[axis], field.lattice.n[static_cast<std::size_t>(axis)]);  // clipped to the lattice
}

TEST(ComputeField, WallsAreNeitherVoidNorSolid) {
  Spheres spheres;
  spheres.add({50e-6, 50e-6, 40e-6}, 15e-6);
  const double h = 4e-6;
  // a floor to z = 22 um (5.5 voxels), and a block over a corner that overlaps it
  const Solids walls{{Plane{{0, 0, 22e-6}, {0, 0, 1}}, Box{{-1, -1, -1}, {10e-6, 10e-6, 44e-6}}}};
  const Field field = compute_field(spheres.view(), walls, request_for({{0, 0, 0}, {1e-4, 1e-4, 1e-4}}, h));
  const double wall = 1e-8 * 22e-6 + 1e-10 * 22e-6;
  EXPECT_NEAR(field.sums.available_volume, 1e-12 - wall, 1e-12 * 1e-12);  // rounding
  ASSERT_TRUE(field.available_fraction);
  EXPECT_EQ(value_at(field.available_fraction, 20, 20, 2), 0);
  EXPECT_FLOAT_EQ(value_at(field.available_fraction, 20, 20, 5), .5);
  EXPECT_EQ(value_at(field.available_fraction, 20, 20, 6), 1);
  EXPECT_EQ(value_at(field.available_fraction, 1, 1, 10), 0);
  EXPECT_FLOAT_EQ(value_at(field.available_fraction, 2, 2, 10), .75);  // a quarter under the block's corner
  EXPECT_EQ(value_at(field.void_fraction, 20, 20, 2), 0);
  EXPECT_FLOAT_EQ(value_at(field.void_fraction, 20, 20, 5), .5);
  EXPECT_EQ(value_at(field.void_fraction, 12, 12, 10), 0);  // inside the sphere
  EXPECT_EQ(field.sums.void_min, 0);
  for (auto it = field.void_fraction->cbeginValueOn(); it; ++it) {
    const openvdb::Coord at = it.getCoord();
    ASSERT_NEAR(it.getValue(),
                field.available_fraction->tree().getValue(at) - field.solid_fraction->tree().getValue(at),
                2e-7);
  }
}

TEST(ComputeField, AWallOnAFaceOfTheLatticeTakesNoVoxel) {
  const double h = 17.3e-6;
  const Lattice lattice = cubic_lattice({{-1e-3, -1e-3, -1e-3}, {1e-3, 1e-3, 1e-3}}, h);
  for (int face = 1; face < 100; face += 7) {
    FieldRequest request;
    request.lattice = lattice;
    const double at = lattice.lo.z + face * h;
    const Field field = compute_field({}, {{Plane{{0, 0, at}, {0, 0, 1}}}}, request);
    const auto n = static_cast<std::uint64_t>(lattice.n[0] * lattice.n[1]);
    EXPECT_EQ(field.available_fraction->activeVoxelCount(), n * static_cast<std::uint64_t>(face));
    EXPECT_EQ(field.sums.void_min, 0);
    EXPECT_EQ(field.sums.void_max, 1);
  }
}

TEST(ComputeField, MassFollowsEachSpheresOwnDensity) {
  Spheres spheres;
  spheres.add({20e-6, 20e-6, 20e-6}, 8e-6);
  spheres.add({60e-6, 20e-6, 20e-6}, 8e-6);
  spheres.density = {4000, 8000};
  FieldRequest request = request_for({{0, 0, 0}, {80e-6, 40e-6, 40e-6}}, 40e-6);
  const Field field = compute_field(spheres.view(), {}, request);
  ASSERT_TRUE(field.mass_density);
  const double each = ball_volume(8e-6);
  EXPECT_NEAR(field.sums.mass / (12000 * each), 1, 1e-14);  // a few roundings
  EXPECT_FLOAT_EQ(value_at(field.mass_density, 0, 0, 0), static_cast<float>(4000 * each / 6.4e-14));
  EXPECT_FLOAT_EQ(value_at(field.mass_density, 1, 0, 0), static_cast<float>(8000 * each / 6.4e-14));
  request.density = 1;  // used only where spheres carry none
  expect_same_bits(field, compute_field(spheres.view(), {}, request));
}

// One density for all takes no sum of its own: as that of differing ones, to rounding, and as much in all.
TEST(ComputeField, MassOfOneDensityIsThatOfManyThatHardlyDiffer) {
  Spheres one = random_spheres(200, {{0, 0, 0}, {160e-6, 90e-6, 120e-6}}, 2e-6, 30e-6, 7), many = one;
  one.density.assign(one.size(), 8200);
  many.density = one.density;
  many.density.back() = std::nextafter(8200.0, 9000.0);
  const FieldRequest request = request_for({{0, 0, 0}, {160e-6, 90e-6, 120e-6}}, 10e-6);
  const Field a = compute_field(one.view(), {}, request), b = compute_field(many.view(), {}, request);
  ASSERT_TRUE(a.mass_density && b.mass_density);
  EXPECT_TRUE(a.mass_density->tree().hasSameTopology(b.mass_density->tree()));
  EXPECT_TRUE(a.mass_density->tree().hasSameTopology(a.solid_fraction->tree()));
  for (auto voxel = a.mass_density->cbeginValueOn(); voxel; ++voxel)  // a float's rounding of either
    EXPECT_NEAR(*voxel, b.mass_density->tree().getValue(voxel.getCoord()), 1.3e-7f * *voxel);
  EXPECT_NEAR(a.sums.mass / b.sums.mass, 1, 1e-14);
}

TEST(ComputeField, RefusesBadInput) {
  const FieldRequest good = request_for(bed_box(), 10e-6);
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  for (const double bad : {inf, -inf, nan})
    for (int column = 0; column < 4; ++column) {
      Spheres spheres = bed(3);
      std::vector<double>* columns[] = {&spheres.x, &spheres.y, &spheres.z, &spheres.radius};
      (*columns[column])[1] = bad;
      try {
        compute_field(spheres.view(), {}, good);
        FAIL() << "accepted column " << column << " = " << bad;
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("sphere 1"), std::string::npos) << error.what();
      }
    }
  for (const double bad : {0., -1e-6}) {
    Spheres spheres = bed(3);
    spheres.radius[2] = bad;
    EXPECT_THROW(compute_field(spheres.view(), {}, good), InputError);
    spheres = bed(3);
    spheres.density = {1, bad, 1};
    EXPECT_THROW(compute_field(spheres.view(), {}, good), InputError);
  }
  FieldRequest bad = good;
  bad.lattice.h.y *= 2;
  EXPECT_THROW(compute_field({}, {}, bad), InputError);
  bad = good;
  bad.method = Method::subsample;
  EXPECT_THROW(compute_field({}, {}, bad), InputError);
  bad = good;
  bad.average_length = nan;
  EXPECT_THROW(compute_field({}, {}, bad), InputError);
  bad = good;
  bad.density = -1;
  EXPECT_THROW(compute_field({}, {}, bad), InputError);
}

TEST(ComputeField, SpheresFarOutsideCostNothingAndDoNotOverflow) {
  Spheres spheres = bed(10);
  const FieldSums without = compute_field(spheres.view(), {}, request_for(bed_box(), 10e-6)).sums;
  spheres.add({1e300, -1e300, 0}, 1e-6);
  spheres.add({0, 1, 0}, 1e-6);
  const FieldSums with = compute_field(spheres.view(), {}, request_for(bed_box(), 10e-6)).sums;
  EXPECT_EQ(with.particles, without.particles);
  EXPECT_EQ(with.solid_volume_field, without.solid_volume_field);
}

}  // namespace
}  // namespace interstice::voxel::test
