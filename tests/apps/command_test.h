// What tests of the command share: a folder of their own, and calls whose exit status and output are kept.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace interstice::testing {

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// How a call of the command ended.
struct Outcome {
  int status = -1;
  std::string out, err;
};

class CommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    const std::string name = std::string("interstice_") + test->test_suite_name() + "_" + test->name();
    folder_ = std::filesystem::temp_directory_path() / (name + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  /// The line for the shell: "interstice ARGUMENTS", with its output in the folder.
  std::string shell_line(const std::string& arguments) const {
    return command_ + " " + arguments + " >'" + at("stdout") + "' 2>'" + at("stderr") + "'";
  }
  Outcome interstice(const std::string& arguments) const {
    const int status = std::system(shell_line(arguments).c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(at("stdout")), slurp(at("stderr"))};
  }

  std::string command_ = INTERSTICE_COMMAND;
  std::filesystem::path folder_;
};

}  // namespace interstice::testing
