// `interstice voids` from the outside: what it writes, what it says, and its exit status.
#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "coupling/io/particle_reader.h"
#include "coupling/io/trajectory.h"
#include "tests/apps/command_test.h"
#include "tests/coupling/io/edem_file.h"
#include "tests/coupling/io/vti_decoding.h"

namespace interstice::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

class Voids : public CommandTest {
 protected:
  static std::string sample(const std::string& name) { return INTERSTICE_SOURCE_DIR "/data/samples/" + name; }

  Outcome call(const std::string& arguments) const { return interstice("voids " + arguments); }
  std::string out() const { return (folder_ / "out").string(); }
  std::string to_out() const { return " -o " + out() + " --no-figures "; }

  // Refused: status 2, one line that says what, and nothing written.
  void expect_refused(const std::string& arguments, const std::string& what) const {
    const Outcome outcome = call(arguments + to_out());
    EXPECT_EQ(outcome.status, 2) << arguments << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(what), std::string::npos) << arguments << "\n" << outcome.err;
    EXPECT_EQ(outcome.out, "") << arguments;
    EXPECT_FALSE(fs::exists(out())) << arguments;
  }
};

double sphere_volume(const std::string& sample_path, std::int64_t frame_number) {
  const auto reader = io::open_particles(sample_path, {});
  io::ParticleFrame frame;
  for (std::int64_t i = 0; i <= frame_number; ++i) reader->next(frame);
  long double sum = 0;
  for (const double r : frame.radius) sum += static_cast<long double>(r) * r * r;
  return static_cast<double>(4 * 3.14159265358979323846264338327950288L / 3 * sum);
}

// Files that LIGGGHTS, LAMMPS and YADE wrote: the sum is that of the radii that they were given.
TEST_F(Voids, TheSolidVolumeInFilesOfOtherProgramsIsThatOfTheirGrains) {
  long double sum = 0;
  for (int i = 0; i < 60; ++i) {
    const long double r = 1e-5L + (i % 11) * 1e-6L;
    sum += r * r * r;
  }
  const auto truth = static_cast<double>(4 * 3.14159265358979323846264338327950288L / 3 * sum);
  std::string inputs;
  const std::vector<std::string> stems{"liggghts",         "liggghts-scaled",         "liggghts-sixdigits",
                                       "lammps-triclinic", "lammps-triclinic-scaled", "lammps-unwrapped",
                                       "yade-mass"};
  for (const char* name :
       {"liggghts.dump", "liggghts-scaled.dump", "liggghts-sixdigits.dump.gz", "lammps-triclinic.dump",
        "lammps-triclinic-scaled.dump.gz", "lammps-unwrapped.dump", "yade-mass.txt"})
    inputs += sample(std::string("programs/") + name) + " ";
  const Outcome outcome = call(inputs + to_out() + "--voxel 9um");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const std::string& stem : stems) {
    const Json s = Json::parse(slurp(fs::path(out()) / stem / "summary.json"));
    EXPECT_EQ(s["particles"], 60) << stem;
    EXPECT_NEAR(s["solid_volume_particles_m3"].get<double>(), truth, 1e-14 * truth) << stem;
    EXPECT_NEAR(s["solid_volume_field_m3"].get<double>(), truth, 1e-13 * truth) << stem;
  }
  // six digits are 1 nm here: fine for these voxels
  EXPECT_EQ(outcome.err.find("positions are written to"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("lammps-triclinic.dump: the box is tilted and periodic along y"),
            std::string::npos);
}

// Both end in .h5: results of EDEM, and our own checkpoints.
TEST_F(Voids, InfoKnowsEdemFilesFromCheckpoints) {
  io::testing::EdemFile(folder_ / "edem.h5").fill(true, 1);
  const Outcome edem = interstice("info " + at("edem.h5") + " --json");
  ASSERT_EQ(edem.status, 0) << edem.err;
  EXPECT_EQ(Json::parse(edem.out)["particles_last_frame"], 3);
  std::ofstream(folder_ / "none.h5") << "no HDF5";
  const Outcome none = interstice("info " + at("none.h5"));
  EXPECT_NE(none.status, 0);
  EXPECT_NE(none.err.find("none.h5"), std::string::npos) << none.err;
}

