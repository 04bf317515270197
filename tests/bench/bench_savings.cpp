// Do beds and layers come to the same answer when steps leave out what they can, and how much sooner?
//
//     bench_savings sleep|rates [SEEDS [bed|bed-sjkr|layer]]
//
// `sleep`: grains at rest sleep; `rates`: only grains below 20 um take the steps that the smallest, of 5 um,
// need. Contacts are chaotic in time, so single grains end elsewhere: means over beds of several seeds are
// compared, from the same starts with the saving and without. A difference within 3 standard errors of the
// two means counts as agreement.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "base/random.h"
#include "dem/simulation.h"
#include "dem/statistics.h"
#include "tests/bench/timing.h"

namespace interstice::dem {
namespace {

constexpr double kMean = 39.4e-6, kDeviation = 10.46e-6, kLargest = 65e-6;  // diameters [m]

/// How a scene is run.
struct Way {
  double smallest;  // diameter [m]
  double step;      // [s]: the same share of the Rayleigh time of the smallest that takes it
  SimulationOptions options;
};
struct Saving {
  const char *plain_name, *name;
  Way plain, with;
};
const Saving kSleep{"awake", "sleeping", {20e-6, 2e-7, {}}, {20e-6, 2e-7, {.sleep_tolerance = 0.05}}};
const Saving kTwoRates{"one step", "two rates", {5e-6, 5e-8, {}}, {5e-6, 2e-7, {.rates = {10e-6, 4}}}};

struct Number {
  std::string name;
  double value;
};
using Numbers = std::vector<Number>;

/// Powder of 10 MPa with the cohesion that keeps the pull-off force of 1 MJ/m^3 at 1 GPa, on a floor.
Model powder_on_floor(bool cohesion) {
  Model m;
  m.materials = {{8200, 1e7, 0.3}, {8200, 1e7, 0.3}};
  const double k = cohesion ? 46.4e3 : 0;  // [J/m^3]
  const PairCoefficients powder{0.35, 0.3, 0.005, k}, wall{0.35, 0.9, 0.005, k};
  m.pairs = {powder, wall, wall, powder};
  m.laws = {.tangential = TangentialLaw::mindlin,
            .rolling = RollingLaw::cdt,
            .cohesion = cohesion ? CohesionLaw::sjkr : CohesionLaw::none};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::periodic, AxisBoundary::open};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 1}};
  return m;
}

double normal_diameter(double smallest, Random& random) {
  for (;;) {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += random.uniform(0, 1);
    const double d = kMean + kDeviation * sum;
    if (d >= smallest && d <= kLargest) return d;
  }
}

/// Grains in cells wider than the largest, in a box that grows upward.
std::vector<NewGrain> loose_grains(std::size_t count, double smallest, double x0, double length, double width,
                                   std::uint64_t seed) {
  Random random(seed, 0);
  std::vector<NewGrain> grains;
  const auto nx = static_cast<std::size_t>(length / kLargest),
             ny = static_cast<std::size_t>(width / kLargest);
  const double cx = length / static_cast<double>(nx), cy = width / static_cast<double>(ny);
  for (std::size_t i = 0; i < count; ++i) {
    NewGrain g;
    g.radius = 0.5 * normal_diameter(smallest, random);
    const auto at = [&](std::size_t n, double cell) {
      return static_cast<double>(n) * cell + random.uniform(g.radius, cell - g.radius);
    };
    g.position = {x0 + at(i % nx, cx), at(i / nx % ny, cy), at(i / nx / ny, kLargest)};
    grains.push_back(g);
  }
  return grains;
}

double weight(const std::vector<GrainRow>& rows) {
  double sum = 0;
  for (const GrainRow& g : rows) sum += 9.81 * g.mass;
  return sum;
}

/// Volume of a sphere below a plane at height h above its centre.
double volume_below(double r, double h) {
  const double t = std::clamp(h + r, 0.0, 2 * r);
  return M_PI * t * t * (r - t / 3);
}

double solid_between(const std::vector<GrainRow>& rows, double z0, double z1) {
  double sum = 0;
  for (const GrainRow& g : rows) sum += volume_below(g.radius, z1 - g.z) - volume_below(g.radius, z0 - g.z);
  return sum;
}

double coordination(const Simulation& sim) {
  return 2 * static_cast<double>(contact_statistics(sim).contacts) / static_cast<double>(sim.grains());
}

double seconds_to(Simulation& sim, double time) {
  return bench::timed([&] {
           while (sim.time() < time) sim.advance(2000);
         })
      .processor;
}

double share_asleep(const Simulation& sim) {
  return static_cast<double>(sim.grains_asleep()) / static_cast<double>(sim.grains());
}

/// 400 grains fall on 0.25 mm x 0.25 mm and come to rest.
Numbers bed(bool cohesion, std::uint64_t seed, const Way& way) {
  constexpr double side = 0.25e-3;
  Model m = powder_on_floor(cohesion);
  m.domain = {{0, 0, -1e-4}, {side, side, 1e-2}};
  Simulation sim(m, way.step, way.options);
  sim.add_grains(loose_grains(400, way.smallest, 0, side, side, seed));
  const double settling = seconds_to(sim, 50e-3);
  const double rest = seconds_to(sim, 65e-3);
  const auto rows = sim.rows();
  const double lo = 50e-6, hi = 200e-6;
  return {{"solid fraction, 50 to 200 um above the floor",
           solid_between(rows, lo, hi) / ((hi - lo) * side * side)},
          {"coordination", coordination(sim)},
          {"normal force, mean [nN]", 1e9 * contact_statistics(sim).normal_force_mean},
          {"load on the floor / weight", wall_statistics(sim, 0).normal_force / weight(rows)},
          {"asleep at the end / grains", share_asleep(sim)},
          {"processor seconds, 0 to 50 ms", settling},
          {"processor seconds, 50 to 65 ms", rest}};
}

