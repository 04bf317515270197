// `interstice run` from the outside: the same bits for any threads and after a stop, fields that agree with
// `voids`, what a kill leaves, and one line and the right exit status for what is wrong.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>

#include "coupling/io/trajectory.h"
#include "coupling/scene/read_scene.h"
#include "tests/apps/command_test.h"

namespace interstice::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

const std::string kScene = INTERSTICE_SOURCE_DIR "/data/scenes/pour.toml";
const std::string kSmall =
    " --set particles.powder.count=60 --set 'phases.pour.until.at_most=\"9 ms\"' --set "
    "'output.trajectory=\"1 ms\"' "
    "--set 'fields.bed.every=\"3 ms\"' --set 'domain.box.2.1=\"0.6 mm\"' "
    "--set 'particles.powder.insert.box.2=[\"0.05 mm\",\"0.5 mm\"]' --no-figures --quiet ";

class Run : public CommandTest {
 protected:
  int call(const std::string& arguments) {
    const Outcome outcome = interstice(arguments);
    out_ = outcome.out, err_ = outcome.err;
    return outcome.status;
  }

  /// Starts a run that would take minutes and returns its process.
  pid_t start_long_run(const std::string& out) {
    const pid_t child = ::fork();
    if (child == 0) {
      ::execl(INTERSTICE_COMMAND, "interstice", "run", kScene.c_str(), "-o", out.c_str(), "--quiet",
              "--no-figures", "--set", "output.trajectory=\"0.05 ms\"", "--set",
              "phases.pour.until.settled_time=\"50 ms\"", nullptr);
      ::_exit(127);
    }
    return child;
  }

  std::string out_, err_;
};

io::ParticleFrame last_frame(const std::string& run) {
  const io::TrajectoryReader reader(run + "/trajectory.h5part");
  return reader.read(reader.frames() - 1);
}

void expect_same_run(const std::string& a, const std::string& b) {
  EXPECT_EQ(slurp(a + "/series.csv"), slurp(b + "/series.csv"));
  EXPECT_EQ(slurp(a + "/fields/bed.csv"), slurp(b + "/fields/bed.csv"));
  const io::TrajectoryReader ra(a + "/trajectory.h5part"), rb(b + "/trajectory.h5part");
  ASSERT_EQ(ra.frames(), rb.frames());
  for (std::int64_t f = 0; f < ra.frames(); ++f) {
    const io::ParticleFrame fa = ra.read(f), fb = rb.read(f);
    EXPECT_EQ(fa.time, fb.time);
    EXPECT_EQ(fa.id, fb.id);
    EXPECT_EQ(fa.x, fb.x);
    EXPECT_EQ(fa.vz, fb.vz);
    EXPECT_EQ(fa.wy, fb.wy);
  }
}

TEST_F(Run, GivesTheSameBitsForOneAndTwoThreadsAndTheReference) {
  ASSERT_EQ(call("run " + kScene + " -o " + at("one") + kSmall + "--threads 1"), 0) << err_;
  ASSERT_EQ(call("run " + kScene + " -o " + at("two") + kSmall + "--threads 2"), 0) << err_;
  ASSERT_EQ(call("run " + kScene + " -o " + at("ref") + kSmall + "--backend reference"), 0) << err_;
  expect_same_run(at("one"), at("two"));
  expect_same_run(at("one"), at("ref"));
  EXPECT_GT(last_frame(at("one")).size(), 50u);
}

TEST_F(Run, StoppedAndResumedGivesTheSameBits) {
  ASSERT_EQ(call("run " + kScene + " -o " + at("whole") + kSmall), 0) << err_;
  EXPECT_EQ(call("run " + kScene + " -o " + at("parts") + kSmall + "--until 2.2ms"), 75) << err_;
  EXPECT_EQ(call("run " + kScene + " -o " + at("parts") + kSmall + "--until 5.1ms --resume"), 75) << err_;
  EXPECT_EQ(call("run " + kScene + " -o " + at("parts") + kSmall + "--resume"), 0) << err_;
  expect_same_run(at("whole"), at("parts"));
}

