#include "apps/voids_frame.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "coupling/scene/format_quantity.h"
#include "coupling/stream/field_memory.h"
#include "coupling/stream/touching_grains.h"
#include "voxel/methods.h"
#include "voxel/scales.h"

namespace interstice::apps {
namespace {

[[noreturn]] void wrong(const std::string& where, const std::string& what) {
  throw InputError(where + ": " + what);
}

// The grains' bounds, spheres and all; along periodic axes the source's own box, since grains reach across
// it.
Box default_box(const io::ParticleFrame& frame, const VoidsOptions& options, const std::string& where) {
  Box box{{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const double r = frame.radius[i];
    const Vec3d p{frame.x[i], frame.y[i], frame.z[i]};
    for (int a = 0; a < 3; ++a) {
      box.lo[a] = std::min(box.lo[a], p[a] - r);
      box.hi[a] = std::max(box.hi[a], p[a] + r);
    }
  }
  for (int a = 0; a < 3; ++a) {
    if (!options.periodic[static_cast<std::size_t>(a)]) continue;
    if (!frame.bounds)
      wrong(where, "the file says no box to repeat; --periodic needs one; give it with --box");
    box.lo[a] = frame.bounds->lo[a];
    box.hi[a] = frame.bounds->hi[a];
  }
  if (!(box.hi.x > box.lo.x && box.hi.y > box.lo.y && box.hi.z > box.lo.z)) {
    wrong(where, "no particles, so no box follows from them; a box is needed; give it with --box");
  }
  return box;
}

void check_periods(const Box& box, const VoidsOptions& options, const std::string& where) {
  const Vec3d size = box.size();
  for (int a = 0; a < 3; ++a) {
    if (!options.periodic[static_cast<std::size_t>(a)]) continue;
    const double cells = std::max(1.0, std::round(size[a] / options.voxel));
    if (std::abs(cells * options.voxel - size[a]) > 1e-9 * size[a]) {
      wrong(where,
            fmt::format("--voxel: {} does not divide the period along {} ({}); a whole number of voxels is "
                        "needed; take --voxel {}",
                        scene::format_length(options.voxel), "xyz"[a], scene::format_length(size[a]),
                        scene::format_exact(size[a] / cells, scene::Dimension::length)));
    }
  }
}

// A wrong unit of length makes fields larger than a machine has room for.
void check_memory(const FramePlan& plan, const std::string& where) {
  const double memory =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  if (plan.memory <= memory) return;
  const auto& n = plan.request.computed.lattice.n;
  wrong(where,
        fmt::format("the field would need some {:.3g} GB ({} x {} x {} voxels); this machine has {:.3g} GB; "
                    "take a larger --voxel or a smaller --box, and check the unit of length (--length-unit)",
                    1e-9 * plan.memory, n[0], n[1], n[2], 1e-9 * memory));
}

/// Columns are looked for now, so that nothing is written for a frame that lacks them. A coordination can be
/// found from the grains' places.
void plan_quantities(const io::ParticleFrame& frame, const VoidsOptions& options, const std::string& where,
                     FramePlan& plan) {
  auto& computed = plan.request.computed;
  try {
    plan.classes = io::classify(frame, options.recipe.classes);
    io::apply(options.recipe, plan.classes, computed);
    voxel::QuantityRequest in_file = computed.quantities;
    in_file.groups.clear();
    in_file.coordination = in_file.coordination && !frame.coordination.empty();
    voxel::check_quantities(io::view_of(frame), in_file);
    if (computed.quantities.coordination && frame.coordination.empty())
      stream::check_touching(frame, computed);
  } catch (const InputError& error) {
    wrong(where, error.what());
  }
}

void check_method_here(const voxel::FieldRequest& request, const VoidsOptions& options,
                       const std::string& where) {
  try {
    voxel::check_method(request);
  } catch (const InputError& error) {
    wrong(where, error.what());
  }
  if (options.scales && request.lattice.cells() > voxel::kMostScaleCells) {
    wrong(where,
          fmt::format("--scales: the box has {} voxels; at most {}; take a larger --voxel or a smaller --box",
                      request.lattice.cells(), voxel::kMostScaleCells));
  }
}

void check_places(const voxel::Lattice& lattice, const VoidsOptions& options, const std::string& where) {
  const auto check = [&](int axis, double at, const std::string& key) {
    const Box box = lattice.box();
    if (at >= box.lo[axis] && at <= box.hi[axis]) return;
    wrong(where, fmt::format("{}: {} = {} is outside the box; {} to {}; move it, or widen --box", key,
                             "xyz"[axis], scene::format_length(at), scene::format_length(box.lo[axis]),
                             scene::format_length(box.hi[axis])));
  };
  for (const auto& slice : options.slices) check(slice.axis, slice.at, "--slice");
  for (const auto& line : options.lines) {
    for (int a = 0; a < 3; ++a) {
      if (a != line.axis) check(a, line.at[a], "--line");
    }
  }
}

}  // namespace

FramePlan plan_frame(const io::ParticleFrame& frame, const VoidsOptions& options, const std::string& where) {
  FramePlan plan;
  auto& request = plan.request;
  request.box = options.box ? *options.box : default_box(frame, options, where);
  check_periods(request.box, options, where);
  auto& computed = request.computed;
  try {
    computed.lattice = voxel::cubic_lattice(request.box, options.voxel);
  } catch (const InputError& error) {
    wrong(where, error.what());
  }
  computed.periodic = options.periodic;
  plan_quantities(frame, options, where, plan);
  computed.precision = options.precision;
  computed.average_length = options.average;
  computed.average_window = options.window;
  computed.density = options.density;
  check_method_here(computed, options, where);
  plan.memory = stream::field_memory(request, stream::cells_reached(frame.radius, computed),
                                     static_cast<double>(frame.size()));
  check_memory(plan, where);
  request.scales = options.scales;
  check_places(computed.lattice, options, where);
  request.slices = options.slices;
  request.lines = options.lines;
  if (options.layers) {
    voxel::LayerRequest layers;
    layers.box = request.box;
    layers.box.lo.z = options.layers->lo;
    layers.box.hi.z = options.layers->hi;
    layers.columns = options.layers->columns;
    layers.periodic = options.periodic;
    layers.density = options.density;
    request.layers = layers;
  }
  request.frame = -1;
  request.step = frame.step;
  request.time = frame.time;
  plan.solids = options.walls.solids;
  for (const auto& wall : frame.walls) plan.solids.shapes.push_back(wall.shape);
  for (const auto& wall : frame.walls) request.walls.push_back(wall.name);
  for (const auto& word : options.walls.words) request.walls.push_back(word);
  return plan;
}

std::string resolution_warning(const std::string& where, double resolution, double voxel) {
  if (!(resolution > 1e-3 * voxel)) return "";
  return fmt::format(
      "{}: positions are written to {} only, more than a thousandth of the voxel ({}); grains may be "
      "displaced by up to half of that; write more digits (dump_modify ID format float %.12g, or doubles)",
      where, scene::format_length(resolution), scene::format_length(voxel));
}

void wrap(io::ParticleFrame& frame, const voxel::FieldRequest& request) {
  const Box box = request.lattice.box();
  const std::array<std::vector<double>*, 3> columns{&frame.x, &frame.y, &frame.z};
  for (int a = 0; a < 3; ++a) {
    if (!request.periodic[static_cast<std::size_t>(a)]) continue;
    const double period = box.hi[a] - box.lo[a];
    for (double& at : *columns[static_cast<std::size_t>(a)]) {
      if (at < box.lo[a] || at >= box.hi[a]) at -= period * std::floor((at - box.lo[a]) / period);
    }
  }
}

}  // namespace interstice::apps
