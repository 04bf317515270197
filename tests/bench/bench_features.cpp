// What each contact feature costs, on one packed bed:
//   bench_features make BED              settles the bed and writes it
//   bench_features table BED             a row per combination: time per particle-step, bytes per particle
//   bench_features names                 the combinations
//   bench_features count BED NAME STEPS  steps that one only, for an instruction counter, and prints how many
//                                        contacts and listed pairs it evaluated
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

#include "base/error.h"
#include "base/random.h"
#include "dem/packing.h"
#include "dem/simulation.h"
#include "dem/statistics.h"
#include "dem/time_step.h"

namespace interstice::dem {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kCell = 800;  // grains in the periodic cell that is settled
constexpr Vec3d kCellSize{0.3e-3, 0.3e-3, 1.5e-3};
constexpr int kTiles = 4;  // copies along x and along y
constexpr int kRounds = 7, kStepsPerRound = 60;

struct Combination {
  const char* name;
  Laws laws;
};

const std::vector<Combination>& combinations() {
  using enum CohesionLaw;
  constexpr auto hertz = NormalLaw::hertz;
  constexpr auto no_friction = TangentialLaw::none;
  constexpr auto mindlin = TangentialLaw::mindlin;
  constexpr auto no_rolling = RollingLaw::none;
  static const std::vector<Combination> all = {
      {"hooke", {NormalLaw::hooke, false, no_friction, no_rolling, none}},
      {"hooke+slider", {NormalLaw::hooke, false, TangentialLaw::slider, no_rolling, none}},
      {"hertz", {hertz, false, no_friction, no_rolling, none}},
      {"hertz+clipped", {hertz, true, no_friction, no_rolling, none}},
      {"hertz+jkr", {hertz, false, no_friction, no_rolling, jkr}},
      {"hertz+mindlin", {hertz, false, mindlin, no_rolling, none}},
      {"hertz+mindlin+cdt", {hertz, false, mindlin, RollingLaw::cdt, none}},
      {"hertz+mindlin+epsd2", {hertz, false, mindlin, RollingLaw::epsd2, none}},
      {"hertz+mindlin+cdt+sjkr", {hertz, false, mindlin, RollingLaw::cdt, sjkr}},
      {"hertz+mindlin+cdt+dmt", {hertz, false, mindlin, RollingLaw::cdt, dmt}},
      {"hertz+mindlin+cdt+vdw", {hertz, false, mindlin, RollingLaw::cdt, van_der_waals}},
      {"hertz+mindlin+cdt+jkr", {hertz, false, mindlin, RollingLaw::cdt, jkr}},
      {"hertz+mindlin+cdt+sjkr+clipped", {hertz, true, mindlin, RollingLaw::cdt, sjkr}},  // generic kernel
  };
  return all;
}

Model bed_model(const Laws& laws, const Vec3d& size) {
  Model m;
  m.domain = {{0, 0, -1e-3}, {size.x, size.y, size.z + 5e-3}};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::periodic, AxisBoundary::open};
  m.gravity = {0, 0, -981};  // pressed, so that contacts stay closed whatever the laws
  m.materials = {{8200, 1e7, 0.3}};
  PairCoefficients pair{.restitution = 0.35, .friction = 0.3, .rolling_friction = 0.005};
  pair.cohesion_energy_density = 46.4e3;  // 1 MJ/m^3 at 1 GPa, scaled to 10 MPa
  pair.work_of_adhesion = 1.4e-4;  // of about the pull-off force that sjkr has here
  pair.hamaker_constant = 65e-21, pair.cutoff = 0.4e-9, pair.range = 40e-9;
  pair.stiffness = 50;  // the tangent stiffness of hertz at an overlap of 2 um
  m.pairs = {pair};
  m.laws = laws;
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  return m;
}

double fine_step(const std::vector<NewGrain>& grains, const Model& m) {
  double smallest = INFINITY;
  for (const NewGrain& g : grains) smallest = std::min(smallest, g.radius);
  return 0.1 * rayleigh_time(smallest, m.materials[0]);
}

/// Box & Muller (1958).
double normal(Random& random) {
  return std::sqrt(-2 * std::log(random.uniform())) * std::cos(2 * M_PI * random.uniform());
}

/// A settled bed of paper 004's powder, cut at 15 um: made once with friction and weight, so that every combination steps
/// the very same contacts.
std::vector<NewGrain> settled_bed() {
  const Vec3d size = kCellSize;
  std::vector<double> radii(kCell);
  Random random(1, 0);
  for (double& r : radii) r = 0.5 * std::clamp(39.4e-6 + 10.46e-6 * normal(random), 15e-6, 65e-6);
  std::vector<NewGrain> cell = pack_in_cell(radii, size.x, size.y, 0.62, 1);
  const Model m = bed_model({.tangential = TangentialLaw::mindlin, .rolling = RollingLaw::cdt}, size);
  Simulation sim(m, fine_step(cell, m));
  sim.add_grains(cell);
  sim.advance(25000);
  GrainColumns c;
  sim.copy_columns(c);
  for (std::size_t i = 0; i < cell.size(); ++i) cell[i].position = {c.x[i], c.y[i], c.z[i]};
  return cell;
}

