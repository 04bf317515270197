// interstice bench: how fast the engine and the fields are on this machine, on beds that anyone can make
// again.
#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/bench_bed.h"
#include "apps/command.h"
#include "base/error.h"
#include "base/version.h"
#include "coupling/scene/units.h"
#include "dem/simulation.h"
#include "dem/statistics.h"
#include "voxel/field.h"

namespace interstice::apps {
namespace {

using Json = nlohmann::ordered_json;

struct BenchArguments {
  std::string bed, write_bed, sizes = "powder";
  bool periodic = false;
  std::int64_t grains = 0;  // 0: what a bed from a file has, or 35,000
  Copies copies{0, 0};      // 0: as `grains` asks for
  int blocks = 5, steps = 100, warm_up = 200;
  double voxel = 17.3e-6;
  std::string short_steps_below;  // "": all grains take the same steps
  bool no_cohesion = false, no_rolling = false, two_materials = false;
  ComputeOptions compute;
};

BedLaws laws_of(const BenchArguments& a) { return {!a.no_cohesion, !a.no_rolling}; }

Bed bed_for(const BenchArguments& a) {
  const bool copied = a.grains > 0 || a.copies.x > 1 || a.copies.y > 1;
  const Bed cell = a.bed.empty() ? make_bed_cell(a.sizes, laws_of(a)) : read_bed(a.bed, a.periodic || copied);
  if (a.copies.x > 0 || a.copies.y > 0)
    return tiled(cell, {std::max(1, a.copies.x), std::max(1, a.copies.y)});
  const std::int64_t own = a.bed.empty() ? 35000 : static_cast<std::int64_t>(cell.grains.size());
  return tiled(cell, copied || a.bed.empty() ? copies_for(cell, a.grains > 0 ? a.grains : own) : Copies{});
}

Json spread(const std::vector<double>& in_turn) {
  std::vector<double> values = in_turn;
  std::sort(values.begin(), values.end());
  return {{"median", values[values.size() / 2]},
          {"min", values.front()},
          {"max", values.back()},
          {"rates", in_turn}};
}

/// How the bed stands: contacts of grains with each other, and how much of its weight the floor carries (all
/// of it in a periodic bed at rest).
Json state_of(const dem::Simulation& sim) {
  dem::GrainColumns c;
  sim.copy_columns(c);
  double mass = 0;
  for (const double m : c.mass) mass += m;
  const dem::MotionStatistics motion = dem::motion_statistics(sim);
  const double grains = static_cast<double>(sim.grains()),
               contacts = static_cast<double>(dem::contact_statistics(sim).contacts);
  return {{"coordination", 2 * contacts / grains},
          {"contacts_per_grain", contacts / grains},
          {"floor_force_over_weight",
           dem::wall_statistics(sim, 0).normal_force / (mass * norm(sim.model().gravity))},
          {"kinetic_energy_over_mgd", motion.kinetic_energy / grains / motion.fall_energy_mean}};
}

/// Of the whole machine, at the median rate: divided by the threads' number it is no time of one thread.
void add_times(Json& j) {
  const double rate = j["particle_steps_per_s"]["median"].get<double>(), ns = 1e9 / rate,
               contacts = j["before"]["contacts_per_grain"].get<double>();
  j["simulated_us_per_s"] = 1e6 * rate / j["grains"].get<double>() * j["time_step_s"].get<double>();
  j["ns_per_particle_step"] = ns;
  j["ns_per_contact_step"] = contacts > 0 ? Json(ns / contacts) : Json();
}

Json bench_steps(const Bed& bed, const BenchArguments& a, double short_below) {
  const dem::Model model = bed_model(bed, laws_of(a));
  const dem::Rates two_rates = short_below > 0 ? bed_rates(bed, short_below) : dem::Rates{};
  dem::Simulation sim(
      model, two_rates.beats * bed_time_step(bed, model),
      {.reference = a.compute.backend == "reference",
       .precision = a.compute.precision == "mixed" ? dem::Precision::mixed : dem::Precision::real64,
       .rates = two_rates});
  sim.add_grains(bed.grains);
  sim.advance(a.warm_up);
  Json j;
  j["grains"] = sim.grains();
  j["time_step_s"] = sim.time_step();
  j["short_steps"] = two_rates.beats;
  j["cohesion"] = !a.no_cohesion;
  j["rolling_friction"] = !a.no_rolling;
  j["two_materials"] = a.two_materials;
  j["before"] = state_of(sim);
  std::vector<double> rates;
  for (int b = 0; b < a.blocks; ++b) {
    const auto start = std::chrono::steady_clock::now();
    sim.advance(a.steps);
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    rates.push_back(static_cast<double>(sim.grains()) * a.steps / s);
  }
  j["after"] = state_of(sim);
  j["listed_pairs_per_grain"] =
      static_cast<double>(sim.pair_contacts().listed()) / static_cast<double>(sim.grains());
  j["list_rebuilds"] = sim.rebuilds();
  j["bytes_per_grain"] = static_cast<double>(sim.bytes()) / static_cast<double>(sim.grains());
  j["particle_steps_per_s"] = spread(rates);
  add_times(j);
  return j;
}

Json bench_field(const Bed& bed, const BenchArguments& a) {
  std::vector<double> x, y, z, r;
  for (const dem::NewGrain& g : bed.grains) {
    x.push_back(g.position.x), y.push_back(g.position.y), z.push_back(g.position.z), r.push_back(g.radius);
  }
  voxel::FieldRequest request;
  request.lattice = voxel::cubic_lattice({{0, 0, 0}, bed.size}, a.voxel);
  if (a.compute.precision == "mixed") request.precision = voxel::Precision::mixed;
  std::vector<double> rates;
  double conservation = 0;
  for (int b = 0; b < a.blocks; ++b) {
    const auto start = std::chrono::steady_clock::now();
    const voxel::Field f =
        voxel::compute_field({x.size(), x.data(), y.data(), z.data(), r.data(), nullptr}, {}, request);
    rates.push_back(static_cast<double>(x.size()) /
                    std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    conservation = std::fabs(f.sums.solid_volume_field / f.sums.solid_volume_particles - 1);
  }
  return {
      {"voxel_m", a.voxel}, {"relative_conservation_error", conservation}, {"spheres_per_s", spread(rates)}};
}

void check(const BenchArguments& a) {
  if (a.blocks < 1 || a.steps < 1 || a.warm_up < 0 || a.grains < 0 || a.copies.x < 0 || a.copies.y < 0) {
    throw InputError(
        "bench: --blocks, --steps, --grains and --tiles must be at least 1, --warm-up at least 0; leave them "
        "out for "
        "the usual");
  }
}

void bench(const BenchArguments& a) {
  apply_compute_options(a.compute);
  check(a);
  const double short_below =
      a.short_steps_below.empty() ? 0 : scene::parse_length(a.short_steps_below, "--short-steps-below");
  Bed bed = bed_for(a);
  if (a.two_materials) mix_materials(bed);
  if (!a.write_bed.empty()) write_bed(bed, a.write_bed);
  Json j;
  j["version"] = kVersion;
  j["commit"] = kCommit;
  j["built_for"] = kBuildArch;
  j["threads"] = a.compute.backend == "reference" ? 1
                 : a.compute.threads > 0          ? a.compute.threads
                                                  : tbb::info::default_concurrency();
  j["bed"] = a.bed.empty() ? a.sizes : a.bed;
  j["precision"] = a.compute.precision;
  j["steps"] = bench_steps(bed, a, short_below);
  j["field"] = bench_field(bed, a);
  fmt::print("{}\n", j.dump(2));
}

}  // namespace

void add_bench(CLI::App& root) {
  auto a = std::make_shared<BenchArguments>();
  CLI::App* c = root.add_subcommand("bench", "time steps and fields on a settled bed; prints JSON");
  c->add_option("--bed", a->bed, "particle file with a settled bed (default: one is made)");
  c->add_flag("--periodic", a->periodic, "the sides of --bed's box are periodic, not walls");
  c->add_option("--sizes", a->sizes, fmt::format("of the bed made here: {}", kBedSizes))
      ->capture_default_str();
  c->add_flag_callback(
      "--equal-sizes", [a] { a->sizes = "equal"; }, "as --sizes equal");
  auto* grains =
      c->add_option("--grains", a->grains,
                    "about how many, by copies of the periodic bed side by side (35,000 where it is made)");
  c->add_option("--tiles-x", a->copies.x, "or: copies of the periodic bed along x")->excludes(grains);
  c->add_option("--tiles-y", a->copies.y, "... along y")->excludes(grains);
  c->add_option("--write-bed", a->write_bed, "write the bed to this text dump before it is timed");
  c->add_option("--short-steps-below", a->short_steps_below,
                "grains below this diameter take several steps for each of the others, such as 20um");
  c->add_option("--warm-up", a->warm_up, "steps before those that are timed")->capture_default_str();
  c->add_option("--blocks", a->blocks, "timed blocks")->capture_default_str();
  c->add_option("--steps", a->steps, "steps in a block")->capture_default_str();
  c->add_flag("--no-cohesion", a->no_cohesion, "without SJKR");
  c->add_flag("--no-rolling", a->no_rolling, "without CDT");
  c->add_flag("--two-materials", a->two_materials,
              "every other grain is of the floor's material: as stiff and heavy, with more friction");
  add_compute_options(*c, a->compute);
  c->callback([a] { bench(*a); });
}

}  // namespace interstice::apps
