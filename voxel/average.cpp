#include "voxel/average.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/error.h"
#include "base/parallel.h"
#include "voxel/average_axes.h"
#include "voxel/average_sphere.h"
#include "voxel/overlap.h"
#include "voxel/text.h"

namespace interstice::voxel {

namespace {

/// The number nearest to `value` that is an integer, where `value` was meant to be one.
double unrounded(double value) {
  const double nearest = std::round(value);
  return std::abs(value - nearest) <= 1e-9 * std::max(1.0, nearest) ? nearest : value;
}

AxisWindow box_window(double cells, double n, bool periodic) {
  AxisWindow window;
  window.periodic = periodic;
  // beyond this the window holds the whole axis from wherever it stands
  const double half = std::max(0.0, 0.5 * (std::min(cells, periodic ? n : 2 * n + 1) - 1));
  window.reach = static_cast<std::int64_t>(std::ceil(half));
  if (window.reach > 0) window.outer = half - static_cast<double>(window.reach - 1);
  return window;
}

AxisWindow gaussian_window(double cells, double n, bool periodic) {
  AxisWindow window;
  window.periodic = periodic;
  double deviation = cells / std::sqrt(12.0);
  if (periodic) deviation = std::min(deviation, 2 * n);  // flat to 1e-34 by then, but for the cut
  const double cut = kGaussianCut * deviation, scale = 1 / (deviation * std::numbers::sqrt2);
  window.reach = static_cast<std::int64_t>(std::min(std::ceil(cut - 0.5), periodic ? 0x1p40 : n - 1));
  window.reach = std::max<std::int64_t>(window.reach, 0);
  for (std::int64_t d = 0; d <= window.reach; ++d) {
    const double lo = static_cast<double>(d) - 0.5, hi = std::min(static_cast<double>(d) + 0.5, cut);
    // far out, the difference of erfc keeps its digits
    window.weights.push_back(d == 0 ? std::erf(hi * scale)
                                    : 0.5 * (std::erfc(lo * scale) - std::erfc(hi * scale)));
  }
  return window;
}

AxisWindow sphere_window(double cells, double n, bool periodic, int axis) {
  if (periodic && cells > kMostWindowPeriods * n)
    throw InputError("an averaging sphere of " + shown(cells, 4) + " voxels is more than " +
                     shown(kMostWindowPeriods) + " periods along " + "xyz"[axis] +
                     "; at most that; choose a smaller averaging length, or the box");
  AxisWindow window;
  window.periodic = periodic;
  const double reach = std::max(0.0, std::ceil(0.5 * cells - 0.5));
  window.reach = static_cast<std::int64_t>(periodic ? reach : std::min(reach, n - 1));
  return window;
}

/// What cells of one axis see of the axis' ends: those that see the same share one number, in order of
/// appearance.
struct Views {
  std::vector<std::size_t> of_cell;   // by cell of the range
  std::vector<std::int64_t> example;  // by number: a cell that sees it
};

Views views_of(const Lattice& lattice, const Window& window, const CellRange& range, const Centres& wanted,
               int axis) {
  const AxisWindow& along = window.axes[axis];
  const std::int64_t step = axis == 2 ? 1 : wanted.step;
  Views views;
  views.of_cell.resize(static_cast<std::size_t>(range.size(axis)));
  bool inner = false;
  std::size_t inner_view = 0;
  for (std::int64_t i = wanted.range.lo[axis]; i < wanted.range.hi[axis]; i += step) {
    const bool sees_no_end = along.periodic || (i >= along.reach && lattice.n[axis] - 1 - i >= along.reach);
    if (!sees_no_end || !inner) views.example.push_back(i);
    if (sees_no_end && !inner) {
      inner = true;
      inner_view = views.example.size() - 1;
    }
    views.of_cell[static_cast<std::size_t>(i - range.lo[axis])] =
        sees_no_end ? inner_view : views.example.size() - 1;
  }
  return views;
}

/// weight_inside for every cell that is wanted, by what it sees of the lattice's ends.
class InsideWeights {
 public:
  InsideWeights(const Lattice& lattice, const Window& window, const CellRange& range, const Centres& wanted) {
    for (int axis = 0; axis < 3; ++axis) views_[axis] = views_of(lattice, window, range, wanted, axis);
    const std::size_t nx = views_[0].example.size();
    ny_ = views_[1].example.size(), nz_ = views_[2].example.size();
    weights_.resize(nx * ny_ * nz_);
    for_each_block({nx * ny_, 16}, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t row = begin; row < end; ++row)
        for (std::size_t z = 0; z < nz_; ++z)
          weights_[row * nz_ + z] = weight_inside(
              lattice, window,
              {views_[0].example[row / ny_], views_[1].example[row % ny_], views_[2].example[z]});
    });
  }
  /// By places in the range, from 0.
  double at(std::size_t x, std::size_t y, std::size_t z) const {
    return weights_[(views_[0].of_cell[x] * ny_ + views_[1].of_cell[y]) * nz_ + views_[2].of_cell[z]];
  }

 private:
  std::array<Views, 3> views_;
  std::size_t ny_ = 0, nz_ = 0;
  std::vector<double> weights_;
};

