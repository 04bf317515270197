#include "apps/bench_bed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/error.h"
#include "coupling/io/atomic_file.h"
#include "coupling/io/particle_reader.h"
#include "coupling/scene/sizes.h"
#include "coupling/stream/step_choice.h"
#include "dem/packing.h"
#include "dem/simulation.h"
#include "dem/time_step.h"

namespace interstice::apps {
namespace {

constexpr int kCellGrains = 1458;        // a 24th of 35,000
constexpr double kCellEdge = 0.25e-3;    // [m]
constexpr double kSolidFraction = 0.60;  // of the packing that settles: below what friction can hold up
constexpr double kAspect = 6;            // of a made bed: along x over along y

scene::Diameters diameters_of(const std::string& sizes) {
  scene::Diameters d;
  if (sizes == "equal") {
    d.mean = d.min = d.max = 40e-6;
  } else if (sizes == "powder") {
    d.law = scene::SizeLaw::normal;
    d.mean = 39.4e-6, d.sd = 10.46e-6, d.min = 5e-6, d.max = 65e-6;
  } else if (sizes == "wide") {  // as many grains from 2 to 4 um as from 50 to 100 um
    d.law = scene::SizeLaw::table;
    constexpr int kClasses = 40;
    for (int i = 0; i <= kClasses; ++i) {
      d.table_diameter.push_back(2e-6 * std::pow(50.0, static_cast<double>(i) / kClasses));
    }
    d.table_share.assign(kClasses, 1.0);
    d.min = d.table_diameter.front(), d.max = d.table_diameter.back();
  } else {
    throw InputError(fmt::format("bench: --sizes {} is not known; one of {}", sizes, kBedSizes));
  }
  return d;
}

/// Of the grains that are not below a radius [m].
double smallest_radius(const Bed& bed, double least) {
  double smallest = INFINITY;
  for (const dem::NewGrain& g : bed.grains)
    if (g.radius >= least) smallest = std::min(smallest, g.radius);
  return smallest;
}

/// Moves the grains for a while, from rest and without springs at first; what speed they have in the end is
/// taken from them.
void relax(Bed& bed, const BedLaws& laws, double softening, std::int64_t steps) {
  const dem::Model model = bed_model(bed, laws, softening);
  dem::Simulation sim(model, bed_time_step(bed, model));
  sim.add_grains(bed.grains);
  sim.advance(steps);
  dem::GrainColumns c;
  sim.copy_columns(c);
  for (std::size_t i = 0; i < bed.grains.size(); ++i) bed.grains[i].position = {c.x[i], c.y[i], c.z[i]};
}

/// Lets a packing come to rest. Overlaps left by geometry are taken out first, speeds being reset over and
/// over. Then the grains fall together while they are soft, which allows large steps. The modulus is doubled
/// from there, not set at once: the elastic energy of a soft bed would throw it up, and it would be long in
/// falling back. In the end the bed swings as a whole (0.6 ms); resetting its speed a few times within that
/// ends it.
void settle(Bed& bed, const BedLaws& laws) {
  constexpr double kSoftest = 0.001;
  constexpr int kResets = 60, kStepsBetweenResets = 100, kLastRounds = 8;
  constexpr double kFall = 6e-3, kRebound = 0.12e-3;  // [s] at the softest; at the full modulus
  const auto steps_in = [&](double duration, double softening) {
    return static_cast<std::int64_t>(duration / bed_time_step(bed, bed_model(bed, laws, softening)));
  };
  for (int i = 0; i < kResets; ++i) relax(bed, laws, kSoftest, kStepsBetweenResets);
  relax(bed, laws, kSoftest, steps_in(kFall, kSoftest));
  for (double softening = 2 * kSoftest; softening < 1; softening *= 2) {
    relax(bed, laws, softening, steps_in(kRebound / std::sqrt(softening), softening));
  }
  for (int i = 0; i < kLastRounds; ++i) relax(bed, laws, 1, steps_in(kRebound, 1));
}

Box bounds_of(const io::ParticleFrame& frame) {
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
  return box;
}

}  // namespace

dem::Model bed_model(const Bed& bed, const BedLaws& laws, double softening) {
  dem::Model m;
  m.domain = {{0, 0, -1e-3}, {bed.size.x, bed.size.y, bed.size.z + 5e-3}};
  m.materials = {{8200, 1e9 * softening, 0.3}, {8200, 1e9 * softening, 0.3}};
  const double k = 1e6 * std::pow(softening, 2.0 / 3);
  const dem::PairCoefficients powder{0.35, 0.3, 0.005, k}, wall{0.35, 0.9, 0.005, k};
  m.pairs = {powder, wall, wall, wall};
  m.laws.tangential = dem::TangentialLaw::mindlin;
  if (laws.rolling) m.laws.rolling = dem::RollingLaw::cdt;
  if (laws.cohesion) m.laws.cohesion = dem::CohesionLaw::sjkr;
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 1}};
  if (bed.periodic) {
    m.boundary = {dem::AxisBoundary::periodic, dem::AxisBoundary::periodic, dem::AxisBoundary::open};
    return m;
  }
  for (int axis = 0; axis < 2; ++axis) {
    Vec3d inward{0, 0, 0};
    inward[axis] = 1;
    m.walls.push_back({Plane{{0, 0, 0}, inward}, 1});
    m.walls.push_back({Plane{bed.size, -inward}, 1});
    m.domain.lo[axis] = -1e-3;
    m.domain.hi[axis] += 1e-3;
  }
  return m;
}

