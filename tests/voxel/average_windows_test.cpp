// Averaging windows against windows summed cell by cell, with weights that are found another way.
#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/error.h"
#include "base/random.h"
#include "tests/voxel/reference_volume.h"
#include "voxel/average.h"
#include "voxel/overlap.h"

namespace interstice::voxel::test {
namespace {

using Flags = std::array<bool, 3>;
using Cell = std::array<std::int64_t, 3>;

constexpr WindowShape kAll[] = {WindowShape::box, WindowShape::sphere, WindowShape::gaussian};

Lattice lattice_of(const Cell& n) { return {{0, 0, 0}, {1, 1, 1}, n}; }

/// Random shares; with walls, a third of the cells is full of wall and a third cut by it.
DenseShares random_shares(const Lattice& lattice, bool walls, std::uint64_t seed) {
  DenseShares shares;
  shares.range = all_cells(lattice);
  for (std::int64_t c = 0; c < lattice.cells(); ++c) {
    Random random(seed, static_cast<std::uint64_t>(c));
    const double kind = random.uniform(), part = random.uniform();
    const double available = !walls ? 1 : kind < 1. / 3 ? 0 : kind < 2. / 3 ? part : 1;
    shares.solid.push_back(available * random.uniform());
    if (walls) shares.available.push_back(available);
  }
  return shares;
}

/// The weight of the cell at an offset from the window's own.
class Weights {
 public:
  Weights(WindowShape shape, double length) : shape_(shape), length_(length) {}

  double operator()(const Cell& offset) {
    const Cell d{std::abs(offset[0]), std::abs(offset[1]), std::abs(offset[2])};
    double& known = known_[static_cast<std::size_t>((d[0] * kMost + d[1]) * kMost + d[2])];
    if (std::isnan(known)) known = found(d);
    return known;
  }

 private:
  double found(const Cell& at) const {
    if (shape_ == WindowShape::sphere) {
      const double x = static_cast<double>(at[0]), y = static_cast<double>(at[1]),
                   z = static_cast<double>(at[2]);
      return reference_volume({0, 0, 0}, length_ / 2, {{x - .5, y - .5, z - .5}, {x + .5, y + .5, z + .5}});
    }
    return along(at[0]) * along(at[1]) * along(at[2]);
  }
  double along(std::int64_t d) const {
    const double lo = std::max(static_cast<double>(d) - .5, 0.) * (d > 0), hi = static_cast<double>(d) + .5;
    const double sides = d > 0 ? 1 : 2;  // the centre's cell lies on both
    if (shape_ == WindowShape::box) {
      const double half = std::max(length_, 1.) / 2;
      return sides * std::max(0., std::min(hi, half) - lo);
    }
    const double deviation = length_ / std::sqrt(12.), cut = 4 * deviation;
    if (lo >= cut) return 0;
    using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
    const auto density = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
    return sides * Rule::integrate(density, lo, std::min(hi, cut), 0) /
           (deviation * std::sqrt(2 * std::numbers::pi));
  }

