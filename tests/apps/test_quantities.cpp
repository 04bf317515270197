// Quantities beside void fraction from the outside: `voids`, `batch` and `run` with --quantities and
// --classes.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/apps/command_test.h"

namespace interstice::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

constexpr double kPi = 3.14159265358979323846;

class Quantities : public CommandTest {
 protected:
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }

  Json summary(const std::string& arguments) const {
    const Outcome outcome =
        interstice("voids " + arguments + " -o " + at("out") + " --no-figures --overwrite --json");
    EXPECT_EQ(outcome.status, 0) << arguments << "\n" << outcome.err;
    return outcome.status == 0 ? Json::parse(outcome.out) : Json();
  }

  void expect_refused(const std::string& arguments, const std::string& what) const {
    const Outcome outcome = interstice("voids " + arguments + " -o " + at("none") + " --no-figures");
    EXPECT_EQ(outcome.status, 2) << arguments << "\n" << outcome.err;
    EXPECT_NE(outcome.err.find(what), std::string::npos) << arguments << "\n" << outcome.err;
    EXPECT_FALSE(fs::exists(at("none"))) << arguments;
  }
};

/// 4 x 4 x 4 touching grains of 10 um in a simple cubic lattice, with every column.
std::string lattice() {
  std::ostringstream text;
  text << "id,x [um],y [um],z [um],diameter [um],vx [m/s],vy [m/s],vz [m/s],material,layer,bonded,"
          "stress_xx [kPa],stress_yy [kPa],stress_zz [kPa],stress_xy [kPa],stress_yz [kPa],stress_xz [kPa]\n";
  for (int i = 0; i < 64; ++i)
    text << i << ',' << i % 4 * 10 + 5 << ',' << i / 4 % 4 * 10 + 5 << ',' << i / 16 * 10 + 5 << ",10,"
         << (i % 2 ? 1.5 : 0.5) << ",2,-3," << 1 + i % 2 << ',' << i / 16 << ',' << (i < 16)
         << ",-1,-2,-6,0.5,0,0\n";
  return text.str();
}

TEST_F(Quantities, OfALatticeAreTheKnownOnes) {
  write("sc.csv", lattice());
  const std::string box = " --voxel 10um --box 0um,40um,0um,40um,0um,40um ";
  const Json s =
      summary(at("sc.csv") + box +
              "--quantities velocity,temperature,diameter,coordination,stress,bonded --classes layer");
  const double phi = kPi / 6;
  EXPECT_NEAR(s["velocity_x_mean_m_s"].get<double>(), 1, 1e-12);
  EXPECT_NEAR(s["velocity_z_mean_m_s"].get<double>(), -3, 1e-12);
  EXPECT_EQ(s["temperature_mean_m2_s2"].get<double>(), 0);  // a grain a voxel
  EXPECT_NEAR(s["mean_diameter_mean_m"].get<double>(), 10e-6, 1e-17);
  EXPECT_NEAR(s["coordination_mean"].get<double>(), 4.5, 1e-12);  // along each axis 2 of 4 have one neighbour
  EXPECT_NEAR(s["pressure_mean_Pa"].get<double>(), 3000 * phi, 1e-9);
  EXPECT_NEAR(s["stress_xy_mean_Pa"].get<double>(), 500 * phi, 1e-9);
  EXPECT_NEAR(s["bonded_fraction_mean"].get<double>(), 0.25, 1e-12);
  EXPECT_NEAR(s["solid_fraction_layer_2_mean"].get<double>(), phi / 4, 1e-12);
  // one voxel for all: half of the grains at 0.5 m/s, half at 1.5
  const Json one =
      summary(at("sc.csv") + " --voxel 40um --box 0um,40um,0um,40um,0um,40um --quantities temperature");
  EXPECT_NEAR(one["temperature_mean_m2_s2"].get<double>(), 0.25 / 3, 1e-12);
  const Json repeated = summary(at("sc.csv") + box + "--periodic xyz --quantities coordination");
  EXPECT_NEAR(repeated["coordination_mean"].get<double>(), 6, 1e-12);
}

