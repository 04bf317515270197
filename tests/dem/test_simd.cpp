// Packs: each lane against the scalar, and rows to lanes and back.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/random.h"
#include "dem/simd/transpose.h"

namespace interstice::dem::simd {
namespace {

template <class Real>
class Packs : public testing::Test {};
using Reals = testing::Types<float, double>;
TYPED_TEST_SUITE(Packs, Reals);

/// Numbers over the whole range in which the laws compute, far from where squares leave it.
template <class Real, class Body>
void for_many(const Body& body) {
  Random random(7, 0);
  const double range = sizeof(Real) == 4 ? 36 : 290;
  for (int round = 0; round < 2000; ++round) {
    Real x[16];
    for (Real& lane : x) lane = static_cast<Real>(std::pow(10.0, random.uniform(-range, range)));
    body(x);
  }
}

/// How far a number is from the exact one, in units of its last place.
template <class Real>
double ulps(Real value, long double exact) {
  const Real at = static_cast<Real>(exact);
  const Real next = std::nextafter(at, std::numeric_limits<Real>::infinity());
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact) / (next - at));
}

/// The last addition rounds by half a unit of the last place; what is added is itself off by less than one:
/// what the series leaves out is half a unit at most (35/128 of 2^-52), what it goes by is rounded once.
TYPED_TEST(Packs, InversesAndRootsAreExactToTheLastPlace) {
  using Real = TypeParam;
  using P = Pack<Real, 16>;
  double worst[3] = {0, 0, 0};
  for_many<Real>([&](const Real* x) {
    Real inverse[16], inverse_root[16], root[16];
    const P p = P::load(x);
    inverse_of(p).store(inverse);
    inverse_root_of(p).store(inverse_root);
    sqrt_of(p).store(root);
    for (int i = 0; i < 16; ++i) {
      const auto exact = static_cast<long double>(x[i]);
      worst[0] = std::max(worst[0], ulps(inverse[i], 1 / exact));
      worst[1] = std::max(worst[1], ulps(inverse_root[i], 1 / std::sqrt(exact)));
      worst[2] = std::max(worst[2], ulps(root[i], std::sqrt(exact)));
    }
  });
  EXPECT_LE(worst[0], 1.5);
  EXPECT_LE(worst[1], 2);
  EXPECT_LE(worst[2], 2.5);  // a product more
}

/// c - a b is rounded once or twice as a b + c is, so both have the same bits; here c nearly cancels a b, and
/// what is left is the rounding.
TYPED_TEST(Packs, AProductIsSubtractedWithTheBitsOfOneOfOtherSignAdded) {
  using Real = TypeParam;
  using P = Pack<Real, 16>;
  const auto same = [](Real a, Real b, Real c) {
    EXPECT_EQ(subtract_product(a, b, c), multiply_add(-a, b, c));
  };
  Random random(11, 0);
  for (int round = 0; round < 500; ++round) {
    Real a[16], b[16], c[16], got[16], want[16];
    for (int i = 0; i < 16; ++i) {
      a[i] = static_cast<Real>(random.uniform(-2, 2)), b[i] = static_cast<Real>(random.uniform(-2, 2));
      c[i] = i % 2 == 0 ? a[i] * b[i] : static_cast<Real>(random.uniform(-2, 2));
      same(a[i], b[i], c[i]);
    }
    subtract_product(P::load(a), P::load(b), P::load(c)).store(got);
    multiply_add(-P::load(a), P::load(b), P::load(c)).store(want);
    for (int i = 0; i < 16; ++i) EXPECT_EQ(got[i], want[i]) << a[i] << ' ' << b[i] << ' ' << c[i];
  }
}

TYPED_TEST(Packs, TheRootOfZeroIsZero) {
  using P = Pack<TypeParam, 16>;
  TypeParam root[16];
  sqrt_of(P(0)).store(root);
  for (const TypeParam r : root) EXPECT_EQ(r, 0);
}

/// A force on a grain of 10 nm has a length, and none has a finite inverse.
TYPED_TEST(Packs, InverseLengthsAreFiniteWhereSquaresUnderflow) {
  using Real = TypeParam;
  const Vec3<Real> tiny{Real(3e-22), Real(0), Real(4e-22)}, none{Real(0), Real(0), Real(0)};
  EXPECT_NEAR(static_cast<double>(dem::inverse_length_of(tiny)) * 5e-22, 1, 1e-6);
  EXPECT_TRUE(std::isfinite(dem::inverse_length_of(none)));
}

TYPED_TEST(Packs, InverseSpinsAreFiniteAndExactOverTheirRange) {
  using Real = TypeParam;
  for (const double spin : {1e-15, 1e-6, 1.0, 1e9}) {
    const auto s = static_cast<Real>(spin);
    EXPECT_NEAR(
        static_cast<double>(dem::inverse_spin_of(Vec3<Real>{s * Real(0.6), Real(0), s * Real(-0.8)})) * spin,
        1, 1e-6);
  }
  EXPECT_TRUE(std::isfinite(dem::inverse_spin_of(Vec3<Real>{Real(0), Real(0), Real(0)})));
}

TYPED_TEST(Packs, LanesChangePlacesAsAsked) {
  using Real = TypeParam;
  Random random(11, 0);
  for (int round = 0; round < 100; ++round) {
    Real x[16], y[16];
    std::uint8_t from[16];
    for (int i = 0; i < 16; ++i) {
      x[i] = static_cast<Real>(i + 1);
      from[i] = static_cast<std::uint8_t>(random.uniform(0, 16));
    }
    permuted(Pack<Real, 16>::load(x), from).store(y);
    for (int i = 0; i < 16; ++i) EXPECT_EQ(y[i], x[from[i]]);
  }
}

