// `interstice batch` from the outside: what it keeps, what it refuses, and what a kill costs.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "tests/apps/command_test.h"

namespace interstice::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A dump of `frames` frames of `grains` spheres each, radius 10 to 20 um, the grid of centres moving along
/// x.
std::string dump(int frames, int grains) {
  std::ostringstream text;
  text.precision(17);
  for (int f = 0; f < frames; ++f) {
    text << "ITEM: TIMESTEP\n"
         << 1000 * f << "\nITEM: NUMBER OF ATOMS\n"
         << grains
         << "\nITEM: BOX BOUNDS ff ff ff\n0 0.002\n0 0.0005\n0 0.0005\nITEM: ATOMS id x y z radius\n";
    for (int i = 0; i < grains; ++i) {
      text << i + 1 << ' ' << (i % 20) * 5e-5 + f * 1e-5 + 3e-5 << ' ' << ((i / 20) % 8) * 5e-5 + 3e-5 << ' '
           << (i / 160) * 5e-5 + 3e-5 << ' ' << 1e-5 + (i % 11) * 1e-6 << '\n';
    }
  }
  return text.str();
}

double volume_of(int grains) {
  long double sum = 0;
  for (int i = 0; i < grains; ++i) {
    const long double r = 1e-5L + (i % 11) * 1e-6L;
    sum += r * r * r;
  }
  return static_cast<double>(4 * 3.14159265358979323846264338327950288L / 3 * sum);
}

