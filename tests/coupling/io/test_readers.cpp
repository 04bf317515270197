// Good particle files of every kind that is read.
#include "coupling/io/trajectory.h"
#include "reader_testing.h"

namespace interstice::io::testing {
namespace {

using Readers = ReaderTest;

const char* const small_dump =
    "ITEM: TIMESTEP\n7\nITEM: NUMBER OF ATOMS\n3\nITEM: BOX BOUNDS pp ff ss\n0 2e-4\n-1e-4 1e-4\n0 3e-4\n"
    "ITEM: ATOMS id type diameter y x z vx \n"
    "3 2 4e-05 1e-5 2e-5 3e-5 0.5 \n"
    "1 1 2e-05 4e-5 5e-5 6e-5 +1.5 \n"
    "2 1 3e-05 7e-5 8e-5 9e-5 -2 \n";

TEST_F(Readers, DumpTakesColumnsByNameAndSortsById) {
  const auto frames = read_all(write("a.dump", small_dump));
  ASSERT_EQ(frames.size(), 1u);
  const auto& f = frames[0];
  EXPECT_EQ(f.id, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(f.x, (std::vector<double>{5e-5, 8e-5, 2e-5}));
  EXPECT_EQ(f.y, (std::vector<double>{4e-5, 7e-5, 1e-5}));
  EXPECT_EQ(f.z, (std::vector<double>{6e-5, 9e-5, 3e-5}));
  EXPECT_EQ(f.radius, (std::vector<double>{1e-5, 1.5e-5, 2e-5}));
  EXPECT_EQ(f.vx, (std::vector<double>{1.5, -2, 0.5}));
  EXPECT_TRUE(f.vy.empty());
  EXPECT_EQ(f.material, (std::vector<std::int32_t>{1, 1, 2}));
  EXPECT_EQ(f.step, 7);
  EXPECT_TRUE(std::isnan(f.time));
  ASSERT_TRUE(f.bounds);
  EXPECT_EQ(*f.bounds, (Box{{0, -1e-4, 0}, {2e-4, 1e-4, 3e-4}}));
  EXPECT_EQ(f.periodic, (std::array<bool, 3>{true, false, false}));
}

TEST_F(Readers, DumpWithWindowsLineEndsAndWithoutFlags) {
  std::string text = replaced(small_dump, " pp ff ss", "");
  std::string crlf;
  for (const char c : text) crlf += c == '\n' ? std::string("\r\n") : std::string(1, c);
  const auto frames = read_all(write("a.dump", crlf));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].size(), 3u);
  EXPECT_EQ(frames[0].periodic, (std::array<bool, 3>{false, false, false}));
}

TEST_F(Readers, DumpIsKnownByContentWhateverItsName) {
  EXPECT_EQ(open_particles(write("a.csv", small_dump), {})->kind(), "LAMMPS dump");
}

TEST_F(Readers, DumpFramesFollowOneAnotherAndCanBeSkipped) {
  const auto path = write("a.dump", small_dump + replaced(small_dump, "\n7\n", "\n9\n"));
  const auto frames = read_all(path);
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_EQ(frames[1].step, 9);
  const auto reader = open_particles(path, {});
  ParticleFrame frame;
  EXPECT_TRUE(reader->skip());
  EXPECT_TRUE(reader->next(frame));
  EXPECT_EQ(frame.step, 9);
  EXPECT_FALSE(reader->skip());
  EXPECT_FALSE(reader->next(frame));
}

TEST_F(Readers, DumpWithTimeAndUnitsBecomesSi) {
  const auto text = "ITEM: UNITS\nmicro\nITEM: TIME\n250\n" + replaced(small_dump, "8e-5", "80");
  const auto frames = read_all(write("a.dump", text + replaced(small_dump, "8e-5", "80")));
  ASSERT_EQ(frames.size(), 2u);
  EXPECT_DOUBLE_EQ(frames[0].time, 250e-6);
  EXPECT_DOUBLE_EQ(frames[0].x[1], 80e-6);
  EXPECT_DOUBLE_EQ(frames[0].vx[0], 1.5);   // um/us
  EXPECT_DOUBLE_EQ(frames[1].x[1], 80e-6);  // the unit is said once a file
}

TEST_F(Readers, LengthUnitScalesPositionsSizesAndBox) {
  ReaderOptions options;
  options.length_unit = 1e-3;
  options.length_unit_given = true;
  const auto frames = read_all(write("a.dump", small_dump), options);
  EXPECT_DOUBLE_EQ(frames[0].x[0], 5e-8);
  EXPECT_DOUBLE_EQ(frames[0].radius[0], 1e-8);
  EXPECT_DOUBLE_EQ(frames[0].bounds->hi.x, 2e-7);
}

TEST_F(Readers, DumpScaledCoordinatesAreUnscaled) {
  const auto text = replaced(small_dump, "diameter y x z", "diameter ys xs zs");
  const auto frames =
      read_all(write("a.dump", replaced(text, "2 1 3e-05 7e-5 8e-5 9e-5", "2 1 3e-05 0.25 0.5 0.75")));
  EXPECT_DOUBLE_EQ(frames[0].x[1], 1e-4);
  EXPECT_DOUBLE_EQ(frames[0].y[1], -0.5e-4);
  EXPECT_DOUBLE_EQ(frames[0].z[1], 2.25e-4);
}

TEST_F(Readers, DumpUnwrappedCoordinatesAreTaken) {
  const auto frames = read_all(write("a.dump", replaced(small_dump, "y x z", "yu xu zu")));
  EXPECT_DOUBLE_EQ(frames[0].x[0], 5e-5);
}

// Box 0..10, 0..8, 0..6 with tilts 2, -1, 3: the bounds around it are -1..12 (0 + min(0, 2, -1, 1), 10 + max)
// and 0..11.
TEST_F(Readers, DumpTiltedBoxIsUnscaledByItsEdges) {
  const auto frames = read_all(write("a.dump",
                                     "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz "
                                     "ff fs mm\n-1 12 2\n0 11 -1\n0 6 3\n"
                                     "ITEM: ATOMS id radius xs ys zs\n1 0.01 0.5 0.25 0.5\n"));
  EXPECT_DOUBLE_EQ(frames[0].x[0], 0.5 * 10 + 0.25 * 2 + 0.5 * -1);
  EXPECT_DOUBLE_EQ(frames[0].y[0], 0.25 * 8 + 0.5 * 3);
  EXPECT_DOUBLE_EQ(frames[0].z[0], 0.5 * 6);
  EXPECT_EQ(*frames[0].bounds, (Box{{0, 0, 0}, {10, 8, 6}}));
}

TEST_F(Readers, DumpTiltedBoxMayBePeriodicAlongAnEdgeThatLiesOnItsAxis) {
  const auto with = [&](const std::string& bounds) {
    return replaced(replaced(small_dump, "BOX BOUNDS pp ff ss", "BOX BOUNDS xy xz yz " + bounds.substr(0, 8)),
                    "0 2e-4\n-1e-4 1e-4\n0 3e-4\n", bounds.substr(9));
  };
  const auto along_x = read_all(write("a.dump", with("pp ff ff\n0 3e-4 1e-4\n-1e-4 1e-4 0\n0 3e-4 0\n")));
  EXPECT_EQ(along_x[0].periodic, (std::array<bool, 3>{true, false, false}));
  EXPECT_DOUBLE_EQ(along_x[0].bounds->hi.x, 2e-4);
  const auto upright = read_all(write("a.dump", with("pp pp pp\n0 2e-4 0\n-1e-4 1e-4 0\n0 3e-4 0\n")));
  EXPECT_EQ(upright[0].periodic, (std::array<bool, 3>{true, true, true}));
  EXPECT_EQ(*upright[0].bounds, (Box{{0, -1e-4, 0}, {2e-4, 1e-4, 3e-4}}));
}

// What LAMMPS writes for a sheared periodic box is read; the period that is slanted is none of ours.
TEST_F(Readers, DumpSlantedPeriodsAreLeftOutAndWarnedOf) {
  for (const auto& [bounds, axis] : {std::pair{"pp pp ff\n0 3e-4 1e-4\n-1e-4 1e-4 0\n0 3e-4 0\n", "along y;"},
                                     {"pp pp pp\n0 3e-4 0\n-1e-4 1e-4 1e-4\n0 3e-4 0\n", "along z;"}}) {
    const std::string line(bounds);
    const auto path = write("a.dump", replaced(replaced(small_dump, "BOX BOUNDS pp ff ss",
                                                        "BOX BOUNDS xy xz yz " + line.substr(0, 8)),
                                               "0 2e-4\n-1e-4 1e-4\n0 3e-4\n", line.substr(9)));
    const auto reader = open_particles(path, {});
    ParticleFrame frame;
    ASSERT_TRUE(reader->next(frame)) << bounds;
    EXPECT_TRUE(frame.periodic[0]);
    EXPECT_FALSE(frame.periodic[std::string(axis) == "along y;" ? 1 : 2]);
    EXPECT_FALSE(frame.bounds.has_value());  // so that --periodic asks for a --box
    ASSERT_EQ(reader->warnings().size(), 1U);
    EXPECT_NE(reader->warnings()[0].find(axis), std::string::npos) << reader->warnings()[0];
  }
}

TEST_F(Readers, YadeTextMayHaveCommentsBehindItsFormat) {
  const auto frames =
      read_all(write("a.txt", "#format x_y_z_r_matId\n# x y z a b\n# at rest\n1\t2\t3\t0.5\t0\n"));
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].z[0], 3);
  EXPECT_EQ(frames[0].radius[0], 0.5);
}

