// What the tests of the readers share: files written for one test, frames read from them.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "base/error.h"
#include "coupling/io/particle_reader.h"

namespace interstice::io::testing {

/// A folder of its own for each test, removed at its end.
class ReaderTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::temp_directory_path() / (std::string("interstice_") + test->test_suite_name() + "_" +
                                                  test->name() + "_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    const auto path = folder_ / name;
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }

  std::filesystem::path folder_;
};

inline std::filesystem::path sample(const std::string& name) {
  return std::filesystem::path(INTERSTICE_SOURCE_DIR) / "data/samples" / name;
}

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline std::vector<ParticleFrame> read_all(const std::filesystem::path& path,
                                           const ReaderOptions& options = {}) {
  std::vector<ParticleFrame> frames;
  const auto reader = open_particles(path, options);
  ParticleFrame frame;
  while (reader->next(frame)) frames.push_back(frame);
  return frames;
}

/// The message of the InputError that reading throws; "" when it throws none.
inline std::string error_of(const std::filesystem::path& path, const ReaderOptions& options = {}) {
  try {
    read_all(path, options);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// `text` with the first `from` replaced; fails the test when it is not there.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

}  // namespace interstice::io::testing
