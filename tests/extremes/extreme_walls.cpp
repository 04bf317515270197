// Walls at 10 m/s and steps in which they cover a part of a grain, or several; skins; fast grains.
#include "tests/extremes/support.h"

namespace interstice::dem {
namespace {

using namespace testing;

const double kRadius = 20e-6;
const Material kSteel{8200, 1e9, 0.3};

/// 64 grains before a box (or a plane) that comes at 10 m/s in steps of `share` of a radius until it has
/// swept them all; how many it has passed, or -1 where the run was refused.
int swept_past(bool box, double share, double thickness, double skin, const BackEnd& b) {
  const double speed = 10;
  Model m =
      open_model(kSteel, {.restitution = 0.35, .friction = 0.3}, {.tangential = TangentialLaw::mindlin}, 1);
  m.walls = {{box ? Shape{Box{{-thickness, -1, -1}, {0, 1, 1}}} : Shape{Plane{{0, 0, 0}, {1, 0, 0}}}, 0}};
  SimulationOptions options = b.options;
  options.skin = skin;
  Simulation sim(m, share * kRadius / speed, options);
  std::vector<NewGrain> grains;
  for (int i = 0; i < 64; ++i)
    grains.push_back(grain({kRadius * (2 + 2.37 * (i % 8)), 2.37 * kRadius * (i / 8), 0}, kRadius));
  sim.add_grains(grains);
  sim.set_wall_velocity(0, {speed, 0, 0});
  const double path = 40 * kRadius;
  try {
    sim.advance(static_cast<std::int64_t>(path / (share * kRadius)));
  } catch (const UnstableError&) {
    return -1;
  }
  const double front = 10 * sim.time();
  int passed = 0;
  for (const double x : columns(sim).x) passed += x > front ? 0 : 1;
  return passed;
}

TEST(FastWalls, PassNoGrain) {
  for (const bool box : {true, false}) {
    for (const double share : {1e-3, 0.01, 0.05, 0.1, 0.2, 0.5}) {
      std::string outcome;
      bool right = true;
      for (const BackEnd& b : back_ends()) {
        const int passed = swept_past(box, share, 10 * kRadius, 0, b);
        outcome +=
            fmt::format("{}{} ({})", outcome.empty() ? "" : ", ",
                        passed < 0 ? "refused" : fmt::format("{} of 64 grains passed", passed), b.name);
        right = right && passed <= 0;
      }
      expect_outcome(
          "wall at 10 m/s",
          fmt::format("{}, {:g} of a radius a step, sweeping 64 grains", box ? "box" : "plane", share),
          outcome, right);
    }
  }
}

TEST(FastWalls, OfAThinBladePassNoGrainUnlessRefused) {
  // A blade of two radii: from a radius a step on it could hop over a grain unseen; a run refuses a wall that
  // covers half the smallest grain in a step before it starts, so half is what must hold here.
  for (const double share : {0.05, 0.2, 0.5}) {
    const int passed = swept_past(true, share, 2 * kRadius, 0, back_ends()[0]);
    expect_outcome("thin blade at 10 m/s", fmt::format("2 radii thick, {:g} of a radius a step", share),
                   passed < 0 ? "refused" : fmt::format("{} of 64 grains passed", passed), passed <= 0);
  }
}

TEST(FastWalls, WhateverTheSkin) {
  // Bits do not depend on the skin, even where a wall covers many skins in a step.
  for (const BackEnd& b : back_ends()) {
    std::vector<GrainColumns> all;
    for (const double skin : {0.0, 1e-9, 1e-7, 1e-5, 1e-3}) {
      Model m = open_model(kSteel, {.restitution = 0.35, .friction = 0.3},
                           {.tangential = TangentialLaw::mindlin}, 1);
      m.walls = {{Box{{-1e-3, -1, -1}, {0, 1, 1}}, 0}};
      SimulationOptions options = b.options;
      options.skin = skin;
      Simulation sim(m, 2e-8, options);
      std::vector<NewGrain> grains;
      for (int i = 0; i < 27; ++i)
        grains.push_back(
            grain({kRadius * (2 + 2.2 * (i % 3)), 2.2 * kRadius * (i / 3 % 3), 2.2 * kRadius * (i / 9)},
                  kRadius * (0.6 + 0.05 * (i % 7))));
      sim.add_grains(grains);
      sim.set_wall_velocity(0, {10, 0, 0});
      sim.advance(1500);
      all.push_back(columns(sim));
    }
    bool same = true;
    for (const GrainColumns& c : all)
      same = same && c.x == all[0].x && c.vz == all[0].vz && c.wy == all[0].wy;
    expect_outcome("skin", fmt::format("1 nm to 1 mm and chosen, wall at 10 m/s ({})", b.name),
                   same ? "the same bits" : "differs", same);
  }
}

TEST(FastGrains, AreRefusedFromHalfARadiusAStepOn) {
  for (const double share : {0.1, 0.3, 0.49, 0.51, 1.0, 10.0, 1e6}) {
    for (const BackEnd& b : back_ends()) {
      Simulation sim(open_model(kSteel, {}, {}, 1e3), 1e-7, b.options);
      const double v = share * kRadius / 1e-7;
      sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0}, kRadius, {v, 0, 0}),
                                           grain({20.3 * kRadius, 0, 0}, kRadius)});
      std::string outcome;
      try {
        sim.advance(1000);
        outcome = columns(sim).vx[1] > 0 ? "collides" : "MISSED the grain ahead";
      } catch (const UnstableError&) {
        outcome = "refused";
      }
      expect_outcome("fast grain", fmt::format("{:g} radii a step towards another ({})", share, b.name),
                     outcome, outcome == (share > 0.5 ? "refused" : "collides") || outcome == "refused");
    }
  }
}

TEST(FastGrains, DoNotLeaveAPeriodicBox) {
  // Head on through the faces, at 0.4 radii a step, with a partner on the other side.
  expect_small("periodic box", "a grain round the box a thousand times, 0.4 radii a step",
               "position is x0 + v t within", 1e-9, 1e-9, [](const BackEnd& b) {
                 Model m = open_model(kSteel, {}, {}, 10 * kRadius);
                 m.boundary.fill(AxisBoundary::periodic);
                 Simulation sim(m, 1e-7, b.options);
                 const double v = 0.4 * kRadius / 1e-7;
                 sim.add_grains(std::vector<NewGrain>{grain({0, 0, 0}, kRadius, {v, 0.5 * v, -0.25 * v})});
                 sim.advance(50000);  // 20000 radii: 1000 boxes
                 const GrainColumns c = columns(sim);
                 const double edge = 20 * kRadius;
                 const auto off = [&](double p) { return std::fabs(p / edge - std::round(p / edge)); };
                 return std::max({off(c.x[0]), off(c.y[0]), off(c.z[0])});
               });
}

}  // namespace
}  // namespace interstice::dem
