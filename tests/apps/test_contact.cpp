// Contact laws from the outside: a scene of a few grains through `interstice run` and `check`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "coupling/io/trajectory.h"
#include "tests/apps/command_test.h"

namespace interstice::testing {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// What varies between the scenes of this file.
struct Case {
  std::string laws = "";  // lines of [contact]
  std::string pair = "";  // lines of [[contact.pair]] beside restitution
  double restitution = 0.35;
  double speed = 0.1;   // of each grain [m/s]
  double sideways = 0;  // of the first grain [m/s]
  double origin = 0;    // of everything along x [m]
  std::string modulus = "1 GPa";
  std::string duration = "0.1 ms";
  std::string step = "{ rayleigh = 0.02, collision = 0.002 }";
  std::string output = "";  // more lines of [output]
};

/// Two grains of 2 x 2^-16 m (30.5 um) that meet head on in a box of 2^-9 m: all places are binary fractions,
/// so that they are exact at any binary origin.
std::string scene_of(const Case& c) {
  const double unit = 0x1p-16;
  return fmt::format(R"(title = "two grains"
[domain]
box = [["{} m", "{} m"], ["-1 mm", "1 mm"], ["-1 mm", "1 mm"]]
gravity = ["0 m/s^2", "0 m/s^2", "0 m/s^2"]
[materials.powder]
density = "8200 kg/m^3"
youngs_modulus = "{}"
poisson_ratio = 0.3
[contact]
{}
[[contact.pair]]
materials = ["powder", "powder"]
restitution = {}
{}
[[particles]]
name = "pair"
material = "powder"
[particles.insert]
method = "list"
csv = """
x [m], y [m], z [m], diameter [m], vx [m/s], vy [m/s]
{}, 0, 0, {}, {}, {}
{}, 0, 0, {}, {}, 0
"""
[[phases]]
name = "meet"
duration = "{}"
[time]
step = {}
[output]
series = "10 us"
trajectory = "50 us"
{})",
                     c.origin - 0x1p-10, c.origin + 0x1p-10, c.modulus, c.laws, c.restitution, c.pair,
                     c.origin - 1.25 * unit, 2 * unit, c.speed, c.sideways, c.origin + 1.25 * unit, 2 * unit,
                     -c.speed, c.duration, c.step, c.output);
}

class Contact : public CommandTest {
 protected:
  int call(const std::string& arguments) {
    const Outcome outcome = interstice(arguments);
    out_ = outcome.out, err_ = outcome.err;
    return outcome.status;
  }

  std::string write_scene(const Case& c) {
    const fs::path path = folder_ / fmt::format("scene{}.toml", scenes_++);
    std::ofstream(path) << scene_of(c);
    return path.string();
  }

  /// Runs the case; the last frame of its trajectory.
  io::ParticleFrame outcome(const Case& c, const std::string& options = "") {
    const std::string scene = write_scene(c), out = (folder_ / fmt::format("run{}", scenes_)).string();
    EXPECT_EQ(call(fmt::format("run {} -o {} --no-figures --quiet {}", scene, out, options)), 0)
        << err_ << c.laws;
    last_run_ = out;
    const io::TrajectoryReader reader(out + "/trajectory.h5part");
    return reader.read(reader.frames() - 1);
  }

  double rebound(const Case& c, const std::string& options = "") {
    const io::ParticleFrame f = outcome(c, options);
    return (f.vx[1] - f.vx[0]) / (2 * c.speed);
  }

  std::string out_, err_, last_run_;
  int scenes_ = 0;
};

const std::string kJkr = "cohesion = \"jkr\"";

