#include "coupling/studies/void_histogram.h"

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>

namespace interstice::studies {
namespace {

constexpr double rounding = 1e-6;  // of a grid's floats: such values count as 0 and 1

voxel::CellRange counted_cells(const voxel::Lattice& lattice,
                               const std::optional<voxel::LayerRequest>& layer) {
  auto range = voxel::all_cells(lattice);
  if (!layer) return range;
  const auto first_centre_from = [&](double z) {
    return static_cast<std::int64_t>(std::ceil((z - lattice.lo.z) / lattice.h.z - 0.5 - 1e-9));
  };
  range.lo[2] = std::clamp(first_centre_from(layer->box.lo.z), std::int64_t{0}, lattice.n[2]);
  range.hi[2] = std::clamp(first_centre_from(layer->box.hi.z), range.lo[2], lattice.n[2]);
  return range;
}

/// Calls visit(cell, value) for each active voxel inside `range`, those of tiles too.
template <class Visit>
void for_each_active(const voxel::FloatGrid& grid, const voxel::CellRange& range, const Visit& visit) {
  if (range.empty()) return;
  const auto coord = [](const std::array<std::int64_t, 3>& c, int less) {
    return openvdb::Coord(static_cast<int>(c[0]) - less, static_cast<int>(c[1]) - less,
                          static_cast<int>(c[2]) - less);
  };
  const openvdb::CoordBBox counted(coord(range.lo, 0), coord(range.hi, 1));
  for (auto it = grid.cbeginValueOn(); it; ++it) {
    openvdb::CoordBBox box;
    it.getBoundingBox(box);
    box.intersect(counted);
    if (box.empty()) continue;
    for (auto cell = box.begin(); cell; ++cell) visit(*cell, static_cast<double>(*it));
  }
}

void count(VoidHistogram::Counts& counts, double value, std::int64_t times) {
  if (value < -rounding) {
    counts.negative += times;
    return;
  }
  const int bin = static_cast<int>((value + rounding) * VoidHistogram::bins);
  counts.in_bin[static_cast<std::size_t>(std::clamp(bin, 0, VoidHistogram::bins - 1))] += times;
}

VoidHistogram::Counts counts_of(const voxel::FloatGrid& values, const voxel::Field& field,
                                const voxel::CellRange& range, std::int64_t cells) {
  VoidHistogram::Counts counts{0, std::vector<std::int64_t>(VoidHistogram::bins, 0)};
  std::int64_t seen = 0;
  const auto& available = field.available_fraction ? *field.available_fraction : values;
  auto wall = available.getConstAccessor();
  for_each_active(values, range, [&](const openvdb::Coord& cell, double value) {
    if (field.available_fraction && !(wall.getValue(cell) > 0)) return;
    ++seen;
    count(counts, value, 1);
  });
  count(counts, static_cast<double>(values.background()), cells - seen);
  return counts;
}

}  // namespace

VoidHistogram void_histogram(const voxel::Field& field, const std::optional<voxel::LayerRequest>& layer) {
  VoidHistogram histogram;
  if (layer) histogram.layer = {{layer->box.lo.z, layer->box.hi.z}};
  const auto range = counted_cells(field.lattice, layer);
  histogram.cells = range.cells();
  if (field.available_fraction) {
    for_each_active(*field.available_fraction, range, [&](const openvdb::Coord&, double available) {
      if (!(available > 0)) --histogram.cells;
    });
  }
  histogram.voxels = counts_of(*field.void_fraction, field, range, histogram.cells);
  if (field.void_fraction_averaged) {
    histogram.averaged = counts_of(*field.void_fraction_averaged, field, range, histogram.cells);
  }
  return histogram;
}

std::string csv_of(const VoidHistogram& histogram) {
  const auto& averaged = histogram.averaged;
  std::string text = "void_fraction_from,void_fraction_to,voxels";
  text += averaged ? ",voxels_averaged\n" : "\n";
  text += fmt::format("-inf,0,{}", histogram.voxels.negative);
  text += averaged ? fmt::format(",{}\n", averaged->negative) : "\n";
  for (int b = 0; b < VoidHistogram::bins; ++b) {
    const auto i = static_cast<std::size_t>(b);
    text += fmt::format("{},{},{}", VoidHistogram::bin_edge(b), VoidHistogram::bin_edge(b + 1),
                        histogram.voxels.in_bin[i]);
    text += averaged ? fmt::format(",{}\n", averaged->in_bin[i]) : "\n";
  }
  return text;
}

}  // namespace interstice::studies
