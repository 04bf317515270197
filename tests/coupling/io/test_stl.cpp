// Surfaces from STL files: both layouts, the same numbers; damaged files in one line.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <vector>

#include "base/error.h"
#include "coupling/io/stl_reader.h"
#include "voxel/solids.h"

namespace interstice::io {
namespace {

using voxel::Triangle;

/// A box in the file's units, turned outwards.
std::vector<Triangle> box_triangles(const Box& box) {
  std::array<Vec3d, 8> corners;
  for (std::size_t c = 0; c < 8; ++c)
    corners[c] = {c & 1 ? box.hi.x : box.lo.x, c & 2 ? box.hi.y : box.lo.y, c & 4 ? box.hi.z : box.lo.z};
  constexpr std::array<std::array<std::size_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c, d] : kFaces) {
    triangles.push_back({corners[a], corners[b], corners[c]});
    triangles.push_back({corners[a], corners[c], corners[d]});
  }
  return triangles;
}

std::string ascii(const std::vector<Triangle>& triangles, const std::string& name = "blade") {
  std::string text = "solid " + name + "\n";
  for (const Triangle& t : triangles) {
    text += "  facet normal 0 0 0\n    outer loop\n";
    for (const Vec3d& p : t) {
      char line[120];
      std::snprintf(line, sizeof line, "      vertex %.9g %.9g %.9e\n", p.x, p.y, p.z);
      text += line;
    }
    text += "    endloop\n  endfacet\n";
  }
  return text + "endsolid " + name + "\n";
}

std::string word(std::uint32_t value) {
  std::string bytes;
  for (int b = 0; b < 4; ++b) bytes += static_cast<char>(value >> (8 * b) & 255);
  return bytes;
}

std::string binary(const std::vector<Triangle>& triangles, std::string header = "made by a test") {
  header.resize(80, '\0');
  std::string bytes = header + word(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    bytes += word(0) + word(0) + word(0);
    for (const Vec3d& p : t)
      for (int axis = 0; axis < 3; ++axis)
        bytes += word(std::bit_cast<std::uint32_t>(static_cast<float>(p[axis])));
    bytes += std::string(2, '\x1f');  // "attributes": colours
  }
  return bytes;
}

