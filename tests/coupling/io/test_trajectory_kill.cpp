// A trajectory whose writer is stopped: killed at every single change of the disk, killed at random, out of
// disk.
#include <fcntl.h>
#include <hdf5.h>
#include <poll.h>
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <iostream>
#include <limits>

#include "base/error.h"
#include "coupling/io/trajectory.h"
#include "tests/coupling/io/interrupted.h"
#include "tests/coupling/io/sample_frames.h"

namespace interstice::io {
namespace {

namespace fs = std::filesystem;
using namespace testing;

constexpr double kKeepAll = std::numeric_limits<double>::infinity();
constexpr std::size_t kGrains = 100;

/// How many frames the reader gives; each must be the one that was written.
std::int64_t whole_frames(const fs::path& path) {
  const TrajectoryReader reader(path);
  for (std::int64_t k = 0; k < reader.frames(); ++k)
    EXPECT_TRUE(same_frame(reader.read(k), sample_frame(k, kGrains))) << "frame " << k;
  return reader.frames();
}

/// Whether the HDF5 library alone, without any recovery, opens the file and its first frames.
bool plainly_readable(const fs::path& path, std::int64_t frames) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return false;
  bool readable = true;
  for (std::int64_t k = 0; k < frames && readable; ++k) {
    const hid_t x = H5Dopen2(file, ("Step#" + std::to_string(k) + "/x").c_str(), H5P_DEFAULT);
    std::vector<double> values(kGrains);
    readable = x >= 0 && H5Dread(x, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) >= 0 &&
               values == sample_frame(k, kGrains).x;
    if (x >= 0) H5Dclose(x);
  }
  H5Fclose(file);
  return readable;
}

/// A trajectory of `frames` frames, and the means to have it back after each experiment.
class Experiment {
 public:
  explicit Experiment(std::int64_t frames) : path_(folder_ / "trajectory.h5part") {
    TrajectoryWriter writer = TrajectoryWriter::create(path_);
    for (std::int64_t k = 0; k < frames; ++k) writer.append(sample_frame(k, kGrains));
    bytes_ = bytes_of(path_);
  }
  const fs::path& restored() const {
    for (const auto& entry : fs::directory_iterator(folder_.path())) fs::remove(entry.path());
    put_bytes(path_, bytes_);
    return path_;
  }
  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
  fs::path path_;
  std::string bytes_;
};

using Change = void (*)(const fs::path&);

/// Stops `change` at each of its changes of the disk in turn. Before it the trajectory has `before` frames,
/// after it `after`; whatever happens it has the one or the other, and goes on.
void stop_everywhere(Change change, std::int64_t before, std::int64_t after, Stop how) {
  const Experiment experiment(before);
  int points = 0, unreadable = 0;
  for (bool stopped = true; stopped; ++points) {
    ASSERT_LT(points, 2000);
    const fs::path path = experiment.restored();
    const int status = in_child([&] {
      stop_after(points, how);
      change(path);
    });
    ASSERT_TRUE(WIFEXITED(status)) << "signal " << WTERMSIG(status);
    stopped = WEXITSTATUS(status) == kKilled;
    ASSERT_TRUE(stopped || WEXITSTATUS(status) == 0) << WEXITSTATUS(status);
    if (!plainly_readable(path, std::min(before, after))) ++unreadable;
    const std::int64_t frames = whole_frames(path);
    EXPECT_TRUE(frames == before || frames == after) << frames << " frames after a stop at change " << points;
    EXPECT_TRUE(stopped || frames == after);
    TrajectoryWriter writer = TrajectoryWriter::resume(path, kKeepAll);
    ASSERT_EQ(writer.frames(), frames);
    writer.append(sample_frame(frames, kGrains));
    EXPECT_EQ(whole_frames(path), frames + 1);
    EXPECT_FALSE(fs::exists(path.string() + ".journal"));
  }
  std::cout << points << " points, at " << unreadable
            << " of them the plain library reads the file only once recovered\n";
}

void append_one(const fs::path& path) {
  TrajectoryWriter writer = TrajectoryWriter::resume(path, kKeepAll);
  writer.append(sample_frame(writer.frames(), kGrains));
}
void drop_two(const fs::path& path) { TrajectoryWriter::resume(path, 0.025); }
void start_anew(const fs::path& path) { TrajectoryWriter::create(path); }

TEST(TrajectoryKill, AppendKilledBeforeAnyChangeOfTheDisk) {
  stop_everywhere(append_one, 3, 4, Stop::before);
}
TEST(TrajectoryKill, AppendKilledHalfwayThroughAnyWrite) { stop_everywhere(append_one, 3, 4, Stop::halfway); }
TEST(TrajectoryKill, FirstAppendKilled) { stop_everywhere(append_one, 0, 1, Stop::halfway); }
TEST(TrajectoryKill, AppendToManyFramesKilled) { stop_everywhere(append_one, 40, 41, Stop::halfway); }
TEST(TrajectoryKill, DroppingFramesKilled) { stop_everywhere(drop_two, 5, 3, Stop::halfway); }
TEST(TrajectoryKill, StartingAnewKilled) { stop_everywhere(start_anew, 2, 0, Stop::halfway); }

// The recovery itself may be killed as well, again at any point.
TEST(TrajectoryKill, RecoveryKilledAtAnyChange) {
  const Experiment experiment(3);
  for (int first = 0, killed = kKilled; killed == kKilled; ++first) {
    const fs::path origin = experiment.restored();
    killed = WEXITSTATUS(in_child([&] {
      stop_after(first, Stop::halfway);
      append_one(origin);
    }));
    if (!fs::exists(origin.string() + ".journal")) continue;
    const std::string bytes = bytes_of(origin), journal = bytes_of(origin.string() + ".journal");
    for (int second = 0, again = kKilled; again == kKilled; ++second) {
      const fs::path path = experiment.restored();
      put_bytes(path, bytes);
      put_bytes(path.string() + ".journal", journal);
      again = WEXITSTATUS(in_child([&] {
        stop_after(second, Stop::halfway);
        TrajectoryReader reader(path);
      }));
      EXPECT_EQ(whole_frames(path), 4) << first << ", " << second;
    }
  }
}

// Somebody else holds the lock, as a writer in the middle of its commit does: the reader must not touch the
// file, and still see the finished frame.
TEST(TrajectoryKill, ReaderThatMayNotRecoverTheFileSeesTheRecoveredContent) {
  const Experiment experiment(3);
  const fs::path path = experiment.restored();
  int n = 0;
  do {
    experiment.restored();
    in_child([&] {
      stop_after(n, Stop::before);
      append_one(path);
    });
    ++n;
  } while (!fs::exists(path.string() + ".journal"));
  const int descriptor = ::open(path.c_str(), O_RDWR);
  struct flock region {};
  region.l_type = F_WRLCK;
  ASSERT_EQ(::fcntl(descriptor, F_OFD_SETLK, &region), 0);
  const std::string before = bytes_of(path);
  EXPECT_EQ(whole_frames(path), 4);
  EXPECT_EQ(bytes_of(path), before);
  EXPECT_TRUE(fs::exists(path.string() + ".journal"));
  ::close(descriptor);
  EXPECT_EQ(whole_frames(path), 4);
  EXPECT_FALSE(fs::exists(path.string() + ".journal"));
}

TEST(TrajectoryKill, JournalOfAnotherFileIsNotReplayed) {
  const Experiment experiment(3);
  const fs::path path = experiment.restored();
  for (int n = 0; !fs::exists(path.string() + ".journal"); ++n) {
    experiment.restored();
    in_child([&] {
      stop_after(n, Stop::before);
      append_one(path);
    });
  }
  const std::string journal = bytes_of(path.string() + ".journal");
  experiment.restored();
  append_one(path);
  append_one(path);
  const std::string good = bytes_of(path);
  put_bytes(path.string() + ".journal", journal);
  EXPECT_THROW(TrajectoryReader{path}, InputError);
  EXPECT_THROW(TrajectoryWriter::resume(path, kKeepAll), InputError);
  EXPECT_EQ(bytes_of(path), good);
  put_bytes(path.string() + ".journal", journal.substr(0, journal.size() / 2));  // not whole: no journal
  EXPECT_EQ(whole_frames(path), 5);
  TrajectoryWriter::create(path);
  EXPECT_EQ(whole_frames(path), 0);
}

void expect_disk_full(const std::function<void()>& change) {
  try {
    change();
  } catch (const RunError& error) {
    const std::string text = error.what();
    EXPECT_TRUE(text.starts_with("cannot write ")) << text;
    EXPECT_NE(text.find("the disk is full"), std::string::npos) << text;
  }
}

TEST(TrajectoryKill, FullDiskAtAnyChangeLosesOnlyTheFrame) {
  const Experiment experiment(3);
  for (int n = 0; n < 2000; ++n) {
    const fs::path path = experiment.restored();
    TrajectoryWriter writer = TrajectoryWriter::resume(path, kKeepAll);
    stop_after(n, Stop::disk_full);
    bool full = false;
    expect_disk_full([&] {
      full = true;
      writer.append(sample_frame(3, kGrains));
      full = false;
    });
    stop_never();
    ASSERT_EQ(whole_frames(path), writer.frames()) << "disk full at change " << n;
    EXPECT_TRUE(full || writer.frames() == 4);
    writer.append(sample_frame(writer.frames(), kGrains));  // space was freed: the run goes on
    EXPECT_EQ(whole_frames(path), writer.frames());
    if (!full) return;
  }
  FAIL() << "append never succeeded";
}

TEST(TrajectoryKill, RealWriteFailureLosesOnlyTheFrame) {
  const Experiment experiment(3);
  const fs::path path = experiment.restored();
  const int status = in_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    TrajectoryWriter writer = TrajectoryWriter::resume(path, kKeepAll);
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    const rlimit small{fs::file_size(path) + 5000, limit.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &small);
    try {
      writer.append(sample_frame(3, 20000));
      ::_exit(1);
    } catch (const RunError&) {
    }
    ::setrlimit(RLIMIT_FSIZE, &limit);
    if (writer.frames() != 3 || TrajectoryReader(path).frames() != 3) ::_exit(2);
    writer.append(sample_frame(3, kGrains));
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(whole_frames(path), 4);
}

// 60 kills at random moments of one and the same run.
TEST(TrajectoryKill, RandomKillsLoseAtMostTheFrameInProgress) {
  const TemporaryFolder folder;
  const fs::path path = folder / "trajectory.h5part";
  TrajectoryWriter::create(path);
  const auto begin = std::chrono::steady_clock::now();
  append_one(path);
  const double typical_us =
      std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
  Random random(1, 0);
  std::int64_t known = 1;
  int unreadable = 0;
  for (int kill = 0; kill < 60; ++kill) {
    int report[2];
    ASSERT_EQ(::pipe(report), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      TrajectoryWriter writer = TrajectoryWriter::resume(path, kKeepAll);
      for (;;) {
        if (::write(report[1], "x", 1) != 1) ::_exit(1);  // "ready", then one for each finished frame
        writer.append(sample_frame(writer.frames(), kGrains));
      }
    }
    ::close(report[1]);
    char byte = 0;
    ASSERT_EQ(::read(report[0], &byte, 1), 1);
    ::usleep(static_cast<useconds_t>(std::min(random.uniform(0, 3 * typical_us), 900000.0)));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    while (::read(report[0], &byte, 1) == 1) ++known;
    ::close(report[0]);
    if (!plainly_readable(path, known)) ++unreadable;
    const std::int64_t frames = whole_frames(path);
    EXPECT_GE(frames, known);
    EXPECT_LE(frames, known + 1);
    known = frames;
  }
  std::cout << known << " frames; after " << unreadable
            << " of 60 kills the plain library needed the recovery\n";
  EXPECT_GT(known, 1);
}

}  // namespace
}  // namespace interstice::io
