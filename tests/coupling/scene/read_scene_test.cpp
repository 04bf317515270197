// A scene file becomes the typed Scene it describes; overrides; the resolved text; the scenes that come with
// the tool.
#include "coupling/scene/read_scene.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/error.h"
#include "coupling/scene/write_scene.h"
#include "tests/coupling/scene/example_scene.h"

namespace interstice::scene {
namespace {

Scene read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_scene_text(text, "x.toml", overrides);
}

std::string message_of(const std::string& text, const std::vector<std::string>& overrides) {
  try {
    read(text, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(ReadScene, TheExampleSaysWhatItSays) {
  const Scene scene = read(kExampleScene);
  EXPECT_EQ(scene.file, "x.toml");
  EXPECT_EQ(scene.title, "Example");
  EXPECT_EQ(scene.domain.box, (Box{{0, -0.5e-3, 0}, {2e-3, 0.5e-3, 3e-3}}));
  EXPECT_EQ(scene.domain.boundary, (std::array{Boundary::open, Boundary::wall, Boundary::open}));
  EXPECT_EQ(scene.domain.wall_material, (std::array<std::string, 3>{"", "steel", ""}));
  EXPECT_EQ(scene.domain.gravity, (Vec3d{0, 0, -9.81}));
  ASSERT_EQ(scene.materials.size(), 2u);
  EXPECT_EQ(scene.materials[1], (Material{"steel", 7800, 1e9, 0.29}));
  EXPECT_EQ(scene.contact.tangential, TangentialLaw::mindlin);
  EXPECT_EQ(scene.contact.rolling, RollingLaw::cdt);
  EXPECT_EQ(scene.contact.cohesion, CohesionLaw::sjkr);
  ASSERT_EQ(scene.contact.pairs.size(), 2u);
  EXPECT_EQ(scene.contact.pairs[1], (ContactPair{.materials = {"steel", "powder"},
                                                 .restitution = 0.35,
                                                 .friction = 0.9,
                                                 .rolling_friction = 0.006,
                                                 .cohesion_energy_density = 1e4}));
  ASSERT_EQ(scene.particles.size(), 1u);
  const Particles& feed = scene.particles[0];
  EXPECT_EQ(feed.count, 1000);
  EXPECT_EQ(feed.diameter.law, SizeLaw::normal);
  EXPECT_EQ(feed.diameter.mean, 39.4e-6);
  EXPECT_EQ(feed.diameter.max, 65e-6);
  ASSERT_TRUE(feed.rain);
  EXPECT_EQ(feed.rain->interval, 0.5e-3);
  ASSERT_EQ(scene.walls.size(), 2u);
  EXPECT_EQ(std::get<Plane>(scene.walls[0].shape), (Plane{{0, 0, 0}, {0, 0, 1}}));
  EXPECT_TRUE(scene.walls[0].watch);
  EXPECT_EQ(scene.walls[1].motion, (std::vector{Motion{"spread", {0.05, 0, 0}}}));
  ASSERT_EQ(scene.phases.size(), 2u);
  EXPECT_TRUE(scene.phases[0].until_inserted && scene.phases[0].until_settled);
  EXPECT_EQ(scene.phases[0].at_most, 0.1);
  EXPECT_EQ(scene.phases[1].duration, 0.04);
  EXPECT_EQ(scene.seed, 7u);
  EXPECT_EQ(scene.output, (Output{0.01, 1e-4, 60}));
  ASSERT_EQ(scene.fields.size(), 1u);
  EXPECT_EQ(scene.fields[0].voxel, 17.3e-6);
  EXPECT_EQ(scene.fields[0].lines, (std::vector{Line{1, {1e-3, 0, 35e-6}}}));
  EXPECT_EQ(scene.fields[0].layers, (FieldLayers{0, 70e-6, {20, 5}}));
}

TEST(ReadScene, WhatIsNotSaidIsTheDefaultOfTheStructs) {
  const Scene scene = read(R"(
domain = { box = [["0 m", "1 m"], ["0 m", "1 m"], ["0 m", "1 m"]] }
phases = [{ name = "only", until = { settled = true, at_most = "1 s" } }]
fields = [{ name = "f", voxel = "1 cm", box = [["0 m", "1 m"], ["0 m", "1 m"], ["0 m", "0.5 m"]] }]
)");
  Domain domain;
  domain.box = {{0, 0, 0}, {1, 1, 1}};
  EXPECT_EQ(scene.domain, domain);
  EXPECT_EQ(scene.contact, Contact{});
  EXPECT_EQ(scene.step, TimeStep{});
  EXPECT_EQ(scene.seed, Scene{}.seed);
  EXPECT_EQ(scene.output, Output{});
  Phase phase;
  phase.name = "only";
  phase.until_settled = true;
  phase.at_most = 1;
  EXPECT_EQ(scene.phases, std::vector{phase});
  Field field;
  field.name = "f";
  field.voxel = 0.01;
  field.box = {{0, 0, 0}, {1, 1, 0.5}};
  field.layers.z_hi = 0.5;
  EXPECT_EQ(scene.fields, std::vector{field});
  EXPECT_TRUE(scene.particles.empty());
}

TEST(ReadScene, AGrainThatIsAloneNeedsNoPairWithItself) {
  const std::string text = R"(
materials = { a = { density = "1 g/cm^3", youngs_modulus = "1 GPa", poisson_ratio = 0 } }
domain = { box = [["0 m", "1 m"], ["0 m", "1 m"], ["0 m", "1 m"]] }
phases = [{ name = "only", duration = "1 ms" }]
[[particles]]
name = "p"
material = "a"
insert = { method = "list", csv = "x [m], y [m], z [m], diameter [mm]\n0.5, 0.5, 0.5, 1\n" }
)";
  EXPECT_EQ(read(text).particles[0].count, 1);
  const std::string two = replaced(text, "0.5, 0.5, 0.5, 1\\n", "0.5, 0.5, 0.5, 1\\n0.1, 0.5, 0.5, 1\\n");
  EXPECT_NE(message_of(two, {}).find("a and a can meet"), std::string::npos);
}

TEST(Overrides, ReachEverythingByNameOrIndex) {
  const Scene scene = read(
      kExampleScene,
      {"particles.feed.count=12", "walls.blade.motion.0.velocity=[\"1 m/s\", \"0 m/s\", \"0 m/s\"]",
       "walls.0.watch=false", "contact.pair.powder-steel.friction=0.5", "contact.pair.0.restitution=40 %",
       "time.step = 8ns", "title=free text = fine", "particles.feed.diameter.mean=30um",
       "domain.gravity.2=0 m/s^2", "fields.layer.slices=[]", "output.series=1ms", "output.series=2ms"});
  EXPECT_EQ(scene.particles[0].count, 12);
  EXPECT_EQ(scene.walls[1].motion[0].velocity, (Vec3d{1, 0, 0}));
  EXPECT_FALSE(scene.walls[0].watch);
  EXPECT_EQ(scene.contact.pairs[1].friction, 0.5);
  EXPECT_EQ(scene.contact.pairs[0].restitution, 0.4);
  EXPECT_EQ(scene.step.fixed, 8e-9);
  EXPECT_EQ(scene.title, "free text = fine");
  EXPECT_EQ(scene.particles[0].diameter.mean, 30e-6);
  EXPECT_EQ(scene.domain.gravity.z, 0);
  EXPECT_TRUE(scene.fields[0].slices.empty());
  EXPECT_EQ(scene.output.series, 2e-3);  // the last one holds
  // a section that the file does not have
  EXPECT_EQ(read("domain = { box = [[\"0 m\", \"1 m\"], [\"0 m\", \"1 m\"], [\"0 m\", \"1 m\"]] }\n"
                 "phases = [{ name = \"a\", duration = \"1 s\" }]",
                 {"time.seed=5"})
                .seed,
            5u);
}

TEST(Sleeping, NeedsGravity) {
  const std::string message = message_of(kExampleScene, {"time.sleeping=true", "domain.gravity.2=0 m/s^2"});
  EXPECT_NE(message.find("time.sleeping: is true, and there is no gravity"), std::string::npos) << message;
}

TEST(ShortSteps, ExcludeSleepAndTheAccountOfEnergies) {
  const std::string below = "time.short_steps_below=20 um";
  EXPECT_EQ(read(kExampleScene, {below}).step.short_below, 20e-6);
  EXPECT_EQ(read(kExampleScene).step.short_below, std::nullopt);
  for (const char* other : {"time.sleeping=true", "output.energy=true"}) {
    const std::string message = message_of(kExampleScene, {below, other});
    EXPECT_NE(message.find("time.short_steps_below: does not go with"), std::string::npos) << message;
  }
}

TEST(Overrides, AreValidatedAndNamedInMessages) {
  const std::pair<std::string, std::string> rows[] = {
      {"particles.feed.count=0", "--set particles.feed.count=0: particles.feed.count: 0 cannot be"},
      {"particles.food.count=5", "particles: has no element \"food\"; its elements are feed; use one"},
      {"walls.7.watch=true", "has no element \"7\"; its elements are substrate, blade"},
      {"particles.feed.conut=5", "unknown key"},
      {"title.x=5", "title: is a text and has nothing named \"x\" inside"},
      {"time.step=8", "8 has no unit; a time is due"},
      {"time.sleep_tolerance=0.5", "--set time.sleep_tolerance=0.5: time.sleep_tolerance: 0.5 cannot be"},
      {"time.short_steps_below=0 um", "time.short_steps_below: 0 m cannot be"},
      {"time.sleep_tolerance=0", "time.sleep_tolerance: 0 cannot be"},
      {"title", "is not an assignment"},
      {"=5", "is not an assignment"},
      {"a..b=5", "is not an assignment"},
      {"title=[1", "not valid TOML"},
      {"title=\"x", "not valid TOML"},
      {"title=a\nb=3", "control characters"},
      {"time.seed=", "time.seed: is a text"},
  };
  for (const auto& [override_text, fragment] : rows) {
    const std::string message = message_of(kExampleScene, {override_text});
    EXPECT_NE(message.find(fragment), std::string::npos) << override_text << " gave: " << message;
    EXPECT_EQ(message.rfind("--set ", 0), 0u) << message;
  }
}

void expect_same_after_resolving(const Scene& scene) {
  const std::string text = resolved_toml(scene);
  Scene back = read_scene_text(text, "resolved.toml");
  back.file = scene.file;
  EXPECT_TRUE(back == scene) << text;
  EXPECT_EQ(resolved_toml(back), text);
}

TEST(Resolved, ReadsBackBitForBit) {
  expect_same_after_resolving(read(kExampleScene));
  const std::string curve =
      "{ distribution = \"normal\", mean = \"39.4 um\", sd = \"10.5 um\", min = \"5 um\", max = \"65 um\" }";
  for (const std::string other :
       {"\"40 um\"", "{ distribution = \"single\", mean = \"33.3 um\" }",
        "{ distribution = \"uniform\", min = \"5 um\", max = \"65 um\", weight = \"mass\" }",
        "{ distribution = \"lognormal\", median = \"30 um\", sigma = 0.3, min = \"5 um\", max = \"65 um\" }",
        "{ distribution = \"bimodal\", mean = \"10 um\", sd = \"1 um\", mean2 = \"40 um\", sd2 = \"7 um\", "
        "share2 = "
        "0.7, min = \"5 um\", max = \"65 um\" }",
        "{ distribution = \"table\", diameters = [\"5 um\", \"17 um\", \"65 um\"], shares = [0, 1e-3] }"})
    expect_same_after_resolving(read(replaced(kExampleScene, curve, other)));
  expect_same_after_resolving(
      read(kExampleScene, {"time.step=8.7 ns", "title=\"quote \\\" back \\\\ line\\nend \\u0001\"",
                           "walls.0.shape.plane.normal=[0.1, -0.0, 3.3]",
                           "walls.0.shape.plane.point=[\"-0 m\", \"0 m\", \"0 m\"]"}));
  expect_same_after_resolving(read(kExampleScene, {"time.short_steps_below=17.3 um"}));
  expect_same_after_resolving(read(kExampleScene, {"output.energy=true", "time.allow_unstable=true",
                                                   "time.sleeping=true", "time.sleep_tolerance=0.01",
                                                   "walls.1.shape={box={lo=[\"0.1 mm\",\"0 m\",\"0 m\"],"
                                                   "hi=[\"0.3 mm\",\"1 mm\",\"1 mm\"]}}"}));
}

TEST(Resolved, NormalsAreUnitVectorsAndStay) {
  for (int i = 1; i < 200; ++i) {
    const std::string normal =
        fmt::format("walls.0.shape.plane.normal=[{}, {}, {}]", 0.37 * i, -1.0 / i, i % 7 + 0.1);
    const Scene scene = read(kExampleScene, {normal});
    EXPECT_NEAR(norm(std::get<Plane>(scene.walls[0].shape).normal), 1, 1e-15);
    expect_same_after_resolving(scene);
  }
  const Scene tiny = read(kExampleScene, {"walls.0.shape.plane.normal=[0, 3e-200, 4e-200]"});
  EXPECT_NEAR(std::get<Plane>(tiny.walls[0].shape).normal.z, 0.8, 1e-15);
}

TEST(DataScenes, AllAreGoodAndResolve) {
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(INTERSTICE_SOURCE_DIR "/data/scenes")) {
    if (entry.path().extension() != ".toml") continue;
    ++scenes;
    std::vector<std::string> warnings;
    try {
      expect_same_after_resolving(read_scene(entry.path().string(), {}, &warnings));
    } catch (const InputError& error) {
      ADD_FAILURE() << error.what();
    }
    EXPECT_TRUE(warnings.empty()) << warnings.front();
  }
  EXPECT_GE(scenes, 6);
}

}  // namespace
}  // namespace interstice::scene
