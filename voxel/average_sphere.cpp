#include "voxel/average_sphere.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "voxel/overlap.h"

namespace interstice::voxel {

namespace {

constexpr std::int64_t kChunk = 1024;  // values that are worked on at once

/// The shares of the cells (a, b, 0), (a, b, 1), ... up to c = most.
BallRow row_of(const Lattice& cells, const PlacedSphere& ball, std::int64_t a, std::int64_t b,
               std::int64_t most) {
  BallRow row{a, b, 0, {}};
  double shares[kBlock];
  for (std::int64_t c = 0; c <= most; c += kBlock) {
    const CellRange block{{a, b, c}, {a + 1, b + 1, std::min(c + kBlock, most + 1)}};
    exact_fractions(cells, ball, block, shares);
    for (std::int64_t k = 0; k < block.size(2); ++k) {
      if (!(shares[k] > 0)) return row;
      if (shares[k] < 1 || !row.cut.empty())
        row.cut.push_back(shares[k]);
      else
        ++row.whole;
    }
  }
  return row;
}

/// The places of cells along y that an offset leads to, in pieces without gaps: calls
/// piece(first output row, first input row, rows) for the output rows [lo, hi).
template <class Piece>
void for_each_piece(std::int64_t lo, std::int64_t hi, std::int64_t offset, std::int64_t n, bool periodic,
                    const Piece& piece) {
  if (!periodic) {
    const std::int64_t from = std::max(lo, -offset), to = std::min(hi, n - offset);
    if (from < to) piece(from, from + offset, to - from);
    return;
  }
  for (std::int64_t out = lo; out < hi;) {
    const std::int64_t in = (((out + offset) % n) + n) % n, rows = std::min(hi - out, n - in);
    piece(out, in, rows);
    out += rows;
  }
}

/// Sums over one sphere-shaped window for a few neighbouring rows of one plane.
class RowSums {
 public:
  RowSums(const std::vector<double>& values, const CellRange& range, const Window& window,
          const std::vector<BallRow>& rows)
      : values_(values.data()), window_(window), rows_(rows) {
    for (int axis = 0; axis < 3; ++axis) n_[axis] = range.size(axis);
    for (const BallRow& row : rows)
      reach_ = std::max(reach_, row.whole + static_cast<std::int64_t>(row.cut.size()) - 1);
  }

  /// The sums for rows [lo, hi) of plane x to `out`, which begins with row lo.
  void sum(std::int64_t x, std::int64_t lo, std::int64_t hi, double* out) {
    x_ = x, lo_ = lo, hi_ = hi;
    const std::size_t count = static_cast<std::size_t>((hi - lo) * n_[2]);
    const auto reach = static_cast<std::size_t>(reach_);
    gathered_.resize(count);
    by_offset_.assign((reach + 1) * count, 0.0);
    by_length_.assign((reach + 2) * count, 0.0);
    for (const BallRow& row : rows_) {
      if (!gather(row)) continue;
      if (row.whole > 0) add(1, by_length_.data() + static_cast<std::size_t>(row.whole) * count);
      for (std::size_t c = 0; c < row.cut.size(); ++c)
        add(row.cut[c], by_offset_.data() + (static_cast<std::size_t>(row.whole) + c) * count);
    }
    // a row with `whole` cells counts at all |c| < whole
    for (std::size_t c = reach + 1; c-- > 0;) {
      double *longer = by_length_.data() + (c + 1) * count, *here = by_length_.data() + c * count,
             *offset = by_offset_.data() + c * count;
      for (std::size_t v = 0; v < count; ++v) {
        offset[v] += longer[v];
        here[v] += longer[v];
      }
    }
    shift(out);
  }

 private:
  void add(double weight, double* to) const {
    for (std::size_t v = 0; v < gathered_.size(); ++v) to[v] += weight * gathered_[v];
  }

  /// The sum of the rows at the offsets of one BallRow, or false where there are none.
  bool gather(const BallRow& row) {
    std::fill(gathered_.begin(), gathered_.end(), 0.0);
    any_ = false;
    add_rows(row.a, row.b);
    if (row.b > 0) add_rows(row.a, -row.b);
    if (row.a > 0) add_rows(-row.a, row.b);
    if (row.a > 0 && row.b > 0) add_rows(-row.a, -row.b);
    if (row.a == row.b) return any_;
    add_rows(row.b, row.a);
    add_rows(row.b, -row.a);
    if (row.b > 0) add_rows(-row.b, row.a);
    if (row.b > 0) add_rows(-row.b, -row.a);
    return any_;
  }