/// Powder of 10 to 50 um of which those below 20 um take two short steps.
TEST_F(Run, TwoRatesOfStepsGiveTheSameBitsForAnyThreadsAndAfterAStop) {
  const std::string sizes =
      " --set 'particles.powder.diameter={ distribution = \"uniform\", min = \"10 um\", max = \"50 um\", "
      "weight = \"number\" }' --set 'time.short_steps_below=\"20 um\"' ";
  ASSERT_EQ(call("check " + kScene + sizes), 0) << err_;
  EXPECT_NE(out_.find("short steps     2 of "), std::string::npos) << out_;
  ASSERT_EQ(call("run " + kScene + " -o " + at("one") + kSmall + sizes + "--threads 1"), 0) << err_;
  ASSERT_EQ(call("run " + kScene + " -o " + at("two") + kSmall + sizes + "--threads 2"), 0) << err_;
  EXPECT_EQ(call("run " + kScene + " -o " + at("parts") + kSmall + sizes + "--until 3.3ms"), 75) << err_;
  EXPECT_EQ(call("run " + kScene + " -o " + at("parts") + kSmall + sizes + "--resume"), 0) << err_;
  expect_same_run(at("one"), at("two"));
  expect_same_run(at("one"), at("parts"));
  const Json j = Json::parse(slurp(at("one") + "/run.json"));
  EXPECT_EQ(j.at("short_steps"), 2);
  EXPECT_GT(last_frame(at("one")).size(), 50u);
}

TEST_F(Run, ShortStepsThatGainNothingAreNamed) {
  ASSERT_EQ(call("check " + kScene + " --set 'time.short_steps_below=\"1 um\"'"), 0) << err_;
  EXPECT_NE(err_.find("time.short_steps_below: 1 um is less than twice the smallest diameter"),
            std::string::npos)
      << err_;
}

TEST_F(Run, TheResolvedSceneGivesTheSameBits) {
  ASSERT_EQ(call("run " + kScene + " -o " + at("a") + kSmall), 0) << err_;
  ASSERT_EQ(call("run " + at("a") + "/scene.resolved.toml -o " + at("b") + " --no-figures --quiet"), 0)
      << err_;
  expect_same_run(at("a"), at("b"));
}

TEST_F(Run, VoidsOnItsTrajectoryFindsItsFields) {
  ASSERT_EQ(call("run " + kScene + " -o " + at("run") + kSmall), 0) << err_;
  ASSERT_EQ(
      call("voids " + at("run") + "/trajectory.h5part -o " + at("voids") +
           " --voxel 20um --box 0mm,0.5mm,0mm,0.5mm,0mm,0.3mm --average 100um --slice y=0.25mm --no-figures "
           "--quiet"),
      0)
      << err_;
  fs::path last;
  for (const auto& entry : fs::directory_iterator(at("run") + "/fields")) {
    if (entry.is_directory() && (last.empty() || entry.path() > last)) last = entry.path();
  }
  const fs::path there = fs::path(at("voids")) / "trajectory";
  EXPECT_EQ(slurp(last / "slices/y=0.00025.csv"), slurp(there / "slices/y=0.00025.csv"));
  const Json a = Json::parse(slurp(last / "summary.json")), b = Json::parse(slurp(there / "summary.json"));
  EXPECT_EQ(a.at("solid_volume_field_m3"), b.at("solid_volume_field_m3"));
  EXPECT_LE(std::fabs(a.at("relative_conservation_error").get<double>()), 1e-12);
}

TEST_F(Run, AKillAtAnyMomentLeavesReadableFilesAndAStopCanGoOn) {
  for (const int milliseconds : {300, 700, 1300}) {
    const std::string out = at("killed" + std::to_string(milliseconds));
    const pid_t child = start_long_run(out);
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    if (!fs::exists(out + "/trajectory.h5part")) continue;  // killed before the first frame
    const io::TrajectoryReader reader(out + "/trajectory.h5part");
    for (std::int64_t f = 0; f < reader.frames(); ++f)
      EXPECT_EQ(reader.read(f).x.size(), reader.read(f).radius.size());
    EXPECT_NE(slurp(out + "/scene.resolved.toml").find("Pour into a box"), std::string::npos);
    EXPECT_EQ(call("info " + out + "/trajectory.h5part"), 0) << err_;
  }
  const std::string out = at("stopped");
  const pid_t child = start_long_run(out);
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  ::kill(child, SIGTERM);
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 75);
  EXPECT_TRUE(fs::exists(out + "/checkpoint.h5"));
  EXPECT_EQ(Json::parse(slurp(out + "/run.json")).at("exit_reason"), "signal");
}

