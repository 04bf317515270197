// Extremes through the command: whole scenes at the edge of what makes sense.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/apps/command_test.h"
#include "tests/report/report.h"

namespace interstice::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

struct Scene {
  std::string grains = "50, 50, 300, 40, 0, 0, 0";  // x, y, z, diameter [um], vx, vy, vz [m/s] a line
  std::string wall_motion = "";
  std::string gravity = "-9.81";
  std::string modulus = "10 MPa";
  std::string step = "{ rayleigh = 0.2, collision = 0.04 }";
  std::string duration = "2 ms";
};

std::string text_of(const Scene& s) {
  return fmt::format(R"(title = "extreme"
[domain]
box = [["0 mm", "0.5 mm"], ["0 mm", "0.5 mm"], ["0 mm", "0.5 mm"]]
gravity = ["0 m/s^2", "0 m/s^2", "{} m/s^2"]
[materials.powder]
density = "8200 kg/m^3"
youngs_modulus = "{}"
poisson_ratio = 0.3
[contact]
tangential = "mindlin"
[[contact.pair]]
materials = ["powder", "powder"]
restitution = 0.35
friction = 0.3
[[particles]]
name = "grains"
material = "powder"
[particles.insert]
method = "list"
csv = """
x [um], y [um], z [um], diameter [um], vx [m/s], vy [m/s], vz [m/s]
{}
"""
[[walls]]
name = "floor"
material = "powder"
shape = {{ plane = {{ point = ["0 m", "0 m", "0 m"], normal = [0, 0, 1] }} }}
[[walls]]
name = "pusher"
material = "powder"
shape = {{ box = {{ center = ["-0.1 mm", "0.25 mm", "0.25 mm"], size = ["0.2 mm", "0.5 mm", "0.5 mm"] }} }}
{}
[[phases]]
name = "only"
duration = "{}"
[time]
step = {}
[output]
series = "0.1 ms"
[[fields]]
name = "bed"
voxel = "20 um"
box = [["0 mm", "0.5 mm"], ["0 mm", "0.5 mm"], ["0 mm", "0.1 mm"]]
)",
                     s.gravity, s.modulus, s.grains, s.wall_motion, s.duration, s.step);
}

struct RunOutcome {
  int status;
  std::string err;
  fs::path folder;

  Json report() const { return Json::parse(std::ifstream(folder / "run.json")); }
};

class Runs : public CommandTest {
 protected:
  RunOutcome run(const Scene& scene) {
    const std::string file = at(fmt::format("{}.toml", count_)), out = at(fmt::format("out{}", count_));
    ++count_;
    std::ofstream(file) << text_of(scene);
    const Outcome o = interstice(fmt::format("run {} -o {} --no-figures --quiet", file, out));
    return {o.status, o.err, out};
  }

  int count_ = 0;
};

TEST_F(Runs, EmptyAndOneGrain) {
  const RunOutcome empty = run({.grains = ""});
  expect_outcome("empty scene", "a list of no grains", fmt::format("exit {}", empty.status),
                 empty.status == 0 && fs::exists(empty.folder / "fields"));
  const RunOutcome one = run({});
  expect_outcome("one grain", "falls and comes to rest", fmt::format("exit {}", one.status),
                 one.status == 0 && one.report().at("grains") == 1);
}

TEST_F(Runs, StepsThatAreTooLong) {
  // Collision time of this grain's impact at 1 m/s: 2.868 (m^2/(R E*^2 v))^0.2 = 6.6 us with another grain.
  const std::string falling = "50, 50, 30, 40, 0, 0, -1";
  const RunOutcome warned = run({.grains = falling, .step = "\"0.5 us\""});
  expect_outcome("time step", "above 0.05 of the collision time", "warns and runs",
                 warned.status == 0 && warned.err.find("collision time") != std::string::npos);
  const RunOutcome refused = run({.grains = falling, .step = "\"1.5 us\""});
  expect_outcome(
      "time step", "above 0.2 of the collision time", "refused with the largest step allowed",
      refused.status == 2 && refused.err.find("or less") != std::string::npos && !fs::exists(refused.folder));
}

TEST_F(Runs, FastWalls) {
  const std::string motion = "motion = [{ phase = \"only\", velocity = [\"10 m/s\", \"0 m/s\", \"0 m/s\"] }]";
  const RunOutcome fine = run({.wall_motion = motion, .duration = "30 us"});
  expect_outcome("wall at 10 m/s", "step chosen by the program",
                 fmt::format("exit {}, nobody crosses", fine.status),
                 fine.status == 0 && fine.report().at("grains_lost") == 0);
  const RunOutcome coarse =
      run({.wall_motion = motion, .step = "{ rayleigh = 0.2, collision = 0.04 }\nallow_unstable = true"});
  EXPECT_NE(coarse.status, -1);
  const RunOutcome jump = run({.wall_motion = motion, .step = "\"1.2 us\"\nallow_unstable = true"});
  expect_outcome("wall at 10 m/s", "more than half the smallest radius in a step", "refused",
                 jump.status == 2 && jump.err.find("half the smallest radius") != std::string::npos);
}

TEST_F(Runs, AnUnstableRunStopsAndKeepsItsCheckpoint) {
  // Two grains pressed into each other by half their radius: far stiffer than any impact that the step was
  // chosen for.
  const RunOutcome o = run({.grains = "250, 250, 100, 40, 0, 0, 0\n260, 250, 100, 40, 0, 0, 0",
                            .step = "\"2 us\"\nallow_unstable = true"});
  expect_outcome(
      "instability while running", "deep overlap, step far too long",
      fmt::format("exit {} naming grain, step and cause; the checkpoint from before is kept", o.status),
      o.status == 3 && o.err.find("grain") != std::string::npos && o.err.find("step") != std::string::npos &&
          fs::exists(o.folder / "checkpoint.h5"));
}

TEST_F(Runs, DeepOverlapIsSeenAtOnce) {
  const RunOutcome o =
      run({.grains = "250, 250, 100, 40, 0, 0, 0\n270, 250, 100, 40, 0, 0, 0", .step = "\"0.9 us\""});
  expect_outcome("initial overlap", "half a diameter, step fine for the speeds but not for this",
                 fmt::format("exit {}: {}", o.status, o.err.substr(0, 60)), o.status == 3);
}

TEST_F(Runs, NumbersThatAreNone) {
  int refused = 0;
  for (const std::string bad : {"50, 50, nan, 40, 0, 0, 0", "50, 50, inf, 40, 0, 0, 0",
                                "50, 50, 300, -40, 0, 0, 0", "50, 50, 300, 0, 0, 0, 0"}) {
    const RunOutcome o = run({.grains = bad});
    refused += o.status == 2 && !fs::exists(o.folder);
  }
  refused += run({.modulus = "0 Pa"}).status == 2;
  expect_outcome("NaN, infinite, negative or zero input", "places, diameters, moduli",
                 "refused with file, line and key; nothing written", refused == 5);
}

TEST_F(Runs, ZeroGravity) {
  const RunOutcome o = run({.grains = "50, 50, 300, 40, 0.01, 0, 0", .gravity = "0"});
  expect_outcome("zero gravity", "a grain in flight", fmt::format("exit {}", o.status), o.status == 0);
}

}  // namespace
}  // namespace interstice::testing