/// A blade spreads a heap of 500 grains 70 um high along a floor 0.26 mm wide, then all stands still.
Numbers layer(std::uint64_t seed, const Way& way) {
  constexpr double width = 0.26e-3, gap = 70e-6, from = 0.4e-3, to = 1.0e-3;
  Model m = powder_on_floor(true);
  m.domain = {{-1e-3, 0, -1e-4}, {3e-3, width, 1e-2}};
  m.boundary[0] = AxisBoundary::open;
  m.walls.push_back({Box{{-0.1e-3, -1, gap}, {0, 2, 1e-2}}, 1});
  m.walls.push_back({Plane{{-0.1e-3, 0, 0}, {1, 0, 0}}, 1});
  m.walls.push_back({Plane{{2e-3, 0, 0}, {-1, 0, 0}}, 1});
  Simulation sim(m, way.step, way.options);
  sim.add_grains(loose_grains(500, way.smallest, 5e-6, 0.6e-3, width, seed));
  const double pour = seconds_to(sim, 20e-3);
  sim.set_wall_velocity(1, {0.05, 0, 0});
  const double spread = seconds_to(sim, 50e-3);
  sim.set_wall_velocity(1, {0, 0, 0});
  const double rest = seconds_to(sim, 80e-3);
  std::vector<GrainRow> deposited;
  for (const GrainRow& g : sim.rows())
    if (g.x >= from && g.x < to) deposited.push_back(g);
  return {{"solid fraction below the gap", solid_between(deposited, 0, gap) / (gap * (to - from) * width)},
          {"coordination", coordination(sim)},
          {"normal force, mean [nN]", 1e9 * contact_statistics(sim).normal_force_mean},
          {"load on the floor / weight", wall_statistics(sim, 0).normal_force / weight(sim.rows())},
          {"asleep at the end / grains", share_asleep(sim)},
          {"processor seconds, pouring", pour},
          {"processor seconds, spreading", spread},
          {"processor seconds, 30 ms of rest", rest}};
}

struct Spread {
  double mean = 0, deviation = 0;
};

Spread spread_of(const std::vector<Numbers>& runs, std::size_t i) {
  Spread s;
  const auto n = static_cast<double>(runs.size());
  for (const Numbers& r : runs) s.mean += r[i].value / n;
  for (const Numbers& r : runs) s.deviation += (r[i].value - s.mean) * (r[i].value - s.mean) / (n - 1);
  s.deviation = std::sqrt(s.deviation);
  return s;
}

void compare(const Saving& saving, const std::string& title, int seeds,
             const std::function<Numbers(std::uint64_t, const Way&)>& run) {
  std::vector<Numbers> plain, with;
  for (int seed = 1; seed <= seeds; ++seed) {
    plain.push_back(run(static_cast<std::uint64_t>(seed), saving.plain));
    with.push_back(run(static_cast<std::uint64_t>(seed), saving.with));
  }
  fmt::print("\n| {} | {} | {} | difference in standard errors |\n|---|---|---|---|\n", title,
             saving.plain_name, saving.name);
  for (std::size_t i = 0; i < plain[0].size(); ++i) {
    const Spread a = spread_of(plain, i), b = spread_of(with, i);
    if (a.mean == 0 && b.mean == 0) continue;  // nobody sleeps
    const double error = std::sqrt((a.deviation * a.deviation + b.deviation * b.deviation) / seeds);
    fmt::print("| {} | {:.4g} ({:.2g}) | {:.4g} ({:.2g}) | {:+.1f} |\n", plain[0][i].name, a.mean,
               a.deviation, b.mean, b.deviation, error > 0 ? (b.mean - a.mean) / error : 0);
  }
}

int main(int count, char** words) {
  const std::string which = count > 1 ? words[1] : "", part = count > 3 ? words[3] : "";
  if (which != "sleep" && which != "rates") {
    fmt::print(stderr, "bench_savings sleep|rates [SEEDS [bed|bed-sjkr|layer]]\n");
    return 2;
  }
  const Saving& saving = which == "sleep" ? kSleep : kTwoRates;
  const int seeds = count > 2 ? std::atoi(words[2]) : 4;
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const auto wanted = [&](const char* name) { return part.empty() || part == name; };
  for (const bool cohesion : {false, true})
    if (wanted(cohesion ? "bed-sjkr" : "bed"))
      compare(saving, cohesion ? "bed, SJKR" : "bed, no cohesion", seeds,
              [&](std::uint64_t seed, const Way& way) { return bed(cohesion, seed, way); });
  if (wanted("layer")) compare(saving, "layer spread by a blade", seeds, layer);
  return 0;
}

}  // namespace
}  // namespace interstice::dem

int main(int count, char** words) { return interstice::dem::main(count, words); }
