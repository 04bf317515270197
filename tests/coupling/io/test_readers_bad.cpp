// Particle files made bad by one change each: the error must name the place, and say what to do.
#include "reader_testing.h"

namespace interstice::io::testing {
namespace {

using BadFiles = ReaderTest;

// A message has the parts that every input error has, and says `what`.
void expect_error(const std::string& message, const std::string& place, const std::string& what) {
  EXPECT_NE(message.find(place), std::string::npos) << message;
  EXPECT_NE(message.find(what), std::string::npos) << message;
  EXPECT_NE(message.find("; "), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

std::string good() { return slurp(sample("two-frames.dump")); }

// Line 10 is the first row of frame 0; frame 1 begins at line 160 and its rows at 169.
TEST_F(BadFiles, DumpCells) {
  const std::string row = "0 1 1.5605e-05 0.0002083489 102 0.0003758182 4.837112e-05 7800\n";
  const auto with = [&](const std::string& bad) {
    return error_of(write("a.dump", replaced(good(), row, bad + "\n")));
  };
  expect_error(with("0 1 -1.5e-05 0.0002 102 0.0003 4.8e-05 7800"), "a.dump:10: frame 0",
               "radius of particle 102");
  expect_error(with("0 1 0 0.0002 102 0.0003 4.8e-05 7800"), "a.dump:10", "is not positive");
  expect_error(with("0 1 nan 0.0002 102 0.0003 4.8e-05 7800"), "a.dump:10", "is not finite");
  expect_error(with("0 1 1.5e-05 inf 102 0.0003 4.8e-05 7800"), "a.dump:10",
               "z of particle 102: `inf` is not finite");
  expect_error(with("0 1 1e-5 1e400 102 0.0003 4.8e-05 7800"), "a.dump:10", "is not finite");
  expect_error(with("0 1 1e-5 abc 102 0.0003 4.8e-05 7800"), "a.dump:10", "is no number");
  expect_error(with("0 1 1e-5 1e-4x 102 0.0003 4.8e-05 7800"), "a.dump:10", "is no number");
  expect_error(with("0 1 1e-5 1e-4 1.5 0.0003 4.8e-05 7800"), "a.dump:10", "is no whole number");
  expect_error(with("0 1 1e-5 1e-4 102 0.0003 4.8e-05"), "a.dump:10",
               "7 values in a row; the header names 8");
  expect_error(with("0 1 1e-5 1e-4 102 0.0003 4.8e-05 7800 1"), "a.dump:10", "9 values in a row");
}

TEST_F(BadFiles, DumpHeader) {
  const auto with = [&](const std::string& from, const std::string& to) {
    return error_of(write("a.dump", replaced(good(), from, to)));
  };
  const auto no_size = with("radius", "size");
  expect_error(no_size, "a.dump:9: frame 0", "no column `radius` or `diameter`");
  expect_error(no_size, "vz, type, size, z, id, x, y, density", "--columns radius=NAME");
  expect_error(with(" x y ", " x q "), "a.dump:9", "no column `y`");
  expect_error(with(" x y ", " x x "), "a.dump:9", "two columns are called `x`");
  expect_error(with("ATOMS\n150", "ATOMS\n-1"), "a.dump:4", "number of atoms");
  expect_error(with("ATOMS\n150", "ATOMS\nmany"), "a.dump:4", "number of atoms");
  expect_error(with("ATOMS\n150", "ATOMS\n151"), "a.dump:160: frame 0",
               "150 rows where NUMBER OF ATOMS says 151");
  expect_error(with("ATOMS\n150", "ATOMS\n149"), "a.dump:159: frame 1", "more rows than NUMBER OF ATOMS");
  expect_error(with("ATOMS\n150", "ATOMS\n999999999999999"), "a.dump:160: frame 0", "150 rows where");
  expect_error(with("0 0.001\n", "0 wide\n"), "a.dump:6", "box bounds");
  expect_error(with("0 0.001\n", "1 0.001\n"), "a.dump:6", "box bounds");
  expect_error(with("0 0.001\n", "0 inf\n"), "a.dump:6", "box bounds");
  expect_error(with("TIMESTEP\n1000", "TIMESTEP\nlate"), "a.dump:2", "time step");
  expect_error(with("ITEM: BOX", "ITEM: BOXES"), "a.dump:5", "section `BOXES");
  expect_error(with("ITEM: NUMBER OF ATOMS\n150\n", ""), "a.dump:7", "before ITEM: NUMBER OF ATOMS");
  expect_error(with("ITEM: BOX BOUNDS ff ff ff\n0 0.001", "ITEM: BOX BOUNDS abc origin\n0 0.001"), "a.dump:5",
               "triclinic/general no");
  expect_error(with("ITEM: TIMESTEP", "ITEM: UNITS\nfurlong\nITEM: TIMESTEP"), "a.dump:2", "units `furlong`");
  expect_error(with("ITEM: ATOMS", "ITEM: ENTRIES"), "a.dump:9", "local entries");
}

TEST_F(BadFiles, DumpBoundariesAndTilts) {
  const auto with = [&](const std::string& to) {
    return error_of(
        write("a.dump", replaced(good(), "ITEM: BOX BOUNDS ff ff ff\n0 0.001\n0 0.0005\n0 0.0004\n", to)));
  };
  expect_error(with("ITEM: BOX BOUNDS ff ff\n0 1\n0 1\n0 1\n"), "a.dump:5", "kinds of boundary");
  expect_error(with("ITEM: BOX BOUNDS ff ff qq\n0 1\n0 1\n0 1\n"), "a.dump:5", "kinds of boundary");
  expect_error(with("ITEM: BOX BOUNDS xy xz yz ff ff ff\n0 2 5\n0 1 0\n0 1 0\n"), "a.dump:8", "no width");
  expect_error(with("ITEM: BOX BOUNDS xy xz yz ff ff ff\n0 2\n0 1 0\n0 1 0\n"), "a.dump:6", "box bounds");
}

TEST_F(BadFiles, DumpWithoutBoundsCannotBeUnscaled) {
  const std::string text =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: ATOMS id xs ys zs radius\n1 0 0 0 1e-5\n";
  expect_error(error_of(write("a.dump", text)), "a.dump:6", "without BOX BOUNDS");
}

TEST_F(BadFiles, DumpCutInItsLastFrameSaysWhichFramesAreWhole) {
  const std::string text = good();
  const auto second = text.find("ITEM: TIMESTEP", 5);
  const auto rows = text.find("ITEM: ATOMS", second);
  const auto third_row = text.find('\n', text.find('\n', text.find('\n', rows) + 1) + 1) + 1;
  const auto cut = [&](std::size_t at) { return error_of(write("a.dump", text.substr(0, at))); };
  expect_error(cut(third_row), "a.dump:170: frame 1: cut after 2 of 150 rows", "frame 0 is whole");
  expect_error(cut(third_row + 6), "frame 1: cut after 2 of 150 rows", "frame 0 is whole");
  expect_error(cut(text.size() - 1), "frame 1: cut after 149 of 150 rows", "frame 0 is whole");
  expect_error(cut(second + 17), "frame 1: cut in section TIMESTEP", "frame 0 is whole");
  expect_error(cut(rows + 8), "frame 1: cut in its header", "frame 0 is whole");
  expect_error(cut(second - 20), "frame 0: cut after", "no frame before it");
  expect_error(error_of(write("b.dump", text + text.substr(0, third_row))), "frame 3",
               "frames 0 to 2 are whole");
}

TEST_F(BadFiles, FramesBeforeACutOneCanBeRead) {
  const std::string text = good();
  const auto reader = open_particles(write("a.dump", text.substr(0, text.size() - 100)), {});
  ParticleFrame frame;
  EXPECT_TRUE(reader->next(frame));
  EXPECT_EQ(frame.size(), 150u);
  EXPECT_THROW(reader->next(frame), InputError);
}

TEST_F(BadFiles, SkippingFindsACutToo) {
  const std::string text = good();
  const auto reader = open_particles(write("a.dump", text.substr(0, text.size() - 100)), {});
  EXPECT_TRUE(reader->skip());
  EXPECT_THROW(reader->skip(), InputError);
}

TEST_F(BadFiles, DamagedGzip) {
  const std::string packed = slurp(sample("two-frames-gz.dump.gz"));
  expect_error(error_of(write("a.dump.gz", packed.substr(0, packed.size() - 500))),
               "a.dump.gz:", "the compressed data end early");
  std::string flipped = packed;
  flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 0x10);
  EXPECT_NE(error_of(write("b.dump.gz", flipped)), "");
  std::string checksum = packed;
  checksum[checksum.size() - 6] = static_cast<char>(checksum[checksum.size() - 6] ^ 1);
  expect_error(error_of(write("c.dump.gz", checksum)), "c.dump.gz:", "the compressed data are damaged");
}

TEST_F(BadFiles, Tables) {
  const auto of = [&](const std::string& text) { return error_of(write("a.csv", text)); };
  expect_error(of("x,y,z,radius\n1,2,3\n"), "a.csv:2", "3 values in a row; the header names 4");
  expect_error(of("x,y,z,radius\n1,2,3,0\n"), "a.csv:2", "is not positive");
  expect_error(of("x,y,z,radius\n1,,3,1e-5\n"), "a.csv:2", "y: `` is no number");
  expect_error(of("x,y,z,size\n1,2,3,1\n"), "a.csv:1", "no column `radius` or `diameter`");
  expect_error(of("x [foot],y,z,radius\n1,2,3,1\n"), "a.csv:1", "unit `foot`");
  expect_error(of("1,2,3,4\n"), "a.csv:1", "no header");
  expect_error(of("1 2 3 4 5\n"), "a.csv:1", "no header");
  expect_error(of("# only words\n"), "a.csv:1", "no table in the file");
}

TEST_F(BadFiles, ColumnsOption) {
  ReaderOptions options;
  options.columns = {{"radius", "nothing"}};
  expect_error(error_of(sample("two-frames.dump"), options), ":9",
               "no such column; the columns are vz, type");
  options.columns = {{"girth", "x"}};
  expect_error(error_of(sample("two-frames.dump"), options), "--columns girth=x",
               "allowed are id, x, y, z, radius");
  options.columns = {{"radius", "x"}};
  expect_error(error_of(sample("two-frames.dump"), options), ":9", "asked for as two things");
}

TEST_F(BadFiles, FilesOfNoKnownKind) {
  expect_error(error_of(folder_ / "missing.dump"), "missing.dump", "cannot be opened");
  expect_error(error_of(folder_), folder_.string(), "is a folder");
  expect_error(error_of(write("a.dump", "")), "a.dump:1", "empty");
  expect_error(error_of(write("a.vtk", "# vtk DataFile Version 2.0\n")), "a.vtk:1", "cut in its header");
  expect_error(error_of(write("a.h5part", "x,y,z,radius\n")), "a.h5part:1", "named as HDF5");
  expect_error(error_of(write("a.dump", "x,y,z,radius\n")), "a.dump:1", "named as a dump");
  expect_error(error_of(write("a.bin", std::string(100, '\0'))), "a.bin:1", "binary");
  expect_error(error_of(write("a.data", "bed\n\n3 atoms\n0 1 xlo xhi\n")), "a.data:1", "LAMMPS data files");
  expect_error(error_of(write("a.csv", "x,y,z,radius\n" + std::string(std::size_t{10} << 20, '1'))),
               "a.csv:2", "8 MiB");
}

}  // namespace
}  // namespace interstice::io::testing
