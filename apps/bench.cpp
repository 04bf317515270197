// interstice bench: how fast the engine and the fields are on this machine, on beds that anyone can make
// again.
#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/error.h"
#include "base/version.h"
#include "coupling/io/atomic_file.h"
#include "coupling/io/particle_reader.h"
#include "coupling/scene/sizes.h"
#include "dem/packing.h"
#include "dem/simulation.h"
#include "dem/statistics.h"
#include "dem/time_step.h"
#include "voxel/field.h"

namespace interstice::apps {
namespace {

using Json = nlohmann::ordered_json;

struct BenchArguments {
  std::string bed, write_bed;
  bool periodic = false;
  int tiles_x = 1, tiles_y = 1;
  int blocks = 5, steps = 100;
  double voxel = 17.3e-6;
  bool no_cohesion = false, equal_sizes = false;
  ComputeOptions compute;
};

/// A bed, and the box that it fills: [0, size) in x and y, the floor at z = 0.
struct Bed {
  std::vector<dem::NewGrain> grains;
  Vec3d size;
};

/// Copies a periodic cell side by side.
Bed tiled(const std::vector<dem::NewGrain>& cell, const Vec3d& size, int tiles_x, int tiles_y) {
  Bed bed;
  for (int ty = 0; ty < tiles_y; ++ty) {
    for (int tx = 0; tx < tiles_x; ++tx) {
      for (dem::NewGrain g : cell) {
        g.position += Vec3d{tx * size.x, ty * size.y, 0};
        bed.grains.push_back(g);
      }
    }
  }
  bed.size = {tiles_x * size.x, tiles_y * size.y, size.z};
  return bed;
}

Bed read_bed(const BenchArguments& a) {
  const auto reader = io::open_particles(a.bed, {});
  io::ParticleFrame frame, next;
  while (reader->next(next)) std::swap(frame, next);
  if (frame.size() == 0) throw InputError(a.bed + ": holds no particles; give a file with a settled bed");
  Box box{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Vec3d p{frame.x[i], frame.y[i], frame.z[i]};
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], p[axis] - frame.radius[i]);
      box.hi[axis] = std::max(box.hi[axis], p[axis] + frame.radius[i]);
    }
  }
  if (frame.bounds) {  // walls where the source had them, whatever the grains reach
    box.lo.x = frame.bounds->lo.x, box.lo.y = frame.bounds->lo.y, box.lo.z = 0;
    box.hi.x = frame.bounds->hi.x, box.hi.y = frame.bounds->hi.y;
  }
  std::vector<dem::NewGrain> grains(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    grains[i].position = Vec3d{frame.x[i], frame.y[i], frame.z[i]} - box.lo;
    grains[i].radius = frame.radius[i];
  }
  return tiled(grains, box.size(), a.tiles_x, a.tiles_y);
}

/// Paper 004's powder on a floor; periodic sides where the bed is tiled, walls where it is not.
dem::Model model_of(const Vec3d& size, bool walls, bool cohesion, double softening) {
  dem::Model m;
  m.domain = {{0, 0, -1e-3}, {size.x, size.y, size.z + 5e-3}};
  m.materials = {{8200, 1e9 * softening, 0.3}, {8200, 1e9 * softening, 0.3}};
  const double k = 1e6 * std::pow(softening, 2.0 / 3);  // keeps pull-off over weight
  const dem::PairCoefficients powder{0.35, 0.3, 0.005, k}, wall{0.35, 0.9, 0.005, k};
  m.pairs = {powder, wall, wall, powder};
  m.laws.tangential = dem::TangentialLaw::mindlin;
  m.laws.rolling = dem::RollingLaw::cdt;
  if (cohesion) m.laws.cohesion = dem::CohesionLaw::sjkr;
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 1}};
  if (!walls) {
    m.boundary = {dem::AxisBoundary::periodic, dem::AxisBoundary::periodic, dem::AxisBoundary::open};
    return m;
  }
  for (int axis = 0; axis < 2; ++axis) {
    Vec3d inward{0, 0, 0};
    inward[axis] = 1;
    m.walls.push_back({Plane{{0, 0, 0}, inward}, 1});
    m.walls.push_back({Plane{size, -inward}, 1});
    m.domain.lo[axis] = -1e-3;
    m.domain.hi[axis] += 1e-3;
  }
  return m;
}

double step_of(const std::vector<dem::NewGrain>& grains, const dem::Model& model) {
  double smallest = INFINITY;
  for (const dem::NewGrain& g : grains) smallest = std::min(smallest, g.radius);
  return 0.2 * dem::rayleigh_time(smallest, model.materials[0]);
}

/// Lets a packing come to rest: first soft (large steps, whatever overlap is left goes), then with the full
/// modulus.
void settle(std::vector<dem::NewGrain>& grains, const Vec3d& size, bool cohesion) {
  for (const auto& [softening, steps] : {std::pair{0.01, 20000}, {0.1, 20000}, {1.0, 20000}}) {
    const dem::Model model = model_of(size, false, cohesion, softening);
    dem::Simulation sim(model, 0.25 * step_of(grains, model));
    sim.add_grains(grains);
    sim.advance(steps);
    dem::GrainColumns c;
    sim.copy_columns(c);
    for (std::size_t i = 0; i < grains.size(); ++i) grains[i].position = {c.x[i], c.y[i], c.z[i]};
  }
}

