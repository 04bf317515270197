#include "voxel/field.h"

#include <openvdb/openvdb.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/parallel.h"
#include "voxel/accumulate.h"
#include "voxel/average.h"
#include "voxel/bins.h"
#include "voxel/channels.h"
#include "voxel/grids.h"
#include "voxel/methods.h"
#include "voxel/methods_kernel.h"
#include "voxel/sum.h"
#include "voxel/text.h"
#include "voxel/union_overlaps.h"
#include "voxel/walls.h"

namespace interstice::voxel {

namespace {

void check(const SpheresView& spheres, const FieldRequest& request) {
  const Lattice& lattice = request.lattice;
  check_lattice(lattice);
  if (lattice.h.x != lattice.h.y || lattice.h.x != lattice.h.z)
    throw InputError("fields need cubic cells; the lattice's edges differ");
  check_method(request);
  if (!(std::isfinite(request.average_length) && request.average_length >= 0))
    throw InputError("the averaging length must be finite and not negative");
  if (!(std::isfinite(request.density) && request.density >= 0))
    throw InputError("the density must be finite and not negative");
  check_spheres(spheres, lattice, request.periodic);
  check_quantities(spheres, request.quantities);
}

// What the spheres themselves bring into the box, apart from any voxel.
struct Inside {
  std::int64_t particles = 0;
  CompensatedSum volume, mass;
  std::vector<double> each;  // [m^3] per sphere, where asked for
};

double ball_volume(double radius) { return 4 * std::numbers::pi / 3 * (radius * radius * radius); }

/// Volume [m^3] of the sphere inside the box; nothing where it does not touch the box.
std::optional<double> clipped_volume(const Lattice& lattice, const PlacedSphere& sphere) {
  const CellRange cells = bounding_cells(lattice, sphere), box = all_cells(lattice);
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis)
    inside = inside && cells.lo[axis] >= box.lo[axis] && cells.hi[axis] <= box.hi[axis];
  if (inside) return ball_volume(sphere.radius);
  if (!touches(lattice, sphere, box)) return {};
  return sphere_range_volume(lattice, sphere, box);
}

/// The same of all images of a sphere together.
std::optional<double> images_volume(const Lattice& lattice, const PlacedSphere& sphere,
                                    const std::array<bool, 3>& periodic) {
  const ImageRange images = images_of(lattice, sphere, periodic);
  std::optional<double> volume;
  std::array<std::int32_t, 3> m;
  for (m[0] = images.lo[0]; m[0] <= images.hi[0]; ++m[0])
    for (m[1] = images.lo[1]; m[1] <= images.hi[1]; ++m[1])
      for (m[2] = images.lo[2]; m[2] <= images.hi[2]; ++m[2])
        if (const auto part = clipped_volume(lattice, moved(sphere, lattice, m)))
          volume = volume.value_or(0) + *part;
  return volume;
}

/// Is all of the sphere inside the box, by more than roundings? Most are, and need no cells to tell.
bool well_inside(const Box& box, const Vec3d& center, double radius) {
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double room = radius + 1e-9 * (box.hi[axis] - box.lo[axis]);
    inside &= center[axis] - box.lo[axis] > room && box.hi[axis] - center[axis] > room;
  }
  return inside;
}

Inside spheres_inside(const SpheresView& spheres, const FieldRequest& request, bool each) {
  const Lattice& lattice = request.lattice;
  const Box box = lattice.box();
  const Blocks blocks{spheres.count, 4096};
  Inside all;
  if (each) all.each.resize(spheres.count);
  std::vector<Inside> partial(blocks.count());
  for_each_block(blocks, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const double r = spheres.radius[s];
      std::optional<double> inside = ball_volume(r);
      if (!well_inside(box, {spheres.x[s], spheres.y[s], spheres.z[s]}, r))
        inside = images_volume(lattice, place(lattice, spheres, s), request.periodic);
      const double volume = inside.value_or(0);
      if (each) all.each[s] = volume;
      partial[b].particles += inside.has_value();
      partial[b].volume.add(volume);
      partial[b].mass.add(volume * (spheres.density ? spheres.density[s] : request.density));
    }
  });
  for (const Inside& part : partial) {
    all.particles += part.particles;
    all.volume.add(part.volume.value());
    all.mass.add(part.mass.value());
  }
  return all;
}

FieldSums sums_of(const Lattice& lattice, const Inside& inside, const std::vector<BlockResult>& blocks) {
  FieldSums sums;
  sums.particles = inside.particles;
  sums.solid_volume_particles = inside.volume.value();
  sums.mass = inside.mass.value();
  CompensatedSum solid, wall, written, deleted;
  std::int64_t covered = 0;
  bool first = true;
  for (const BlockResult& block : blocks) {
    solid.add(block.solid);
    wall.add(block.wall);
    written.add(block.written);
    deleted.add(block.deleted);
    covered += block.cells;
    sums.negative_voxels += block.negative;
    sums.void_min = first ? block.void_min : std::min(sums.void_min, block.void_min);
    sums.void_max = first ? block.void_max : std::max(sums.void_max, block.void_max);
    first = false;
  }
  if (covered < lattice.cells()) {  // the rest of the lattice is empty
    sums.void_min = first ? 1.0 : std::min(sums.void_min, 1.0);
    sums.void_max = first ? 1.0 : std::max(sums.void_max, 1.0);
  }
  const double cell = lattice.cell_volume();
  sums.solid_volume_field = solid.value() * cell;
  sums.written_solid_volume = written.value() * cell;
  sums.deleted_volume = deleted.value() * cell;
  sums.available_volume = (static_cast<double>(lattice.cells()) - wall.value()) * cell;
  return sums;
}