TEST_F(Voids, SingleIsSaidAndKeepsTheVolume) {
  const Outcome outcome = call(sample("two-frames.dump") + to_out() + "--voxel 17um --precision mixed");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json s = Json::parse(slurp(fs::path(out()) / "two-frames" / "summary.json"));
  EXPECT_EQ(s["method"], "exact, single");
  const double error = s["relative_conservation_error"].get<double>();
  EXPECT_GT(error, 1e-13);  // not double
  EXPECT_LE(error, 1e-6);
}

TEST_F(Voids, LastFrameOfADumpWithAllFiles) {
  const Outcome outcome =
      call(sample("two-frames.dump") + to_out() +
           "--voxel 10um --average 60um --slice x=0.5mm --slice z=50um --line y@x=0.5mm,z=0.1mm "
           "--layers 0um,100um,8,4");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const fs::path folder = fs::path(out()) / "two-frames";
  for (const char* file : {"fields.vdb", "fields.vti", "slices/x=0.0005.csv", "slices/z=5e-05.csv",
                           "lines/y@x=0.0005,z=0.0001.csv", "layers.csv", "profile_x.csv", "summary.json"}) {
    EXPECT_TRUE(fs::exists(folder / file)) << file;
  }
  const Json s = Json::parse(slurp(folder / "summary.json"));
  EXPECT_EQ(s["particles"], 150);
  EXPECT_EQ(s["frame"], 1);
  EXPECT_EQ(s["step"], 2000);
  EXPECT_LE(s["relative_conservation_error"].get<double>(), 1e-12);
  EXPECT_LE(s["written_conservation_error"].get<double>(), 1e-6);
  const double truth = sphere_volume(sample("two-frames.dump"), 1);
  EXPECT_NEAR(s["solid_volume_particles_m3"].get<double>(), truth, 1e-12 * truth);
  EXPECT_NEAR(s["mass_kg"].get<double>(), 7800 * truth, 1e-11 * 7800 * truth);
  EXPECT_GT(s["layer_mean"].get<double>(), 0);
  EXPECT_NE(outcome.out.find("150 in the box"), std::string::npos);

  openvdb::initialize();
  openvdb::io::File vdb((folder / "fields.vdb").string());
  vdb.open();
  EXPECT_TRUE(vdb.hasGrid("void_fraction_averaged"));
  EXPECT_EQ(vdb.getMetadata()->metaValue<double>("voxel"), 1e-5);
  const Vti vti(folder / "fields.vti");
  double sum = 0;
  for (const float v : vti.array("solid_fraction")) sum += static_cast<double>(v);
  EXPECT_NEAR(sum * 1e-15, truth, 1e-6 * truth);
}

TEST_F(Voids, AllFramesEachInAFolderAndASeries) {
  const Outcome outcome =
      call(sample("two-frames-gz.dump.gz") + to_out() + "--voxel 20um --frame all --json --quiet");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const fs::path folder = fs::path(out()) / "two-frames-gz";
  EXPECT_TRUE(fs::exists(folder / "frame_000000/summary.json"));
  EXPECT_TRUE(fs::exists(folder / "frame_000001/fields.vdb"));
  EXPECT_NE(slurp(folder / "fields.pvd").find("file=\"frame_000001/fields.vti\""), std::string::npos);
  const Json all = Json::parse(outcome.out);
  ASSERT_EQ(all["results"].size(), 2u);
  EXPECT_EQ(all["results"][1]["frame"], 1);
  EXPECT_EQ(outcome.err, "");
}

