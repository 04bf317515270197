#include "voxel/average.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "voxel/text.h"

namespace interstice::voxel {

namespace {

constexpr std::size_t kLanes = 16;  // neighbouring rows that are summed side by side

// Rows of n values, `stride` apart; rows side by side are consecutive.
struct Rows {
  std::size_t outer, n, stride;
};

// Window sums along `lanes` neighbouring rows at once. `prefix` holds the running sums of the row, continued
// over its ends by `margin` cells: with what lies at the other side, or with nothing.
void sum_rows(double* first, const Rows& rows, std::size_t lanes, const Window& window,
              std::vector<double>& prefix) {
  const auto n = static_cast<std::int64_t>(rows.n), margin = window.whole + 1;
  prefix.assign(static_cast<std::size_t>(n + 2 * margin + 1) * kLanes, 0.0);
  const auto at = [&](std::int64_t i) {
    return prefix.data() + (i + margin) * static_cast<std::int64_t>(kLanes);
  };
  for (std::int64_t i = -margin; i < n + margin; ++i) {
    const double* before = at(i);
    double* after = at(i + 1);
    const bool inside = i >= 0 && i < n;
    const std::int64_t source = inside || !window.periodic ? i : ((i % n) + n) % n;
    if (inside || window.periodic) {
      const double* value = first + source * static_cast<std::int64_t>(rows.stride);
      for (std::size_t l = 0; l < lanes; ++l) after[l] = before[l] + value[l];
    } else {
      for (std::size_t l = 0; l < lanes; ++l) after[l] = before[l];
    }
  }
  for (std::int64_t i = 0; i < n; ++i) {
    const double *lo = at(i - window.whole), *hi = at(i + window.whole + 1);
    const double *outer_lo = at(i - window.whole - 1), *outer_hi = at(i + window.whole + 2);
    double* value = first + i * static_cast<std::int64_t>(rows.stride);
    for (std::size_t l = 0; l < lanes; ++l)
      value[l] = (hi[l] - lo[l]) + window.rest * ((outer_hi[l] - hi[l]) + (lo[l] - outer_lo[l]));
  }
}

void sum_along(std::vector<double>& values, const Rows& rows, const Window& window) {
  if (window.reach() == 0) return;
  const std::size_t chunks = (rows.stride + kLanes - 1) / kLanes;
  for_each_block({rows.outer * chunks, 16}, [&](std::size_t, std::size_t begin, std::size_t end) {
    std::vector<double> prefix;
    for (std::size_t task = begin; task < end; ++task) {
      const std::size_t lane = task % chunks * kLanes;
      double* first = values.data() + task / chunks * rows.n * rows.stride + lane;
      sum_rows(first, rows, std::min(kLanes, rows.stride - lane), window, prefix);
    }
  });
}

void sum_over_cube(std::vector<double>& values, const CellRange& range,
                   const std::array<Window, 3>& windows) {
  const auto nx = static_cast<std::size_t>(range.size(0)), ny = static_cast<std::size_t>(range.size(1)),
             nz = static_cast<std::size_t>(range.size(2));
  sum_along(values, {nx * ny, nz, 1}, windows[2]);
  sum_along(values, {nx, ny, nz}, windows[1]);
  sum_along(values, {1, nx, ny * nz}, windows[0]);
}

// What a window centred on each cell of an axis holds of the lattice, in cells.
std::vector<double> window_lengths(const Lattice& lattice, const CellRange& range, const Window& window,
                                   int axis) {
  std::vector<double> lengths;
  for (std::int64_t i = range.lo[axis]; i < range.hi[axis]; ++i) {
    const auto side = [&](std::int64_t cells) {  // cells of the lattice on one side of cell i
      if (window.periodic) cells = window.whole + 1;
      return static_cast<double>(std::min(cells, window.whole)) + (cells > window.whole ? window.rest : 0.0);
    };
    lengths.push_back(1 + side(i) + side(lattice.n[axis] - 1 - i));
  }
  return lengths;
}

}  // namespace

std::array<Window, 3> averaging_windows(const Lattice& lattice, double length,
                                        const std::array<bool, 3>& periodic) {
  std::array<Window, 3> windows;
  for (int axis = 0; axis < 3; ++axis) {
    const double n = static_cast<double>(lattice.n[axis]);
    // beyond this the window holds the whole axis from wherever it stands
    const double cells = std::min(length / lattice.h[axis], periodic[axis] ? n : 2 * n + 1);
    const double half = std::max(0.0, 0.5 * (cells - 1));
    windows[axis].whole = static_cast<std::int64_t>(half);
    windows[axis].rest = half - std::floor(half);
    windows[axis].periodic = periodic[axis];
  }
  return windows;
}

DenseShares dense_shares(const Lattice& lattice, const CellRange& occupied,
                         const std::array<Window, 3>& windows, bool walls) {
  DenseShares shares;
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    // averages are non-zero one reach around the spheres; the walls in their windows lie another reach away
    const std::int64_t margin = windows[axis].reach() * (walls ? 2 : 1);
    const bool whole = windows[axis].periodic;
    shares.range.lo[axis] = whole ? 0 : std::max<std::int64_t>(0, occupied.lo[axis] - margin);
    shares.range.hi[axis] = whole ? lattice.n[axis] : std::min(lattice.n[axis], occupied.hi[axis] + margin);
    cells *= static_cast<double>(shares.range.size(axis));
  }
  const double doubles = cells * (walls ? 2 : 1);
  if (doubles > kMostAverageDoubles) {
    throw InputError("averaged fields over this box need " + shown(doubles * 8 / 0x1p30, 3) +
                     " GiB (at most 4); choose a larger voxel, a smaller box, or no averaging length");
  }
  shares.solid.assign(static_cast<std::size_t>(cells), 0.0);
  if (walls) shares.available.assign(static_cast<std::size_t>(cells), 1.0);
  return shares;
}

void average(const Lattice& lattice, const std::array<Window, 3>& windows, DenseShares& shares) {
  const CellRange& range = shares.range;
  sum_over_cube(shares.solid, range, windows);
  if (!shares.available.empty()) {
    sum_over_cube(shares.available, range, windows);
    for_each_block({shares.solid.size(), 1 << 16}, [&](std::size_t, std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c)
        shares.solid[c] = shares.available[c] > 1e-12 ? shares.solid[c] / shares.available[c] : 0.0;
    });
    return;
  }
  std::array<std::vector<double>, 3> lengths;
  for (int axis = 0; axis < 3; ++axis) lengths[axis] = window_lengths(lattice, range, windows[axis], axis);
  for_each_block({lengths[0].size(), 1}, [&](std::size_t i, std::size_t, std::size_t) {
    double* value = shares.solid.data() + i * lengths[1].size() * lengths[2].size();
    for (const double y : lengths[1])
      for (const double z : lengths[2]) *value++ /= lengths[0][i] * y * z;
  });
}

}  // namespace interstice::voxel
