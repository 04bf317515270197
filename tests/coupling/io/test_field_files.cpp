// The files of one field, read back.
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "coupling/io/field_files.h"
#include "coupling/io/vti_file.h"
#include "reader_testing.h"
#include "vti_decoding.h"

namespace interstice::io::testing {
namespace {

using interstice::testing::Vti;

// Three grains, one on the box's face, over a floor of which the lowest layer of voxels is solid.
class FieldFiles : public ReaderTest {
 protected:
  void SetUp() override {
    ReaderTest::SetUp();
    request.computed.lattice = voxel::cubic_lattice({{0, 0, -1e-5}, {2e-4, 1.5e-4, 1.1e-4}}, 1e-5);
    request.computed.density = 7800;
    request.computed.average_length = 5e-5;
    request.box = {{0, 0, -1e-5}, {2e-4, 1.5e-4, 1.1e-4}};
    request.source = "three.csv";
    request.kind = "CSV";
    request.time = 0.25;
    request.version = "1.2.3";
    solids.shapes.push_back(Plane{{0, 0, 0}, {0, 0, 1}});
    field = voxel::compute_field(view, solids, request.computed);
  }

  const std::vector<double> x{5e-5, 1.2e-4, 2e-4}, y{5e-5, 8e-5, 1e-4}, z{3e-5, 5e-5, 6e-5},
      r{3e-5, 2.5e-5, 2e-5};
  voxel::SpheresView view{3, x.data(), y.data(), z.data(), r.data(), nullptr};
  voxel::Solids solids;
  voxel::Field field;
  FieldFilesRequest request;
};

TEST_F(FieldFiles, VdbHoldsAllGridsAndMetadata) {
  write_field_files(folder_ / "out", field, view, solids, request);
  openvdb::initialize();
  openvdb::io::File file((folder_ / "out/fields.vdb").string());
  file.open();
  const auto meta = file.getMetadata();
  EXPECT_EQ(meta->metaValue<double>("voxel"), 1e-5);
  EXPECT_EQ(meta->metaValue<double>("time"), 0.25);
  EXPECT_EQ(meta->metaValue<double>("average"), 5e-5);
  EXPECT_EQ(meta->metaValue<std::string>("method"), "exact");
  EXPECT_EQ(meta->metaValue<std::string>("source"), "three.csv");
  EXPECT_EQ(meta->metaValue<std::string>("version"), "1.2.3");
  EXPECT_NE(meta->metaValue<std::string>("box"), "");
  for (const char* name : {"void_fraction", "solid_fraction", "available_fraction", "mass_density",
                           "void_fraction_averaged", "solid_fraction_averaged"}) {
    ASSERT_TRUE(file.hasGrid(name)) << name;
    const auto grid = file.readGrid(name);
    EXPECT_EQ(grid->metaValue<std::int64_t>("file_voxel_count"), grid->activeVoxelCount()) << name;
    const openvdb::CoordBBox box = grid->evalActiveVoxelBoundingBox();
    EXPECT_EQ(grid->metaValue<openvdb::Vec3i>("file_bbox_min"), box.min().asVec3i()) << name;
    EXPECT_EQ(grid->metaValue<openvdb::Vec3i>("file_bbox_max"), box.max().asVec3i()) << name;
  }
  const auto solid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("solid_fraction"));
  EXPECT_EQ(solid->background(), 0.0f);
  EXPECT_EQ(openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("void_fraction"))->background(), 1.0f);
  const auto centre = solid->indexToWorld(openvdb::Coord(0, 0, 0));
  EXPECT_NEAR(centre.x(), 5e-6, 1e-18);
  EXPECT_NEAR(centre.z(), -5e-6, 1e-18);
  double sum = 0;
  for (auto it = solid->cbeginValueOn(); it; ++it) {
    sum += static_cast<double>(*it) * static_cast<double>(it.getVoxelCount()) * 1e-15;
  }
  EXPECT_NEAR(sum, field.sums.solid_volume_field, 1e-6 * field.sums.solid_volume_field);
}

TEST_F(FieldFiles, VtiHoldsTheSameValuesXFastest) {
  write_field_files(folder_ / "out", field, view, solids, request);
  const Vti vti(folder_ / "out/fields.vti");
  EXPECT_EQ(vti.attribute("<ImageData", "WholeExtent"), "0 20 0 15 0 12");
  EXPECT_EQ(vti.attribute("<ImageData", "Origin"), "0 0 -1e-05");
  EXPECT_EQ(vti.attribute("<ImageData", "Spacing"), "1e-05 1e-05 1e-05");
  EXPECT_NE(vti.xml.find(">0.25</DataArray>"), std::string::npos);
  for (const auto& [name, grid] : {std::pair{"void_fraction", field.void_fraction},
                                   {"solid_fraction", field.solid_fraction},
                                   {"available_fraction", field.available_fraction},
                                   {"void_fraction_averaged", field.void_fraction_averaged},
                                   {"solid_fraction_averaged", field.solid_fraction_averaged}}) {
    const auto values = vti.array(name);
    ASSERT_EQ(values.size(), 20u * 15u * 12u) << name;
    const auto read = grid->getConstAccessor();
    std::size_t at = 0;
    for (int k = 0; k < 12; ++k) {
      for (int j = 0; j < 15; ++j) {
        for (int i = 0; i < 20; ++i, ++at)
          ASSERT_EQ(values[at], read.getValue({i, j, k})) << name << i << j << k;
      }
    }
  }
}

