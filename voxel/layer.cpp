#include "voxel/layer.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "voxel/bins.h"
#include "voxel/overlap.h"

namespace interstice::voxel {

namespace {

// The same columns twice, as cells: cut off at the top of the gap, and reaching above every sphere.
struct Stands {
  Lattice gap, whole;
};

Stands stands_of(const SpheresView& spheres, const LayerRequest& request) {
  const Box& box = request.box;
  Lattice gap{box.lo, {0, 0, 0}, {request.columns[0], request.columns[1], 1}};
  for (int axis = 0; axis < 3; ++axis) {
    const double length = box.hi[axis] - box.lo[axis];
    if (!(std::isfinite(length) && length > 0))
      throw InputError("the layer's box is empty or not finite along " + std::string(1, "xyz"[axis]) +
                       "; give lo < hi");
    if (gap.n[axis] < 1 || gap.n[axis] > 1'000'000)
      throw InputError("a layer has 1 to 1,000,000 columns along an axis, not " +
                       std::to_string(gap.n[axis]));
    gap.h[axis] = length / static_cast<double>(gap.n[axis]);
  }
  if (gap.cells() > 100'000'000) throw InputError("a layer has at most 100 million columns; choose fewer");
  check_lattice(gap);
  check_spheres(spheres, gap, {request.periodic[0], request.periodic[1], false});
  Lattice whole = gap;
  for (std::size_t s = 0; s < spheres.count; ++s)
    whole.h.z = std::max(whole.h.z, (spheres.z[s] + spheres.radius[s] - box.lo.z) * (1 + 1e-12));
  return {gap, whole};
}

struct Sums {
  std::vector<double> gap, mass, whole;  // [m^3], [kg], [m^3] per column
  std::vector<double> top;               // [m] above the floor
};

// The highest point of the sphere over the column's rectangle, above the floor [m]; negative where there is
// none.
double top_over(const Lattice& lattice, const PlacedSphere& sphere, std::int64_t i, std::int64_t j) {
  double squared = sphere.radius * sphere.radius;
  const std::array<std::int64_t, 2> column{i, j};
  for (int axis = 0; axis < 2; ++axis) {
    const double h = lattice.h[axis];
    const double below = static_cast<double>(column[axis] - sphere.cell[axis]) * h - sphere.offset[axis];
    const double distance = std::max({below, -(below + h), 0.0});
    squared -= distance * distance;
  }
  if (squared <= 0) return -1;
  return static_cast<double>(sphere.cell[2]) * lattice.h.z + sphere.offset.z + std::sqrt(squared);
}

// Volumes [m^3] of the sphere over each of the columns `touched`, y fastest.
void volumes_over(const Lattice& stand, const PlacedSphere& sphere, const CellRange& touched,
                  double* volumes) {
  const CellRange around = bounding_cells(stand, sphere);
  if (around.size(0) * around.size(1) * around.size(2) == 1) {  // wholly in that one
    *volumes = 4 * std::numbers::pi / 3 * (sphere.radius * sphere.radius * sphere.radius);
    return;
  }
  exact_fractions(stand, sphere, touched, volumes);
  const double cell = stand.cell_volume();
  for (std::int64_t c = touched.size(0) * touched.size(1) - 1; c >= 0; --c) volumes[c] *= cell;
}

// Adds all that one sphere brings to the columns of `block`.
void add_sphere(const SpheresView& spheres, const LayerRequest& request, const Stands& stands,
                const BinEntry& entry, const CellRange& block, Sums& sums) {
  const PlacedSphere sphere = moved(place(stands.whole, spheres, entry.sphere), stands.whole, entry.image);
  const CellRange touched = intersection(bounding_cells(stands.whole, sphere), block);
  if (touched.empty()) return;
  double whole[kBlockCells], cut[kBlockCells];
  volumes_over(stands.whole, sphere, touched, whole);
  // Most spheres lie below the top of the gap, or above it: only those that it cuts are worked on twice.
  const double height = static_cast<double>(sphere.cell[2]) * stands.whole.h.z + sphere.offset.z;
  const bool within = height + sphere.radius <= stands.gap.h.z;
  const bool above = height - sphere.radius >= stands.gap.h.z;
  if (!within && !above)
    volumes_over(stands.gap, moved(place(stands.gap, spheres, entry.sphere), stands.gap, entry.image),
                 touched, cut);
  const double* const gap = within ? whole : cut;
  const double density =
      spheres.density ? spheres.density[static_cast<std::size_t>(entry.sphere)] : request.density;
  std::size_t next = 0;
  for (std::int64_t i = touched.lo[0]; i < touched.hi[0]; ++i)
    for (std::int64_t j = touched.lo[1]; j < touched.hi[1]; ++j, ++next) {
      const auto c = static_cast<std::size_t>(i + stands.gap.n[0] * j);
      sums.whole[c] += whole[next];
      sums.top[c] = std::max(sums.top[c], top_over(stands.whole, sphere, i, j));
      if (above) continue;
      sums.gap[c] += gap[next];
      sums.mass[c] += gap[next] * density;
    }
}

Sums sums_of(const SpheresView& spheres, const LayerRequest& request, const Stands& stands) {
  const auto columns = static_cast<std::size_t>(stands.gap.cells());
  Sums sums{std::vector<double>(columns), std::vector<double>(columns), std::vector<double>(columns),
            std::vector<double>(columns)};
  const Bins bins = bin_spheres(spheres, stands.whole, {request.periodic[0], request.periodic[1], false});
  for_each_block({bins.keys.size(), 1}, [&](std::size_t b, std::size_t, std::size_t) {
    const CellRange block = block_cells(stands.whole, BlockGrid(stands.whole).block(bins.keys[b]));
    for (std::size_t e = bins.first[b]; e < bins.first[b + 1]; ++e)
      add_sphere(spheres, request, stands, bins.entries[e], block, sums);
  });
  return sums;
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : 0.0; }

// Sums over a set of columns, from which all means follow.
// Ground that a wall stands on counts for nothing.
struct Totals {
  double solid = 0, available = 0, height = 0, surface = 0;