/// A CSV file without quoted cells but in its header's last columns: rows of cells.
std::vector<std::vector<std::string>> table_of(const fs::path& path) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream in(slurp(path));
  for (std::string line; std::getline(in, line);) {
    rows.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

class Batch : public CommandTest {
 protected:
  std::string file(const std::string& name, const std::string& content) const {
    std::ofstream(folder_ / name, std::ios::binary) << content;
    return (folder_ / name).string() + " ";
  }
  std::string out(const std::string& name = "out") const { return (folder_ / name).string(); }

  std::string command(const std::string& arguments) const { return shell_line("batch " + arguments); }
  Outcome call(const std::string& arguments) const { return interstice("batch " + arguments); }
};

const std::string kPlain = " --voxel 20um --no-figures --quiet --json ";

TEST_F(Batch, ARowPerFrameInInputOrderWithTheNumbersOfTheSummary) {
  const std::string inputs = file("b.dump", dump(3, 400)) + file("a.dump", dump(1, 320));
  const Outcome outcome = call(inputs + "-o " + out() + kPlain);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(Json::parse(outcome.out)["computed"], 4);
  const auto rows = table_of(fs::path(out()) / "table.csv");
  ASSERT_EQ(rows.size(), 5u);
  EXPECT_EQ(std::vector<std::string>(rows[0].begin(), rows[0].begin() + 4),
            (std::vector<std::string>{"file", "frame", "time_s", "folder"}));
  const std::vector<std::string> folders{"b/frame_000000", "b/frame_000001", "b/frame_000002", "a"};
  for (std::size_t r = 1; r < rows.size(); ++r) {
    ASSERT_EQ(rows[r].size(), rows[0].size()) << r;
    EXPECT_EQ(rows[r][3], folders[r - 1]);
    const Json summary = Json::parse(slurp(fs::path(out()) / rows[r][3] / "summary.json"));
    for (const char* key : {"particles", "solid_volume_particles_m3", "void_fraction_min", "seconds"}) {
      const auto at = std::find(rows[0].begin(), rows[0].end(), key) - rows[0].begin();
      ASSERT_LT(static_cast<std::size_t>(at), rows[0].size()) << key;
      EXPECT_EQ(std::stod(rows[r][static_cast<std::size_t>(at)]), summary[key].get<double>()) << key;
    }
    const double truth = volume_of(r < 4 ? 400 : 320);
    EXPECT_NEAR(summary["solid_volume_particles_m3"].get<double>(), truth, 1e-12 * truth);
    EXPECT_LE(summary["relative_conservation_error"].get<double>(), 1e-12);
  }
  EXPECT_TRUE(fs::exists(fs::path(out()) / "b/time_space.csv"));
  EXPECT_TRUE(fs::exists(fs::path(out()) / "b/fields.pvd"));
  EXPECT_FALSE(fs::exists(fs::path(out()) / "a/time_space.csv"));  // one moment is no course of time
  const Json manifest = Json::parse(slurp(fs::path(out()) / "batch.json"));
  EXPECT_EQ(manifest["inputs"][0]["size"], fs::file_size(folder_ / "b.dump"));
  EXPECT_EQ(manifest["options"]["--voxel"][0], "20um");
}

TEST_F(Batch, SameFilesForAnyNumberOfThreads) {
  const std::string inputs = file("a.dump", dump(6, 400)) + file("b.dump", dump(5, 200));
  ASSERT_EQ(call(inputs + "-o " + out("1") + kPlain + "--average 60um --threads 1").status, 0);
  ASSERT_EQ(call(inputs + "-o " + out("4") + kPlain + "--average 60um --threads 4").status, 0);
  const auto one = table_of(out("1") + "/table.csv"), four = table_of(out("4") + "/table.csv");
  ASSERT_EQ(one.size(), 12u);
  ASSERT_EQ(four.size(), 12u);
  for (std::size_t r = 0; r < one.size(); ++r) {
    for (std::size_t c = 0; c < one[0].size(); ++c) {
      if (one[0][c] == "seconds") continue;
      EXPECT_EQ(one[r][c], four[r][c]) << one[0][c];
    }
  }
  for (const char* path :
       {"a/frame_000003/fields.vti", "b/frame_000004/profile_bed.csv", "a/time_space.csv"}) {
    EXPECT_EQ(slurp(out("1") + "/" + path), slurp(out("4") + "/" + path)) << path;
  }
}

TEST_F(Batch, AStatedMemoryIsKeptToAndIsNoOtherBatch) {
  const std::string inputs = file("a.dump", dump(3, 400));
  const Outcome little = call(inputs + "-o " + out() + kPlain + "--memory 0.1MB");
  EXPECT_EQ(little.status, 1);
  EXPECT_NE(little.err.find("a.dump: frame 0: the field may need"), std::string::npos) << little.err;
  EXPECT_NE(little.err.find("--memory allows 0.1 MB"), std::string::npos) << little.err;
  EXPECT_EQ(call(inputs + "-o " + out() + kPlain + "--memory 1GB").status, 0);  // goes on
  EXPECT_EQ(table_of(out() + "/table.csv").size(), 4u);
  for (const char* wrong : {"4", "lots", "-1GB", "0GB", "3 m"}) {
    const Outcome refused = call(inputs + "-o " + out("x") + kPlain + "--memory '" + wrong + "'");
    EXPECT_EQ(refused.status, 2) << wrong;
    EXPECT_NE(refused.err.find("--memory"), std::string::npos) << refused.err;
  }
}

TEST_F(Batch, WarnsOnceAFileOfCoarselyWrittenPositions) {
  std::string text = dump(3, 100);
  const Outcome outcome =
      call(file("a.csv", "x,y,z,radius\n0.0012,0.0013,0.0014,0.00002\n") + file("b.dump", text) + "-o " +
           out() + " --voxel 20um --no-figures --quiet --json");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto first = outcome.err.find("a.csv: positions are written to 100 um only");
  ASSERT_NE(first, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("positions are written", first + 40), std::string::npos) << outcome.err;
}

TEST_F(Batch, FinishedFramesAreSkippedAndOthersAreMade) {
  const std::string inputs = file("a.dump", dump(4, 300));
  ASSERT_EQ(call(inputs + "-o " + out() + kPlain).status, 0);
  const auto table = slurp(out() + "/table.csv");
  const auto written = fs::last_write_time(out() + "/a/frame_000001/fields.vdb");
  fs::remove(out() + "/a/frame_000002/summary.json");  // no longer whole
  const Outcome again = call(inputs + "-o " + out() + kPlain);
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_EQ(Json::parse(again.out)["skipped"], 3);
  EXPECT_EQ(Json::parse(again.out)["computed"], 1);
  EXPECT_EQ(fs::last_write_time(out() + "/a/frame_000001/fields.vdb"), written);
  EXPECT_EQ(table_of(out() + "/table.csv").size(), 5u);
}

TEST_F(Batch, OtherOptionsOrInputsAreRefusedWithoutOverwrite) {
  const std::string a = file("a.dump", dump(2, 300)), b = file("b.dump", dump(1, 300));
  ASSERT_EQ(call(a + "-o " + out() + kPlain).status, 0);
  const auto table = slurp(out() + "/table.csv");
  const auto refused = [&](const std::string& arguments, const std::string& what) {
    const Outcome outcome = call(arguments);
    EXPECT_EQ(outcome.status, 2) << arguments;
    EXPECT_NE(outcome.err.find(what), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("--overwrite"), std::string::npos) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(slurp(out() + "/table.csv"), table);
  };
  refused(a + "-o " + out() + " --voxel 25um --no-figures --quiet --json", "--voxel");
  refused(a + "-o " + out() + kPlain + "--average 60um", "--average");
  refused(a + b + "-o " + out() + kPlain, "other inputs");
  file("a.dump", dump(3, 300));
  refused(a + "-o " + out() + kPlain, "changed");
  const Outcome anew = call(a + "-o " + out() + " --voxel 25um --no-figures --quiet --json --overwrite");
  ASSERT_EQ(anew.status, 0) << anew.err;
  EXPECT_EQ(Json::parse(anew.out)["computed"], 3);
  fs::create_directories(folder_ / "mine");
  file("mine/notes.txt", "keep");
  EXPECT_EQ(call(a + "-o " + out("mine") + kPlain).status, 2);
  EXPECT_EQ(slurp(folder_ / "mine/notes.txt"), "keep");
}

TEST_F(Batch, ABrokenFileOrFrameIsNamedAndCostsOnlyItself) {
  std::string bad_number = dump(4, 300);
  const auto second = bad_number.find("ITEM: TIMESTEP", 10), row = bad_number.find("\n7 ", second);
  bad_number.replace(row + 3, 4, "oops");
  const std::string cut = dump(3, 300);
  const std::string inputs = file("bad.dump", bad_number) + file("good.dump", dump(2, 300)) +
                             file("cut.dump", cut.substr(0, cut.size() - 100)) + file("none.csv", "") +
                             (folder_ / "missing.dump").string() + " ";
  const Outcome outcome = call(inputs + "-o " + out() + kPlain);
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.err.find("bad.dump: frame 1"), std::string::npos) << outcome.err;
  for (const char* name : {"cut.dump", "none.csv", "missing.dump"})
    EXPECT_NE(outcome.err.find(name), std::string::npos) << name;
  const Json json = Json::parse(outcome.out);
  EXPECT_EQ(json["computed"], 7);  // 3 of bad, 2 of good, 2 of cut
  EXPECT_EQ(json["failed"].size(), 4u);
  EXPECT_EQ(table_of(out() + "/table.csv").size(), 8u);
  EXPECT_TRUE(fs::exists(out() + "/bad/frame_000003/summary.json"));
  EXPECT_FALSE(fs::exists(out() + "/bad/frame_000001/summary.json"));
  EXPECT_EQ(Json::parse(slurp(out() + "/batch.json"))["failed"].size(), 4u);

  // A file that gave nothing may be mended; the frames there are stay.
  file("none.csv", "x,y,z,radius\n1e-4,1e-4,1e-4,2e-5\n");
  const Outcome again = call(inputs + "-o " + out() + kPlain);
  EXPECT_EQ(again.status, 1);
  EXPECT_EQ(Json::parse(again.out)["computed"], 1) << again.err;
}