TEST_F(Readers, DumpUnwrappedFractionsOfTheBoxAreUnscaled) {
  const auto text = replaced(small_dump, "diameter y x z", "diameter ysu xsu zsu");
  const auto frames =
      read_all(write("a.dump", replaced(text, "2 1 3e-05 7e-5 8e-5 9e-5", "2 1 3e-05 0.25 1.5 -0.5")));
  EXPECT_DOUBLE_EQ(frames[0].x[1], 3e-4);
  EXPECT_DOUBLE_EQ(frames[0].z[1], -1.5e-4);
}

double resolution_of(const std::filesystem::path& path, const ReaderOptions& options = {}) {
  const auto reader = open_particles(path, options);
  ParticleFrame frame;
  EXPECT_TRUE(reader->next(frame));
  return reader->position_resolution();
}

TEST_F(Readers, ResolutionOfPositionsIsThatOfTheirDigits) {
  const auto csv = [&](const std::string& rows, const std::string& head = "x,y,z,radius\n") {
    return resolution_of(write("a.csv", head + rows));
  };
  EXPECT_NEAR(csv("0.0123456,0,0,1e-5\n"), 1e-7, 1e-15);
  EXPECT_NEAR(csv("0.0123456,0.1,0,1e-5\n"), 1e-6, 1e-14);  // %g: 0.1 is 0.100000 without its zeros
  EXPECT_NEAR(csv("1.23456e-2,0,-1.5e-01,1e-5\n"), 1e-6, 1e-14);
  EXPECT_NEAR(csv("0.012300,0.1,0,1e-5\n"), 1e-5, 1e-13);  // five digits are the most there are
  EXPECT_NEAR(csv("12.3456,0,0,1\n", "x [um],y,z,radius\n"), 1e-10, 1e-18);
  EXPECT_NEAR(csv("123.456789012,0,0,1e-5\n"), 1e-9, 1e-17);
  EXPECT_EQ(csv("0,0,0,1e-5\n"), 0);
  ReaderOptions millimetres;
  millimetres.length_unit = 1e-3;
  EXPECT_NEAR(resolution_of(write("a.csv", "x,y,z,radius\n12.3456,0,0,1\n"), millimetres), 1e-7, 1e-15);
  EXPECT_NEAR(resolution_of(write("a.dump", small_dump)), 1e-5, 1e-13);
  // three digits of fractions of a box of 3e-4 m
  const auto scaled = replaced(small_dump, "diameter y x z", "diameter ys xs zs");
  EXPECT_NEAR(resolution_of(write("a.dump", replaced(scaled, "9e-5", "0.125"))), 1e-3 * 3e-4, 1e-15);
}

