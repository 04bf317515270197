#include "coupling/io/state_file.h"

#include <hdf5.h>
#include <signal.h>

#include <limits>

#include "base/error.h"
#include "tests/coupling/io/interrupted.h"
#include "tests/coupling/io/sample_frames.h"

namespace interstice::io {
namespace {

namespace fs = std::filesystem;
using namespace testing;

State sample_state(std::uint64_t seed) {
  Random random(seed, 0);
  State state;
  for (int i = 0; i < 5000; ++i) state.real["positions"].push_back(random.uniform(-1, 1));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  state.real["odd"] = {nan,    -nan,
                       -0.0,   std::numeric_limits<double>::infinity(),
                       5e-324, std::bit_cast<double>(0x7FF0000000000001ull)};
  state.real["empty"] = {};
  state.integer["ids"] = {0, -1, std::numeric_limits<std::int64_t>::min(),
                          std::numeric_limits<std::int64_t>::max()};
  state.integer["none"] = {};
  state.text["scene"] = "title = \"ä\"\n" + std::string(100000, 's');
  state.text["nothing"] = "";
  state.text["zeros"] = std::string("a\0b\0\0", 5);
  return state;
}

bool same_state(const State& a, const State& b) {
  if (a.integer != b.integer || a.text != b.text || a.real.size() != b.real.size()) return false;
  for (const auto& [key, values] : a.real)
    if (!b.real.contains(key) || !same_bits(values, b.real.at(key))) return false;
  return true;
}

TEST(StateFile, GivesBackEveryBit) {
  const TemporaryFolder folder;
  write_state(folder / "c.h5", sample_state(1));
  EXPECT_TRUE(same_state(read_state(folder / "c.h5"), sample_state(1)));
  write_state(folder / "c.h5", State{});
  EXPECT_TRUE(same_state(read_state(folder / "c.h5"), State{}));
}

TEST(StateFile, TakesAnyNameAndThousandsOfEntries) {
  const TemporaryFolder folder;
  State state;
  for (const char* name : {"", ".", "..", "a/b", "/", "%", "%2F", "100%", "a.b", "spaces and ä"}) {
    state.real[name] = {1, 2};
    state.text[name] = name;
  }
  for (int i = 0; i < 5000; ++i) state.integer["wall." + std::to_string(i)] = {i, -i};
  write_state(folder / "c.h5", state);
  EXPECT_TRUE(same_state(read_state(folder / "c.h5"), state));
}

TEST(StateFile, IsPlainHdf5) {
  const TemporaryFolder folder;
  write_state(folder / "c.h5", sample_state(1));
  const hid_t file = H5Fopen((folder / "c.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  const hid_t array = H5Dopen2(file, "real/positions", H5P_DEFAULT);
  ASSERT_GE(array, 0);
  std::vector<double> values(5000);
  EXPECT_GE(H5Dread(array, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  EXPECT_EQ(values, sample_state(1).real["positions"]);
  H5Dclose(array);
  H5Fclose(file);
}

void expect_input_error(const fs::path& path) {
  try {
    read_state(path);
    FAIL() << "accepted " << path;
  } catch (const InputError& error) {
    EXPECT_EQ(error.messages().size(), 1u);
    EXPECT_TRUE(std::string(error.what()).starts_with(path.string() + ": ")) << error.what();
  }
}

TEST(StateFile, NamesWhatIsNoStateFile) {
  const TemporaryFolder folder;
  put_bytes(folder / "text", "not HDF5");
  put_bytes(folder / "empty", "");
  H5Fclose(H5Fcreate((folder / "other.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
  for (const char* name : {"missing", "text", "empty", "other.h5"}) expect_input_error(folder / name);
  expect_input_error(folder.path());
}

// Every damage is found before the HDF5 library sees the file, so none can crash it.
TEST(StateFile, RefusesDamagedFiles) {
  const TemporaryFolder folder;
  State state;
  state.real["a"] = {1, 2, 3};
  state.text["t"] = "text";
  write_state(folder / "good.h5", state);
  const std::string good = bytes_of(folder / "good.h5");
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ (1 << (i % 8)));
    put_bytes(folder / "bad.h5", bad);
    EXPECT_THROW(read_state(folder / "bad.h5"), InputError) << "bit flipped in byte " << i;
  }
  for (std::size_t length = 0; length < good.size(); length += 7) {
    put_bytes(folder / "bad.h5", good.substr(0, length));
    EXPECT_THROW(read_state(folder / "bad.h5"), InputError) << "cut to " << length;
  }
  put_bytes(folder / "bad.h5", good + "more");
  EXPECT_THROW(read_state(folder / "bad.h5"), InputError);
}

TEST(StateFile, IsOldOrNewWhereverTheWriterIsKilled) {
  const TemporaryFolder folder;
  const fs::path path = folder / "c.h5";
  for (const Stop how : {Stop::before, Stop::halfway}) {
    bool killed = true;
    for (int n = 0; killed; ++n) {
      write_state(path, sample_state(1));
      const int status = in_child([&] {
        stop_after(n, how);
        write_state(path, sample_state(2));
      });
      ASSERT_TRUE(WIFEXITED(status));
      killed = WEXITSTATUS(status) == kKilled;
      ASSERT_TRUE(killed || WEXITSTATUS(status) == 0);
      const State state = read_state(path);
      EXPECT_TRUE(same_state(state, sample_state(1)) || same_state(state, sample_state(2))) << n;
      EXPECT_TRUE(killed || same_state(state, sample_state(2)));
    }
  }
}

TEST(StateFile, IsOldOrNewAfterKillsAtRandomMoments) {
  const TemporaryFolder folder;
  const fs::path path = folder / "c.h5";
  write_state(path, sample_state(0));
  Random random(3, 0);
  for (int kill = 0; kill < 40; ++kill) {
    const pid_t child = ::fork();
    if (child == 0)
      for (std::uint64_t seed = 0;; ++seed) write_state(path, sample_state(seed % 4));
    ::usleep(static_cast<useconds_t>(random.uniform(0, 20000)));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    const State state = read_state(path);
    int matches = 0;
    for (std::uint64_t seed = 0; seed < 4; ++seed) matches += same_state(state, sample_state(seed));
    EXPECT_EQ(matches, 1);
  }
}

TEST(StateFile, FullDiskIsReportedAndKeepsTheOldFile) {
  const TemporaryFolder folder;
  const fs::path path = folder / "c.h5";
  write_state(path, sample_state(1));
  for (int n = 0;; ++n) {
    ASSERT_LT(n, 500);
    bool full = false;
    stop_after(n, Stop::disk_full);
    try {
      write_state(path, sample_state(2));
    } catch (const RunError& error) {
      full = true;
      EXPECT_TRUE(
          std::string(error.what()).starts_with("cannot write " + path.string() + ": the disk is full"))
          << error.what();
    }
    stop_never();
    const State state = read_state(path);
    EXPECT_TRUE(same_state(state, sample_state(2)) || (full && same_state(state, sample_state(1))));
    if (!full) break;
  }
}

}  // namespace
}  // namespace interstice::io
