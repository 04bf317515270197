// VTK files: the same grains in every layout, small files with values checked by hand, and files made bad by
// one change each. The sample files are encoded by data/samples/make_samples.py, which shares nothing with
// the readers.
#include <algorithm>

#include "reader_testing.h"

namespace interstice::io::testing {
namespace {

using VtkFiles = ReaderTest;

class VtkSample : public ::testing::TestWithParam<const char*> {};

TEST_P(VtkSample, HoldsTheGrainsOfTheDump) {
  const auto dump = read_all(sample("two-frames.dump"));
  const auto frames = read_all(sample(GetParam()));
  ASSERT_EQ(frames.size(), 1u);
  const auto& f = frames[0];
  ASSERT_EQ(f.size(), 150u);
  EXPECT_EQ(f.id, dump[0].id);
  const bool floats = std::string(GetParam()) == "inline.vtp";
  for (std::size_t i = 0; i < 150; ++i) {
    const double slack =
        floats ? 0x1p-24 : 1e-15;  // half a unit in the last place of a float; of doubles, relative
    EXPECT_NEAR(f.x[i], dump[0].x[i], slack * dump[0].x[i]);
    EXPECT_NEAR(f.y[i], dump[0].y[i], slack * dump[0].y[i]);
    EXPECT_NEAR(f.z[i], dump[0].z[i], slack * dump[0].z[i]);
    EXPECT_NEAR(f.radius[i], dump[0].radius[i], slack * dump[0].radius[i]);
  }
  EXPECT_EQ(std::isnan(f.time), std::string(GetParam()) == "pizza.vtk");  // which has no time
  EXPECT_TRUE(std::isnan(f.time) || f.time == 0.25);
  if (std::string(GetParam()).find(".vtk") != std::string::npos) {
    EXPECT_EQ(f.vz, std::vector<double>(150, -0.5));
    EXPECT_EQ(f.vx, std::vector<double>(150, 0.0));
  }
}

INSTANTIATE_TEST_SUITE_P(Samples, VtkSample,
                         ::testing::Values("pizza.vtk", "binary.vtk", "ascii.vtp", "inline.vtp",
                                           "inline-zlib.vtp", "raw.vtp", "raw-zlib-big-endian.vtp",
                                           "base64.vtp", "base64-zlib.vtp"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace_if(
                               name.begin(), name.end(), [](char c) { return !std::isalnum(c); }, '_');
                           return name;
                         });

const char* const small_vtk =
    "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 float\n0.1 0.2 0.3 "
    "0.4\n0.5 0.6\n"
    "CELLS 2 4\n1 0 1 1\nCELL_TYPES 2\n1 1\nPOINT_DATA 2\nFIELD FieldData 3\nomega 3 2 double\n1 2 3\n4 5 6\n"
    "Grain%20size 1 2 double\n0.01 0.02\nMETADATA\nINFORMATION 0\n\ntype 1 2 int\n3 4\nNORMALS n float\n0 0 "
    "1 0 0 1\n";

const char* const small_vtp =
    "<VTKFile type='PolyData' byte_order='LittleEndian'><PolyData><Piece NumberOfPoints='2'>"
    "<CellData><DataArray type='Float32' Name='c'>7 8 9</DataArray></CellData>"
    "<PointData Scalars='r'><DataArray type='Float64' Name='a &lt; b' format='ascii'>0.01 0.02</DataArray>"
    "<DataArray type='String' Name='names' format='ascii'>65 0</DataArray></PointData>"
    "<Points><DataArray type='Float32' NumberOfComponents='3' format='ascii'>0.1 0.2 0.3\n0.4 0.5 "
    "0.6</DataArray>"
    "</Points><Verts><DataArray type='Int64' Name='connectivity'>0 1</DataArray></Verts>"
    "</Piece></PolyData></VTKFile>";

ReaderOptions radius_is(const std::string& name) {
  ReaderOptions options;
  options.columns = {{"radius", name}};
  return options;
}

TEST_F(VtkFiles, LegacyTextByHand) {
  const auto frames = read_all(write("a.vtk", small_vtk), radius_is("Grain size"));
  const auto& f = frames.at(0);
  EXPECT_EQ(f.x, (std::vector<double>{0.1, 0.4}));
  EXPECT_EQ(f.z, (std::vector<double>{0.3, 0.6}));
  EXPECT_EQ(f.radius, (std::vector<double>{0.01, 0.02}));
  EXPECT_EQ(f.wy, (std::vector<double>{2, 5}));
  EXPECT_EQ(f.material, (std::vector<std::int32_t>{3, 4}));
  EXPECT_TRUE(f.id.empty());
}

TEST_F(VtkFiles, LegacyBinaryBytesByHand) {
  using namespace std::string_literals;
  const auto path =
      write("a.vtk",
            "# vtk DataFile Version 3.0\nx\nBINARY\nDATASET POLYDATA\nPOINTS 1 float\n"
            "\x3f\x80\x00\x00\xc0\x00\x00\x00\x3e\x80\x00\x00\n"  // 1, -2, 0.25
            "VERTICES 1 2\n\0\0\0\1\0\0\0\0\nPOINT_DATA 1\nSCALARS radius double\nLOOKUP_TABLE default\n"
            "\x3f\x84\x7a\xe1\x47\xae\x14\x7b\nSCALARS id long 1\nLOOKUP_TABLE default\n"
            "\0\0\0\0\0\0\1\2\n"s);
  const auto f = read_all(path).at(0);
  EXPECT_EQ(f.x[0], 1);
  EXPECT_EQ(f.y[0], -2);
  EXPECT_EQ(f.z[0], 0.25);
  EXPECT_EQ(f.radius[0], 0.01);
  EXPECT_EQ(f.id[0], 258);
}

TEST_F(VtkFiles, XmlByHand) {
  const auto f = read_all(write("a.vtp", small_vtp), radius_is("a < b")).at(0);
  EXPECT_EQ(f.y, (std::vector<double>{0.2, 0.5}));
  EXPECT_EQ(f.radius, (std::vector<double>{0.01, 0.02}));
}

TEST_F(VtkFiles, LengthUnitScalesPositionsSizesAndSpeeds) {
  ReaderOptions options;
  options.length_unit = 1e-3;
  const auto f = read_all(sample("binary.vtk"), options).at(0);
  const auto g = read_all(sample("binary.vtk")).at(0);
  EXPECT_DOUBLE_EQ(f.x[3], 1e-3 * g.x[3]);
  EXPECT_DOUBLE_EQ(f.radius[3], 1e-3 * g.radius[3]);
  EXPECT_DOUBLE_EQ(f.vz[3], -0.5e-3);
}

TEST_F(VtkFiles, NoPointsAreAFrameWithoutGrains) {
  EXPECT_EQ(
      read_all(write("a.vtk", "# vtk DataFile Version 3.0\nx\nASCII\nDATASET POLYDATA\nPOINTS 0 float\n"))
          .at(0)
          .size(),
      0u);
  EXPECT_EQ(
      read_all(write("a.vtp",
                     "<VTKFile type='PolyData'><PolyData><Piece NumberOfPoints='0'/></PolyData></VTKFile>"))
          .at(0)
          .size(),
      0u);
}

TEST_F(VtkFiles, ResolutionIsThatOfDigitsOrBits) {
  const auto of = [](const std::filesystem::path& path) {
    const auto reader = open_particles(path, {});
    ParticleFrame frame;
    EXPECT_TRUE(reader->next(frame));
    return reader->position_resolution();
  };
  EXPECT_EQ(of(sample("raw.vtp")), 0);
  EXPECT_EQ(of(sample("binary.vtk")), 0);
  float farthest = 0;
  const auto f = read_all(sample("inline.vtp")).at(0);
  for (const auto* axis : {&f.x, &f.y, &f.z}) {
    for (const double v : *axis) farthest = std::max(farthest, static_cast<float>(v));
  }
  EXPECT_EQ(of(sample("inline.vtp")), static_cast<double>(std::nextafter(farthest, 1.0f)) - farthest);
  EXPECT_NEAR(of(sample("pizza.vtk")), 1e-10, 1e-20);  // seven digits; the farthest 9.9e-4 m
}

void expect_error(const std::string& message, const std::string& place, const std::string& what) {
  EXPECT_NE(message.find(place), std::string::npos) << message;
  EXPECT_NE(message.find(what), std::string::npos) << message;
  EXPECT_NE(message.find("; "), std::string::npos) << message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
}

TEST_F(VtkFiles, BadLegacy) {
  const auto with = [&](const std::string& from, const std::string& to) {
    return error_of(write("a.vtk", replaced(small_vtk, from, to)), radius_is("Grain size"));
  };
  expect_error(with("ASCII", "EBCDIC"), "a.vtk:3", "ASCII or BINARY");
  expect_error(with("UNSTRUCTURED_GRID", "RECTILINEAR_GRID"), "a.vtk:4", "has no particles");
  expect_error(with("POINTS 2 float", "POINTS -2 float"), "a.vtk:5", "a count of 0 or more");
  expect_error(with("POINTS 2 float", "POINTS 999999999999999 float"), "a.vtk:5", "a count of 0 or more");
  expect_error(with("POINTS 2 float", "POINTS 999999999999 float"), "a.vtk:8", "a number is due");
  expect_error(with("POINTS 2 float", "POINTS 1 float"), "a.vtk:6", "the array is complete");
  expect_error(with("POINTS 2 float", "POINTS 2 quaternion"), "a.vtk:5", "numbers of type `quaternion`");
  expect_error(with("0.4\n", "nan\n"), "a.vtk", "is not finite");
  expect_error(with("0.4\n", "far\n"), "a.vtk:6", "`far` where a number is due");
  expect_error(with("0.01 0.02", "0.01 0"), "a.vtk", "point 1: 0 is not positive");
  expect_error(with("0.01 0.02", "-0.01 0.02"), "a.vtk", "is not positive");
  expect_error(with("3 4\n", "3 4.5\n"), "a.vtk", "no whole number");
  expect_error(with("POINT_DATA 2", "POINT_DATA 3"), "a.vtk:12", "POINTS has 2");
  expect_error(with("size 1 2", "size 1 1"), "a.vtk", "the array is complete");
  expect_error(with("size 1 2", "size 0 2"), "a.vtk", "1 to 1024");
  expect_error(with("CELL_TYPES", "CELL_KINDS"), "a.vtk:10", "`CELL_KINDS` where a section");
  expect_error(error_of(write("a.vtk", small_vtk)), "a.vtk", "no column `radius` or `diameter`");
  expect_error(
      error_of(write("b.vtk", std::string(small_vtk).substr(0, std::string(small_vtk).find("0.5 0.6"))),
               radius_is("Grain size")),
      "b.vtk:", "the file ends early");
  const std::string binary = slurp(sample("binary.vtk"));
  expect_error(error_of(write("c.vtk", binary.substr(0, 2000))), "c.vtk:", "cut in an array");
  expect_error(error_of(write("d.vtk", replaced(binary, "POINTS 150", "POINTS 999999999999"))),
               "d.vtk:", "cut in an array");
}

TEST_F(VtkFiles, BadXml) {
  const auto with = [&](const std::string& from, const std::string& to) {
    return error_of(write("a.vtp", replaced(small_vtp, from, to)), radius_is("a < b"));
  };
  expect_error(with("'PolyData'", "'ImageData'"), "a.vtp:1", "type `ImageData`");
  expect_error(with("'PolyData'", "'PPolyData'"), "a.vtp:1", "give the .vtp files that it lists");
  expect_error(with("LittleEndian", "MiddleEndian"), "a.vtp:1", "byte_order `MiddleEndian`");
  expect_error(with("byte_order", "header_type='UInt16' byte_order"), "a.vtp:1", "header_type `UInt16`");
  expect_error(with("byte_order", "compressor='vtkLZ4DataCompressor' byte_order"), "a.vtp:1", "vtkLZ4");
  expect_error(with("Points='2'", "Points='-2'"), "a.vtp:1", "NumberOfPoints: `-2`");
  expect_error(with("Points='2'", "Points='3'"), "a.vtp:1", "3 are due");
  expect_error(with("Points='2'", "Points='999999999999'"), "a.vtp:1", "999999999999 are due");
  expect_error(with("Points='2'", "Points='1'"), "a.vtp:1", "all numbers are there");
  expect_error(with("Components='3'", "Components='2'"), "a.vtp:1", "NumberOfComponents 3");
  expect_error(with("format='ascii'>0.1", "format='morse'>0.1"), "a.vtp:1", "format `morse`");
  expect_error(with("format='ascii'>0.1 ", "format='binary'>0.1 "), "a.vtp:1", "base64");
  expect_error(with("0.02</DataArray>", "0.02</Array>"), "a.vtp:1", "</Array> where </DataArray> is due");
  expect_error(with("0.02<", "nan<"), "a.vtp", "is not finite");
  expect_error(with("Name='a &lt; b'", "Name='a &lt; b' Name='c'"), "a.vtp:1", "attribute `Name` twice");
  expect_error(with("<PointData", "<!DOCTYPE x><PointData"), "a.vtp:1", "DOCTYPE");
  expect_error(with("</PolyData></VTKFile>", "</PolyData>"), "a.vtp:2", "the file ends early");
  expect_error(with("</Piece>", "</Piece><Piece NumberOfPoints='1'></Piece>"), "a.vtp:2",
               "more than one Piece");
  const std::string good = small_vtp;
  const auto points = good.find("<Points>"), verts = good.find("<Verts>");
  expect_error(error_of(write("b.vtp", good.substr(0, points) + good.substr(verts)), radius_is("a < b")),
               "b.vtp:", "without Points");
  expect_error(error_of(write("c.vtp", good)), "c.vtp", "no column `radius` or `diameter`");
  expect_error(error_of(write("d.vtp", "<?xml version='1.0'?><svg/>")), "d.vtp:1", "not VTK's");
}

TEST_F(VtkFiles, BadBinaryXml) {
  const std::string raw = slurp(sample("raw.vtp")), zlib = slurp(sample("raw-zlib-big-endian.vtp"));
  expect_error(error_of(write("a.vtp", raw.substr(0, raw.size() - 600))), "a.vtp:", "the file ends early");
  const std::string base64 = slurp(sample("base64.vtp"));
  expect_error(error_of(write("a.vtp", replaced(base64, "UInt32", "UInt64"))),
               "a.vtp:", "check byte_order and header");
  expect_error(error_of(write("a.vtp", replaced(raw, "LittleEndian", "BigEndian"))),
               "a.vtp:", "check byte_order");
  expect_error(error_of(write("a.vtp", replaced(raw, "Points=\"150\"", "Points=\"151\""))),
               "a.vtp:", "are due for the number of points");
  expect_error(error_of(write("a.vtp", replaced(raw, ">\n_", ">\n"))), "a.vtp:", "without its `_`");
  // the points' 8 + 150 * 24 bytes are followed by the ids
  expect_error(error_of(write("a.vtp", replaced(raw, "offset=\"3608\"", "offset=\"8\""))),
               "a.vtp:", "begins within the one before it");
  std::string flipped = zlib;
  flipped[zlib.size() - 200] = static_cast<char>(flipped[zlib.size() - 200] ^ 4);
  EXPECT_NE(error_of(write("a.vtp", flipped)), "");
  const std::string inlined = slurp(sample("inline-zlib.vtp"));
  expect_error(error_of(write("a.vtp", inlined.substr(0, inlined.size() - 300))), "a.vtp:", "early");
}

}  // namespace
}  // namespace interstice::io::testing
