// Starting another program: its folder, its errors, its end, and an end to waiting.
#include <gtest/gtest.h>

#include <csignal>

#include "base/error.h"
#include "coupling/figures/process.h"
#include "tests/coupling/figures/temporary_folder.h"

namespace {

using namespace interstice;
using namespace std::chrono_literals;

figures::ProcessResult shell(const std::string& command, const std::filesystem::path& folder,
                             std::chrono::milliseconds timeout = 20s) {
  return figures::run_process("/bin/sh", {"-c", command}, folder, timeout);
}

TEST(Process, RunsInItsFolderAndGivesItsErrorsAndStatus) {
  const fixtures::TemporaryFolder folder;
  const auto result = shell("echo made > here.txt; echo trouble >&2; echo unseen; exit 3", folder.path());
  EXPECT_EQ(result.status, 3);
  EXPECT_EQ(result.errors, "trouble\n");
  EXPECT_FALSE(result.timed_out);
  EXPECT_TRUE(std::filesystem::exists(folder / "here.txt"));
}

TEST(Process, EndsWhatTakesTooLong) {
  const fixtures::TemporaryFolder folder;
  const auto begin = std::chrono::steady_clock::now();
  const auto result = shell("exec sleep 60", folder.path(), 200ms);
  EXPECT_TRUE(result.timed_out);
  EXPECT_EQ(result.status, 128 + SIGKILL);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 10s);
}

TEST(Process, WaitsForWhatClosesItsErrorsEarly) {
  const fixtures::TemporaryFolder folder;
  EXPECT_EQ(shell("exec 2>&-; sleep 0.2; exit 5", folder.path()).status, 5);
}

TEST(Process, KeepsMuchErrorOutputWithoutStalling) {
  const fixtures::TemporaryFolder folder;
  const auto result = shell(
      "i=0; while [ $i -lt 4000 ]; do echo 0123456789012345678901234567890123456789 >&2; "
      "i=$((i+1)); done",
      folder.path());
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.errors.size(), 64U * 1024U);
}

TEST(Process, SaysWhatCannotBeStarted) {
  const fixtures::TemporaryFolder folder;
  EXPECT_THROW(figures::run_process(folder / "none", {}, folder.path(), 1s), RunError);
  EXPECT_THROW(figures::run_process("/bin/sh", {"-c", "true"}, folder / "none", 1s), RunError);
}

TEST(Process, FindsProgramsOnThePathOnly) {
  EXPECT_TRUE(figures::find_program("sh"));
  EXPECT_FALSE(figures::find_program("no-such-program-anywhere"));
  const fixtures::Environment empty("PATH", "");
  EXPECT_FALSE(figures::find_program("sh"));
}

}  // namespace
