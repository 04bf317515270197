#include "voxel/scales.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/parallel.h"
#include "voxel/average.h"
#include "voxel/overlap.h"
#include "voxel/sum.h"
#include "voxel/text.h"

namespace interstice::voxel {

namespace {

/// The field's voxels as doubles, all of the box.
DenseShares dense_field(const Field& field) {
  DenseShares dense;
  dense.range = all_cells(field.lattice);
  const auto cells = static_cast<std::size_t>(field.lattice.cells());
  dense.solid.resize(cells);
  if (field.available_fraction) dense.available.resize(cells);
  const auto& n = field.lattice.n;
  for_each_block({static_cast<std::size_t>(n[0]), 1}, [&](std::size_t i, std::size_t, std::size_t) {
    auto solid = field.solid_fraction->getConstAccessor();
    const auto x = static_cast<int>(i);
    for (int y = 0; y < n[1]; ++y)
      for (int z = 0; z < n[2]; ++z)
        dense.solid[dense.index(x, y, z)] = static_cast<double>(solid.getValue({x, y, z}));
    if (!field.available_fraction) return;
    auto available = field.available_fraction->getConstAccessor();
    for (int y = 0; y < n[1]; ++y)
      for (int z = 0; z < n[2]; ++z)
        dense.available[dense.index(x, y, z)] = static_cast<double>(available.getValue({x, y, z}));
  });
  return dense;
}

/// The cubes of one edge: their windows, the cells that they may be centred on, how much each holds.
struct Cubes {
  std::array<Window, 3> windows;
  CellRange centres;
  double cells = 1;  // in a cube
};

Cubes cubes_of(const Lattice& lattice, std::int64_t edge, const std::array<bool, 3>& periodic) {
  Cubes cubes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t n = lattice.n[axis];
    const bool whole = edge >= n;
    Window& window = cubes.windows[axis];
    // A window over the whole axis must neither count a cell twice nor miss one.
    window.periodic = periodic[axis] && !whole;
    window.whole = whole ? n : edge / 2;
    const std::int64_t margin = whole || periodic[axis] ? 0 : edge / 2;
    cubes.centres.lo[axis] = margin;
    cubes.centres.hi[axis] = whole ? 1 : n - margin;  // along a whole axis all centres are one
    cubes.cells *= static_cast<double>(std::min(edge, n));
  }
  return cubes;
}

ScaleRow row_of(const Lattice& lattice, std::int64_t edge, const std::array<bool, 3>& periodic,
                DenseShares shares) {
  const Cubes cubes = cubes_of(lattice, edge, periodic);
  average(lattice, cubes.windows, shares);
  ScaleRow row;
  row.length = static_cast<double>(edge) * lattice.h.x;
  CompensatedSum sum, squares, free;
  row.min = std::numeric_limits<double>::infinity(), row.max = -row.min;
  const auto visit = [&](const auto& use) {
    for (std::int64_t i = cubes.centres.lo[0]; i < cubes.centres.hi[0]; ++i)
      for (std::int64_t j = cubes.centres.lo[1]; j < cubes.centres.hi[1]; ++j)
        for (std::int64_t k = cubes.centres.lo[2]; k < cubes.centres.hi[2]; ++k) {
          const std::size_t at = shares.index(i, j, k);
          const double available = shares.available.empty() ? cubes.cells : shares.available[at];
          if (available >= 0.5 * cubes.cells) use(1 - shares.solid[at], available);
        }
  };
  visit([&](double empty, double available) {
    ++row.cubes;
    sum.add(empty);
    free.add(available);
    row.min = std::min(row.min, empty);
    row.max = std::max(row.max, empty);
  });
  if (row.cubes == 0) return row;
  const auto count = static_cast<double>(row.cubes);
  row.mean = sum.value() / count;
  visit([&](double empty, double) { squares.add((empty - row.mean) * (empty - row.mean)); });
  row.sd = std::sqrt(squares.value() / count);
  row.independent = static_cast<double>(lattice.cells()) / cubes.cells;
  row.grains = free.value() / count * lattice.cell_volume();  // the free volume of a cube, for now
  return row;
}

/// Of the spheres whose centre is in the box, or of all where none is.
double weighted_grain_volume(const SpheresView& spheres, const Box& box) {
  for (const bool all : {false, true}) {
    CompensatedSum volume, square;
    for (std::size_t s = 0; s < spheres.count; ++s) {
      if (!all && !box.contains({spheres.x[s], spheres.y[s], spheres.z[s]})) continue;
      const double r = spheres.radius[s], v = 4 * std::numbers::pi / 3 * (r * r * r);
      volume.add(v);
      square.add(v * v);
    }
    if (volume.value() > 0) return square.value() / volume.value();
  }
  return 0;
}

/// The shortest length from which on, up to the last row that has enough cubes, `holds`.
template <class Holds>
double length_from(const std::vector<ScaleRow>& rows, const Holds& holds) {
  double length = std::numeric_limits<double>::quiet_NaN();
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    if (row->independent < ScaleReport::kIndependent) continue;
    if (!holds(*row)) break;
    length = row->length;
  }
  return length;
}

}  // namespace

ScaleReport void_scales(const Field& field, const SpheresView& spheres, const std::array<bool, 3>& periodic) {
  const Lattice& lattice = field.lattice;
  if (lattice.cells() > kMostScaleCells)
    throw InputError("the scale report needs all voxels at once, and these are " +
                     std::to_string(lattice.cells()) +
                     "; at most 2^27 (134217728); choose a larger voxel or a smaller box");
  const DenseShares dense = dense_field(field);
  ScaleReport report;
  report.grain_volume = weighted_grain_volume(spheres, lattice.box());
  const std::int64_t longest = std::max({lattice.n[0], lattice.n[1], lattice.n[2]});
  std::int64_t edge = 1;
  for (;;) {
    ScaleRow row = row_of(lattice, edge, periodic, dense);
    if (row.cubes > 0) {
      const double solid = 1 - row.mean;
      row.grains = report.grain_volume > 0 ? row.grains * solid / report.grain_volume : 0;
      row.sd_random = row.grains > 0 ? solid / std::sqrt(row.grains) : 0;
      row.sd_one_grain = row.grains > 0 ? solid / row.grains : 0;
      report.rows.push_back(row);
    }
    if (edge >= longest) break;
    // some four lengths to a doubling, all odd
    edge = std::max(edge + 2, static_cast<std::int64_t>(static_cast<double>(edge) * 1.19) / 2 * 2 + 1);
  }
  const auto& rows = report.rows;
  report.random_length = length_from(rows, [](const ScaleRow& row) { return row.sd <= row.sd_random; });
  report.many_grains_length =
      length_from(rows, [](const ScaleRow& row) { return row.sd >= row.sd_one_grain; });
  return report;
}

}  // namespace interstice::voxel