TEST_F(Voids, SeveralInputsOfSeveralKindsAgree) {
  const Outcome outcome =
      call(sample("two-frames.dump") + " " + sample("micrometres.csv") + " " + sample("yade.txt") + to_out() +
           "--voxel 20um --frame 0 --json --density 7800kg/m^3");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json all = Json::parse(outcome.out)["results"];
  ASSERT_EQ(all.size(), 3u);
  const double volume = all[0]["solid_volume_field_m3"];
  for (const auto& one : all) {
    EXPECT_NEAR(one["solid_volume_field_m3"].get<double>(), volume, 1e-12 * volume);
    EXPECT_NEAR(one["mass_kg"].get<double>(), 7800 * volume, 1e-11 * 7800 * volume);
  }
}

TEST_F(Voids, MethodsOfCouplingsSayWhatTheyDelete) {
  const auto summary = [&](const std::string& options) {
    const Outcome outcome =
        call(sample("two-frames.dump") + to_out() + "--overwrite --voxel 10um --json " + options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return Json::parse(outcome.out);
  };
  const double truth = sphere_volume(sample("two-frames.dump"), 1);
  const Json kept = summary("--method divided");
  EXPECT_EQ(kept["method"], "divided");
  EXPECT_EQ(kept["deleted_volume_m3"], 0);
  EXPECT_LT(kept["void_fraction_min"], 0);
  const Json limited = summary("--method divided:0.1");
  EXPECT_EQ(limited["method"], "divided:0.1");
  EXPECT_NEAR(limited["void_fraction_min"].get<double>(), 0.1, 1e-12);
  const double deleted = limited["deleted_volume_m3"];
  EXPECT_GT(deleted, 0);
  EXPECT_NEAR(limited["solid_volume_field_m3"].get<double>() + deleted, truth, 1e-9 * truth);
  EXPECT_NE(limited["messages"].dump().find("deleted"), std::string::npos);
  const Json spread = summary("--method kernel:60um");
  EXPECT_EQ(spread["method"], "kernel:6e-05m");
  EXPECT_LE(spread["relative_conservation_error"].get<double>(), 1e-12);
}

TEST_F(Voids, UnionTakesSharedPlacesOffOnce) {
  // two spheres of 50 um, 60 um apart, and one inside the first
  std::ofstream(folder_ / "pair.csv") << "x,y,z,radius\n0,0,0,5e-5\n6e-5,0,0,5e-5\n1e-6,0,0,1e-5\n";
  const Outcome outcome =
      call((folder_ / "pair.csv").string() + to_out() + "--voxel 10um --overlap union --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json s = Json::parse(outcome.out);
  EXPECT_EQ(s["overlap"], "union");
  const double pi = 3.14159265358979323846, r = 5e-5, d = 6e-5;
  const double lens = pi * (4 * r + d) * (2 * r - d) * (2 * r - d) / 12;
  EXPECT_NEAR(s["overlap_volume_m3"].get<double>() / (lens + 4 * pi / 3 * 1e-15), 1, 1e-12);
  EXPECT_LE(s["relative_conservation_error"].get<double>(), 1e-12);
  EXPECT_EQ(s["negative_voxels"], 0);
}

// One ball less, counted on the same grid: the difference is that ball, wherever the grid's cells are.
TEST_F(Voids, TwoFilesAreComparedOnOneGrid) {
  std::ofstream(at("a.csv")) << "x,y,z,radius\n5e-5,5e-5,5e-5,2e-5\n";
  std::ofstream(at("b.csv")) << "x,y,z,radius\n5e-5,5e-5,5e-5,2e-5\n2.1e-4,5e-5,5.3e-5,3e-5\n";
  std::ofstream(at("c.csv")) << "x,y,z,radius\n";
  const auto voids = [&](const std::string& inputs, const std::string& out, const std::string& box) {
    const auto outcome = call(inputs + " -o " + at(out) + " --voxel 10um --box " + box +
                              " --slice x=0.21mm --average 30um --layers 20um,80um,3,1 --no-figures");
    ASSERT_EQ(outcome.status, 0) << outcome.err;
  };
  const auto compare = [&](const std::string& a, const std::string& b) {
    return interstice("compare " + at(a) + " " + at(b) + " -o " + at("ab") + " --overwrite --json");
  };
  const std::string box = "0um,300um,0um,100um,0um,100um";
  voids(at("a.csv"), "a", box);
  voids(at("b.csv"), "b", box);
  const auto both = compare("a", "b");
  ASSERT_EQ(both.status, 0) << both.err;
  const auto difference = Json::parse(both.out)["difference_fields"][0];
  EXPECT_EQ(difference["field"], "fields");
  const double ball = 4 * M_PI / 3 * 27e-15, cells = 3000e-15;
  EXPECT_NEAR(difference["mean"].get<double>(), -ball / cells, 1e-6 * ball / cells);  // floats
  EXPECT_EQ(difference["largest"], -1);
  for (const char* file : {"fields/fields_difference.vdb", "fields/fields_difference.vti", "comparison.csv",
                           "figures/fields_end_slices.png", "figures/fields_end_slices_difference.png"})
    EXPECT_TRUE(fs::exists(at("ab") + "/" + file)) << file;
  EXPECT_NE(slurp(at("ab") + "/comparison.csv").find("end/fields/solid_fraction_gap,"), std::string::npos);
  EXPECT_EQ(slurp(at("ab") + "/report.md").find("nan"), std::string::npos);

  voids(at("b.csv"), "shifted", "5um,300um,0um,100um,0um,100um");
  EXPECT_NE(compare("a", "shifted").out.find("shifted by a fraction of a cell along x"), std::string::npos);
  voids(at("a.csv") + " " + at("c.csv"), "two", box);
  const auto many = compare("two", "b");
  EXPECT_EQ(many.status, 2);
  EXPECT_NE(many.err.find("more frames than one"), std::string::npos) << many.err;
  EXPECT_EQ(compare("two/a", "b").status, 0);
  std::ofstream(at("b/b/summary.json")) << "{";
  const auto broken = compare("a", "b");
  EXPECT_EQ(broken.status, 2);
  EXPECT_NE(broken.err.find("summary.json: no JSON"), std::string::npos) << broken.err;
}

TEST_F(Voids, ScalesAreATableAndASentence) {
  const Outcome outcome = call(sample("two-frames.dump") + to_out() + "--voxel 20um --scales --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string table = slurp(fs::path(out()) / "two-frames" / "scales.csv");
  EXPECT_EQ(table.rfind("length_m,windows,independent_windows,grains_per_window,void_fraction_mean", 0), 0u);
  const Json s = Json::parse(outcome.out);
  EXPECT_EQ(static_cast<std::int64_t>(std::count(table.begin(), table.end(), '\n')),
            1 + s["scales"]["lengths"].get<std::int64_t>());
  EXPECT_NE(s["messages"].dump().find("void fractions vary over cubes"), std::string::npos);
}

TEST_F(Voids, WindowsAreNamedInTheSummary) {
  for (const char* window : {"box", "sphere", "gaussian"}) {
    const Outcome outcome = call(sample("two-frames.dump") + to_out() +
                                 "--voxel 20um --average 100um --scales --overwrite --no-figures --json "
                                 "--average-window " +
                                 window);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json s = Json::parse(outcome.out);
    EXPECT_EQ(s["average_window"], window);
    EXPECT_EQ(s["scales"]["window"], window);
  }
}

TEST_F(Voids, SolidsLeaveTheirVolumeOut) {
  // an STL tetrahedron with legs of 0.2 mm, a ball, a cylinder, a box and a plane, apart from each other
  std::ofstream(folder_ / "corner.stl") << R"(solid corner
facet normal 0 0 -1 outer loop vertex 0 0 0 vertex 0 .2 0 vertex .2 0 0 endloop endfacet
facet normal 0 -1 0 outer loop vertex 0 0 0 vertex .2 0 0 vertex 0 0 .2 endloop endfacet
facet normal -1 0 0 outer loop vertex 0 0 0 vertex 0 0 .2 vertex 0 .2 0 endloop endfacet
facet normal 1 1 1 outer loop vertex .2 0 0 vertex 0 .2 0 vertex 0 0 .2 endloop endfacet
endsolid)";
  std::ofstream(folder_ / "grain.csv")
      << "x [mm],y [mm],z [mm],radius [mm]\n0.500000,0.500000,0.500000,0.05\n";
  const std::string grain =
      (folder_ / "grain.csv").string() + to_out() +
      "--voxel 30um --box 0mm,0.9mm,0mm,0.9mm,0mm,0.9mm --no-figures --json --overwrite ";
  const Outcome outcome =
      call(grain + "--walls " + at("corner.stl") +
           "@mm --solid ball:0.7mm,0.2mm,0.2mm,0.1mm "
           "--solid cylinder:0.2mm,0.6mm,0.7mm,0.2mm,0.85mm,0.7mm,0.08mm "
           "--solid box:0.7mm,0.8mm,0.7mm,0.9mm,0.1mm,0.2mm --solid plane:0mm,0mm,0.89mm,0,0,-2");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json s = Json::parse(outcome.out);
  const double pi = 3.14159265358979323846;
  const double solids = .008 / 6 + 4 * pi / 3 * .001 + pi * .0064 * .25 + .1 * .2 * .1 + .81 * .01;
  EXPECT_NEAR(s["available_volume_m3"].get<double>() / (1e-9 * (.729 - solids)), 1, 1e-12);
  EXPECT_EQ(s["walls"].size(), 5u);
  EXPECT_EQ(outcome.err, "");
  const Outcome small = call(grain + "--walls " + at("corner.stl") + "@um");
  ASSERT_EQ(small.status, 0) << small.err;
  EXPECT_NE(small.err.find("check its unit"), std::string::npos) << small.err;
  const Outcome large = call(grain + "--walls " + at("corner.stl") + "@m");
  EXPECT_NE(large.err.find("check its unit"), std::string::npos) << large.err;
}

TEST_F(Voids, ABoxThatIsNoMultipleIsExtendedUpwardAndSaidSo) {
  const Outcome outcome =
      call(sample("yade.txt") + to_out() + "--voxel 30um --box 0mm,1mm,0mm,0.5mm,0mm,0.4mm --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json s = Json::parse(outcome.out);
  EXPECT_EQ(s["shape"], Json::array({34, 17, 14}));
  EXPECT_TRUE(s["box_extended"].get<bool>());
  EXPECT_NEAR(s["box_m"][1].get<double>(), 1.02e-3, 1e-15);
}

TEST_F(Voids, NegativeCoordinatesAndOtherMethods) {
  const std::string box = "--voxel 20um --box -0.1mm,1mm,-0.1mm,0.5mm,-0.1mm,0.4mm --json ";
  const double truth = sphere_volume(sample("yade.txt"), 0);
  for (const char* method : {"exact", "subsample:4", "centre"}) {
    const Outcome outcome =
        call(sample("yade.txt") + " -o " + out() + method + " --no-figures --method " + method + " " + box);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json s = Json::parse(outcome.out);
    EXPECT_EQ(s["method"], method);
    EXPECT_NEAR(s["solid_volume_field_m3"].get<double>(), truth, 0.05 * truth);
  }
}

TEST_F(Voids, PeriodicBoxKeepsEveryGrainWhole) {
  // Half the box along x: grains across the faces come back in from the other side.
  const Outcome outcome = call(sample("yade.txt") + to_out() +
                               "--voxel 20um --box 0mm,0.5mm,0mm,0.5mm,-0.02mm,0.5mm --periodic xy --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const double truth = sphere_volume(sample("yade.txt"), 0);
  EXPECT_NEAR(Json::parse(outcome.out)["solid_volume_particles_m3"].get<double>(), truth, 1e-12 * truth);
}

TEST_F(Voids, UnitOfLengthAndColumnsByOtherNames) {
  std::ofstream(folder_ / "a.csv")
      << "px,py,pz,size\n100.000,100.000,100.000,20\n200.000,100.000,100.000,30\n";
  const Outcome outcome = call((folder_ / "a.csv").string() + to_out() +
                               "--voxel 10um --length-unit um --columns x=px,y=py,z=pz,radius=size --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const double truth = 4e-18 * std::acos(-1.0) / 3 * (20 * 20 * 20 + 30 * 30 * 30);
  EXPECT_NEAR(Json::parse(outcome.out)["solid_volume_field_m3"].get<double>(), truth, 1e-12 * truth);
}

TEST_F(Voids, PositionsWrittenTooCoarselyAreWarnedOf) {
  std::ofstream(folder_ / "a.csv") << "x,y,z,radius\n100,100,100,20\n200,100,100,30\n";
  const Outcome outcome =
      call((folder_ / "a.csv").string() + to_out() + "--voxel 10um --length-unit um --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("written to 1 um only"), std::string::npos) << outcome.err;
}

TEST_F(Voids, WallsOfATrajectoryAreNeitherPowderNorVoid) {
  io::ParticleFrame frame;
  frame.time = 0.25;
  frame.id = {1};
  frame.x = frame.y = {5e-5};
  frame.z = frame.radius = {2e-5};
  frame.walls = {{"floor", Plane{{0, 0, 0}, {0, 0, 1}}}};
  io::TrajectoryWriter::create(folder_ / "run.h5part").append(frame);
  const Outcome outcome = call((folder_ / "run.h5part").string() + to_out() +
                               "--voxel 10um --box 0um,100um,0um,100um,-50um,50um --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json s = Json::parse(outcome.out);
  EXPECT_EQ(s["kind"], "H5Part");
  EXPECT_EQ(s["time_s"], 0.25);
  EXPECT_NEAR(s["available_volume_m3"].get<double>(), 0.5e-12, 1e-24);
  const double volume = 4 * std::acos(-1.0) / 3 * std::pow(2e-5, 3);
  EXPECT_NEAR(s["solid_fraction_mean"].get<double>(), volume / 0.5e-12, 1e-12);
  EXPECT_TRUE(Vti(fs::path(out()) / "run/fields.vti").has("available_fraction"));
}

TEST_F(Voids, WrongUseIsRefusedBeforeAnythingIsWritten) {
  const std::string dump = sample("two-frames.dump") + " --voxel 20um ";
  expect_refused(sample("two-frames.dump"), "--voxel");
  expect_refused(sample("two-frames.dump") + " --voxel 20", "--voxel");
  expect_refused(sample("two-frames.dump") + " --voxel 0um", "not positive");
  expect_refused(dump + "--average 19um", "--average: 19um is less than a voxel; at least 20um");
  expect_refused(dump + "--box 0mm,1mm", "--box");
  expect_refused(dump + "--box 1mm,0mm,0mm,1mm,0mm,1mm", "--box");
  expect_refused(dump + "--slice q=1mm", "--slice");
  expect_refused(dump + "--slice x=1m", "--slice: x = 1 m is outside the box");
  expect_refused(dump + "--line y@x=9,z=1mm", "--line");
  expect_refused(dump + "--line y@x=9mm,z=0.1mm", "--line: x = 9 mm is outside the box");
  expect_refused(dump + "--layers 0um,70um,40", "--layers");
  expect_refused(dump + "--layers 70um,0um,4,4", "--layers");
  expect_refused(dump + "--method subsample:0", "--method");
  expect_refused(dump + "--method subsample", "--method");
  expect_refused(dump + "--method divided:1", "least void fraction");
  expect_refused(dump + "--method divided:x", "least void fraction");
  expect_refused(dump + "--method kernel", "kernel's length is missing");
  expect_refused(dump + "--method kernel:60", "kernel");
  expect_refused(dump + "--method kernel:-60um", "kernel");
  expect_refused(dump + "--method kernel:1m", "1000 voxels");
  expect_refused(dump + "--method cloud", "kernel:LENGTH");
  expect_refused(dump + "--overlap most", "union");
  expect_refused(dump + "--overlap union --method centre", "union needs the method exact");
  expect_refused(dump + "--walls tool.stl", "says no unit of length");
  expect_refused(dump + "--walls tool.stl@furlong", "furlong");
  expect_refused(dump + "--walls missing.stl@mm", "missing.stl: cannot be read");
  expect_refused(dump + "--solid cone:1mm", "no such solid");
  expect_refused(dump + "--solid ball:0mm,0mm,0mm", "3 values where 4 are due");
  expect_refused(dump + "--solid ball:0mm,0mm,0mm,-1mm", "radius is not positive");
  expect_refused(dump + "--solid ball:0mm,0mm,0mm,1", "--solid");
  expect_refused(dump + "--solid cylinder:0mm,0mm,0mm,0mm,0mm,0mm,1mm", "at the same place");
  expect_refused(dump + "--solid plane:0mm,0mm,0mm,0,0,0", "no direction");
  expect_refused(dump + "--average 60um --average-window ball", "box, sphere or gaussian");
  expect_refused(dump + "--average-window sphere", "nothing to average");
  expect_refused(dump + "--frame 2", "0 to 1");
  expect_refused(dump + "--frame first", "--frame");
  expect_refused(dump + "--periodic w", "--periodic");
  expect_refused(dump + "--periodic x --box 0mm,1.01mm,0mm,1mm,0mm,1mm", "does not divide the period");
  expect_refused(dump + "--columns radius", "--columns");
  expect_refused(dump + "--columns radius=none", "no such column");
  expect_refused(dump + "--density 7800", "--density");
  expect_refused(dump + "--length-unit parsec", "--length-unit");
  expect_refused(dump + "--length-unit m --voxel-size 3", "--voxel-size");
  expect_refused(dump + sample("no-such-file.dump"), "no-such-file.dump");
  expect_refused(sample("two-frames.dump") + " --voxel 1pm", "larger voxel");
  expect_refused(sample("two-frames.dump") + " --voxel 1nm", "this machine has");
}

TEST_F(Voids, AllErrorsAreReported) {
  const Outcome outcome = call(sample("yade.txt") + to_out() + "--voxel 20 --slice q=1mm --frame never");
  EXPECT_EQ(outcome.status, 2);
  for (const char* key : {"--voxel", "--slice", "--frame"})
    EXPECT_NE(outcome.err.find(key), std::string::npos) << key;
}

TEST_F(Voids, TwoInputsOfOneStemAreAnError) {
  fs::copy(sample("yade.txt"), folder_ / "yade.csv");
  expect_refused(sample("yade.txt") + " " + (folder_ / "yade.csv").string() + " --voxel 20um",
                 "same folder `yade`");
}

TEST_F(Voids, ACutDumpIsRefusedButItsWholeFramesCanBeRead) {
  const std::string text = slurp(sample("two-frames.dump"));
  std::ofstream(folder_ / "cut.dump") << text.substr(0, text.size() - 300);
  const std::string cut = (folder_ / "cut.dump").string() + " --voxel 20um ";
  expect_refused(cut, "frame 0 is whole");
  expect_refused(cut + "--frame all", "frame 0 is whole");
  EXPECT_EQ(call(cut + to_out() + "--frame 0").status, 0);
}

TEST_F(Voids, ResultsAreReplacedOnlyWhenAskedTo) {
  const std::string dump = sample("two-frames.dump") + to_out() + "--voxel 20um ";
  ASSERT_EQ(call(dump + "--slice x=0.5mm").status, 0);
  const Outcome refused = call(dump);
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("--overwrite"), std::string::npos);
  EXPECT_EQ(call(dump + "--overwrite").status, 0);
  EXPECT_FALSE(fs::exists(fs::path(out()) / "two-frames/slices"));
}

TEST_F(Voids, SameBitsForAnyNumberOfThreads) {
  const std::string dump = sample("two-frames.dump") + " --voxel 5um --average 60um --no-figures --threads ";
  ASSERT_EQ(call(dump + "1 -o " + out() + "1").status, 0);
  ASSERT_EQ(call(dump + "2 -o " + out() + "2").status, 0);
  EXPECT_EQ(slurp(out() + "1/two-frames/fields.vti"), slurp(out() + "2/two-frames/fields.vti"));
}

}  // namespace
}  // namespace interstice::testing