TEST_F(Run, RefusesWhatIsWrongWithOneLineAndWritesNothing) {
  const auto refused = [&](const std::string& extra, const std::string& what) {
    EXPECT_EQ(call("run " + kScene + " -o " + at("refused") + kSmall + extra), 2) << extra;
    EXPECT_NE(err_.find(what), std::string::npos) << extra << "\n" << err_;
    EXPECT_FALSE(fs::exists(at("refused"))) << extra;
  };
  refused("--set 'materials.powder.density=\"8200 kg\"'", "materials.powder.density");
  refused("--set materials.powder.density=8200", "kg/m^3");
  refused("--set 'materials.powder.densty=\"8200 kg/m^3\"'", "density");
  refused("--set 'time.step=\"2 us\"'", "0.2");  // 0.28 of the collision time
  refused("--precision half", "half");
  refused("--backend cuda", "cuda");
  refused("--threads -3", "--threads");
  refused("--until 5", "--until");
  EXPECT_EQ(call("run /no/such/scene.toml -o " + at("refused")), 2);
  EXPECT_NE(err_.find("/no/such/scene.toml"), std::string::npos);
  EXPECT_EQ(call("run " + kScene + " -o " + at("refused") + " --resume"), 2);
}

TEST_F(Run, DoesNotOverwriteUnasked) {
  ASSERT_EQ(call("run " + kScene + " -o " + at("run") + kSmall + "--until 1ms"), 75);
  EXPECT_EQ(call("run " + kScene + " -o " + at("run") + kSmall + "--until 1ms"), 2);
  EXPECT_NE(err_.find("--overwrite"), std::string::npos);
  EXPECT_EQ(call("run " + kScene + " -o " + at("run") + kSmall + "--until 1ms --overwrite"), 75);
  EXPECT_EQ(call("run " + kScene + " -o " + at("run") + kSmall + "--resume --set time.seed=7"), 2)
      << "another scene";
}

TEST_F(Run, AnUnstableStepEndsWithStatusThree) {
  EXPECT_EQ(call("run " + kScene + " -o " + at("run") + kSmall +
                 "--set 'time.step=\"6 us\"' --set time.allow_unstable=true --set "
                 "'particles.powder.insert.velocity=[\"0 "
                 "m/s\",\"0 m/s\",\"-0.5 m/s\"]'"),
            3)
      << err_;
  EXPECT_NE(err_.find("unstable"), std::string::npos) << err_;
}

TEST_F(Run, AFullDiskIsAFailureWithOneLine) {
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{40000, 40000};  // no file may grow beyond 40 kB: what a full disk does to a trajectory
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::signal(SIGXFSZ, SIG_IGN);
    ::_exit(call("run " + kScene + " -o " + at("run") +
                 " --quiet --no-figures --set 'output.trajectory=\"0.1 ms\"'"));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const std::string err = slurp(at("stderr"));
  EXPECT_NE(err.find("cannot write"), std::string::npos) << err;
}

