#include "coupling/io/trajectory.h"

#include <hdf5.h>

#include <set>

#include "base/error.h"
#include "tests/coupling/io/sample_frames.h"

namespace interstice::io {
namespace {

using testing::same_frame;
using testing::sample_frame;
using testing::TemporaryFolder;

TEST(Trajectory, GivesBackEveryBit) {
  const TemporaryFolder folder;
  TrajectoryWriter writer = TrajectoryWriter::create(folder / "t.h5part");
  ParticleFrame first = sample_frame(0, 137);
  first.x[3] = std::numeric_limits<double>::quiet_NaN();
  first.vx[4] = -0.0;
  first.vy[5] = std::numeric_limits<double>::denorm_min();
  first.vz[6] = -std::numeric_limits<double>::infinity();
  writer.append(first);
  writer.append(sample_frame(1, 70000));  // more than one chunk
  EXPECT_EQ(writer.frames(), 2);
  const TrajectoryReader reader(folder / "t.h5part");
  ASSERT_EQ(reader.frames(), 2);
  EXPECT_EQ(reader.time(1), 0.01);
  EXPECT_TRUE(same_frame(reader.read(0), first));
  EXPECT_TRUE(same_frame(reader.read(1), sample_frame(1, 70000)));
}

TEST(Trajectory, LeavesOutWhatTheFrameLacks) {
  const TemporaryFolder folder;
  ParticleFrame bare;
  bare.x = bare.y = bare.z = {1, 2};
  bare.radius = {3, 4};
  TrajectoryWriter::create(folder / "t.h5part").append(bare);
  const ParticleFrame read = TrajectoryReader(folder / "t.h5part").read(0);
  EXPECT_TRUE(same_frame(read, bare));
  EXPECT_TRUE(std::isnan(read.time));
  EXPECT_EQ(read.step, -1);
  EXPECT_FALSE(read.bounds.has_value());
}

TEST(Trajectory, KeepsFramesWithoutParticlesAndTheirWalls) {
  const TemporaryFolder folder;
  ParticleFrame empty = sample_frame(0, 0);
  empty.walls.push_back({"", Plane{{1, 2, 3}, {0, 1, 0}}});
  empty.walls.push_back({std::string(300, 'w') + "ä/b", Box{{1, 2, 3}, {4, 5, 6}}});
  TrajectoryWriter writer = TrajectoryWriter::create(folder / "t.h5part");
  writer.append(empty);
  writer.append(sample_frame(1, 5));
  const TrajectoryReader reader(folder / "t.h5part");
  EXPECT_TRUE(same_frame(reader.read(0), empty));
  EXPECT_TRUE(same_frame(reader.read(1), sample_frame(1, 5)));
}

TEST(Trajectory, HoldsManyFrames) {
  const TemporaryFolder folder;
  TrajectoryWriter writer = TrajectoryWriter::create(folder / "t.h5part");
  for (int k = 0; k < 150; ++k) writer.append(sample_frame(k, 3));
  const TrajectoryReader reader(folder / "t.h5part");
  ASSERT_EQ(reader.frames(), 150);
  for (int k = 0; k < 150; ++k) EXPECT_TRUE(same_frame(reader.read(k), sample_frame(k, 3))) << k;
}

TEST(Trajectory, ResumeDropsLaterFramesAndContinuesTheNumbers) {
  const TemporaryFolder folder;
  {
    TrajectoryWriter writer = TrajectoryWriter::create(folder / "t.h5part");
    for (int k = 0; k < 9; ++k) writer.append(sample_frame(k, 50));
  }
  TrajectoryWriter writer = TrajectoryWriter::resume(folder / "t.h5part", 0.04);
  EXPECT_EQ(writer.frames(), 5);
  EXPECT_EQ(TrajectoryReader(folder / "t.h5part").frames(), 5);
  for (int k = 5; k < 8; ++k) writer.append(sample_frame(k, 60));
  const TrajectoryReader reader(folder / "t.h5part");
  ASSERT_EQ(reader.frames(), 8);
  for (int k = 0; k < 8; ++k) EXPECT_TRUE(same_frame(reader.read(k), sample_frame(k, k < 5 ? 50 : 60))) << k;
  EXPECT_EQ(TrajectoryWriter::resume(folder / "t.h5part", -1).frames(), 0);
  EXPECT_EQ(TrajectoryReader(folder / "t.h5part").frames(), 0);
  EXPECT_EQ(TrajectoryWriter::resume(folder / "new.h5part", 1).frames(), 0);
}

TEST(Trajectory, RefusesColumnsOfUnequalLength) {
  const TemporaryFolder folder;
  TrajectoryWriter writer = TrajectoryWriter::create(folder / "t.h5part");
  ParticleFrame frame = sample_frame(0, 5);
  frame.vy.pop_back();
  EXPECT_THROW(writer.append(frame), RunError);
  frame = sample_frame(0, 5);
  frame.radius.clear();
  EXPECT_THROW(writer.append(frame), RunError);
  EXPECT_EQ(TrajectoryReader(folder / "t.h5part").frames(), 0);
}

TEST(Trajectory, CanBeReadWhileItGrows) {
  const TemporaryFolder folder;
  TrajectoryWriter writer = TrajectoryWriter::create(folder / "t.h5part");
  writer.append(sample_frame(0, 500));
  const TrajectoryReader early(folder / "t.h5part");
  for (int k = 1; k < 30; ++k) {
    writer.append(sample_frame(k, 500));
    EXPECT_EQ(TrajectoryReader(folder / "t.h5part").frames(), k + 1);
  }
  EXPECT_EQ(early.frames(), 1);
  EXPECT_TRUE(same_frame(early.read(0), sample_frame(0, 500)));
  EXPECT_THROW(early.read(1), InputError);
}

void expect_input_error(const std::filesystem::path& path) {
  try {
    const TrajectoryReader reader(path);
    FAIL() << "accepted " << path;
  } catch (const InputError& error) {
    EXPECT_EQ(error.messages().size(), 1u);
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
  }
}

TEST(Trajectory, NamesWhatIsNoTrajectory) {
  const TemporaryFolder folder;
  testing::put_bytes(folder / "text.h5part", "x y z\n");
  testing::put_bytes(folder / "empty.h5part", "");
  const hid_t other = H5Fcreate((folder / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(other);
  for (const char* name : {"missing.h5part", "text.h5part", "empty.h5part", "other.h5"})
    expect_input_error(folder / name);
  expect_input_error(folder.path());
}

// A file of another program: float32 columns, no walls, no header of ours.
TEST(Trajectory, ReadsForeignH5PartButDoesNotContinueIt) {
  const TemporaryFolder folder;
  const hid_t file = H5Fcreate((folder / "t.h5part").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  for (const char* step : {"Step#5", "Step#10"}) {
    const hid_t group = H5Gcreate2(file, step, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hsize_t n = 2;
    const hid_t space = H5Screate_simple(1, &n, nullptr);
    for (const char* name : {"x", "y", "z", "radius"}) {
      const hid_t data =
          H5Dcreate2(group, name, H5T_IEEE_F32BE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      const float values[2] = {1.5f, 2.5f};
      H5Dwrite(data, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
      H5Dclose(data);
    }
    H5Sclose(space), H5Gclose(group);
  }
  H5Fclose(file);
  const TrajectoryReader reader(folder / "t.h5part");
  ASSERT_EQ(reader.frames(), 2);
  EXPECT_TRUE(std::isnan(reader.time(0)));
  EXPECT_EQ(reader.read(1).radius, (std::vector<double>{1.5, 2.5}));
  EXPECT_THROW(TrajectoryWriter::resume(folder / "t.h5part", 1), InputError);
}

// What vtkH5PartReader (ParaView 5.11) and h5py rely on, checked through the plain C library.
TEST(Trajectory, LiesAsH5PartReadersExpect) {
  const TemporaryFolder folder;
  TrajectoryWriter writer = TrajectoryWriter::create(folder / "t.h5part");
  for (int k = 0; k < 3; ++k) writer.append(sample_frame(k, 10));
  const hid_t file = H5Fopen((folder / "t.h5part").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const hid_t properties = H5Fget_create_plist(file);
  unsigned superblock = 9;
  H5Pget_version(properties, &superblock, nullptr, nullptr, nullptr);
  EXPECT_EQ(superblock, 0u);
  H5Pclose(properties);

  std::set<std::string> root;
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* set) -> herr_t {
    static_cast<std::set<std::string>*>(set)->insert(name);
    return 0;
  };
  H5Literate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &root);
  EXPECT_EQ(root, (std::set<std::string>{"Step#0", "Step#1", "Step#2", "Walls"}));

  const hid_t step = H5Gopen2(file, "Step#1", H5P_DEFAULT);
  std::set<std::string> columns;
  H5Literate(step, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &columns);
  EXPECT_EQ(columns, (std::set<std::string>{"bonded", "density", "id", "layer", "material", "omega_0",
                                            "omega_1", "omega_2", "radius", "velocity_0", "velocity_1",
                                            "velocity_2", "x", "y", "z"}));
  for (const std::string& name : columns) {
    const hid_t dataset = H5Dopen2(step, name.c_str(), H5P_DEFAULT);
    const hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset),
                created = H5Dget_create_plist(dataset);
    const bool small = name == "bonded" || name == "layer" || name == "material";
    EXPECT_GT(H5Tequal(type, name == "id" ? H5T_NATIVE_LLONG
                             : small      ? H5T_NATIVE_INT
                                          : H5T_NATIVE_DOUBLE),
              0)
        << name;
    EXPECT_EQ(H5Sget_simple_extent_ndims(space), 1);
    EXPECT_EQ(H5Sget_simple_extent_npoints(space), 10);
    ASSERT_EQ(H5Pget_nfilters(created), 2);
    for (unsigned i = 0; i < 2; ++i) {
      unsigned flags = 0, configuration = 0;
      std::size_t values = 0;
      const H5Z_filter_t filter =
          H5Pget_filter2(created, i, &flags, &values, nullptr, 0, nullptr, &configuration);
      EXPECT_EQ(filter, i == 0 ? H5Z_FILTER_SHUFFLE : H5Z_FILTER_DEFLATE);
    }
    H5Pclose(created), H5Sclose(space), H5Tclose(type), H5Dclose(dataset);
  }
  const hid_t time = H5Aopen(step, "TimeValue", H5P_DEFAULT);
  const hid_t type = H5Aget_type(time);
  EXPECT_GT(H5Tequal(type, H5T_NATIVE_DOUBLE), 0);
  double value = 0;
  H5Aread(time, H5T_NATIVE_DOUBLE, &value);
  EXPECT_EQ(value, 0.01);
  H5Tclose(type), H5Aclose(time), H5Gclose(step), H5Fclose(file);
}

}  // namespace
}  // namespace interstice::io