TEST_F(Contact, EveryDampingReturnsWhatItPromises) {
  for (const std::string normal : {"normal = \"hertz\"\n", "normal = \"hooke\"\n"}) {
    const std::string stiffness = normal.find("hooke") != std::string::npos ? "stiffness = \"1000 N/m\"" : "";
    // The dashpot of a linear contact acts at once, so its onset is off by half a step: 0.6 dt/t_c.
    const double tolerance = stiffness.empty() ? 1e-3 : 2e-3;
    for (const double e : {0.2, 0.35, 0.7}) {
      const auto with = [&](const std::string& damping) {
        return Case{.laws = normal + "damping = \"" + damping + "\"", .pair = stiffness, .restitution = e};
      };
      EXPECT_NEAR(rebound(with("tension")), e, tolerance) << normal << e;
      EXPECT_NEAR(rebound(with("clipped")), e, tolerance) << normal << e;
      const double uncorrected = e == 0.2 ? 0.3249 : e == 0.35 ? 0.4342 : 0.7182;  // integrated reference
      EXPECT_NEAR(rebound(with("clipped_uncorrected")), uncorrected, tolerance) << normal << e;
    }
  }
}

TEST_F(Contact, AdhesionSticksBelowTheSpeedThatCheckNames) {
  const Case slow{.laws = kJkr,
                  .pair = "work_of_adhesion = \"20 mJ/m^2\"",
                  .restitution = 1,
                  .speed = 0.004,
                  .duration = "3 ms"};
  ASSERT_EQ(call("check " + write_scene(slow) + " --json"), 0) << err_;
  const double sticking = Json::parse(out_).at("contacts").at(0).at("sticking_speed_m_s");
  // JKR (1971): 7.0922 (w^5 R*^4 / E*^2)^(1/3) is lost in every impact.
  const double radius = 0x1p-16, modulus = 1e9 / 1.82, mass = 4.0 / 3 * M_PI * std::pow(radius, 3) * 8200 / 2;
  const double work = 7.0922 * std::cbrt(std::pow(0.02, 5) * std::pow(radius / 2, 4) / (modulus * modulus));
  EXPECT_NEAR(sticking, std::sqrt(2 * work / mass), 1e-4 * sticking);
  Case at = slow;
  at.speed = 0.5 * 0.98 * sticking;  // each
  EXPECT_LT(std::fabs(rebound(at)), 0.9);
  const io::ParticleFrame stuck = outcome(at);
  EXPECT_LT(stuck.x[1] - stuck.x[0], 2 * radius + 1e-8);
  at.speed = 0.5 * 1.02 * sticking;
  const io::ParticleFrame flown = outcome(at);
  EXPECT_GT(flown.x[1] - flown.x[0], 2 * radius + 1e-7);
}

TEST_F(Contact, BothNamesOfAnAdhesionAreOneNumber) {
  const auto run = [&](const std::string& key) {
    return rebound({.laws = kJkr, .pair = key, .restitution = 0.8});
  };
  EXPECT_EQ(run("work_of_adhesion = \"20 mJ/m^2\""), run("surface_energy = \"10 mJ/m^2\""));
}

TEST_F(Contact, AFarDomainIsTheNearOneToTheBit) {
  const std::string laws = "tangential = \"mindlin\"\nrolling = \"epsd2\"\ncohesion = \"sjkr\"";
  Case near{.laws = laws,
            .pair = "friction = 0.3\nrolling_friction = 0.01\ncohesion_energy_density = \"1 MJ/m^3\"",
            .sideways = 0.05};
  Case far = near;
  far.origin = 2;  // a thousand domain lengths
  for (const std::string precision : {"--precision double", "--precision mixed"}) {
    const io::ParticleFrame a = outcome(near, precision), b = outcome(far, precision);
    EXPECT_LT(a.vx[0], 0);  // it did bounce
    EXPECT_EQ(a.vx, b.vx);
    EXPECT_EQ(a.vy, b.vy);
    EXPECT_EQ(a.wz, b.wz);
    EXPECT_NEAR(b.x[0] - 2, a.x[0], 4.5e-16);  // one rounding of a place at 2 m
  }
}

TEST_F(Contact, MixedPrecisionIsNearDouble) {
  const Case c{.laws = "tangential = \"mindlin\"", .pair = "friction = 0.3", .sideways = 0.05};
  const io::ParticleFrame a = outcome(c), b = outcome(c, "--precision mixed");
  EXPECT_NE(a.vx, b.vx);
  for (int i = 0; i < 2; ++i) {
    EXPECT_NEAR(b.vx[i] / a.vx[i], 1, 1e-6);  // a few roundings of single precision
    EXPECT_NEAR(b.wz[i] / a.wz[i], 1, 1e-5);
  }
}

