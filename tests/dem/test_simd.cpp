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

/// Newton's rule ends within a unit and a half of the last place: its last addition rounds by half a unit,
/// the correction added is itself off by less than one.
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

TYPED_TEST(Packs, RowsBecomeLanesAndLanesRows) {
  using Real = TypeParam;
  Real rows[16][6], back[16][6];
  for (int r = 0; r < 16; ++r)
    for (int j = 0; j < 6; ++j) rows[r][j] = static_cast<Real>(10 * r + j), back[r][j] = Real(-1);
  QuadLoader<Real, 16> loader;
  unrolled<16>([&](auto row) {
    loader.template load<decltype(row)::value>(
        reinterpret_cast<const std::byte*>(rows[decltype(row)::value] + 1));
  });
  const auto quad = loader.quad();
  Real lanes[4][16];
  quad.a.store(lanes[0]), quad.b.store(lanes[1]), quad.c.store(lanes[2]), quad.d.store(lanes[3]);
  for (int r = 0; r < 16; ++r)
    for (int j = 0; j < 4; ++j) EXPECT_EQ(lanes[j][r], rows[r][j + 1]);

  const QuadStorer<Real, 16> storer(quad);
  unrolled<16>([&](auto row) {
    constexpr int r = decltype(row)::value;
    if constexpr (r % 2 == 0) storer.template store<r>(back[r] + 1);
    if constexpr (r % 2 == 1) storer.template store_three<r>(back[r] + 1);
  });
  for (int r = 0; r < 16; ++r) {
    EXPECT_EQ(back[r][0], -1);
    for (int j = 1; j < 4; ++j) EXPECT_EQ(back[r][j], rows[r][j]);
    EXPECT_EQ(back[r][4], r % 2 == 0 ? rows[r][4] : Real(-1)) << "the fourth number of row " << r;
    EXPECT_EQ(back[r][5], -1);
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

}  // namespace
}  // namespace interstice::dem::simd
