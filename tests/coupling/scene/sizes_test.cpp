// Size distributions against closed forms: moments of the cut normal curve, quantiles, Kolmogorov-Smirnov
// distances.
#include "coupling/scene/sizes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

namespace interstice::scene {
namespace {

double normal_cdf(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }
double normal_pdf(double z) { return std::exp(-0.5 * z * z) / std::sqrt(2 * std::numbers::pi); }

Diameters normal(double mean, double sd, double min, double max) {
  Diameters d;
  d.law = SizeLaw::normal;
  d.mean = mean, d.sd = sd, d.min = min, d.max = max;
  return d;
}
/// Wang et al. 2021 as paper 004 takes it over: D10, D50, D90 = 25.9, 39.4, 52.7 um.
Diameters published() { return normal(39.4e-6, 10.46e-6, 5e-6, 65e-6); }

/// The distribution function of the cut normal curve (by number or by mass, as it is given).
double cut_normal(const Diameters& d, double x) {
  const double a = normal_cdf((d.min - d.mean) / d.sd), b = normal_cdf((d.max - d.mean) / d.sd);
  return (normal_cdf((x - d.mean) / d.sd) - a) / (b - a);
}

/// The largest distance between the sample's distribution and the law's; `mass` weighs each grain by d^3.
double distance(std::vector<double> sample, bool mass, const std::function<double(double)>& law) {
  std::sort(sample.begin(), sample.end());
  const auto weight = [&](double d) { return mass ? d * d * d : 1.0; };
  double total = 0, sum = 0, largest = 0;
  for (const double d : sample) total += weight(d);
  for (const double d : sample) {
    largest = std::max(largest, std::abs(sum / total - law(d)));
    sum += weight(d);
    largest = std::max(largest, std::abs(sum / total - law(d)));
  }
  return largest;
}

TEST(Sizes, TheMeanOfTheCutNormalCurveIsItsClosedForm) {
  for (const Diameters& d :
       {published(), normal(30e-6, 40e-6, 25e-6, 65e-6), normal(40e-6, 0.01e-6, 5e-6, 65e-6)}) {
    const double a = (d.min - d.mean) / d.sd, b = (d.max - d.mean) / d.sd, z = normal_cdf(b) - normal_cdf(a);
    const double mean = d.mean + d.sd * (normal_pdf(a) - normal_pdf(b)) / z;
    const double ratio = (normal_pdf(a) - normal_pdf(b)) / z;
    const double variance = d.sd * d.sd * (1 + (a * normal_pdf(a) - b * normal_pdf(b)) / z - ratio * ratio);
    const SizeDistribution sizes(d);
    EXPECT_NEAR(sizes.moment(0), 1, 1e-12);
    EXPECT_NEAR(sizes.moment(1), mean, 1e-9 * mean);
    EXPECT_NEAR(sizes.moment(2), variance + mean * mean, 1e-9 * mean * mean);
  }
}

TEST(Sizes, QuantilesInvertTheDistribution) {
  for (const Diameters& d :
       {published(), normal(40e-6, 0.01e-6, 5e-6, 65e-6), normal(5e-6, 100e-6, 5e-6, 500e-6)}) {
    const SizeDistribution sizes(d);
    for (double p = 0.001; p < 1; p += 0.0137) EXPECT_NEAR(cut_normal(d, sizes.quantile(p)), p, 1e-9) << p;
    EXPECT_EQ(sizes.quantile(0), d.min);
    EXPECT_EQ(sizes.quantile(1), d.max);
  }
}

TEST(Sizes, ThePublishedPowderHasItsD10D50D90) {
  EXPECT_NEAR(quantile(published(), 0.1), 25.9e-6, 0.2e-6);
  EXPECT_NEAR(quantile(published(), 0.5), 39.4e-6, 0.2e-6);
  EXPECT_NEAR(quantile(published(), 0.9), 52.7e-6, 0.3e-6);  // the cut at 65 um takes a little
}

TEST(Sizes, UniformByNumberAndByMass) {
  Diameters d;
  d.law = SizeLaw::uniform;
  d.min = 1e-6, d.max = 100e-6;
  EXPECT_NEAR(quantile(d, 0.25), d.min + 0.25 * (d.max - d.min), 1e-15);
  d.weight = SizeWeight::mass;  // the number goes with d^-3: F = (1 - (min/d)^2) / (1 - (min/max)^2)
  const double whole = 1 - std::pow(d.min / d.max, 2);
  for (double p = 0.001; p < 1; p += 0.0137) {
    const double exact = d.min / std::sqrt(1 - p * whole);
    EXPECT_NEAR(quantile(d, p), exact, 1e-8 * exact) << p;
  }
  // the mean mass of a grain: integral of a constant over integral of d^-3
  const double mean_cube = (d.max - d.min) / (0.5 * (std::pow(d.min, -2) - std::pow(d.max, -2)));
  EXPECT_NEAR(SizeDistribution(d).moment(3), mean_cube, 1e-6 * mean_cube);
}

TEST(Sizes, LognormalHasItsMedianAndItsMassesToo) {
  Diameters d;
  d.law = SizeLaw::lognormal;
  d.mean = 30e-6, d.sd = 0.4, d.min = 1e-6, d.max = 900e-6;  // wide enough for the cut not to matter
  EXPECT_NEAR(quantile(d, 0.5), 30e-6, 1e-12);
  EXPECT_NEAR(quantile(d, normal_cdf(1)), 30e-6 * std::exp(0.4), 1e-12);
  EXPECT_NEAR(SizeDistribution(d).moment(1), 30e-6 * std::exp(0.08), 1e-11);
  // Hatch and Choate 1929: the median by number of a log-normal mass curve is smaller by exp(3 sigma^2)
  d.weight = SizeWeight::mass;
  EXPECT_NEAR(quantile(d, 0.5), 30e-6 * std::exp(-3 * 0.16), 1e-11);
}

TEST(Sizes, SamplesFollowTheLaw) {
  const std::int64_t n = 200000;
  const double kolmogorov =
      1.95 / std::sqrt(static_cast<double>(n));  // exceeded by chance once in a thousand
  Diameters d = published();
  EXPECT_LT(distance(sample_diameters(d, n, 1, 0), false, [&](double x) { return cut_normal(d, x); }),
            kolmogorov);
  d.weight = SizeWeight::mass;  // fewer grains carry the mass, so the distance is larger
  d.min = 15e-6;
  EXPECT_LT(distance(sample_diameters(d, n, 1, 0), true, [&](double x) { return cut_normal(d, x); }),
            3 * kolmogorov);

  Diameters two;
  two.law = SizeLaw::bimodal;
  two.mean = 10e-6, two.sd = 1e-6, two.mean2 = 40e-6, two.sd2 = 3e-6, two.share2 = 0.25;
  two.min = 1e-6, two.max = 60e-6;
  EXPECT_LT(distance(sample_diameters(two, n, 1, 0), false,
                     [](double x) {
                       return 0.75 * normal_cdf((x - 10e-6) / 1e-6) + 0.25 * normal_cdf((x - 40e-6) / 3e-6);
                     }),
            kolmogorov);
}

TEST(Sizes, TableSharesComeBack) {
  Diameters d;
  d.law = SizeLaw::table;
  d.table_diameter = {5e-6, 15e-6, 25e-6, 45e-6, 65e-6};
  d.table_share = {1, 0, 2, 5};
  d.min = 5e-6, d.max = 65e-6;
  for (const SizeWeight weight : {SizeWeight::number, SizeWeight::mass}) {
    d.weight = weight;
    std::array<double, 4> share{};
    double total = 0;
    for (const double x : sample_diameters(d, 200000, 3, 0)) {
      const std::size_t k = x < 15e-6 ? 0 : x < 25e-6 ? 1 : x < 45e-6 ? 2 : 3;
      const double w = weight == SizeWeight::mass ? x * x * x : 1;
      share[k] += w;
      total += w;
    }
    EXPECT_EQ(share[1], 0);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(share[k] / total, d.table_share[k] / 8, 0.015) << k;
  }
}

TEST(Sizes, SamplesAreAPureFunctionAndStayInside) {
  const Diameters d = published();
  const auto a = sample_diameters(d, 1000, 7, 2);
  EXPECT_EQ(a, sample_diameters(d, 1000, 7, 2));
  EXPECT_NE(a, sample_diameters(d, 1000, 8, 2));
  EXPECT_NE(a, sample_diameters(d, 1000, 7, 3));
  const auto longer = sample_diameters(d, 2000, 7, 2);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), longer.begin()));
  for (const double x : longer) EXPECT_TRUE(x >= d.min && x <= d.max);
  EXPECT_TRUE(sample_diameters(d, 0, 7, 2).empty());
}

TEST(Sizes, ExtremesStayFinite) {
  Diameters single;
  single.mean = single.min = single.max = 40e-6;
  EXPECT_EQ(sample_diameters(single, 3, 1, 1), std::vector<double>(3, 40e-6));
  EXPECT_EQ(SizeDistribution(single).moment(3), std::pow(40e-6, 3));
  for (const Diameters& d : {normal(65e-6, 1e-12, 5e-6, 65e-6), normal(5e-6, 1, 5e-6, 5.0000001e-6),
                             normal(1, 1e-3, 1e-7, 1.0), normal(40e-6, 1e-30, 5e-6, 65e-6)})
    for (const SizeWeight weight : {SizeWeight::number, SizeWeight::mass}) {
      Diameters law = d;
      law.weight = weight;
      for (const double x : sample_diameters(law, 1000, 1, 1)) EXPECT_TRUE(x >= d.min && x <= d.max) << x;
    }
}

}  // namespace
}  // namespace interstice::scene