double bed_time_step(const Bed& bed, const dem::Model& model) {
  return 0.2 * dem::rayleigh_time(smallest_radius(bed, 0), model.materials[0]);
}

dem::Rates bed_rates(const Bed& bed, double short_below) {
  const double smallest = smallest_radius(bed, 0), limit = 0.5 * short_below;
  if (!(smallest < limit))
    throw InputError(
        fmt::format("bench: --short-steps-below {:.4g} um: no grain is below it, the smallest has "
                    "{:.4g} um; give more, or leave it out",
                    1e6 * short_below, 2e6 * smallest));
  // The Rayleigh time goes with the radius.
  return {limit, stream::short_steps_in(smallest_radius(bed, limit) / smallest)};
}

Bed make_bed_cell(const std::string& sizes, const BedLaws& laws) {
  std::vector<double> radii = scene::sample_diameters(diameters_of(sizes), kCellGrains, 1, 0);
  for (double& r : radii) r *= 0.5;
  Bed cell;
  cell.grains = dem::pack_in_cell(radii, kCellEdge, kCellEdge, kSolidFraction, 1);
  cell.size = {kCellEdge, kCellEdge, 1.8e-3};
  settle(cell, laws);
  return cell;
}

Bed read_bed(const std::string& path, bool periodic) {
  const auto reader = io::open_particles(path, {});
  io::ParticleFrame frame, next;
  while (reader->next(next)) std::swap(frame, next);
  if (frame.size() == 0) throw InputError(path + ": holds no particles; give a file with a settled bed");
  const Box box = bounds_of(frame);
  Bed bed;
  bed.size = box.size();
  bed.periodic = periodic;
  bed.grains.resize(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) {
    bed.grains[i].position = Vec3d{frame.x[i], frame.y[i], frame.z[i]} - box.lo;
    bed.grains[i].radius = frame.radius[i];
  }
  return bed;
}

Copies copies_for(const Bed& cell, std::int64_t grains) {
  const double copies = static_cast<double>(grains) / static_cast<double>(cell.grains.size());
  const int y =
      std::max(1, static_cast<int>(std::lround(std::sqrt(copies * cell.size.x / cell.size.y / kAspect))));
  return {std::max(1, static_cast<int>(std::lround(copies / y))), y};
}

Bed tiled(const Bed& cell, const Copies& copies) {
  Bed bed;
  bed.periodic = cell.periodic;
  bed.size = {copies.x * cell.size.x, copies.y * cell.size.y, cell.size.z};
  bed.grains.reserve(cell.grains.size() * static_cast<std::size_t>(copies.x) *
                     static_cast<std::size_t>(copies.y));
  for (int ty = 0; ty < copies.y; ++ty) {
    for (int tx = 0; tx < copies.x; ++tx) {
      for (dem::NewGrain g : cell.grains) {
        g.position += Vec3d{tx * cell.size.x, ty * cell.size.y, 0};
        bed.grains.push_back(g);
      }
    }
  }
  return bed;
}

void mix_materials(Bed& bed) {
  for (std::size_t i = 1; i < bed.grains.size(); i += 2) bed.grains[i].material = 1;
}

void write_bed(const Bed& bed, const std::string& path) {
  std::string text = fmt::format(
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS {}\n0 {}\n0 {}\n0 {}\n"
      "ITEM: ATOMS id x y z radius\n",
      bed.grains.size(), bed.periodic ? "pp pp ff" : "ff ff ff", bed.size.x, bed.size.y, bed.size.z);
  for (std::size_t i = 0; i < bed.grains.size(); ++i) {
    const dem::NewGrain& g = bed.grains[i];
    fmt::format_to(std::back_inserter(text), "{} {} {} {} {}\n", i + 1, g.position.x, g.position.y,
                   g.position.z, g.radius);
  }
  io::write_text_atomically(path, text);
}

}  // namespace interstice::apps