TEST_F(Contact, EnergyColumnsBalance) {
  const Case c{.laws = "tangential = \"mindlin\"\nrolling = \"cdt\"\ncohesion = \"sjkr\"",
               .pair = "friction = 0.3\nrolling_friction = 0.01\ncohesion_energy_density = \"1 MJ/m^3\"",
               .sideways = 0.05,
               .duration = "20 us",
               .step = "\"10 ps\"",
               .output = "energy = true"};
  outcome(c);
  std::ifstream in(last_run_ + "/series.csv");
  std::string header, line, last;
  std::getline(in, header);
  while (std::getline(in, line)) last = line;
  const double mass = 4.0 / 3 * M_PI * std::pow(0x1p-16, 3) * 8200;
  const double start = 0.5 * mass * (2 * 0.1 * 0.1 + 0.05 * 0.05);
  EXPECT_TRUE(header.ends_with("energy_residual_J"));
  EXPECT_LT(std::fabs(std::stod(last.substr(last.rfind(',') + 1))), 1e-6 * start) << last;
}

TEST_F(Contact, CheckWarnsWhereALawLeavesItsRange) {
  const auto warning = [&](const Case& c) {
    EXPECT_EQ(call("check " + write_scene(c)), 0) << err_;
    return err_;
  };
  EXPECT_NE(warning({.laws = kJkr, .pair = "work_of_adhesion = \"0.1 mJ/m^2\"", .modulus = "110 GPa"})
                .find("use dmt"),
            std::string::npos);
  EXPECT_NE(
      warning({.laws = "cohesion = \"dmt\"", .pair = "work_of_adhesion = \"20 mJ/m^2\"", .modulus = "10 MPa"})
          .find("use jkr"),
      std::string::npos);
  EXPECT_NE(warning({.laws = "", .speed = 1, .modulus = "100 kPa", .step = "\"10 ns\""}).find("overlap by"),
            std::string::npos);
  EXPECT_NE(warning({.laws = "cohesion = \"van_der_waals\"",
                     .pair = "hamaker_constant = \"65 zJ\"\ncutoff = \"0.4 nm\"",
                     .speed = 1})
                .find("cut-off"),
            std::string::npos);
  EXPECT_EQ(warning({.laws = ""}), "");
}

TEST_F(Contact, CohesionThatOutweighsALinearSpringIsRefused) {
  const Case c{.laws = "normal = \"hooke\"\ncohesion = \"sjkr\"",
               .pair = "stiffness = \"10 N/m\"\ncohesion_energy_density = \"1 MJ/m^3\""};
  EXPECT_EQ(call(fmt::format("run {} -o {}", write_scene(c), (folder_ / "none").string())), 2);
  EXPECT_NE(err_.find("outweighs"), std::string::npos) << err_;
  EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(Contact, CheckSaysWhichKernelRuns) {
  const std::string friction = "tangential = \"mindlin\"\n", pair = "friction = 0.3";
  ASSERT_EQ(call("check --json " + write_scene({.laws = friction, .pair = pair})), 0) << err_;
  EXPECT_EQ(Json::parse(out_).at("kernel"), "own");
  ASSERT_EQ(
      call("check --json " + write_scene({.laws = friction + "normal = \"hooke\"\ndamping = \"clipped\"",
                                          .pair = pair + "\nstiffness = \"1000 N/m\""})),
      0)
      << err_;
  EXPECT_EQ(Json::parse(out_).at("kernel"), "generic");
}

TEST_F(Contact, ACheckpointOfAnotherPrecisionIsNotContinued) {
  const std::string scene = write_scene({.laws = ""}), out = (folder_ / "run").string();
  ASSERT_EQ(call(fmt::format("run {} -o {} --no-figures --quiet --until 20us", scene, out)), 75) << err_;
  EXPECT_EQ(call(fmt::format("run {} -o {} --no-figures --quiet --resume --precision mixed", scene, out)), 2);
  EXPECT_NE(err_.find("other settings"), std::string::npos) << err_;
  EXPECT_EQ(call(fmt::format("run {} -o {} --no-figures --quiet --resume", scene, out)), 0) << err_;
}

}  // namespace
}  // namespace interstice::testing