/// A bed like that of paper 004, 3 mm x 0.5 mm x 1.5 mm: a periodic cell of 972 grains, 12 x 3 times.
Bed make_bed(const BenchArguments& a) {
  scene::Diameters sizes;
  sizes.law = scene::SizeLaw::normal;
  sizes.mean = 39.4e-6, sizes.sd = 10.46e-6, sizes.min = 5e-6, sizes.max = 65e-6;
  std::vector<double> radii = scene::sample_diameters(sizes, 972, 1, 0);
  for (double& r : radii) r *= a.equal_sizes ? 20e-6 / r : 0.5;
  std::vector<dem::NewGrain> cell = dem::pack_in_cell(radii, 0.25e-3, 0.5e-3 / 3, 0.62, 1);
  const Vec3d size{0.25e-3, 0.5e-3 / 3, 1.8e-3};
  settle(cell, size, !a.no_cohesion);
  return tiled(cell, size, 12, 3);
}

/// As a text dump, which other programs and --bed read.
void write_bed(const Bed& bed, const std::string& path) {
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS pp pp ff\n0 {}\n0 {}\n0 {}\n"
      "ITEM: ATOMS id x y z radius\n",
      bed.grains.size(), bed.size.x, bed.size.y, bed.size.z);
  for (std::size_t i = 0; i < bed.grains.size(); ++i) {
    const dem::NewGrain& g = bed.grains[i];
    text += fmt::format("{} {} {} {} {}\n", i + 1, g.position.x, g.position.y, g.position.z, g.radius);
  }
  io::write_text_atomically(path, text);
}

Json spread(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return {{"median", values[values.size() / 2]},
          {"min", values.front()},
          {"max", values.back()},
          {"rates", values}};
}

Json bench_steps(const Bed& bed, const BenchArguments& a) {
  const bool walls = !a.bed.empty() && !a.periodic && a.tiles_x * a.tiles_y == 1;
  const dem::Model model = model_of(bed.size, walls, !a.no_cohesion, 1);
  dem::Simulation sim(
      model, step_of(bed.grains, model),
      {.reference = a.compute.backend == "reference",
       .precision = a.compute.precision == "mixed" ? dem::Precision::mixed : dem::Precision::real64});
  sim.add_grains(bed.grains);
  sim.advance(20);
  std::vector<double> rates;
  for (int b = 0; b < a.blocks; ++b) {
    const auto start = std::chrono::steady_clock::now();
    sim.advance(a.steps);
    const double s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    rates.push_back(static_cast<double>(sim.grains()) * a.steps / s);
  }
  const dem::ContactStatistics c = dem::contact_statistics(sim);
  Json j;
  j["grains"] = sim.grains();
  j["time_step_s"] = sim.time_step();
  j["cohesion"] = !a.no_cohesion;
  j["coordination"] = 2.0 * static_cast<double>(c.contacts) / static_cast<double>(sim.grains());
  j["listed_pairs_per_grain"] =
      static_cast<double>(sim.pair_contacts().listed()) / static_cast<double>(sim.grains());
  j["list_rebuilds"] = sim.rebuilds();
  j["bytes_per_grain"] = static_cast<double>(sim.bytes()) / static_cast<double>(sim.grains());
  j["particle_steps_per_s"] = spread(rates);
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

void bench(const BenchArguments& a) {
  apply_compute_options(a.compute);
  if (a.blocks < 1 || a.steps < 1 || a.tiles_x < 1 || a.tiles_y < 1) {
    throw InputError("bench: --blocks, --steps and --tiles must be at least 1; leave them out for the usual");
  }
  const Bed bed = a.bed.empty() ? make_bed(a) : read_bed(a);
  if (!a.write_bed.empty()) write_bed(bed, a.write_bed);
  Json j;
  j["version"] = kVersion;
  j["commit"] = kCommit;
  j["built_for"] = kBuildArch;
  j["threads"] = a.compute.backend == "reference" ? 1
                 : a.compute.threads > 0          ? a.compute.threads
                                                  : tbb::info::default_concurrency();
  j["bed"] = !a.bed.empty() ? a.bed : a.equal_sizes ? "settled, equal 40 um" : "settled, 5 to 65 um";
  j["precision"] = a.compute.precision;
  j["steps"] = bench_steps(bed, a);
  j["field"] = bench_field(bed, a);
  fmt::print("{}\n", j.dump(2));
}

}  // namespace

void add_bench(CLI::App& root) {
  auto a = std::make_shared<BenchArguments>();
  CLI::App* c = root.add_subcommand("bench", "time steps and fields on a settled bed; prints JSON");
  c->add_option("--bed", a->bed, "particle file with a settled bed (default: one of 35,000 grains is made)");
  c->add_flag("--periodic", a->periodic, "the sides of --bed's box are periodic, not walls");
  c->add_option("--write-bed", a->write_bed, "write the bed to this text dump before it is timed");
  c->add_option("--tiles-x", a->tiles_x, "copies of the bed along x (its box is then periodic)");
  c->add_option("--tiles-y", a->tiles_y, "copies along y");
  c->add_option("--blocks", a->blocks, "timed blocks");
  c->add_option("--steps", a->steps, "steps in a block");
  c->add_flag("--equal-sizes", a->equal_sizes, "the built-in bed with 40 um grains instead of 5 to 65 um");
  c->add_flag("--no-cohesion", a->no_cohesion, "without SJKR");
  add_compute_options(*c, a->compute);
  c->callback([a] { bench(*a); });
}

}  // namespace interstice::apps