  void add(const LayerColumns& columns, std::size_t c) {
    const double weight =
        columns.available_volume[c];  // as good as the free area: the gap is equally high everywhere
    solid += columns.solid_fraction[c] * weight;
    available += weight;
    height += columns.solid_height[c] * weight;
    surface += columns.surface_height[c] * weight;
  }
};

// Over the columns that are free for the most part: slivers beside a moving wall would only add noise.
double deviation_of(const LayerColumns& columns) {
  const double most = columns.available_volume.empty() ? 0
                                                       : *std::max_element(columns.available_volume.begin(),
                                                                           columns.available_volume.end());
  double sum = 0, squares = 0, count = 0;
  const auto free_columns = [&](const auto& body) {
    for (std::size_t c = 0; c < columns.solid_fraction.size(); ++c)
      if (columns.available_volume[c] > 0.5 * most) body(columns.solid_fraction[c]);
  };
  free_columns([&](double value) { sum += value, ++count; });
  const double mean = ratio(sum, count);
  free_columns([&](double value) { squares += (value - mean) * (value - mean); });
  return count > 1 ? std::sqrt(squares / (count - 1)) : 0.0;
}

}  // namespace

LayerColumns layer_columns(const SpheresView& spheres, const Solids& solids, const LayerRequest& request) {
  if (!(std::isfinite(request.density) && request.density >= 0))
    throw InputError("the density must be finite and not negative");
  const Stands stands = stands_of(spheres, request);
  const Sums sums = sums_of(spheres, request, stands);
  const Lattice& gap = stands.gap;
  LayerColumns columns;
  columns.columns = request.columns;
  for (std::int64_t i = 0; i < gap.n[0]; ++i) columns.x.push_back(gap.cell_center(i, 0, 0).x);
  for (std::int64_t j = 0; j < gap.n[1]; ++j) columns.y.push_back(gap.cell_center(0, j, 0).y);
  for (std::int64_t j = 0; j < gap.n[1]; ++j)
    for (std::int64_t i = 0; i < gap.n[0]; ++i) {
      const auto c = static_cast<std::size_t>(i + gap.n[0] * j);
      const Vec3d corner{gap.lo.x + static_cast<double>(i) * gap.h.x,
                         gap.lo.y + static_cast<double>(j) * gap.h.y, gap.lo.z};
      double available = gap.cell_volume();
      if (!solids.empty())
        available = std::max(0.0, available - solid_volume(solids, {corner, corner + gap.h}));
      if (available < 1e-12 * gap.cell_volume()) available = 0;  // rounding of a wall that fills the column
      const double height = ratio(sums.whole[c], available / gap.h.z);
      columns.available_volume.push_back(available);
      columns.solid_fraction.push_back(ratio(sums.gap[c], available));
      columns.mass_density.push_back(ratio(sums.mass[c], available));
      columns.solid_height.push_back(height);
      columns.surface_height.push_back(sums.top[c]);
      columns.solid_fraction_below_surface.push_back(ratio(height, sums.top[c]));
    }
  return columns;
}

LayerSummary layer_summary(const LayerColumns& columns) {
  Totals totals;
  for (std::size_t c = 0; c < columns.solid_fraction.size(); ++c) totals.add(columns, c);
  LayerSummary summary;
  summary.solid_fraction_gap = ratio(totals.solid, totals.available);
  summary.solid_height = ratio(totals.height, totals.available);
  summary.surface_height = ratio(totals.surface, totals.available);
  summary.solid_fraction_below_surface = ratio(totals.height, totals.surface);
  summary.solid_fraction_sd = deviation_of(columns);
  return summary;
}

LayerProfile layer_profile(const LayerColumns& columns, int axis) {
  const auto nx = static_cast<std::size_t>(columns.columns[0]),
             ny = static_cast<std::size_t>(columns.columns[1]);
  LayerProfile profile;
  profile.at = axis == 0 ? columns.x : columns.y;
  for (std::size_t p = 0; p < profile.at.size(); ++p) {
    Totals totals;
    for (std::size_t q = 0; q < (axis == 0 ? ny : nx); ++q)
      totals.add(columns, axis == 0 ? p + nx * q : q + nx * p);
    profile.solid_fraction.push_back(ratio(totals.solid, totals.available));
    profile.solid_height.push_back(ratio(totals.height, totals.available));
    profile.surface_height.push_back(ratio(totals.surface, totals.available));
    profile.solid_fraction_below_surface.push_back(ratio(totals.height, totals.surface));
  }
  return profile;
}

}  // namespace interstice::voxel