TEST_F(Readers, DumpOfNoGrainsIsAFrame) {
  const auto frames =
      read_all(write("a.dump",
                     "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 "
                     "1\n0 1\nITEM: ATOMS id x y z radius\n"));
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_EQ(frames[0].size(), 0u);
}

TEST_F(Readers, ColumnsOptionNamesTheFilesColumns) {
  ReaderOptions options;
  options.columns = {{"radius", "c_size"}, {"x", "c_pos[1]"}};
  const auto text = replaced(replaced(small_dump, "diameter", "c_size"), " x ", " c_pos[1] ");
  const auto frames = read_all(write("a.dump", text), options);
  EXPECT_DOUBLE_EQ(frames[0].radius[0], 2e-5);
  EXPECT_DOUBLE_EQ(frames[0].x[0], 5e-5);
}

TEST_F(Readers, SamplesOfAllKindsHoldTheSameGrains) {
  const auto dump = read_all(sample("two-frames.dump"));
  const auto packed = read_all(sample("two-frames-gz.dump.gz"));
  const auto csv = read_all(sample("micrometres.csv"));
  const auto yade = read_all(sample("yade.txt"));
  ASSERT_EQ(dump.size(), 2u);
  ASSERT_EQ(packed.size(), 2u);
  ASSERT_EQ(csv.size(), 1u);
  ASSERT_EQ(yade.size(), 1u);
  ASSERT_EQ(dump[0].size(), 150u);
  EXPECT_EQ(dump[1].z, packed[1].z);
  EXPECT_LT(dump[1].z[0], dump[0].z[0]);
  for (const auto* other : {&packed[0], &csv[0], &yade[0]}) {
    ASSERT_EQ(other->size(), 150u);
    for (std::size_t i = 0; i < 150; ++i) {
      EXPECT_NEAR(other->x[i], dump[0].x[i], 1e-15);
      EXPECT_NEAR(other->y[i], dump[0].y[i], 1e-15);
      EXPECT_NEAR(other->z[i], dump[0].z[i], 1e-15);
      EXPECT_NEAR(other->radius[i], dump[0].radius[i], 1e-15);
    }
  }
}