  WindowShape shape_;
  double length_;
  static constexpr std::int64_t kMost = 40;
  std::vector<double> known_ = std::vector<double>(kMost * kMost * kMost, NAN);
};

struct Case {
  WindowShape shape;
  double length;  // in cells
  Flags periodic;
  bool walls;
  Cell n{9, 7, 11};
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << name_of(c.shape) << ' ' << c.length << " cells" << (c.walls ? ", walls" : "");
  for (const bool p : c.periodic) *out << (p ? " periodic" : " open");
}

class WindowsAgainstDirectSums : public testing::TestWithParam<Case> {};

TEST_P(WindowsAgainstDirectSums, EveryCell) {
  const Case& c = GetParam();
  const Lattice lattice = lattice_of(c.n);
  const Window window = averaging_window(lattice, c.shape, c.length, c.periodic);
  const DenseShares before = random_shares(lattice, c.walls, 7);
  DenseShares after = before;
  average(lattice, window, {after.range}, after);
  Weights weights(c.shape, c.length);
  Cell reach;  // of the direct sums: a few cells more than the window's
  for (std::size_t a = 0; a < 3; ++a)
    reach[a] = c.periodic[a] ? static_cast<std::int64_t>(1.2 * c.length) + 3 : c.n[a];
  Cell d;
  for (std::int64_t i = 0; i < c.n[0]; ++i)
    for (std::int64_t j = 0; j < c.n[1]; ++j)
      for (std::int64_t k = 0; k < c.n[2]; ++k) {
        double solid = 0, available = 0;
        for (d[0] = -reach[0]; d[0] <= reach[0]; ++d[0])
          for (d[1] = -reach[1]; d[1] <= reach[1]; ++d[1])
            for (d[2] = -reach[2]; d[2] <= reach[2]; ++d[2]) {
              Cell at{i + d[0], j + d[1], k + d[2]};
              bool inside = true;
              for (std::size_t a = 0; a < 3; ++a) {
                if (c.periodic[a]) at[a] = (at[a] % c.n[a] + c.n[a]) % c.n[a];
                inside = inside && at[a] >= 0 && at[a] < c.n[a];
              }
              if (!inside) continue;
              const std::size_t index = before.index(at[0], at[1], at[2]);
              const double w = weights(d);
              solid += w * before.solid[index];
              available += w * (c.walls ? before.available[index] : 1);
            }
        const double expected = available > 0 ? solid / available : 0;
        // rounding of sums of some thousand shares and of prefix sums of rows
        ASSERT_NEAR(after.solid[after.index(i, j, k)], expected, 1e-13) << i << ' ' << j << ' ' << k;
        if (!c.walls) {
          EXPECT_NEAR(weight_inside(lattice, window, {i, j, k}), available, 1e-12);
        }
      }
}

constexpr Flags kOpen{false, false, false}, kSlab{true, true, false}, kPeriodic{true, true, true};

INSTANTIATE_TEST_SUITE_P(
    All, WindowsAgainstDirectSums,
    testing::Values(
        Case{WindowShape::sphere, 5, kOpen, false}, Case{WindowShape::sphere, 5.3, kSlab, true},
        Case{WindowShape::sphere, 1, kOpen, true}, Case{WindowShape::sphere, 1.4, kPeriodic, true},
        Case{WindowShape::sphere, 9.9, kPeriodic, false},
        Case{WindowShape::sphere, 14.2, kSlab, true},  // more than a period of y
        Case{WindowShape::sphere, 40, kOpen, true},    // more than the box
        Case{WindowShape::sphere, 8, {false, true, false}, true, {17, 1, 3}},
        Case{WindowShape::sphere, 7, {true, false, true}, false, {1, 12, 2}},
        Case{WindowShape::gaussian, 5, kOpen, false}, Case{WindowShape::gaussian, 4.4, kSlab, true},
        Case{WindowShape::gaussian, .8, kPeriodic, true}, Case{WindowShape::gaussian, 12, kSlab, true},
        Case{WindowShape::gaussian, 8, {false, true, false}, true, {17, 1, 3}},
        Case{WindowShape::box, 5.3, kSlab, true}, Case{WindowShape::box, 6, kOpen, true}));

TEST(Windows, AUniformFieldStaysUniform) {
  // whatever walls and open edges take of a window, solid and available lose the same
  const Lattice lattice = lattice_of({14, 9, 20});
  for (const WindowShape shape : kAll)
    for (const Flags& periodic : {kOpen, kSlab, kPeriodic})
      for (const bool walls : {false, true})
        for (const double length : {1., 4.7, 11.}) {
          DenseShares shares = random_shares(lattice, walls, 3);
          for (std::size_t c = 0; c < shares.solid.size(); ++c)
            shares.solid[c] = 0.37 * (walls ? shares.available[c] : 1);
          const std::vector<double> before = shares.available;
          average(lattice, averaging_window(lattice, shape, length, periodic), {shares.range}, shares);
          for (std::size_t c = 0; c < shares.solid.size(); ++c) {
            if (walls && length < 2 && before[c] == 0) continue;  // a window wholly inside a wall
            // rounding of sums of at most some thousand shares
            ASSERT_NEAR(shares.solid[c], 0.37, 1e-13) << name_of(shape) << ' ' << length << ' ' << c;
          }
        }
}

TEST(Windows, KeepTheTotalWhereNothingEnds) {
  const Lattice lattice = lattice_of({12, 10, 9});
  for (const WindowShape shape : kAll) {
    DenseShares shares = random_shares(lattice, false, 5);
    double before = 0, after = 0;
    for (const double s : shares.solid) before += s;
    average(lattice, averaging_window(lattice, shape, 4.2, kPeriodic), {shares.range}, shares);
    for (const double s : shares.solid) after += s;
    EXPECT_NEAR(after / before, 1, 1e-13) << name_of(shape);
  }
}

TEST(Windows, OfOneGrainAtTheirCentre) {
  // The share of a window that one ball of radius r at its centre fills: for a sphere and a box by their
  // volumes; for a Gaussian of standard deviation s,
  //   erf(r / (s sqrt 2)) - sqrt(2 / pi) (r / s) exp(-r^2 / (2 s^2)).
  // That the field is constant in each voxel spreads the grain: a point and another one in the same voxel
  // differ by a variance of 1/6 along an axis, which adds to s^2 and changes the share by 5e-4. That is a
  // mean over how the surface lies in its voxels: each of the 1600 strays by a tenth of the Gaussian's slope
  // there, 3.8e-6, together by 1.5e-5; allowed is three times that. The cut takes erfc(4 / sqrt 2) from each
  // axis, outside the ball.
  const std::int64_t n = 97;
  const double r = 11.3, length = 10 * std::sqrt(12.);
  const Lattice lattice = lattice_of({n, n, n});
  DenseShares grain;
  grain.range = all_cells(lattice);
  grain.solid.assign(static_cast<std::size_t>(n * n * n), 0.);
  for_each_overlap(lattice, {n / 2., n / 2., n / 2.}, r, grain.range,
                   [&](std::int64_t i, std::int64_t j, std::int64_t k, double volume) {
                     grain.solid[grain.index(i, j, k)] = volume;
                   });
  const double ball = 4 * std::numbers::pi / 3 * r * r * r, s = std::sqrt(100 + 1. / 6), u = r / s;
  const double gaussian =
      (std::erf(u / std::numbers::sqrt2) - std::sqrt(2 / std::numbers::pi) * u * std::exp(-u * u / 2)) /
      std::pow(std::erf(4 / std::numbers::sqrt2), 3);
  const double expected[] = {ball / (length * length * length), std::pow(2 * r / length, 3), gaussian};
  const double tolerance[] = {1e-13, 1e-13, 4.5e-5};
  for (const WindowShape shape : kAll) {
    DenseShares shares = grain;
    average(lattice, averaging_window(lattice, shape, length, kOpen), {shares.range}, shares);
    const auto w = static_cast<std::size_t>(shape);
    EXPECT_NEAR(shares.solid[shares.index(n / 2, n / 2, n / 2)], expected[w], tolerance[w]) << name_of(shape);
  }
}

TEST(Windows, AGaussianHasTheSecondMomentOfItsBox) {
  // less what the cut at c standard deviations takes, 2 c phi(c) / erf(c / sqrt 2), and with 1/12 for the
  // cells
  const double length = 60, c = kGaussianCut;
  const Window window = averaging_window(lattice_of({999, 999, 999}), WindowShape::gaussian, length, kOpen);
  const auto& w = window.axes[0].weights;
  double sum = w[0], second = 0;
  for (std::size_t d = 1; d < w.size(); ++d) {
    sum += 2 * w[d];
    second += 2 * w[d] * static_cast<double>(d * d);
  }
  EXPECT_NEAR(sum, std::erf(c / std::numbers::sqrt2), 1e-14);
  const double phi = std::exp(-c * c / 2) / std::sqrt(2 * std::numbers::pi);
  const double expected =
      length * length / 12 * (1 - 2 * c * phi / std::erf(c / std::numbers::sqrt2)) + 1. / 12;
  // the last cell, cut within: its weight of some 1e-6 sits half a cell off at a distance of 69 cells
  EXPECT_NEAR(second / sum / expected, 1, 1e-5);
}

TEST(Windows, OnlyWantedCellsNeedTheSameBits) {
  const Lattice lattice = lattice_of({23, 31, 12});
  const Window window = averaging_window(lattice, WindowShape::sphere, 6.6, kSlab);
  for (const bool walls : {false, true}) {
    DenseShares all = random_shares(lattice, walls, 9), some = all;
    average(lattice, window, {all.range}, all);
    const Centres wanted{{{2, 5, 0}, {22, 30, 12}}, 3};
    average(lattice, window, wanted, some);
    for (std::int64_t i = 2; i < 22; i += 3)
      for (std::int64_t j = 5; j < 30; j += 3)
        for (std::int64_t k = 0; k < 12; ++k)
          ASSERT_EQ(some.solid[some.index(i, j, k)], all.solid[all.index(i, j, k)]);
  }
}

TEST(Windows, GiveTheSameBitsForAnyNumberOfThreads) {
  const Lattice lattice = lattice_of({40, 33, 21});
  for (const WindowShape shape : kAll) {
    const Window window = averaging_window(lattice, shape, 7.7, kSlab);
    DenseShares one = random_shares(lattice, true, 13), two = one;
    tbb::task_arena(1).execute([&] { average(lattice, window, {one.range}, one); });
    tbb::task_arena(2).execute([&] { average(lattice, window, {two.range}, two); });
    EXPECT_EQ(one.solid, two.solid) << name_of(shape);
  }
}

TEST(Windows, AreExactlyZeroWhereTheyHoldNothing) {
  const Lattice lattice = lattice_of({30, 30, 30});
  for (const WindowShape shape : kAll) {
    DenseShares shares;
    shares.range = all_cells(lattice);
    shares.solid.assign(27000, 0.);
    shares.solid[shares.index(4, 4, 4)] = 0.7;
    const Window window = averaging_window(lattice, shape, 5, kOpen);
    average(lattice, window, {shares.range}, shares);
    const std::int64_t reach = window.axes[0].reach;
    EXPECT_GT(shares.solid[shares.index(4 + reach, 4, 4)], 0) << name_of(shape);
    EXPECT_EQ(shares.solid[shares.index(5 + reach, 4, 4)], 0) << name_of(shape);
    EXPECT_EQ(shares.solid[shares.index(29, 29, 29)], 0) << name_of(shape);
  }
}

TEST(Windows, RefuseWhatIsTooMuch) {
  const Lattice thin = lattice_of({100, 2, 100});
  EXPECT_THROW(averaging_window(thin, WindowShape::sphere, 129, {false, true, false}), InputError);
  EXPECT_NO_THROW(averaging_window(thin, WindowShape::sphere, 128, {false, true, false}));
  EXPECT_NO_THROW(averaging_window(thin, WindowShape::gaussian, 1e9, {false, true, false}));
  const Lattice large = lattice_of({1024, 1024, 300});  // 3.1e8 cells: twice that is beyond 2^29
  const CellRange all = all_cells(large);
  EXPECT_THROW(dense_shares(large, all, averaging_window(large, WindowShape::sphere, 9, kOpen), false),
               InputError);
  EXPECT_THROW(dense_shares(large, all, averaging_window(large, WindowShape::box, 9, kOpen), true),
               InputError);
}

}  // namespace
}  // namespace interstice::voxel::test