// A grain alone on a floor, beside a ball, and in the corner that a wall makes with the floor.
TEST_F(Quantities, CountContactsWithEverySolid) {
  write("one.csv", "x [um],y [um],z [um],diameter [um]\n20,20,10,20\n");
  const auto coordination = [&](const std::string& solids) {
    return summary(at("one.csv") + " --voxel 10um --box 0um,40um,0um,40um,-10um,30um " + solids +
                   " --quantities coordination")["coordination_mean"]
        .get<double>();
  };
  const std::string floor = " --solid plane:0um,0um,0um,0,0,1";
  EXPECT_EQ(coordination(""), 0);
  EXPECT_EQ(coordination(floor), 1);
  EXPECT_EQ(coordination(floor + " --solid ball:50um,20um,10um,20um"), 2);
  EXPECT_EQ(coordination(floor + " --solid ball:51um,20um,10um,20um"), 1);
  EXPECT_EQ(coordination(floor + " --solid box:0um,10um,0um,40um,0um,40um"), 2);
  EXPECT_EQ(coordination(" --solid cylinder:20um,0um,30um,20um,40um,30um,10um"), 1);
  write(
      "under.stl",
      "solid under\n"
      "facet normal 0 0 -1\nouter loop\nvertex -90 -90 -9\nvertex 20 90 -9\nvertex 90 -90 "
      "-9\nendloop\nendfacet\n"
      "facet normal 0 -1 0\nouter loop\nvertex -90 -90 -9\nvertex 90 -90 -9\nvertex 20 20 "
      "0\nendloop\nendfacet\n"
      "facet normal 1 1 0\nouter loop\nvertex 90 -90 -9\nvertex 20 90 -9\nvertex 20 20 0\nendloop\nendfacet\n"
      "facet normal -1 1 0\nouter loop\nvertex 20 90 -9\nvertex -90 -90 -9\nvertex 20 20 "
      "0\nendloop\nendfacet\n"
      "endsolid under\n");  // a pyramid whose tip is under the grain
  EXPECT_EQ(coordination("--walls " + at("under.stl") + "@um"), 1);
}

TEST_F(Quantities, OfSizeClassesAddUpToTheSolid) {
  write("three.csv",
        "x,y,z,radius,material\n1e-4,1e-4,1e-4,1e-5,3\n2e-4,1e-4,1e-4,2e-5,3\n3e-4,1e-4,1e-4,3e-5,7\n");
  const Json sizes = summary(at("three.csv") + " --voxel 10um --classes size:30um,40um");
  const auto share = [&](const Json& s, const std::string& name) {
    return s["solid_fraction_" + name + "_mean"].get<double>() / s["solid_fraction_mean"].get<double>();
  };
  EXPECT_NEAR(share(sizes, "size_below_30um"), 1.0 / 36, 1e-12);
  EXPECT_NEAR(share(sizes, "size_30um_to_40um"), 0, 1e-12);  // an edge belongs to the class above it
  EXPECT_NEAR(share(sizes, "size_from_40um"), 35.0 / 36, 1e-12);
  const Json materials = summary(at("three.csv") + " --voxel 10um --classes material");
  EXPECT_NEAR(share(materials, "material_3"), 9.0 / 36, 1e-12);
  EXPECT_NEAR(share(materials, "material_7"), 27.0 / 36, 1e-12);
}

TEST_F(Quantities, StandInTheTablesOfSlicesAndLines) {
  write("sc.csv", lattice());
  summary(at("sc.csv") + " --voxel 10um --box 0um,40um,0um,40um,0um,60um --average 30um --slice y=5um " +
          "--line z@x=5um,y=5um --quantities velocity,coordination");
  std::ifstream in(folder_ / "out/sc/lines/z@x=5e-06,y=5e-06.csv");
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(
      line,
      "x_m,y_m,z_m,void_fraction,solid_fraction,mass_density_kg_m3,void_fraction_averaged,coordination,"
      "coordination_averaged,velocity_x_m_s,velocity_x_averaged_m_s,velocity_y_m_s,velocity_y_averaged_m_s,"
      "velocity_z_m_s,velocity_z_averaged_m_s");
  std::vector<std::string> rows;
  while (std::getline(in, line)) rows.push_back(line);
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_NE(rows[0].find(",3,"), std::string::npos) << rows[0];        // a corner of the lattice
  EXPECT_NE(rows[5].find(",nan,nan,"), std::string::npos) << rows[5];  // no solid within 30 um / 2
}

TEST_F(Quantities, WhoseColumnsAreMissingAreRefused) {
  write("bare.csv", "x,y,z,radius\n1e-4,1e-4,1e-4,1e-5\n");
  const std::string bare = at("bare.csv") + " --voxel 10um ";
  expect_refused(bare + "--quantities velocity", "velocity needs the columns vx, vy and vz");
  expect_refused(bare + "--quantities diameter,temperature", "temperature needs the columns vx, vy and vz");
  expect_refused(bare + "--quantities stress", "stress needs the columns stress_xx");
  expect_refused(bare + "--quantities bonded", "bonded needs the column bonded");
  expect_refused(bare + "--classes layer", "no column layer");
  expect_refused(bare + "--classes material", "no column material");
  expect_refused(bare + "--quantities speed", "speed is no quantity; velocity, temperature");
  expect_refused(bare + "--classes size:40um,20um", "do not rise");
  expect_refused(bare + "--classes size:40", "um");
  expect_refused(bare + "--classes colour", "size:DIAMETER");
  expect_refused(bare + "--quantities coordination --periodic x --box 80um,120um,80um,120um,80um,120um",
                 "less than two of the largest grains");
  EXPECT_EQ(summary(bare + "--quantities coordination")["coordination_mean"], 0);
}

