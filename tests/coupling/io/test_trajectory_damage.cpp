// Damaged trajectories: whatever is wrong with the file, the reader gives frames or says InputError.
#include <sys/resource.h>

#include <iostream>
#include <map>

#include "base/error.h"
#include "coupling/io/trajectory.h"
#include "tests/coupling/io/interrupted.h"
#include "tests/coupling/io/sample_frames.h"

namespace interstice::io {
namespace {

namespace fs = std::filesystem;
using namespace testing;

enum Outcome { whole = 0, refused = 3, partly = 4, altered = 5, odd = 99 };

/// Reads all that can be read, in a child process that a hang or a crash ends.
int read_everything(const fs::path& path) {
  return in_child([&] {
    const rlimit ten_seconds{10, 10};  // of processor time: a hang ends with SIGXCPU, a busy machine does not
    ::setrlimit(RLIMIT_CPU, &ten_seconds);
    try {
      const TrajectoryReader reader(path);
      bool all = true, same = true;
      for (std::int64_t k = 0; k < reader.frames(); ++k) {
        try {
          same = same_frame(reader.read(k), sample_frame(k, 40)) && same;
        } catch (const InputError&) {
          all = false;
        }
      }
      ::_exit(!same ? altered : all ? whole : partly);
    } catch (const InputError&) {
      ::_exit(refused);
    }
  });
}

class TrajectoryDamage : public ::testing::Test {
 protected:
  TrajectoryDamage() {
    TrajectoryWriter writer = TrajectoryWriter::create(folder_ / "good.h5part");
    for (int k = 0; k < 4; ++k) writer.append(sample_frame(k, 40));
    good_ = bytes_of(folder_ / "good.h5part");
  }

  void expect_frames_or_refusal(const std::string& bytes, const std::string& what) {
    put_bytes(folder_ / "bad.h5part", bytes);
    const int status = read_everything(folder_ / "bad.h5part");
    if (WIFSIGNALED(status)) {
      ++outcomes_[-WTERMSIG(status)];
      ADD_FAILURE() << what << ": signal " << WTERMSIG(status);
    } else {
      ++outcomes_[WEXITSTATUS(status)];
      EXPECT_NE(WEXITSTATUS(status), odd) << what << ": an exception other than InputError";
    }
  }

  ~TrajectoryDamage() override {
    EXPECT_EQ(outcomes_[altered], 0) << "read without complaint, but not what was written";
    std::cout << outcomes_[whole] << " read whole, " << outcomes_[partly] << " in part, "
              << outcomes_[refused] << " refused\n";
  }

  TemporaryFolder folder_;
  std::string good_;
  std::map<int, int> outcomes_;
};

TEST_F(TrajectoryDamage, CutAnywhere) {
  Random random(1, 0);
  for (int i = 0; i < 200; ++i) {
    const auto length = static_cast<std::size_t>(random.uniform(0, static_cast<double>(good_.size())));
    expect_frames_or_refusal(good_.substr(0, length), "cut to " + std::to_string(length));
  }
}

TEST_F(TrajectoryDamage, RandomBytes) {
  for (std::uint64_t i = 0; i < 1000; ++i) {
    Random random(2, i);
    std::string bad = good_;
    const int count = 1 + static_cast<int>(random.uniform(0, 20));
    for (int j = 0; j < count; ++j)
      bad[static_cast<std::size_t>(random.uniform(0, static_cast<double>(bad.size())))] =
          static_cast<char>(random.uniform(0, 256));
    expect_frames_or_refusal(bad, "case " + std::to_string(i));
  }
}

TEST_F(TrajectoryDamage, ZeroedAndShuffledBlocks) {
  for (std::uint64_t i = 0; i < 300; ++i) {
    Random random(3, i);
    std::string bad = good_;
    const auto block = static_cast<std::size_t>(random.uniform(16, 2048));
    const auto to = static_cast<std::size_t>(random.uniform(0, static_cast<double>(bad.size() - block)));
    const auto from = static_cast<std::size_t>(random.uniform(0, static_cast<double>(bad.size() - block)));
    bad.replace(to, block, i % 2 == 0 ? std::string(block, '\0') : good_.substr(from, block));
    expect_frames_or_refusal(bad, "case " + std::to_string(i));
  }
}

}  // namespace
}  // namespace interstice::io