TEST_F(Batch, WrongUseIsRefusedBeforeAnythingIsWritten) {
  const std::string a = file("a.dump", dump(1, 300));
  for (const std::string& arguments :
       {a + "--voxel 20", a + "--voxel 20um --figures bmp", a + "--voxel 20um --contours 1.5",
        a + "--voxel 20um --frame first", a + a + "--voxel 20um", out("missing") + " --voxel 20um"}) {
    EXPECT_EQ(call(arguments + " -o " + out()).status, 2) << arguments;
    EXPECT_FALSE(fs::exists(out())) << arguments;
  }
}

// Killed at moments spread over its work, then called again: no frame that was done is done twice, and the
// end is that of a batch that nobody disturbed.
TEST_F(Batch, KillsCostAtMostTheFramesInProgress) {
  constexpr int frames = 30;
  const std::string inputs = file("a.dump", dump(frames, 640));
  const std::string arguments = inputs + "-o " + out() + " --voxel 5um --average 60um --no-figures --quiet";
  std::size_t finished = 0;
  for (int kill = 0; kill < 12; ++kill) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::setpgid(0, 0);
      ::execl("/bin/sh", "sh", "-c", ("exec " + command(arguments)).c_str(), nullptr);
      ::_exit(127);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(120 + 61 * kill));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    // Whole rows in the table whose frames are whole: they only ever become more.
    std::size_t whole = 0;
    const std::string text = fs::exists(out() + "/table.csv") ? slurp(out() + "/table.csv") : "";
    for (const char c : text) whole += c == '\n';
    if (whole > 0) --whole;  // the header
    EXPECT_GE(whole, finished) << kill;
    finished = whole;
  }
  const Outcome end = call(arguments + " --json");
  ASSERT_EQ(end.status, 0) << end.err;
  EXPECT_GE(Json::parse(end.out)["skipped"].get<std::size_t>(), finished);
  EXPECT_EQ(Json::parse(end.out)["skipped"].get<int>() + Json::parse(end.out)["computed"].get<int>(), frames);
  ASSERT_EQ(call(inputs + "-o " + out("calm") + " --voxel 5um --average 60um --no-figures --quiet").status,
            0);
  const auto killed = table_of(out() + "/table.csv"), calm = table_of(out("calm") + "/table.csv");
  ASSERT_EQ(killed.size(), calm.size());
  for (std::size_t r = 0; r < calm.size(); ++r) {
    for (std::size_t c = 0; c < calm[0].size(); ++c) {
      if (calm[0][c] == "seconds") continue;
      EXPECT_EQ(killed[r][c], calm[r][c]) << calm[0][c];
    }
  }
  EXPECT_EQ(slurp(out() + "/a/frame_000017/fields.vti"), slurp(out("calm") + "/a/frame_000017/fields.vti"));
}