/// Sixteen rows of ten numbers, none like another.
template <class Real>
struct Rows {
  Real at[16][10];
  Rows() {
    for (int r = 0; r < 16; ++r)
      for (int j = 0; j < 10; ++j) at[r][j] = static_cast<Real>(10 * r + j + 1);
  }
};

TYPED_TEST(Packs, EightNumbersOfRowsBecomeLanesAndLanesRows) {
  using Real = TypeParam;
  const Rows<Real> rows;
  OctLoader<Real, 16> loader;
  unrolled<16>([&](auto row) { loader.template load<decltype(row)::value>(rows.at[row] + 1); });
  const auto c = loader.columns();
  for (std::size_t j = 0; j < 8; ++j) {
    Real lanes[16];
    c[j].store(lanes);
    for (int r = 0; r < 16; ++r) EXPECT_EQ(lanes[r], rows.at[r][j + 1]) << "row " << r << ", number " << j;
  }

  Rows<Real> back;
  const Quads<Real, 16> first(c[0], c[1], c[2], c[3]), last(c[4], c[5], c[6], c[7]);
  const OctStorer<Real, 16> storer(-first, last);
  unrolled<16>([&](auto row) { storer.template store<decltype(row)::value>(back.at[15 - row] + 1); });
  for (int r = 0; r < 16; ++r) {
    EXPECT_EQ(back.at[15 - r][0], 10 * (15 - r) + 1) << "before the row";
    EXPECT_EQ(back.at[15 - r][9], 10 * (15 - r) + 10) << "behind it";
    for (int j = 1; j < 9; ++j) EXPECT_EQ(back.at[15 - r][j], j < 5 ? -rows.at[r][j] : rows.at[r][j]);
  }
}

TEST(Transpose, FourDoublesOfRowsBecomeLanesAndLanesRows) {
  const Rows<double> rows;
  QuadLoader<16> loader, difference;
  unrolled<16>([&](auto row) {
    loader.load<decltype(row)::value>(rows.at[row] + 1);
    difference.load_difference<decltype(row)::value>(rows.at[row] + 1, rows.at[(7 * row + 3) % 16] + 2);
  });
  const auto c = loader.columns(), d = difference.columns();
  for (std::size_t j = 0; j < 4; ++j) {
    double lanes[16], differences[16];
    c[j].store(lanes), d[j].store(differences);
    for (int r = 0; r < 16; ++r) {
      const double other = rows.at[(7 * r + 3) % 16][j + 2];
      EXPECT_EQ(lanes[r], rows.at[r][j + 1]);
      EXPECT_EQ(differences[r], j < 3 ? lanes[r] - other : lanes[r] + other);
    }
  }
  Rows<double> back;
  const Quads<double, 16> storer(c[0], c[1], c[2], c[3]);
  unrolled<16>([&](auto row) {
    constexpr int r = decltype(row)::value;
    if constexpr (r % 2 == 0) storer.store<r>(back.at[15 - r] + 1);
    if constexpr (r % 2 == 1) storer.store_three<r>(back.at[15 - r] + 1);
  });
  for (int r = 0; r < 16; ++r) {
    const int to = 15 - r;
    for (int j = 0; j < 10; ++j) {
      const bool written = j > 0 && j < (r % 2 == 0 ? 5 : 4);
      EXPECT_EQ(back.at[to][j], written ? rows.at[r][j] : 10 * to + j + 1) << "row " << r << ", number " << j;
    }
  }
}

TYPED_TEST(Packs, TakeCountsAndOtherPrecisions) {
  using P = Pack<TypeParam, 16>;
  std::uint32_t counts[16];
  for (std::uint32_t i = 0; i < 16; ++i) counts[i] = i * i;
  TypeParam lanes[16];
  from_counts<TypeParam, 16>(counts).store(lanes);
  float singles[16];
  converted<float>(P::load(lanes)).store(singles);
  double doubles[16];
  converted<double>(P::load(lanes)).store(doubles);
  for (std::uint32_t i = 0; i < 16; ++i) {
    EXPECT_EQ(lanes[i], static_cast<TypeParam>(i * i));
    EXPECT_EQ(singles[i], static_cast<float>(i * i));
    EXPECT_EQ(doubles[i], i * i);
  }
}

TYPED_TEST(Packs, TakeTwoLanesForTheirHalves) {
  using P = Pack<TypeParam, 16>;
  constexpr int kTaken = 64 / sizeof(TypeParam);
  TypeParam numbers[16], taken[kTaken];
  const volatile int one = 1;  // numbers known to the compiler it folds by itself, which gcc 12 gets wrong
  for (int i = 0; i < 16; ++i) numbers[i] = static_cast<TypeParam>(i * one);
  const P p = P::load(numbers);
  unrolled<16>([&](auto lane) {
    constexpr int a = decltype(lane)::value, b = sizeof(TypeParam) == 4 ? (3 * a + 5) % 16 : a;
    halves_of<a, b, kTaken>(p).store(taken);
    for (int i = 0; i < kTaken; ++i)
      EXPECT_EQ(taken[i], static_cast<TypeParam>(i < kTaken / 2 ? a : b)) << a << ' ' << b << ' ' << i;
  });
}

}  // namespace
}  // namespace interstice::dem::simd