TEST_F(Quantities, ColumnsByOtherNames) {
  std::string text =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1e-4\n0 1e-4\n0 1e-4\n";
  text += "ITEM: ATOMS id type x y z radius c_con c_b\n1 2 5e-5 5e-5 5e-5 2e-5 5 1\n";
  write("one.dump", text);
  const Json s =
      summary(at("one.dump") +
              " --voxel 10um --quantities coordination,bonded --columns coordination=c_con,bonded=c_b");
  EXPECT_NEAR(s["coordination_mean"].get<double>(), 5, 1e-12);
  EXPECT_NEAR(s["bonded_fraction_mean"].get<double>(), 1, 1e-12);
}

TEST_F(Quantities, AreInTheTableOfABatch) {
  write("sc.csv", lattice());
  const Outcome outcome = interstice("batch " + at("sc.csv") + " -o " + at("out") +
                                     " --voxel 10um --quantities velocity,stress --no-figures");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string table = slurp(folder_ / "out/table.csv");
  EXPECT_NE(table.find("velocity_y_mean_m_s"), std::string::npos);
  EXPECT_NE(table.find("pressure_mean_Pa"), std::string::npos);
}

TEST_F(Quantities, OfARunComeFromItsContacts) {
  const std::string scene = INTERSTICE_SOURCE_DIR "/data/scenes/pour.toml";
  const Outcome outcome =
      interstice("run " + scene + " -o " + at("run") +
                 " --set particles.powder.count=240 --set 'phases.pour.until.at_most=\"40 ms\"' --set "
                 "'output.trajectory=\"1 ms\"' --set 'domain.box.2.1=\"0.6 mm\"' "
                 "--set 'particles.powder.insert.box.2=[\"0.05 mm\",\"0.5 mm\"]' "
                 "--set 'fields.bed.quantities=[\"velocity\",\"coordination\",\"stress\"]' --set "
                 "'fields.bed.classes=\"material\"' --no-figures --quiet");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  fs::path last;
  for (const auto& entry : fs::directory_iterator(at("run") + "/fields"))
    if (entry.is_directory() && (last.empty() || entry.path() > last)) last = entry.path();
  const Json a = Json::parse(slurp(last / "summary.json"));
  const Json b = summary(at("run") +
                         "/trajectory.h5part --voxel 20um --box 0mm,0.5mm,0mm,0.5mm,0mm,0.3mm --quantities "
                         "velocity,coordination --classes material");
  EXPECT_EQ(a.at("velocity_z_mean_m_s"), b.at("velocity_z_mean_m_s"));
  // by places alone at most a pair or two whose gap is all but nothing count otherwise
  EXPECT_GT(a.at("coordination_mean").get<double>(),
            2);  // more grains than the floor has room for: they stack
  EXPECT_NEAR(a.at("coordination_mean").get<double>(), b.at("coordination_mean").get<double>(), 0.05);
  EXPECT_GT(a.at("pressure_mean_Pa").get<double>(), 0);  // a bed that rests on its floor
  int classes = 0;
  for (const auto& [key, value] : a.items()) classes += key.rfind("solid_fraction_material_", 0) == 0;
  EXPECT_EQ(classes, 1);
}

TEST_F(Quantities, OfARunAreReadWithItsScene) {
  const std::string scene = INTERSTICE_SOURCE_DIR "/data/scenes/pour.toml";
  const auto message = [&](const std::string& set) {
    const Outcome outcome = interstice("check " + scene + " --set '" + set + "'");
    EXPECT_EQ(outcome.status, 2) << set;
    return outcome.err;
  };
  EXPECT_NE(
      message("fields.bed.quantities=[\"speed\"]").find("fields.bed.quantities.0: speed is no quantity"),
      std::string::npos);
  EXPECT_NE(message("fields.bed.method=\"cloud\"").find("fields.bed.method: cloud is no method"),
            std::string::npos);
  EXPECT_NE(message("fields.bed.classes=\"size:1um,1um\"").find("do not rise"), std::string::npos);
  EXPECT_NE(message("fields.bed.overlap=\"most\"").find("fields.bed.overlap"), std::string::npos);
}

}  // namespace
}  // namespace interstice::testing
