#include "voxel/scales.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/parallel.h"
#include "voxel/average.h"
#include "voxel/average_axes.h"
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

/// The windows of one length: where they stand, and how much each holds.
struct Windows {
  Window window;
  Centres centres;
  double weight = 0;     // as weight_inside
  double effective = 0;  // cells that count alike and give an average of the same spread
};

/// For weights w: (sum of w)^2 / (sum of w^2), over the part of an axis that is inside. What averaging over
/// white noise leaves of its variance is the inverse of this, so that a Gaussian is compared with as many
/// grains as a box of the same spread would hold.
double effective_cells(const AxisWindow& window, std::int64_t i, std::int64_t n) {
  double squares = window.weights[0] * window.weights[0];
  for (const std::int64_t side : {i, n - 1 - i})
    for (std::int64_t d = 1; d <= (window.periodic ? window.reach : std::min(side, window.reach)); ++d)
      squares += window.weights[static_cast<std::size_t>(d)] * window.weights[static_cast<std::size_t>(d)];
  const double sum = axis_weight_inside(window, i, n);
  return sum * sum / squares;
}

Windows windows_of(const Lattice& lattice, WindowShape shape, std::int64_t edge,
                   const std::array<bool, 3>& periodic) {
  Windows windows{averaging_window(lattice, shape, static_cast<double>(edge), periodic), {}, 0, 0};
  std::array<std::int64_t, 3> example;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t n = lattice.n[axis];
    const bool cube_takes_all = shape == WindowShape::box && edge >= n;
    AxisWindow& along = windows.window.axes[axis];
    if (cube_takes_all) along = {false, n, 1, {}};  // neither a cell twice nor one missed
    CellRange& range = windows.centres.range;
    const bool all = periodic[axis] && !cube_takes_all, middle = !all && edge >= n;
    range.lo[axis] = all ? 0 : middle ? n / 2 : edge / 2;
    range.hi[axis] = all ? n : middle ? n / 2 + 1 : n - edge / 2;
    example[axis] = (range.lo[axis] + range.hi[axis]) / 2;
  }
  if (shape == WindowShape::sphere) windows.centres.step = std::max<std::int64_t>(1, edge / 8);
  windows.weight = weight_inside(lattice, windows.window, example);
  windows.effective = windows.weight;
  if (shape == WindowShape::gaussian) {
    windows.effective = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      windows.effective *= effective_cells(windows.window.axes[axis], example[axis], lattice.n[axis]);
  }
  return windows;
}

ScaleRow row_of(const Lattice& lattice, const Windows& windows, std::int64_t edge, DenseShares shares) {
  average(lattice, windows.window, windows.centres, shares);
  ScaleRow row;
  row.length = static_cast<double>(edge) * lattice.h.x;
  CompensatedSum sum, squares, free;
  row.min = std::numeric_limits<double>::infinity(), row.max = -row.min;
  const CellRange& range = windows.centres.range;
  const auto visit = [&](const auto& use) {
    for (std::int64_t i = range.lo[0]; i < range.hi[0]; i += windows.centres.step)
      for (std::int64_t j = range.lo[1]; j < range.hi[1]; j += windows.centres.step)
        for (std::int64_t k = range.lo[2]; k < range.hi[2]; ++k) {
          const std::size_t at = shares.index(i, j, k);
          const double available = shares.available.empty() ? 1 : shares.available[at] / windows.weight;
          if (available >= 0.5) use(1 - shares.solid[at], available);
        }
  };
  visit([&](double empty, double available) {
    ++row.windows;
    sum.add(empty);
    free.add(available);
    row.min = std::min(row.min, empty);
    row.max = std::max(row.max, empty);
  });
  if (row.windows == 0) return row;
  const auto count = static_cast<double>(row.windows);
  row.mean = sum.value() / count;
  visit([&](double empty, double) { squares.add((empty - row.mean) * (empty - row.mean)); });
  row.sd = std::sqrt(squares.value() / count);
  row.independent = static_cast<double>(lattice.cells()) / windows.effective;
  // the free volume of a window, for now
  row.grains = free.value() / count * windows.effective * lattice.cell_volume();
  return row;
}