class Stl : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  voxel::TriangleMesh read(const std::string& content, double unit = 1e-3) const {
    std::ofstream(path_, std::ios::binary) << content;
    return read_stl(path_, unit);
  }
  std::string error_of(const std::string& content) const {
    try {
      read(content);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }
  void expect_refused(const std::string& content, const std::string& with) const {
    const std::string error = error_of(content);
    EXPECT_EQ(error.rfind(path_.string() + ": ", 0), 0u) << error;
    EXPECT_NE(error.find(with), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    EXPECT_LT(error.size(), 500u) << error;
  }

  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() / ("stl_" + std::to_string(::getpid()));
  const std::filesystem::path path_ = folder_ / "blade.stl";
  const Box box_{{1, -2, .5}, {3, 4.25, 2}};  // [mm] in single precision to the bit
  const std::vector<Triangle> good_ = box_triangles(box_);
};

TEST_F(Stl, BothLayoutsGiveTheSameSolid) {
  const voxel::TriangleMesh text = read(ascii(good_)), bytes = read(binary(good_));
  EXPECT_EQ(text.triangles, bytes.triangles);
  EXPECT_EQ(bytes.triangles.size(), 12u);
  EXPECT_NEAR(bytes.volume / (2 * 6.25 * 1.5 * 1e-9), 1, 1e-14);
  EXPECT_NEAR(bytes.bounds.lo.y, -2e-3, 1e-18);
  EXPECT_NEAR(read(binary(good_), 1e-6).volume / bytes.volume, 1e-9, 1e-20);
  // as a solid: the box itself
  const voxel::Solids mesh{.meshes = {{std::make_shared<voxel::TriangleMesh>(bytes), {0, 0, 0}}}};
  const voxel::Solids shape{.shapes = {Box{1e-3 * box_.lo, 1e-3 * box_.hi}}};
  for (int i = 0; i < 6; ++i) {
    const double x = .4e-3 * i;
    const Box cell{{x, .1e-3, .3e-3}, {x + .7e-3, .8e-3, .9e-3}};
    EXPECT_NEAR(solid_volume(mesh, cell) / cell.volume(), solid_volume(shape, cell) / cell.volume(), 1e-13);
  }
}

TEST_F(Stl, ABinaryFileMayBeginWithSolid) {
  EXPECT_EQ(read(binary(good_, "solid by a program that likes the word")).triangles.size(), 12u);
  EXPECT_EQ(read(binary(good_, "solid x\nfacet normal 0 0 1\n")).triangles.size(), 12u);
}

TEST_F(Stl, AsciiMayBeWrittenInManyWays) {
  std::string capitals = ascii(good_);
  for (char& c : capitals) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  EXPECT_EQ(read(capitals).triangles.size(), 12u);
  std::string returns = ascii(good_, "a name of several words endsolid facet");
  for (std::size_t at = 0; (at = returns.find('\n', at)) != std::string::npos; at += 2)
    returns.insert(at, "\r");
  EXPECT_EQ(read(returns).triangles.size(), 12u);
  std::string plus = ascii(good_);
  plus.replace(plus.find("vertex 1 "), 9, "vertex +1.0e+0 ");
  EXPECT_EQ(read(plus).triangles, read(ascii(good_)).triangles);
  // two bodies in one file
  EXPECT_EQ(read(ascii(good_) + ascii(box_triangles({{10, 0, 0}, {11, 1, 1}}))).triangles.size(), 24u);
  std::string normals = ascii(good_);
  normals.replace(normals.find("normal 0 0 0"), 12, "normal nan nan nan");
  EXPECT_EQ(read(normals).triangles.size(), 12u);
}

TEST_F(Stl, OneChangeMakesAFileBad) {
  const std::string bytes = binary(good_), text = ascii(good_);
  expect_refused("", "0 bytes are no STL");
  expect_refused("not an STL at all", "no STL");
  expect_refused(bytes.substr(0, bytes.size() - 1), "has 684; the file is cut off");
  expect_refused(bytes + "x", "cut off, damaged");
  std::string huge = bytes;
  huge.replace(80, 4, "\xff\xff\xff\xff");
  expect_refused(huge, "4294967295 triangles");
  std::string solid_huge = binary(good_, "solid");
  solid_huge.replace(80, 4, "\xff\xff\xff\x7f");
  expect_refused(solid_huge, "2147483647 triangles");
  std::string none = bytes.substr(0, 84);
  none.replace(80, 4, std::string(4, '\0'));
  expect_refused(none, "without triangles");
  std::string infinite = bytes;
  infinite.replace(84 + 50 + 12, 4, word(std::bit_cast<std::uint32_t>(INFINITY)));
  expect_refused(infinite, "triangle 2: a coordinate is not finite");
  expect_refused(binary({good_.begin(), good_.end() - 1}), "not closed: 3 edges");

  const auto with = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    return changed;
  };
  expect_refused(with("vertex 1 ", "vertex one "), "line 4: 'one' where a finite number is due");
  expect_refused(with("vertex 1 ", "vertex inf "), "where a finite number is due");
  expect_refused(with("vertex 1 ", "vertex 1e999 "), "where a finite number is due");
  expect_refused(with("endloop", "vertex 0 0 0 endloop"), "line 7: 'vertex' where 'endloop' is due");
  expect_refused(with("outer", "inner"), "'inner' where 'outer' is due");
  expect_refused(text.substr(0, text.size() / 2), "it is cut off");
  expect_refused(text.substr(0, text.rfind("endsolid")), "it is cut off");
  expect_refused(text + "more", "'more' where 'solid' or the end is due");
  expect_refused("solid nothing\nendsolid\n", "without triangles");

  EXPECT_THROW(read_stl(folder_, 1), InputError);
  EXPECT_THROW(read_stl(folder_ / "missing.stl", 1), InputError);
}

TEST_F(Stl, DamagedFilesAreReadOrRefused) {
  std::mt19937 random(5);
  int refused = 0;
  for (int n = 0; n < 1500; ++n) {
    std::string content = n % 2 ? ascii(good_) : binary(good_, n % 4 ? "solid" : "");
    for (int edit = 0; edit <= n % 3; ++edit) {
      const std::size_t at = random() % content.size();
      switch (random() % 4) {
        case 0:
          content[at] = static_cast<char>(random());
          break;
        case 1:
          content.erase(at, 1 + random() % 40);
          break;
        case 2:
          content.insert(at, content.substr(random() % content.size(), random() % 60));
          break;
        default:
          content.resize(at + 1);
      }
    }
    try {
      const voxel::TriangleMesh mesh = read(content);
      EXPECT_GE(mesh.triangles.size(), 4u);
      EXPECT_TRUE(std::isfinite(mesh.volume));
    } catch (const InputError& error) {
      ++refused;
      ASSERT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    }
  }
  EXPECT_GT(refused, 900);
}

}  // namespace
}  // namespace interstice::io