/// Takes overlaps out of what the spheres bring in, and hidden spheres out of the bins. [m^3] in all.
double leave_out_hidden(const Overlaps& overlaps, const std::vector<double>& inside, Bins& bins) {
  CompensatedSum volume;
  volume.add(overlaps.volume);
  for (std::size_t s = 0; s < overlaps.hidden.size(); ++s)
    if (overlaps.hidden[s]) volume.add(inside[s]);
  drop_hidden(overlaps, bins);
  return volume.value();
}

/// Room for what averages are taken from.
DenseParts dense_parts(const Lattice& lattice, const CellRange& occupied, const Window& window, bool walls,
                       const Channels& channels) {
  DenseParts dense{dense_shares(lattice, occupied, window, walls), {}};
  dense.parts.resize(channels.outputs.size());
  const std::size_t cells = dense.shares.solid.size();
  double numbers = static_cast<double>(cells) * doubles_a_cell(window, walls);
  for (const Output& output : channels.outputs)
    numbers += output.averageable() ? static_cast<double>(cells) : 0;
  if (numbers > kMostAverageDoubles)
    throw InputError("averages of these quantities over this box need " + shown(numbers * 8 / 0x1p30, 3) +
                     " GiB (at most 4); choose fewer quantities, a larger voxel, a smaller box, or no "
                     "averaging length");
  for (std::size_t o = 0; o < dense.parts.size(); ++o)
    if (channels.outputs[o].averageable()) dense.parts[o].assign(cells, 0.0);
  return dense;
}

/// Integrals and means of the quantities, from the parts of all blocks.
void sum_quantities(const Channels& channels, const std::vector<BlockResult>& blocks, Field& field) {
  auto quantity = field.quantities.begin();
  for (std::size_t o = 0; o < channels.outputs.size(); ++o) {
    if (channels.outputs[o].is_mass()) continue;
    CompensatedSum parts;
    for (const BlockResult& block : blocks)
      if (!block.parts.empty()) parts.add(block.parts[o]);
    QuantityGrid& q = *quantity++;
    const double volume = q.per_solid ? field.sums.solid_volume_field : field.sums.available_volume;
    q.integral = parts.value() * field.lattice.cell_volume();
    q.mean = volume > 0 ? q.integral / volume : std::numeric_limits<double>::quiet_NaN();
  }
}

}  // namespace

Field compute_field(const SpheresView& spheres, const Solids& solids, const FieldRequest& request) {
  openvdb::initialize();
  check(spheres, request);
  const Lattice& lattice = request.lattice;
  const Channels channels = channels_for(spheres, request.quantities, request.density);
  const bool averaged = request.average_length > 0;
  const bool united = request.overlap == Overlap::united;
  const Solids walls = relative_to(solids, lattice);
  const std::vector<WallBlock> walled = wall_blocks(walls, lattice);
  const Inside inside = spheres_inside(spheres, request, united || request.method == Method::kernel);

  std::optional<KernelSpread> kernel;
  SpheresView binned = spheres;
  if (request.method == Method::kernel) {
    kernel = kernel_spread(spheres, inside.each, request, walls, walled);
    binned.radius = kernel->reach.data();
  }
  Bins bins = bin_spheres(binned, lattice, request.periodic, kRegion);
  std::optional<Overlaps> overlaps;
  double overlap_volume = 0;
  if (united) {
    overlaps = find_overlaps(spheres, lattice, bins, kRegion);
    overlap_volume = leave_out_hidden(*overlaps, inside.each, bins);
  }

  DenseParts dense;
  Window window;
  if (averaged && !bins.reached.empty()) {
    window = averaging_window(lattice, request.average_window, request.average_length / lattice.h.x,
                              request.periodic);
    dense = dense_parts(lattice, bins.reached, window, !walled.empty(), channels);
  }
  std::vector<BlockResult> blocks = accumulate(
      {spheres, request, bins, walls, walled, channels, dense.shares.range.empty() ? nullptr : &dense,
       kernel ? &*kernel : nullptr, overlaps ? &*overlaps : nullptr});

  Field field;
  field.lattice = lattice;
  field.sums = sums_of(lattice, inside, blocks);
  field.sums.overlap_volume = overlap_volume;
  fill_grids(request, !solids.empty(), channels, blocks, field);
  sum_quantities(channels, blocks, field);
  if (averaged) {
    if (!dense.shares.range.empty())
      average(lattice, window, {dense.shares.range}, dense.shares, dense.parts);
    fill_averaged_grids(request, channels, dense, field);
  }
  return field;
}

}  // namespace interstice::voxel