TEST_F(Readers, CsvUnitsPerColumnAndLengthUnitForTheRest) {
  ReaderOptions options;
  options.length_unit = 1e-3;
  options.length_unit_given = true;
  const auto text =
      "\xef\xbb\xbf# made by hand\r\n\"X [\xc2\xb5m]\";y (mm);z;Radius;vx [mm/s];density "
      "[g/cm^3]\r\n1;2;3;4;5;7.8";
  const auto path = write("a.csv", text);
  const auto frames = read_all(path, options);
  ASSERT_EQ(frames[0].size(), 1u);
  EXPECT_DOUBLE_EQ(frames[0].x[0], 1e-6);
  EXPECT_DOUBLE_EQ(frames[0].y[0], 2e-3);
  EXPECT_DOUBLE_EQ(frames[0].z[0], 3e-3);
  EXPECT_DOUBLE_EQ(frames[0].radius[0], 4e-3);
  EXPECT_DOUBLE_EQ(frames[0].vx[0], 5e-3);
  EXPECT_DOUBLE_EQ(frames[0].density[0], 7800);
}

TEST_F(Readers, CsvWithItsHeaderInAComment) {
  const auto frames = read_all(write("a.csv", "# x, y, z, radius\n1e-3,2e-3,3e-3,4e-5\n"));
  EXPECT_DOUBLE_EQ(frames[0].radius[0], 4e-5);
}

TEST_F(Readers, CsvWithBlanksBetweenColumnsAndUnitsApart) {
  const auto frames = read_all(write("a.txt", "x [um] y [um] z [um] r [um]\n1 2 3 4\n\n5 6 7 8\n"));
  ASSERT_EQ(frames[0].size(), 2u);
  EXPECT_DOUBLE_EQ(frames[0].radius[1], 8e-6);
}

TEST_F(Readers, YadeTextWithoutAnyHeader) {
  const auto path = write("a.txt", "0.001\t0.002\t0.003\t4e-05\n0.002\t0.002\t0.003\t5e-05\n");
  const auto frames = read_all(path);
  ASSERT_EQ(frames[0].size(), 2u);
  EXPECT_DOUBLE_EQ(frames[0].radius[1], 5e-5);
}

TEST_F(Readers, TrajectoryComesWithItsWallsSortedById) {
  ParticleFrame frame;
  frame.time = 0.5;
  frame.id = {2, 1};
  frame.x = {2e-4, 1e-4};
  frame.y = frame.z = {0, 0};
  frame.radius = {2e-5, 1e-5};
  frame.walls = {{"floor", Plane{{0, 0, 0}, {0, 0, 1}}}, {"blade", Box{{0, 0, 0}, {1, 2, 3}}}};
  auto writer = TrajectoryWriter::create(folder_ / "a.h5part");
  writer.append(frame);
  frame.time = 1;
  writer.append(frame);

  const auto reader = open_particles(folder_ / "a.h5part", {});
  EXPECT_EQ(reader->kind(), "H5Part");
  EXPECT_EQ(reader->frames(), 2);
  EXPECT_TRUE(reader->skip());
  ParticleFrame read;
  ASSERT_TRUE(reader->next(read));
  EXPECT_FALSE(reader->next(frame));
  EXPECT_EQ(read.time, 1);
  EXPECT_EQ(read.id, (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(read.x, (std::vector<double>{1e-4, 2e-4}));
  EXPECT_EQ(read.radius, (std::vector<double>{1e-5, 2e-5}));
  ASSERT_EQ(read.walls.size(), 2u);
  EXPECT_EQ(read.walls[1].name, "blade");
  EXPECT_EQ(std::get<Box>(read.walls[1].shape), (Box{{0, 0, 0}, {1, 2, 3}}));
}

TEST_F(Readers, SizesOfNoPowderAreWarnedOf) {
  const auto reader = open_particles(write("a.csv", "x,y,z,radius\n100,200,300,20\n"), {});
  ParticleFrame frame;
  ASSERT_TRUE(reader->next(frame));
  ASSERT_EQ(reader->warnings().size(), 1u);
  EXPECT_NE(reader->warnings()[0].find("--length-unit"), std::string::npos);
}

TEST_F(Readers, RepeatedIdsAreWarnedOf) {
  const auto reader = open_particles(write("a.dump", replaced(small_dump, "\n2 1", "\n1 1")), {});
  ParticleFrame frame;
  ASSERT_TRUE(reader->next(frame));
  EXPECT_EQ(frame.size(), 3u);
  ASSERT_EQ(reader->warnings().size(), 1u);
}

}  // namespace
}  // namespace interstice::io::testing