/// Lengths in voxels: some four to a doubling, all odd; the last is the first that is as long as the box.
std::vector<std::int64_t> edges_of(const Lattice& lattice, WindowShape shape,
                                   const std::array<bool, 3>& periodic) {
  std::int64_t longest = std::max({lattice.n[0], lattice.n[1], lattice.n[2]});
  std::int64_t most = std::numeric_limits<std::int64_t>::max();
  for (std::size_t axis = 0; axis < 3; ++axis)
    if (shape == WindowShape::sphere && periodic[axis])
      most = std::min(most, static_cast<std::int64_t>(kMostWindowPeriods) * lattice.n[axis]);
  std::vector<std::int64_t> edges;
  for (std::int64_t edge = 1; edge <= most;
       edge = std::max(edge + 2, static_cast<std::int64_t>(static_cast<double>(edge) * 1.19) / 2 * 2 + 1)) {
    edges.push_back(edge);
    if (edge >= longest) break;
  }
  return edges;
}

/// [m^3], ascending: of the spheres whose centre is in the box, or of all where none is.
std::vector<double> grain_volumes(const SpheresView& spheres, const Box& box) {
  std::vector<double> volumes;
  for (const bool all : {false, true}) {
    for (std::size_t s = 0; s < spheres.count; ++s) {
      if (!all && !box.contains({spheres.x[s], spheres.y[s], spheres.z[s]})) continue;
      const double r = spheres.radius[s];
      volumes.push_back(4 * std::numbers::pi / 3 * (r * r * r));
    }
    if (!volumes.empty()) break;
  }
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

double weighted_mean(const std::vector<double>& volumes) {
  CompensatedSum sum, squares;
  for (const double v : volumes) {
    sum.add(v);
    squares.add(v * v);
  }
  return volumes.empty() ? 0 : squares.value() / sum.value();
}

/// [m] of the grain at which half of all volume is reached.
double median_diameter(const std::vector<double>& volumes) {
  CompensatedSum all, below;
  for (const double v : volumes) all.add(v);
  for (const double v : volumes) {
    below.add(v);
    if (below.value() >= 0.5 * all.value()) return 2 * std::cbrt(v * 3 / (4 * std::numbers::pi));
  }
  return 0;
}

/// The shortest length from which on, up to the last row that has enough windows, `holds`.
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

ScaleReport void_scales(const Field& field, const SpheresView& spheres, const std::array<bool, 3>& periodic,
                        WindowShape window) {
  const Lattice& lattice = field.lattice;
  if (lattice.cells() > kMostScaleCells)
    throw InputError("the scale report needs all voxels at once, and these are " +
                     std::to_string(lattice.cells()) +
                     "; at most 2^27 (134217728); choose a larger voxel or a smaller box");
  const DenseShares dense = dense_field(field);
  ScaleReport report;
  report.window = window;
  const std::vector<double> volumes = grain_volumes(spheres, lattice.box());
  report.grain_volume = weighted_mean(volumes);
  report.median_diameter = median_diameter(volumes);
  for (const std::int64_t edge : edges_of(lattice, window, periodic)) {
    ScaleRow row = row_of(lattice, windows_of(lattice, window, edge, periodic), edge, dense);
    if (row.windows == 0) continue;
    const double solid = 1 - row.mean;
    row.grains = report.grain_volume > 0 ? row.grains * solid / report.grain_volume : 0;
    row.sd_random = row.grains > 0 ? solid / std::sqrt(row.grains) : 0;
    row.sd_one_grain = row.grains > 0 ? solid / row.grains : 0;
    report.rows.push_back(row);
  }
  const auto& rows = report.rows;
  report.random_length = length_from(rows, [](const ScaleRow& row) { return row.sd <= row.sd_random; });
  report.many_grains_length =
      length_from(rows, [](const ScaleRow& row) { return row.sd >= row.sd_one_grain; });
  return report;
}

}  // namespace interstice::voxel