TEST_F(Batch, TheBedOverTimeIsTheVolumeOfTheGrainsSlabBySlab) {
  // One grain of 20 um that moves by a slab a frame, in a box of 10 x 5 x 5 slabs of 50 um.
  std::ostringstream text;
  for (int f = 0; f < 5; ++f) {
    text << "ITEM: TIMESTEP\n"
         << f << "\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 1\n0 1\n"
         << "ITEM: ATOMS id x y z radius\n1 " << 25e-6 + f * 50e-6 << " 1e-4 1e-4 2e-5\n";
  }
  const Outcome outcome = call(file("a.dump", text.str()) + "-o " + out() +
                               " --voxel 50um --box 0um,500um,0um,250um,0um,250um --no-figures --quiet");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto rows = table_of(out() + "/a/time_space.csv");
  ASSERT_EQ(rows.size(), 1u + 5 * 10);
  EXPECT_EQ(rows[0][3], "x_m");
  const double share = 4 * std::acos(-1.0) / 3 * 8e-15 / (50e-6 * 250e-6 * 250e-6);
  for (int f = 0; f < 5; ++f) {
    for (int i = 0; i < 10; ++i) {
      const auto& row = rows[static_cast<std::size_t>(1 + 10 * f + i)];
      EXPECT_NEAR(std::stod(row[5]), i == f ? share : 0, 1e-12 * share) << f << ' ' << i;
      EXPECT_NEAR(std::stod(row[4]), i == f ? 1 - share : 1, 1e-15);
    }
  }
}

}  // namespace
}  // namespace interstice::testing
