// Placement lists: CSV files with units in their header.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <numbers>

#include "base/error.h"
#include "coupling/scene/read_scene.h"

namespace interstice::scene {
namespace {

/// A folder with a scene and its list, gone at the end of the test.
class GrainList : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("grain_list_test." + std::to_string(getpid()));
    std::filesystem::create_directory(folder_);
    write("scene.toml", R"(
domain = { box = [["-1 mm", "1 mm"], ["-1 mm", "1 mm"], ["-1 mm", "1 mm"]] }
materials = { a = { density = "1 g/cm^3", youngs_modulus = "1 GPa", poisson_ratio = 0 } }
contact = { pair = [{ materials = ["a", "a"], restitution = 1 }] }
phases = [{ name = "only", duration = "1 ms" }]
particles = [{ name = "p", material = "a", insert = { method = "list", file = "grains.csv" } }]
)");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::vector<PlacedGrain> read(const std::string& csv) const {
    write("grains.csv", csv);
    return read_scene((folder_ / "scene.toml").string()).particles.at(0).list.value().grains;
  }
  std::string error_of(const std::string& csv) const {
    try {
      read(csv);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  std::string csv_path() const { return (folder_ / "grains.csv").string(); }

  std::filesystem::path folder_;
};

TEST_F(GrainList, ColumnsInAnyOrderAndUnit) {
  const auto grains = read(
      "\xEF\xBB\xBF# made by hand\r\n diameter [um] , z[mm],y [um],x [um], wz [rpm], vx [mm/s]\r\n\r\n"
      "40, 0.5, -2, 1.5, 60, 100\r\n# between\r\n30,0,0,1e2,0,-1\r\n");
  ASSERT_EQ(grains.size(), 2u);
  EXPECT_EQ(grains[0].position, (Vec3d{1.5e-6, -2e-6, 0.5e-3}));
  EXPECT_EQ(grains[0].diameter, 40e-6);
  EXPECT_EQ(grains[0].velocity, (Vec3d{0.1, 0, 0}));
  EXPECT_DOUBLE_EQ(grains[0].spin.z, 2 * std::numbers::pi);
  EXPECT_EQ(grains[1].position.x, 100e-6);
}

TEST_F(GrainList, ErrorsNameFileLineAndColumn) {
  const std::string header = "x [um], y [um], z [um], diameter [um]\n";
  const std::tuple<std::string, std::string, std::string> rows[] = {
      {header + "1, 2, 3, 4\n1, 2, x, 4\n", ":3:7: ", "z = \"x\" is not a finite number"},
      {header + "1, 2, 3, -4\n", ":2:10: ", "diameter = -4 cannot be: grains are of finite size"},
      {header + "1, 2, 3, nan\n", ":2:10: ", "not a finite number"},
      {header + "1, 2, 3, 1e400\n", ":2:10: ", "not a finite number"},
      {header + "1, 2, 3\n", ":2:7: ", "the row has 3 values; 4 are due"},
      {header + "1, 2, 3, 4, 5\n", ":2:13: ", "the row has 5 values"},
      {header + "1, 2, 3, 4\n1, 2, 3, 5\n", ":3:1: ", "the very place of the one in line 2"},
      {"x [um], y [um], z, diameter [um]\n",
       ":1:17: ", "column z has no unit; a length in brackets is due; write z [um]"},
      {"x [um], y [um], z [s], diameter [um]\n", ":1:17: ", "column z: \"s\" is the unit of a time"},
      {"x [um], y [um], diameter [um]\n", ":1:1: ", "column z is missing"},
      {"x [um], y [um], z [um], diametre [um]\n", ":1:25: ",
       "column \"diametre\" is unknown; allowed: x, y, z, diameter, vx, vy, vz, wx, wy, wz; did you mean "
       "\"diameter\"?"},
      {"x [um], x [um], y [um], z [um], diameter [um]\n", ":1:9: ", "column x is there twice"},
      {"", ":1:1: ", "has no header"},
      {header + "5000, 2, 3, 4\n", "scene.toml",
       "1 of 1 grains start outside the domain, the first is number 1"},
  };
  for (const auto& [csv, place, fragment] : rows) {
    const std::string message = error_of(csv);
    EXPECT_NE(message.find(fragment), std::string::npos) << csv << "\n" << message;
    EXPECT_NE(message.find(place), std::string::npos) << message;
    if (place[0] == ':') {
      EXPECT_EQ(message.rfind(csv_path() + place, 0), 0u) << message;
    }
  }
}

TEST_F(GrainList, AWrongColumnDoesNotFloodTheScreen) {
  std::string csv = "x [um], y [um], z [um], diameter [um]\n";
  for (int i = 0; i < 1000; ++i) csv += "1, 2, 3, 0\n";
  try {
    read(csv);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.messages().size(), 21u);
    EXPECT_NE(error.messages().back().find("more errors"), std::string::npos);
  }
}

TEST_F(GrainList, OneGrainAtTheVeryPlaceOfAnotherIsFoundAmongThousands) {
  std::string csv = "x [um], y [um], z [um], diameter [um]\n";
  for (int i = 0; i < 20; ++i) {  // a lattice, so that places share coordinates and bits of them
    for (int j = 0; j < 20; ++j) {
      for (int k = 0; k < 20; ++k) {
        csv += std::to_string(i - 10) + "," + std::to_string(2 * j) + "," + std::to_string(64 * k - 640) +
               ",1\n";
      }
    }
  }
  const auto grains = read(csv);
  ASSERT_EQ(grains.size(), 8000u);
  EXPECT_EQ(grains.back().position, (Vec3d{9e-6, 38e-6, 576e-6}));
  // Line 2 + (10 * 20 + 0) * 20 + 10, at the origin; minus nought is nought, and the last line may lack its
  // end.
  EXPECT_NE(error_of(csv + "-0, 0.0, -0e0, 3")
                .find(":8002:1: the grain has the very place of the one in line 4012"),
            std::string::npos)
      << error_of(csv + "-0, 0.0, -0e0, 3");
}

TEST_F(GrainList, NumbersAreRoundedOnceWhateverTheUnit) {
  // What a compiler makes of the same decimals; +7.0e-05 and 0.00007 are one number.
  const auto grains = read(
      "x [m],y [um],z [mm],diameter [m]\n6.531589171488031e-05,65.31589171488031,"
      "0.06531589171488031,+7.0e-05\n1e-7,0.1,1E-4,0.00007\n");
  ASSERT_EQ(grains.size(), 2u);
  EXPECT_EQ(grains[0].position, (Vec3d{6.531589171488031e-05, 6.531589171488031e-05, 6.531589171488031e-05}));
  EXPECT_EQ(grains[1].position, (Vec3d{1e-7, 1e-7, 1e-7}));
  EXPECT_EQ(grains[0].diameter, 7e-5);
  EXPECT_EQ(grains[1].diameter, 7e-5);
}

TEST_F(GrainList, AMissingFileIsNamedAtItsKey) {
  std::filesystem::remove(folder_ / "grains.csv");
  try {
    read_scene((folder_ / "scene.toml").string());
    FAIL();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("scene.toml:6:"), std::string::npos) << message;
    EXPECT_NE(message.find("particles.p.insert.file: " + csv_path() + ": cannot be read"), std::string::npos)
        << message;
  }
}

}  // namespace
}  // namespace interstice::scene
