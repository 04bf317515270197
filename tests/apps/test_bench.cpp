// `interstice bench`: its beds must be at rest, or what is timed on them means nothing. Equal frictional
// spheres that settle under their weight touch four to six others on average (4 where friction is infinite, 6
// without it: Silbert et al., Phys. Rev. E 65, 031304, 2002), the twentieth of them that rattle left out, and
// the floor carries them all.
#include <nlohmann/json.hpp>

#include "command_test.h"

namespace interstice::testing {
namespace {

using Json = nlohmann::json;

class Bench : public CommandTest {
 protected:
  Json bench(const std::string& options) const {
    const Outcome r = interstice("bench --blocks 2 --steps 10 " + options);
    EXPECT_EQ(r.status, 0) << r.err;
    return r.status == 0 ? Json::parse(r.out) : Json();
  }
};

void expect_at_rest(const Json& state) {
  EXPECT_GT(state["coordination"], 4.0 * (1 - 0.05));
  EXPECT_LT(state["coordination"], 5.0);
  EXPECT_NEAR(state["floor_force_over_weight"], 1, 0.15);  // what is left of the bed's swinging
  EXPECT_LT(state["kinetic_energy_over_mgd"], 1e-4);       // a tenth of what scenes call settled
}

TEST_F(Bench, MadeBedsAreAtRestWrittenAndReadBackToo) {
  const std::string bed = at("bed.dump");
  const Json made = bench("--sizes equal --grains 1458 --write-bed '" + bed + "'")["steps"];
  EXPECT_EQ(made["grains"], 1458);
  expect_at_rest(made["before"]);
  expect_at_rest(made["after"]);

  // Nothing but positions and radii is in the file: friction has to build up anew, and few contacts may go.
  const Json read = bench("--bed '" + bed + "' --periodic --warm-up 2000")["steps"];
  expect_at_rest(read["before"]);
  EXPECT_NEAR(read["before"]["coordination"], made["before"]["coordination"], 0.1);

  const Json copies = bench("--bed '" + bed + "' --grains 6000")["steps"];
  EXPECT_EQ(copies["grains"], 4 * 1458);
  EXPECT_DOUBLE_EQ(copies["before"]["coordination"], made["before"]["coordination"]);
  EXPECT_DOUBLE_EQ(
      copies["ns_per_contact_step"].get<double>(),
      copies["ns_per_particle_step"].get<double>() / copies["before"]["contacts_per_grain"].get<double>());
}

/// Grains of two materials, as stiff and heavy as one, lie as well, and friction that is three times as high
/// lets no contact go.
TEST_F(Bench, GrainsOfTwoMaterialsStayAtRest) {
  const Json one = bench("--sizes equal --grains 1458")["steps"],
             two = bench("--sizes equal --grains 1458 --two-materials")["steps"];
  EXPECT_EQ(two["two_materials"], true);
  expect_at_rest(two["after"]);
  EXPECT_NEAR(two["after"]["coordination"], one["after"]["coordination"], 0.05);
  EXPECT_NE(two["after"]["kinetic_energy_over_mgd"], one["after"]["kinetic_energy_over_mgd"]);
}

/// The smallest grain of this cell decides: as many short steps as it is smaller than the limit, whole ones.
TEST_F(Bench, SmallGrainsMayTakeShorterSteps) {
  const std::string bed = at("bed.csv");
  std::ofstream(bed) << "x,y,z,radius\n2e-4,2e-4,50e-6,50e-6\n2e-4,3e-4,20e-6,20e-6\n2e-4,4e-4,6e-6,6e-6\n";
  const Json one = bench("--bed '" + bed + "'")["steps"],
             two = bench("--bed '" + bed + "' --short-steps-below 30um")["steps"];
  EXPECT_EQ(one["short_steps"], 1);
  EXPECT_EQ(two["short_steps"], 3);  // 20 um over 6 um
  EXPECT_DOUBLE_EQ(two["time_step_s"].get<double>(), 3 * one["time_step_s"].get<double>());
  EXPECT_DOUBLE_EQ(
      two["simulated_us_per_s"].get<double>(),
      two["particle_steps_per_s"]["median"].get<double>() / 3 * two["time_step_s"].get<double>() * 1e6);
  const Outcome refused = interstice("bench --bed '" + bed + "' --short-steps-below 10um");
  EXPECT_EQ(refused.status, 2);
  EXPECT_NE(refused.err.find("no grain is below it, the smallest has 12 um"), std::string::npos)
      << refused.err;
}

TEST_F(Bench, WhatCannotBeMeasuredIsRefused) {
  for (const auto& [options, words] : {std::pair{"--sizes huge", "--sizes huge is not known; one of powder"},
                                       {"--blocks 0", "at least 1"},
                                       {"--warm-up -1", "at least 0"},
                                       {"--bed nowhere.dump", "nowhere.dump"},
                                       {"--short-steps-below 20", "20 has no unit"}}) {
    const Outcome r = interstice(std::string("bench ") + options);
    EXPECT_EQ(r.status, 2) << options;
    EXPECT_NE(r.err.find(words), std::string::npos) << r.err;
  }
}

}  // namespace
}  // namespace interstice::testing