// Velocity as vectors, stress as six components in VTK's order, both with their averages.
TEST_F(FieldFiles, HoldQuantitiesByTheirComponents) {
  const std::vector<double> vx{1, 2, 3}, vy{-4, 5, -6}, vz{0.5, 0.25, 8};
  std::array<std::vector<double>, 6> stress;
  for (std::size_t c = 0; c < 6; ++c) {
    const double s = 100.0 * static_cast<double>(c) - 200;
    stress[c] = {s, 2 * s, -s};
    view.stress[c] = stress[c].data();
  }
  view.velocity = {vx.data(), vy.data(), vz.data()};
  request.computed.quantities.velocity = request.computed.quantities.stress = true;
  field = voxel::compute_field(view, solids, request.computed);
  write_field_files(folder_ / "out", field, view, solids, request);
  const Vti vti(folder_ / "out/fields.vti");
  EXPECT_EQ(vti.attribute("Name=\"velocity\"", "NumberOfComponents"), "3");
  EXPECT_EQ(vti.attribute("Name=\"stress\"", "NumberOfComponents"), "6");
  openvdb::initialize();
  openvdb::io::File file((folder_ / "out/fields.vdb").string());
  file.open();
  const auto velocity = openvdb::gridPtrCast<openvdb::Vec3SGrid>(file.readGrid("velocity"));
  EXPECT_TRUE(file.hasGrid("velocity_averaged") && file.hasGrid("pressure") &&
              file.hasGrid("stress_xz_averaged"));
  EXPECT_EQ(velocity->metaValue<std::string>("units"), "m/s");
  EXPECT_NEAR(velocity->indexToWorld(openvdb::Coord(0, 0, 0)).z(), -5e-6, 1e-18);
  std::size_t active = 0;
  for (const std::string suffix : {"", "_averaged"}) {
    const auto v = vti.array("velocity" + suffix), s = vti.array("stress" + suffix);
    ASSERT_EQ(v.size(), 3 * 20u * 15u * 12u);
    ASSERT_EQ(s.size(), 6 * 20u * 15u * 12u);
    for (const voxel::QuantityGrid& q : field.quantities) {
      const std::string axes = "xyz";
      const std::vector<std::string> tensor{"xx", "yy", "zz", "xy", "yz", "xz"};
      const bool vector = q.name == "velocity";
      if (!vector && q.name != "stress") continue;
      const auto component = vector
                                 ? axes.find(q.component)
                                 : static_cast<std::size_t>(
                                       std::find(tensor.begin(), tensor.end(), q.component) - tensor.begin());
      const auto read = (suffix.empty() ? q.grid : q.averaged)->getConstAccessor();
      const auto& values = vector ? v : s;
      std::size_t at = component;
      for (int k = 0; k < 12; ++k)
        for (int j = 0; j < 15; ++j)
          for (int i = 0; i < 20; ++i, at += vector ? 3 : 6) {
            const openvdb::Coord cell(i, j, k);
            ASSERT_EQ(values[at], read.getValue(cell)) << q.full_name() << cell;
            if (!vector || !suffix.empty()) continue;
            ASSERT_EQ(velocity->tree().getValue(cell)[static_cast<int>(component)], read.getValue(cell));
            active += velocity->tree().isValueOn(cell);
          }
    }
  }
  EXPECT_EQ(active, 3 * field.solid_fraction->activeVoxelCount());
}

// More cells than one block of the compressor holds, and a last block that is shorter.
TEST_F(FieldFiles, VtiOfManyBlocks) {
  request.computed.lattice = voxel::cubic_lattice({{0, 0, 0}, {2e-4, 1.5e-4, 1.1e-4}}, 1.3e-6);
  request.computed.average_length = 0;
  field = voxel::compute_field(view, solids, request.computed);
  write_vti(folder_ / "a.vti", field, std::nan(""));
  const Vti vti(folder_ / "a.vti");
  EXPECT_EQ(vti.xml.find("TimeValue"), std::string::npos);
  EXPECT_FALSE(vti.has("solid_fraction_averaged"));
  const auto values = vti.array("solid_fraction");
  ASSERT_EQ(static_cast<std::int64_t>(values.size()), field.lattice.cells());
  double sum = 0;
  for (const float v : values) sum += static_cast<double>(v);
  const double volume = sum * field.lattice.cell_volume();
  EXPECT_NEAR(volume, field.sums.solid_volume_field, 1e-6 * field.sums.solid_volume_field);
}