  void add_rows(std::int64_t dx, std::int64_t dy) {
    std::int64_t x = x_ + dx;
    if (window_.axes[0].periodic) x = ((x % n_[0]) + n_[0]) % n_[0];
    if (x < 0 || x >= n_[0]) return;
    const double* plane = values_ + x * n_[1] * n_[2];
    for_each_piece(lo_, hi_, dy, n_[1], window_.axes[1].periodic,
                   [&](std::int64_t to, std::int64_t from, std::int64_t rows) {
                     any_ = true;
                     double* sum = gathered_.data() + (to - lo_) * n_[2];
                     const double* value = plane + from * n_[2];
                     for (std::int64_t v = 0; v < rows * n_[2]; ++v) sum[v] += value[v];
                   });
  }

  /// Adds up the sums by offset along z, both sides at once.
  void shift(double* out) const {
    const std::int64_t n = n_[2];
    const std::size_t count = gathered_.size();
    std::copy_n(by_offset_.data(), count, out);
    for (std::int64_t c = 1; c <= reach_; ++c) {
      const double* sums = by_offset_.data() + static_cast<std::size_t>(c) * count;
      for (std::int64_t row = 0; row < hi_ - lo_; ++row, sums += n) {
        double* to = out + row * n;
        if (window_.axes[2].periodic) {
          const std::int64_t d = c % n;
          for (std::int64_t k = 0; k < n; ++k)
            to[k] += sums[k >= d ? k - d : k - d + n] + sums[k + d < n ? k + d : k + d - n];
          continue;
        }
        const std::int64_t both = std::min(c, n), last = std::max(n - c, std::int64_t{0});
        for (std::int64_t k = 0; k < std::min(both, last); ++k) to[k] += sums[k + c];
        for (std::int64_t k = both; k < last; ++k) to[k] += sums[k - c] + sums[k + c];
        for (std::int64_t k = std::max(both, last); k < n; ++k) to[k] += sums[k - c];
      }
    }
  }

  const double* values_;
  const Window& window_;
  const std::vector<BallRow>& rows_;
  std::array<std::int64_t, 3> n_{0, 0, 0};
  std::int64_t reach_ = 0, x_ = 0, lo_ = 0, hi_ = 0;
  bool any_ = false;
  std::vector<double> gathered_, by_offset_, by_length_;
};

}  // namespace

std::vector<BallRow> ball_rows(double radius, const std::array<std::int64_t, 3>& most) {
  const Lattice cells{{0, 0, 0}, {1, 1, 1}, {1, 1, 1}};
  const PlacedSphere ball{{0, 0, 0}, {0.5, 0.5, 0.5}, radius};
  const std::int64_t reach = std::max<std::int64_t>(0, floor_index(std::ceil(radius - 0.5)));
  const auto within = [&](int axis) { return most[axis] < 0 ? reach : std::min(reach, most[axis]); };
  const std::int64_t x = within(0), y = within(1);
  std::vector<BallRow> rows;
  for (std::int64_t a = 0; a <= std::max(x, y); ++a)
    for (std::int64_t b = 0; b <= std::min({a, x, y}); ++b) {
      BallRow row = row_of(cells, ball, a, b, within(2));
      if (row.whole == 0 && row.cut.empty()) break;
      rows.push_back(std::move(row));
    }
  return rows;
}

void sum_over_sphere(std::vector<double>& values, const CellRange& range, const Window& window,
                     const Centres& wanted) {
  std::array<std::int64_t, 3> most;
  for (int axis = 0; axis < 3; ++axis) most[axis] = window.axes[axis].periodic ? -1 : range.size(axis) - 1;
  const std::vector<BallRow> rows = ball_rows(window.radius, most);
  const std::int64_t nz = range.size(2), plane = range.size(1) * nz;
  const auto steps = [&](int axis) { return (wanted.range.size(axis) + wanted.step - 1) / wanted.step; };
  // rows side by side are worked on together, unless only every step-th is wanted
  const std::int64_t together = wanted.step > 1 ? 1 : std::max<std::int64_t>(1, kChunk / nz);
  const std::int64_t chunks = (steps(1) + together - 1) / together;
  std::vector<double> sums(values.size());
  for_each_block(
      {static_cast<std::size_t>(steps(0) * chunks), 8}, [&](std::size_t, std::size_t begin, std::size_t end) {
        RowSums row_sums(values, range, window, rows);
        for (std::size_t task = begin; task < end; ++task) {
          const auto t = static_cast<std::int64_t>(task);
          const std::int64_t x = wanted.range.lo[0] - range.lo[0] + t / chunks * wanted.step;
          const std::int64_t lo = wanted.range.lo[1] - range.lo[1] + t % chunks * together * wanted.step;
          const std::int64_t hi = std::min(lo + together, wanted.range.hi[1] - range.lo[1]);
          row_sums.sum(x, lo, hi, sums.data() + x * plane + lo * nz);
        }
      });
  values.swap(sums);
}

}  // namespace interstice::voxel
