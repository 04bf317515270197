#include "coupling/io/atomic_file.h"

#include <signal.h>
#include <sys/resource.h>

#include <fstream>

#include "base/error.h"
#include "coupling/io/posix_file.h"
#include "tests/coupling/io/interrupted.h"
#include "tests/coupling/io/sample_frames.h"

namespace interstice::io {
namespace {

namespace fs = std::filesystem;
using namespace testing;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string failure_of(const std::function<void()>& write) {
  try {
    write();
  } catch (const RunError& error) {
    return error.what();
  }
  return "no failure";
}

TEST(AtomicFile, ReplacesTheWholeFile) {
  const TemporaryFolder folder;
  write_text_atomically(folder / "a.txt", "first");
  EXPECT_EQ(bytes_of(folder / "a.txt"), "first");
  write_text_atomically(folder / "a.txt", std::string(100000, 'x'));
  EXPECT_EQ(bytes_of(folder / "a.txt"), std::string(100000, 'x'));
  write_text_atomically(folder / "a.txt", "");
  EXPECT_EQ(bytes_of(folder / "a.txt"), "");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(AtomicFile, TemporaryIsHiddenBesideTheTargetWithItsExtension) {
  const TemporaryFolder folder;
  write_atomically(folder / "a.vdb", [&](const fs::path& temporary) {
    EXPECT_EQ(temporary.parent_path(), folder.path());
    EXPECT_EQ(temporary.filename().string().front(), '.');
    EXPECT_EQ(temporary.extension(), ".vdb");
    put_bytes(temporary, "x");
    EXPECT_FALSE(fs::exists(folder / "a.vdb"));
  });
  EXPECT_TRUE(fs::exists(folder / "a.vdb"));
}

TEST(AtomicFile, LongNamesWork) {
  const TemporaryFolder folder;
  const std::string name = std::string(240, 'n') + ".csv";
  write_text_atomically(folder / name, "x");
  EXPECT_EQ(bytes_of(folder / name), "x");
}

TEST(AtomicFile, AFailureLeavesTheOldContentAndNoTemporary) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.txt";
  write_text_atomically(path, "old");
  const auto fails_with = [&](auto&& exception) {
    return failure_of([&] {
      write_atomically(path, [&](const fs::path& temporary) {
        put_bytes(temporary, "half");
        throw exception;
      });
    });
  };
  const std::string prefix = "cannot write " + path.string() + ": ";
  EXPECT_EQ(fails_with(RunError("the disk is full")), prefix + "the disk is full");
  EXPECT_EQ(fails_with(RunError(prefix + "said before")), prefix + "said before");
  EXPECT_EQ(fails_with(std::runtime_error("odd")), prefix + "odd");
  EXPECT_TRUE(fails_with(std::system_error(ENOSPC, std::generic_category()))
                  .starts_with(prefix + "the disk is full"));
  EXPECT_EQ(failure_of([&] { write_atomically(path, [](const fs::path&) {}); }),
            prefix + "No such file or directory");
  EXPECT_THROW(write_atomically(path, [](const fs::path&) { throw InputError("yours"); }), InputError);
  EXPECT_EQ(failure_of([&] {
              write_atomically(
                  path, [&](const fs::path& t) { throw RunError("cannot write " + t.string() + ": why"); });
            }),
            prefix + "why");
  EXPECT_EQ(bytes_of(path), "old");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(AtomicFile, NamesAMissingFolderAndAFolderInTheWay) {
  const TemporaryFolder folder;
  EXPECT_NE(failure_of([&] { write_text_atomically(folder / "no/a.txt", "x"); }).find("there is no folder"),
            std::string::npos);
  EXPECT_NE(failure_of([&] { write_text_atomically(folder.path(), "x"); }).find("a folder has this name"),
            std::string::npos);
}

TEST(AtomicFile, IsOldOrNewWhereverTheWriterIsKilled) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.txt";
  const std::string old_text(50000, 'o'), new_text(70000, 'n');
  for (const Stop how : {Stop::before, Stop::halfway}) {
    bool killed = true;
    for (int n = 0; killed; ++n) {
      put_bytes(path, old_text);
      const int status = in_child([&] {
        stop_after(n, how);
        write_text_atomically(path, new_text);
      });
      killed = WEXITSTATUS(status) == kKilled;
      const std::string text = bytes_of(path);
      EXPECT_TRUE(text == old_text || text == new_text) << "mixed after a kill at change " << n;
      EXPECT_TRUE(killed || text == new_text);
    }
  }
  EXPECT_EQ(files_in(folder.path()), 1u) << "the last writer removes what the killed ones left";
}

TEST(AtomicFile, FullDiskIsReportedWhereverItStrikes) {
  const TemporaryFolder folder;
  const fs::path path = folder / "a.txt";
  put_bytes(path, "old");
  for (int n = 0;; ++n) {
    ASSERT_LT(n, 100);
    stop_after(n, Stop::disk_full);
    const std::string failure = failure_of([&] { write_text_atomically(path, "new"); });
    stop_never();
    EXPECT_EQ(files_in(folder.path()), 1u);
    if (failure == "no failure") break;
    EXPECT_TRUE(failure.starts_with("cannot write " + path.string() + ": the disk is full")) << failure;
  }
  EXPECT_EQ(bytes_of(path), "new");
}

TEST(AtomicFile, RealWriteFailureIsReported) {
  const TemporaryFolder folder;
  put_bytes(folder / "a.txt", "old");
  const int status = in_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = 1000;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const std::string failure =
        failure_of([&] { write_text_atomically(folder / "a.txt", std::string(5000, 'n')); });
    ::_exit(failure.find("File too large") != std::string::npos ? 0 : 1);
  });
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(bytes_of(folder / "a.txt"), "old");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

}  // namespace
}  // namespace interstice::io