std::vector<NewGrain> tiled(const std::vector<NewGrain>& cell) {
  std::vector<NewGrain> bed;
  for (int tile = 0; tile < kTiles * kTiles; ++tile) {
    for (NewGrain g : cell) {
      g.position += Vec3d{tile % kTiles * kCellSize.x, tile / kTiles * kCellSize.y, 0};
      bed.push_back(g);
    }
  }
  return bed;
}

void write_bed(const char* path) {
  std::ofstream out(path);
  for (const NewGrain& g : settled_bed())
    out << fmt::format("{} {} {} {}\n", g.position.x, g.position.y, g.position.z, g.radius);
  if (!out) throw RunError(fmt::format("{}: cannot be written", path));
}

std::vector<NewGrain> read_bed(const char* path) {
  std::ifstream in(path);
  std::vector<NewGrain> cell;
  NewGrain g;
  while (in >> g.position.x >> g.position.y >> g.position.z >> g.radius) cell.push_back(g);
  if (cell.empty()) throw InputError(fmt::format("{}: no bed; make one with bench_features make", path));
  return tiled(cell);
}

Simulation prepare(const Combination& c, const std::vector<NewGrain>& bed) {
  const Vec3d size{kTiles * kCellSize.x, kTiles * kCellSize.y, kCellSize.z};
  const Model m = bed_model(c.laws, size);
  Simulation sim(m, fine_step(bed, m), {.skin = 2e-6});
  sim.add_grains(bed);
  sim.advance(3);
  return sim;
}

void print_table(const char* path) {
  const auto bed = read_bed(path);
  std::vector<Simulation> sims;
  for (const Combination& c : combinations()) sims.push_back(prepare(c, bed));
  std::vector<std::vector<double>> times(sims.size());
  for (int round = 0; round < kRounds; ++round) {  // interleaved, so that a busy machine is fair to all
    for (std::size_t i = 0; i < sims.size(); ++i) {
      const auto start = Clock::now();
      sims[i].advance(kStepsPerRound);
      const double s = std::chrono::duration<double>(Clock::now() - start).count();
      times[i].push_back(1e9 * s / kStepsPerRound / static_cast<double>(sims[i].grains()));
    }
  }
  fmt::print("combination\tns_per_particle_step\tlow\thigh\tbytes_per_particle\tcontacts_per_particle\n");
  for (std::size_t i = 0; i < sims.size(); ++i) {
    std::sort(times[i].begin(), times[i].end());
    const double n = static_cast<double>(sims[i].grains());
    fmt::print("{}\t{:.0f}\t{:.0f}\t{:.0f}\t{:.0f}\t{:.2f}\n", combinations()[i].name, times[i][kRounds / 2],
               times[i].front(), times[i].back(), static_cast<double>(sims[i].bytes()) / n,
               static_cast<double>(contact_statistics(sims[i]).contacts) / n);
  }
}

int step_one(const char* path, const char* name, int steps) {
  for (const Combination& c : combinations()) {
    if (std::strcmp(c.name, name) != 0) continue;
    Simulation sim = prepare(c, read_bed(path));
    double contacts = 0, listed = 0;
    for (int s = 0; s < steps; ++s) {
      sim.advance(1);
      contacts += static_cast<double>(contact_statistics(sim).contacts);
      listed += static_cast<double>(sim.pair_contacts().listed());
    }
    fmt::print("{}\t{}\n", contacts, listed);
    return 0;
  }
  fmt::print(stderr, "bench_features: no combination is named {}\n", name);
  return 2;
}

}  // namespace
}  // namespace interstice::dem

int main(int argc, char** argv) try {
  using namespace interstice::dem;
  const std::string job = argc > 1 ? argv[1] : "";
  if (job == "make" && argc == 3) {
    write_bed(argv[2]);
  } else if (job == "table" && argc == 3) {
    print_table(argv[2]);
  } else if (job == "names") {
    for (const Combination& c : combinations()) fmt::print("{}\n", c.name);
  } else if (job == "count" && argc == 5) {
    return step_one(argv[2], argv[3], std::atoi(argv[4]));
  } else {
    fmt::print(stderr, "usage: bench_features make BED | table BED | names | count BED NAME STEPS\n");
    return 2;
  }
  return 0;
} catch (const std::exception& e) {
  fmt::print(stderr, "error: {}\n", e.what());
  return 1;
}
