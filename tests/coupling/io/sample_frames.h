// Frames and folders for the tests of the files that survive.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "base/random.h"
#include "coupling/io/particle_frame.h"

namespace interstice::io::testing {

/// An empty folder, removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "interstice-test-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void put_bytes(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// Frame `number` of a run of `particles` grains: every column filled, a pure function of its arguments.
inline ParticleFrame sample_frame(std::int64_t number, std::size_t particles) {
  Random random(7, static_cast<std::uint64_t>(number));
  ParticleFrame f;
  f.time = 0.01 * static_cast<double>(number);
  f.step = 1000 * number;
  for (std::size_t i = 0; i < particles; ++i) {
    f.id.push_back(static_cast<std::int64_t>(i) + (std::int64_t{1} << 40));
    f.radius.push_back(random.uniform(5e-6, 65e-6));
    f.density.push_back(8200);
    f.material.push_back(static_cast<std::int32_t>(i % 3));
    f.layer.push_back(static_cast<std::int32_t>(number));
    f.bonded.push_back(i % 7 == 0 ? 1 : 0);
  }
  for (auto* column : {&f.x, &f.y, &f.z, &f.vx, &f.vy, &f.vz, &f.wx, &f.wy, &f.wz})
    for (std::size_t i = 0; i < particles; ++i) column->push_back(random.uniform(-1e-3, 1e-3));
  f.bounds = Box{{-0.5e-3, -0.9e-3, 0}, {18e-3, 0.9e-3, 2.2e-3}};
  f.periodic = {false, true, false};
  f.walls = {{"substrate", Plane{{0, 0, 0}, {0, 0, 1}}},
             {"blade", Box{{1e-3 * f.time, -7e-4, 7e-5}, {1e-3 * f.time + 2e-4, 7e-4, 2e-3}}}};
  return f;
}

template <class Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

inline bool same_walls(const std::vector<WallPose>& a, const std::vector<WallPose>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const WallPose& p, const WallPose& q) {
    return p.name == q.name && p.shape == q.shape;
  });
}

/// Equal to the last bit, NaNs included.
inline bool same_frame(const ParticleFrame& a, const ParticleFrame& b) {
  bool same =
      std::bit_cast<std::uint64_t>(a.time) == std::bit_cast<std::uint64_t>(b.time) && a.step == b.step;
  for (const auto column : {&ParticleFrame::x, &ParticleFrame::y, &ParticleFrame::z, &ParticleFrame::radius,
                            &ParticleFrame::vx, &ParticleFrame::vy, &ParticleFrame::vz, &ParticleFrame::wx,
                            &ParticleFrame::wy, &ParticleFrame::wz, &ParticleFrame::density})
    same = same && same_bits(a.*column, b.*column);
  for (const auto column : {&ParticleFrame::material, &ParticleFrame::layer, &ParticleFrame::bonded})
    same = same && same_bits(a.*column, b.*column);
  return same && same_bits(a.id, b.id) && a.bounds == b.bounds && a.periodic == b.periodic &&
         same_walls(a.walls, b.walls);
}

}  // namespace interstice::io::testing
