// What a grid says about itself, and what slices and lines read from it.
#include "voxel/sample.h"

#include <gtest/gtest.h>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <cmath>

#include "base/error.h"
#include "tests/voxel/support.h"

namespace interstice::voxel::test {
namespace {

Field example(bool walls = false) {
  FieldRequest request;
  request.lattice = cubic_lattice(bed_box(), 17.3e-6);
  request.density = 4430;
  request.average_length = 60e-6;
  Solids solids;
  if (walls) solids.shapes.push_back(Plane{{0, 0, 20e-6}, {0, 0, 1}});
  return compute_field(bed(100).view(), solids, request);
}

std::vector<openvdb::FloatGrid::Ptr> grids(const Field& field) {
  return {field.solid_fraction, field.void_fraction,           field.available_fraction,
          field.mass_density,   field.solid_fraction_averaged, field.void_fraction_averaged};
}

TEST(Grids, SayWhatTheyAre) {
  const Field field = example(true);
  const char* names[] = {"solid_fraction", "void_fraction",           "available_fraction",
                         "mass_density",   "solid_fraction_averaged", "void_fraction_averaged"};
  for (std::size_t g = 0; g < 6; ++g) {
    const auto grid = grids(field)[g];
    ASSERT_TRUE(grid);
    EXPECT_EQ(grid->getName(), names[g]);
    const bool mass = g == 3, averaged = g > 3;
    EXPECT_EQ(grid->getGridClass(), mass ? openvdb::GRID_UNKNOWN : openvdb::GRID_FOG_VOLUME);
    EXPECT_EQ(grid->metaValue<std::string>("units"), mass ? "kg/m^3" : "1");
    EXPECT_EQ(grid->metaValue<std::string>("method"), "exact");
    EXPECT_EQ(grid->metaValue<double>("voxel"), 17.3e-6);
    EXPECT_FALSE(grid->metaValue<std::string>("version").empty());
    double box[6];
    ASSERT_EQ(std::sscanf(grid->metaValue<std::string>("box").c_str(), "%lf,%lf,%lf,%lf,%lf,%lf", box,
                          box + 1, box + 2, box + 3, box + 4, box + 5),
              6);
    EXPECT_EQ(box[0], field.lattice.lo.x);
    EXPECT_DOUBLE_EQ(box[5], field.lattice.box().hi.z);
    EXPECT_EQ((*grid)["average_length"] != nullptr, averaged);
    if (averaged) {
      EXPECT_EQ(grid->metaValue<double>("average_length"), 60e-6);
    }
  }
}

TEST(Grids, NameTheMethod) {
  FieldRequest request;
  request.lattice = cubic_lattice(bed_box(), 50e-6);
  request.method = Method::subsample;
  request.subsample = 3;
  EXPECT_EQ(compute_field({}, {}, request).void_fraction->metaValue<std::string>("method"), "subsample:3");
}

TEST(Grids, IndicesAreVoxelCentres) {
  const Field field = example();
  for (const auto& grid : grids(field)) {
    if (!grid) continue;
    for (const openvdb::Coord at : {openvdb::Coord(0, 0, 0), openvdb::Coord(3, 5, 7)}) {
      const openvdb::Vec3d world = grid->indexToWorld(at);
      const Vec3d center = field.lattice.cell_center(at.x(), at.y(), at.z());
      // rounding of coordinates of 1e-4
      EXPECT_NEAR(world.x(), center.x, 1e-19);
      EXPECT_NEAR(world.y(), center.y, 1e-19);
      EXPECT_NEAR(world.z(), center.z, 1e-19);
    }
  }
}

TEST(Grids, AWorldPointFindsItsVoxel) {
  Spheres spheres;
  spheres.add({-1e-6, 31e-6, 4e-6}, 1e-6);
  FieldRequest request;
  request.lattice = cubic_lattice({{-20e-6, 0, 0}, {20e-6, 60e-6, 30e-6}}, 5e-6);
  const Field field = compute_field(spheres.view(), {}, request);
  const auto& transform = field.solid_fraction->transform();
  const openvdb::Coord at = transform.worldToIndexCellCentered(openvdb::Vec3d(-1e-6, 31e-6, 4e-6));
  EXPECT_EQ(at, openvdb::Coord(3, 6, 0));
  EXPECT_GT(field.solid_fraction->tree().getValue(at), 0);
}

// OpenVDB's own constructors refuse voxels below 14.4 um in metres; ours must be right, and survive a file.
TEST(Grids, SmallVoxelsKeepTheirTransformThroughAStream) {
  Spheres spheres;
  spheres.add({1.0000125e-3, 2e-3, 3e-3}, 20e-9);
  for (const double voxel : {20e-6, 14e-6, 1e-6, 5e-9}) {
    const Vec3d lo{1e-3, 2e-3, 3e-3};
    FieldRequest request;
    request.lattice = cubic_lattice({lo, lo + Vec3d{20 * voxel, 20 * voxel, 20 * voxel}}, voxel);
    const Field field = compute_field(spheres.view(), {}, request);
    std::stringstream bytes(std::ios::in | std::ios::out | std::ios::binary);
    openvdb::io::Stream(static_cast<std::ostream&>(bytes)).write({field.void_fraction});
    const auto read = openvdb::io::Stream(static_cast<std::istream&>(bytes)).getGrids();
    ASSERT_EQ(read->size(), 1u);
    const openvdb::math::Transform& transform = read->front()->transform();
    EXPECT_EQ(transform.voxelSize(), openvdb::Vec3d(voxel));
    EXPECT_EQ(transform.mapType(), openvdb::math::UniformScaleTranslateMap::mapType());
    const openvdb::Vec3d world = transform.indexToWorld(openvdb::Coord(7, 0, 19));
    const Vec3d center = field.lattice.cell_center(7, 0, 19);
    EXPECT_NEAR(world.x(), center.x, 1e-18);  // rounding of 1e-3
    EXPECT_NEAR(world.z(), center.z, 1e-18);
    EXPECT_EQ(transform.worldToIndexCellCentered(world), openvdb::Coord(7, 0, 19));
  }
}

TEST(SampleSlice, ReadsTheVoxelsThatHoldTheCoordinate) {
  const Field field = example();
  for (int axis = 0; axis < 3; ++axis) {
    const double at = field.lattice.lo[axis] + 3.4 * 17.3e-6;
    const Samples slice = sample_slice(field, axis, at);
    EXPECT_EQ(slice.normal_axis, axis);
    EXPECT_EQ(slice.rows, field.lattice.n[static_cast<std::size_t>(slice.axes[0])]);
    EXPECT_EQ(slice.columns, field.lattice.n[static_cast<std::size_t>(slice.axes[1])]);
    EXPECT_NE(slice.axes[0], axis);
    EXPECT_LT(slice.axes[0], slice.axes[1]);
    ASSERT_EQ(slice.void_fraction.size(), static_cast<std::size_t>(slice.rows * slice.columns));
    std::size_t s = 0;
    for (int r = 0; r < slice.rows; ++r)
      for (int c = 0; c < slice.columns; ++c, ++s) {
        openvdb::Coord cell;
        cell[axis] = 3;
        cell[slice.axes[0]] = r;
        cell[slice.axes[1]] = c;
        EXPECT_EQ(slice.void_fraction[s], static_cast<double>(field.void_fraction->tree().getValue(cell)));
        EXPECT_EQ(slice.solid_fraction[s], static_cast<double>(field.solid_fraction->tree().getValue(cell)));
        EXPECT_EQ(slice.mass_density[s], static_cast<double>(field.mass_density->tree().getValue(cell)));
        EXPECT_EQ(slice.void_fraction_averaged[s],
                  static_cast<double>(field.void_fraction_averaged->tree().getValue(cell)));
        EXPECT_NEAR(slice.center[s][axis], field.lattice.lo[axis] + 3.5 * 17.3e-6, 1e-18);  // rounding
      }
  }
}

TEST(SampleSlice, FacesBelongToTheVoxelAboveAndTheTopToTheLast) {
  const Field field = example();
  const double h = 17.3e-6, lo = field.lattice.lo.z;
  EXPECT_NEAR(sample_slice(field, 2, lo + 2 * h).center[0].z, lo + 2.5 * h, 1e-18);
  EXPECT_NEAR(sample_slice(field, 2, lo).center[0].z, lo + .5 * h, 1e-18);
  const double hi = field.lattice.box().hi.z;
  EXPECT_NEAR(sample_slice(field, 2, hi).center[0].z, hi - .5 * h, 1e-18);
  EXPECT_THROW(sample_slice(field, 2, lo - 1e-6), InputError);
  EXPECT_THROW(sample_slice(field, 2, hi + 1e-6), InputError);
}

TEST(SampleLine, IsARowOfTheSlice) {
  const Field field = example();
  const Vec3d at{100e-6, 77e-6, 60e-6};
  const Samples line = sample_line(field, 1, at);
  EXPECT_EQ(line.normal_axis, -1);
  EXPECT_EQ(line.rows, 1);
  EXPECT_EQ(line.columns, field.lattice.n[1]);
  const Samples slice = sample_slice(field, 0, at.x);  // rows: y, columns: z
  const auto k = static_cast<std::size_t>(cell_along(field.lattice, 2, at.z));
  for (std::size_t j = 0; j < static_cast<std::size_t>(line.columns); ++j) {
    const std::size_t s = j * static_cast<std::size_t>(slice.columns) + k;
    EXPECT_EQ(line.void_fraction[j], slice.void_fraction[s]);
    EXPECT_EQ(line.mass_density[j], slice.mass_density[s]);
    EXPECT_EQ(line.center[j], slice.center[s]);
  }
  EXPECT_NO_THROW(sample_line(field, 1, {100e-6, 1e9, 60e-6}));  // its own component does not matter
  EXPECT_THROW(sample_line(field, 1, {1, 77e-6, 60e-6}), InputError);
}

TEST(SampleLine, HasGapsWhereWallsLeaveNothing) {
  FieldRequest request;
  request.lattice = cubic_lattice({{0, 0, 0}, {100e-6, 20e-6, 20e-6}}, 10e-6);
  const Solids wall{{Box{{35e-6, -1, -1}, {60e-6, 1, 1}}}};  // half of voxel 3, all of 4 and 5
  const Samples line = sample_line(compute_field({}, wall, request), 0, {0, 5e-6, 5e-6});
  const std::vector<double> left = outside_walls(line, line.void_fraction);
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(std::isnan(left[i]), i == 4 || i == 5) << i;
    if (std::isnan(left[i])) continue;
    EXPECT_FLOAT_EQ(static_cast<float>(left[i]), i == 3 ? 0.5f : 1.0f) << i;
  }
  const std::vector<double> clear = clear_of_walls(line);
  for (std::size_t i = 0; i < 10; ++i) EXPECT_EQ(std::isnan(clear[i]), i >= 3 && i <= 5) << i;
  const Samples open = sample_line(compute_field({}, {}, request), 0, {0, 5e-6, 5e-6});
  EXPECT_EQ(outside_walls(open, open.void_fraction), open.void_fraction);
  EXPECT_EQ(clear_of_walls(open), open.void_fraction);
}

TEST(SampleLine, WithoutDensityOrAverages) {
  FieldRequest request;
  request.lattice = cubic_lattice(bed_box(), 50e-6);
  const Samples line = sample_line(compute_field({}, {}, request), 0, {0, 20e-6, 20e-6});
  EXPECT_TRUE(line.mass_density.empty());
  EXPECT_TRUE(line.void_fraction_averaged.empty());
  for (const double v : line.void_fraction) EXPECT_EQ(v, 1);
}

}  // namespace
}  // namespace interstice::voxel::test
