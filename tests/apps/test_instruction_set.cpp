// Programs for other instruction sets beside the command: which of them a call reaches, and with which words.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/version.h"
#include "tests/apps/command_test.h"

namespace interstice::testing {
namespace {

namespace fs = std::filesystem;

/// The command in a folder of its own, beside a stand-in for another instruction set that prints its words.
class InstructionSet : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    fs::copy_file(command_, at("interstice"));
    command_ = at("interstice");
  }
  void put_program(const std::string& place, const std::string& level) const {
    fs::create_directories(at(place));
    const std::string path = at(place + "/interstice-" + level);
    std::ofstream(path) << "#!/bin/sh\necho \"" << level << ":\" \"$@\"\n";
    fs::permissions(path, fs::perms::owner_all);
  }
};

TEST_F(InstructionSet, TheOneThatIsAskedForGetsTheCall) {
  put_program(".", "x86-64-v2");
  const Outcome ran = interstice("voids 'a b.csv' -o out --voxel 5um --isa x86-64-v2");
  EXPECT_EQ(ran.status, 0) << ran.err;
  EXPECT_EQ(ran.out, "x86-64-v2: voids a b.csv -o out --voxel 5um --isa x86-64-v2\n");
}

TEST_F(InstructionSet, ItMayBeInstalledApart) {
  fs::create_directories(at("bin"));
  fs::rename(at("interstice"), at("bin/interstice"));
  fs::create_symlink("bin/interstice", at("interstice"));
  put_program("libexec/interstice", "x86-64");
  EXPECT_EQ(interstice("bench --isa=x86-64").out, "x86-64: bench --isa=x86-64\n");
}

TEST_F(InstructionSet, OneThatIsNotHereIsRefusedInOneLine) {
  put_program(".", "x86-64-v2");
  const Outcome ran = interstice("bench --isa x86-64-v9");
  EXPECT_EQ(ran.status, 2);
  EXPECT_EQ(ran.out, "");
  EXPECT_NE(ran.err.find("error: --isa: no program for 'x86-64-v9' is here; allowed: auto, "),
            std::string::npos)
      << ran.err;
  EXPECT_NE(ran.err.find("x86-64-v2"), std::string::npos) << ran.err;
  EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
}

/// A program that was made for one machine is the best there, whatever lies beside it.
TEST_F(InstructionSet, AProgramForThisMachineStays) {
  if (std::string(kBuildArch) != "native") GTEST_SKIP() << "built for " << kBuildArch;
  for (const char* level : {"x86-64-v2", "x86-64-v3", "x86-64-v4"}) put_program(".", level);
  for (const char* own : {"auto", "native"}) {
    const Outcome ran = interstice("voids nothing.csv -o out --voxel 5um --isa " + std::string(own));
    EXPECT_EQ(ran.status, 2);
    EXPECT_EQ(ran.out, "");
  }
}

/// One that took over does not look for another: two that are named wrongly do not call each other forever.
TEST_F(InstructionSet, WhatTookOverDoesNotHandOn) {
  put_program(".", "x86-64-v2");
  ASSERT_EQ(::setenv("INTERSTICE_TAKEN_OVER", "1", 1), 0);
  const Outcome ran = interstice("bench --isa x86-64-v2");
  ::unsetenv("INTERSTICE_TAKEN_OVER");
  EXPECT_EQ(ran.status, std::string(kBuildArch) == "x86-64-v2" ? 0 : 2);
  EXPECT_EQ(ran.out.find("x86-64-v2:"), std::string::npos);
}

}  // namespace
}  // namespace interstice::testing
