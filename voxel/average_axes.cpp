#include "voxel/average_axes.h"

#include <algorithm>

#include "base/parallel.h"

namespace interstice::voxel {

namespace {

constexpr std::size_t kLanes = 16;  // neighbouring rows that are summed side by side

/// Rows of n values, `stride` apart; rows side by side are consecutive.
struct Rows {
  std::size_t outer, n, stride;
};

/// `lanes` neighbouring rows, continued over their ends by `margin` cells: with what lies at the other side,
/// or with nothing.
class PaddedRows {
 public:
  void fill(const double* first, const Rows& rows, std::size_t lanes, std::int64_t margin, bool periodic) {
    lanes_ = lanes;
    margin_ = margin;
    const auto n = static_cast<std::int64_t>(rows.n);
    values_.assign(static_cast<std::size_t>(n + 2 * margin) * lanes, 0.0);
    for (std::int64_t i = -margin; i < n + margin; ++i) {
      const bool inside = i >= 0 && i < n;
      if (!inside && !periodic) continue;
      const std::int64_t source = inside ? i : ((i % n) + n) % n;
      std::copy_n(first + source * static_cast<std::int64_t>(rows.stride), lanes, at(i));
    }
  }
  double* at(std::int64_t i) { return values_.data() + (i + margin_) * static_cast<std::int64_t>(lanes_); }

 private:
  std::size_t lanes_ = 0;
  std::int64_t margin_ = 0;
  std::vector<double> values_;
};

/// Box: differences of prefix sums.
void sum_box(double* first, const Rows& rows, std::size_t lanes, const AxisWindow& window,
             PaddedRows& prefix) {
  const auto n = static_cast<std::int64_t>(rows.n);
  const std::int64_t reach = window.reach;
  prefix.fill(first, rows, lanes, reach + 1, window.periodic);
  for (std::int64_t i = -reach; i < n + reach + 1; ++i) {  // at(i): the sum of all cells up to i
    const double* before = prefix.at(i - 1);
    double* sum = prefix.at(i);
    for (std::size_t l = 0; l < lanes; ++l) sum[l] += before[l];
  }
  for (std::int64_t i = 0; i < n; ++i) {
    const double *lo = prefix.at(i - reach), *hi = prefix.at(i + reach - 1);
    const double *outer_lo = prefix.at(i - reach - 1), *outer_hi = prefix.at(i + reach);
    double* value = first + i * static_cast<std::int64_t>(rows.stride);
    for (std::size_t l = 0; l < lanes; ++l)
      value[l] = (hi[l] - lo[l]) + window.outer * ((outer_hi[l] - hi[l]) + (lo[l] - outer_lo[l]));
  }
}

/// Gaussian: cell by cell of the window, both sides at once.
void sum_weighted(double* first, const Rows& rows, std::size_t lanes, const AxisWindow& window,
                  PaddedRows& padded, std::vector<double>& sums) {
  padded.fill(first, rows, lanes, window.reach, window.periodic);
  const std::size_t count = rows.n * lanes;
  sums.assign(padded.at(0), padded.at(0) + count);
  for (double& sum : sums) sum *= window.weights[0];
  for (std::int64_t d = 1; d <= window.reach; ++d) {
    const double w = window.weights[static_cast<std::size_t>(d)];
    const double *lo = padded.at(-d), *hi = padded.at(d);
    for (std::size_t c = 0; c < count; ++c) sums[c] += w * (lo[c] + hi[c]);
  }
  for (std::size_t i = 0; i < rows.n; ++i)
    std::copy_n(sums.data() + i * lanes, lanes, first + i * rows.stride);
}

void sum_along(std::vector<double>& values, const Rows& rows, const AxisWindow& window) {
  if (window.reach == 0 && window.weights.empty()) return;
  const std::size_t chunks = (rows.stride + kLanes - 1) / kLanes;
  for_each_block({rows.outer * chunks, 16}, [&](std::size_t, std::size_t begin, std::size_t end) {
    PaddedRows padded;
    std::vector<double> sums;
    for (std::size_t task = begin; task < end; ++task) {
      const std::size_t lane = task % chunks * kLanes;
      const std::size_t lanes = std::min(kLanes, rows.stride - lane);
      double* first = values.data() + task / chunks * rows.n * rows.stride + lane;
      if (window.weights.empty())
        sum_box(first, rows, lanes, window, padded);
      else
        sum_weighted(first, rows, lanes, window, padded, sums);
    }
  });
}

}  // namespace

void sum_over_axes(std::vector<double>& values, const CellRange& range,
                   const std::array<AxisWindow, 3>& window) {
  const auto nx = static_cast<std::size_t>(range.size(0)), ny = static_cast<std::size_t>(range.size(1)),
             nz = static_cast<std::size_t>(range.size(2));
  sum_along(values, {nx * ny, nz, 1}, window[2]);
  sum_along(values, {nx, ny, nz}, window[1]);
  sum_along(values, {1, nx, ny * nz}, window[0]);
}

double axis_weight_inside(const AxisWindow& window, std::int64_t i, std::int64_t n) {
  const auto side = [&](std::int64_t cells) {  // cells of the axis on one side of cell i
    if (window.periodic) cells = window.reach;
    const std::int64_t within = std::min(cells, window.reach);
    if (window.weights.empty())
      return within < window.reach || within == 0 ? static_cast<double>(within)
                                                  : static_cast<double>(within - 1) + window.outer;
    double sum = 0;
    for (std::int64_t d = 1; d <= within; ++d) sum += window.weights[static_cast<std::size_t>(d)];
    return sum;
  };
  return (window.weights.empty() ? 1 : window.weights[0]) + (side(i) + side(n - 1 - i));
}

}  // namespace interstice::voxel