// The same in the thread that writes fields: the run stops with the reason, and no half file has a name.
TEST_F(Run, AFullDiskUnderTheFieldsIsAFailureWithOneLine) {
  constexpr std::uintmax_t most = 300000;  // the .vdb and the .vti of the first field would be larger
  const pid_t child = ::fork();
  if (child == 0) {
    const rlimit limit{most, most};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    ::signal(SIGXFSZ, SIG_IGN);
    ::_exit(call("run " + kScene + " -o " + at("run") + kSmall + "--set 'fields.bed.voxel=\"5 um\"'"));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const std::string err = slurp(at("stderr"));
  EXPECT_NE(err.find("cannot write " + at("run") + "/fields/bed_000000"), std::string::npos) << err;
  for (const auto& file : fs::directory_iterator(at("run") + "/fields")) {
    const std::string name = file.path().filename().string();
    EXPECT_TRUE(name[0] == '.' || file.is_directory() || file.file_size() < most) << name;
  }
}

TEST_F(Run, AFieldThatWouldNotFitIntoMemoryIsRefusedBeforeAnythingIsWritten) {
  EXPECT_EQ(call("run " + kScene + " -o " + at("run") + kSmall + "--set 'fields.bed.voxel=\"0.05 um\"'"), 2);
  EXPECT_NE(err_.find("fields: `bed` (10000 x 10000 x 6000 voxels) would need"), std::string::npos) << err_;
  EXPECT_FALSE(fs::exists(at("run")));
}

TEST_F(Run, ReportsWhatItDid) {
  ASSERT_EQ(call("run " + kScene + " -o " + at("run") + kSmall + "--json"), 0) << err_;
  const Json printed = Json::parse(out_), written = Json::parse(slurp(at("run") + "/run.json"));
  EXPECT_EQ(printed.at("steps"), written.at("steps"));
  EXPECT_EQ(written.at("grains_inserted"), 60);
  EXPECT_EQ(written.at("exit_reason"), "finished");
  EXPECT_NEAR(written.at("time_step_collision_fraction").get<double>(), 0.04, 1e-12);
  EXPECT_EQ(slurp(at("run") + "/series.csv").substr(0, 17), "time_s,particles,");
}

// Figs. 10 to 13 of the compactors' paper: void fraction on three sections, and along y at 35 um in each.
TEST_F(Run, DrawsThePapersSectionsAndLinesAtTheEndOfEachPhase) {
  for (const char* name :
       {"static-walls", "compactors", "coarse-static-walls", "coarse-compactors", "short-static-walls",
        "short-compactors", "quick-static-walls", "quick-compactors"}) {
    const scene::Scene scene =
        scene::read_scene(INTERSTICE_SOURCE_DIR "/data/scenes/" + std::string(name) + ".toml");
    ASSERT_EQ(scene.fields.size(), 1u) << name;
    const scene::Field& field = scene.fields[0];
    ASSERT_EQ(field.slices.size(), 3u) << name;
    ASSERT_EQ(field.lines.size(), 3u) << name;
    const double length = field.box.hi.x - field.box.lo.x;
    for (std::size_t i = 0; i < 3; ++i) {  // equidistant
      EXPECT_EQ(field.slices[i].axis, 0) << name;
      EXPECT_NEAR(field.slices[i].at, 0.25 * static_cast<double>(i + 1) * length, 1e-12) << name;
      EXPECT_EQ(field.lines[i].axis, 1) << name;
      EXPECT_EQ(field.lines[i].at.x, field.slices[i].at) << name;
      EXPECT_NEAR(field.lines[i].at.z, 35e-6, 1e-15) << name;
    }
  }
  if (std::system("command -v gnuplot > /dev/null") != 0) GTEST_SKIP() << "gnuplot is missing";
  ASSERT_EQ(call("run " INTERSTICE_SOURCE_DIR "/data/scenes/quick-compactors.toml -o " + at("run") +
                 " --quiet --set particles.feed.count=40 --set 'phases.pour.until.at_most=\"4 ms\"'"
                 " --set 'phases.spread.duration=\"1 ms\"' --set 'phases.compact.duration=\"1 ms\"'"
                 " --set 'output.series=\"0 s\"'"),
            0)
      << err_;
  for (const std::string phase : {"spread", "compact"})
    for (const auto& [figure, third] :
         {std::pair{"layer-slices-" + phase, "X3: x = 1.5 mm"},
          std::pair{"layer-slices-" + phase + "-averaged", "X3: x = 1.5 mm"},
          std::pair{"layer-lines-" + phase, "along y at x = 1.5 mm, z = 0.035 mm"}}) {
      EXPECT_TRUE(fs::exists(at("run") + "/figures/" + figure + ".png")) << figure;
      EXPECT_NE(slurp(at("run") + "/figures/" + figure + ".gp").find(third), std::string::npos) << figure;
    }
}

}  // namespace
}  // namespace interstice::testing