/// Visits the wanted cells row by row, in parallel: row(x, y, first index of the row in `shares`), places in
/// the range from 0.
template <class Row>
void for_each_row(const DenseShares& shares, const Centres& wanted, const Row& row) {
  const CellRange& all = shares.range;
  const auto steps = static_cast<std::size_t>((wanted.range.size(0) + wanted.step - 1) / wanted.step);
  for_each_block({steps, 1}, [&](std::size_t s, std::size_t, std::size_t) {
    const std::int64_t i = wanted.range.lo[0] + static_cast<std::int64_t>(s) * wanted.step;
    for (std::int64_t j = wanted.range.lo[1]; j < wanted.range.hi[1]; j += wanted.step)
      row(static_cast<std::size_t>(i - all.lo[0]), static_cast<std::size_t>(j - all.lo[1]),
          shares.index(i, j, all.lo[2]));
  });
}

void sum_over(std::vector<double>& values, const CellRange& range, const Window& window,
              const Centres& wanted) {
  if (window.shape == WindowShape::sphere)
    sum_over_sphere(values, range, window, wanted);
  else
    sum_over_axes(values, range, window.axes);
}

}  // namespace

Window averaging_window(const Lattice& lattice, WindowShape shape, double cells,
                        const std::array<bool, 3>& periodic) {
  cells = unrounded(cells);
  Window window{shape, {}, 0.5 * cells};
  for (int axis = 0; axis < 3; ++axis) {
    const double n = static_cast<double>(lattice.n[axis]);
    window.axes[axis] = shape == WindowShape::box      ? box_window(cells, n, periodic[axis])
                        : shape == WindowShape::sphere ? sphere_window(cells, n, periodic[axis], axis)
                                                       : gaussian_window(cells, n, periodic[axis]);
  }
  return window;
}

double doubles_a_cell(const Window& window, bool walls) {
  return 1 + (walls ? 1 : 0) + (window.shape == WindowShape::sphere ? 1 : 0);
}

DenseShares dense_shares(const Lattice& lattice, const CellRange& occupied, const Window& window,
                         bool walls) {
  DenseShares shares;
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    // averages are non-zero one reach around the spheres; the walls in their windows lie another reach away
    const std::int64_t margin = window.axes[axis].reach * (walls ? 2 : 1);
    const bool whole = window.axes[axis].periodic;
    shares.range.lo[axis] = whole ? 0 : std::max<std::int64_t>(0, occupied.lo[axis] - margin);
    shares.range.hi[axis] = whole ? lattice.n[axis] : std::min(lattice.n[axis], occupied.hi[axis] + margin);
    cells *= static_cast<double>(shares.range.size(axis));
  }
  const double doubles = cells * doubles_a_cell(window, walls);
  if (doubles > kMostAverageDoubles) {
    throw InputError("averaged fields over this box need " + shown(doubles * 8 / 0x1p30, 3) +
                     " GiB (at most 4); choose a larger voxel, a smaller box, or no averaging length");
  }
  shares.solid.assign(static_cast<std::size_t>(cells), 0.0);
  if (walls) shares.available.assign(static_cast<std::size_t>(cells), 1.0);
  return shares;
}

double weight_inside(const Lattice& lattice, const Window& window, const std::array<std::int64_t, 3>& cell) {
  if (window.shape != WindowShape::sphere) {
    double weight = 1;
    for (int axis = 0; axis < 3; ++axis)
      weight *= axis_weight_inside(window.axes[axis], cell[axis], lattice.n[axis]);
    return weight;
  }
  Box box;  // the lattice as seen from the cell's centre, in cells
  for (int axis = 0; axis < 3; ++axis) {
    const bool endless = window.axes[axis].periodic;
    box.lo[axis] = endless ? -INFINITY : -(static_cast<double>(cell[axis]) + 0.5);
    box.hi[axis] = endless ? INFINITY : static_cast<double>(lattice.n[axis] - cell[axis]) - 0.5;
  }
  return sphere_box_volume({0, 0, 0}, window.radius, box);
}

void average(const Lattice& lattice, const Window& window, const Centres& wanted, DenseShares& shares,
             std::span<std::vector<double>> others) {
  const auto nz = static_cast<std::size_t>(shares.range.size(2));
  const bool walls = !shares.available.empty();
  const auto for_each_part = [&](const auto& use) {
    for (std::vector<double>& part : others)
      if (!part.empty()) use(part);
    use(shares.solid);
  };
  for_each_part([&](std::vector<double>& part) { sum_over(part, shares.range, window, wanted); });
  if (walls) sum_over(shares.available, shares.range, window, wanted);
  std::optional<InsideWeights> inside;
  if (!walls) inside.emplace(lattice, window, shares.range, wanted);
  // differences of prefix sums leave some rounding, in cells, where there is nothing
  const double nothing = window.shape == WindowShape::box ? 1e-12 : 0;
  for_each_row(shares, wanted, [&](std::size_t x, std::size_t y, std::size_t first) {
    for_each_part([&](std::vector<double>& part) {
      for (std::size_t z = 0; z < nz; ++z) {
        const double available = walls ? shares.available[first + z] : inside->at(x, y, z);
        part[first + z] = available > nothing ? part[first + z] / available : 0.0;
      }
    });
  });
}

}  // namespace interstice::voxel