TEST_F(FieldFiles, VtiAboveItsLimitIsLeftOutAndSaidSo) {
  request.vti_most_cells = 100;
  const auto result = write_field_files(folder_ / "out", field, view, solids, request);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out/fields.vti"));
  ASSERT_EQ(result.messages.size(), 1u);
  EXPECT_NE(result.messages[0].find("3600 cells"), std::string::npos);
}

TEST_F(FieldFiles, TablesAndNames) {
  request.slices = {{0, 4.5e-5}};
  request.lines = {{1, {4.5e-5, 0, 3.5e-5}}};
  request.layers =
      voxel::LayerRequest{{{0, 0, 0}, {2e-4, 1.5e-4, 5e-5}}, {4, 3}, {false, false, false}, 7800};
  request.stem = "bed_000007";
  request.tables = "bed_000007";
  write_field_files(folder_ / "out", field, view, solids, request);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/bed_000007.vdb"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/bed_000007.vti"));
  const auto inner = folder_ / "out/bed_000007";
  std::istringstream slice(slurp(inner / "slices/x=4.5e-05.csv"));
  std::string line;
  std::getline(slice, line);
  EXPECT_EQ(line, "x_m,y_m,z_m,void_fraction,solid_fraction,mass_density_kg_m3,void_fraction_averaged");
  int rows = 0;
  while (std::getline(slice, line)) ++rows;
  EXPECT_EQ(rows, 15 * 12);
  EXPECT_TRUE(std::filesystem::exists(inner / "lines/y@x=4.5e-05,z=3.5e-05.csv"));
  std::istringstream layers(slurp(inner / "layers.csv"));
  std::getline(layers, line);
  EXPECT_EQ(line.substr(0, 46), "x_m,y_m,solid_fraction,mass_density_kg_m3,soli");
  rows = 0;
  while (std::getline(layers, line)) ++rows;
  EXPECT_EQ(rows, 12);
  EXPECT_TRUE(std::filesystem::exists(inner / "profile_x.csv"));
  EXPECT_TRUE(std::filesystem::exists(inner / "profile_y.csv"));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().string().find(".tmp"), std::string::npos) << "left behind: " << entry.path();
  }
}

TEST_F(FieldFiles, SummaryHoldsTheContractsKeys) {
  request.lines = {{1, {4.5e-5, 0, 3.5e-5}}};
  write_field_files(folder_ / "out", field, view, solids, request);
  const auto json = nlohmann::json::parse(slurp(folder_ / "out/summary.json"));
  for (const char* key :
       {"particles", "voxel_m", "box_m", "shape", "method", "solid_volume_particles_m3",
        "solid_volume_field_m3", "relative_conservation_error", "written_conservation_error",
        "solid_fraction_mean", "void_fraction_mean", "void_fraction_min", "void_fraction_max",
        "negative_voxels", "layer_mean", "layer_sd", "seconds"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["particles"], 3);
  EXPECT_EQ(json["shape"], (std::vector<int>{20, 15, 12}));
  EXPECT_LE(json["relative_conservation_error"].get<double>(), 1e-12);
  EXPECT_LE(json["written_conservation_error"].get<double>(), 1e-6);
  // the floor takes one layer of voxels of twelve
  EXPECT_NEAR(json["available_volume_m3"].get<double>(), 2e-4 * 1.5e-4 * 1.1e-4, 1e-24);
  EXPECT_NEAR(json["solid_fraction_mean"].get<double>() + json["void_fraction_mean"].get<double>(), 1, 1e-15);
  EXPECT_TRUE(json["layer_mean"].is_null());
  EXPECT_EQ(json["lines"][0]["name"], "y@x=4.5e-05,z=3.5e-05");
}

TEST_F(FieldFiles, WhatTheFieldDoesNotHoldIsRefusedBeforeAnythingIsWritten) {
  request.slices = {{0, 1.0}};
  EXPECT_THROW(write_field_files(folder_ / "out", field, view, solids, request), InputError);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(FieldFiles, FolderThatCannotBeMade) {
  write("file", "");
  EXPECT_THROW(write_field_files(folder_ / "file" / "out", field, view, solids, request), RunError);
}

TEST_F(FieldFiles, PvdSeriesGrowsInOrderOfTime) {
  const auto path = folder_ / "a.pvd";
  EXPECT_TRUE(read_pvd(path).empty());
  append_to_pvd(path, {0.2, "b.vti"});
  append_to_pvd(path, {0.1, "a.vti"});
  append_to_pvd(path, {0.3, "b.vti"});
  const auto entries = read_pvd(path);
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].file, "a.vti");
  EXPECT_EQ(entries[0].time, 0.1);
  EXPECT_EQ(entries[1].file, "b.vti");
  EXPECT_EQ(entries[1].time, 0.3);
}

}  // namespace
}  // namespace interstice::io::testing
