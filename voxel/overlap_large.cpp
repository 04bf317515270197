#include "voxel/overlap_large.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace interstice::voxel {

namespace {

struct Interval {
  double lo, hi;
  double length() const { return hi - lo; }
};

// Double-exponential points and weights on [0, 1] (Takahasi & Mori, Publ. RIMS 9, 1974, 721): t = 1/(1 +
// exp(-pi sinh x)) at evenly spaced x. The outermost weights are below 1e-17; twice as many points change no
// cell by more than rounding does (20,000 surface cells at R/h from 51 to 30,000).
struct DoubleExponentialRule {
  static constexpr int kSide = 20;
  static constexpr int kPoints = 2 * kSide + 1;
  static constexpr double kStep = 3.24 / kSide;
  std::array<double, kPoints> at, weight;

  DoubleExponentialRule() {
    double sum = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double x = (i - kSide) * kStep, t = 1 / (1 + std::exp(-std::numbers::pi * std::sinh(x)));
      const double rest = 1 / (1 + std::exp(std::numbers::pi * std::sinh(x)));
      at[i] = t;
      weight[i] = std::cosh(x) * t * rest;
      sum += weight[i];
    }
    for (double& w : weight) w /= sum;
  }
};

// Area between a circle's chord and its arc.
double segment_area(double radius, double chord) {
  const double half = std::asin(std::min(1.0, chord / (2 * radius)));
  if (half > 0.25) return radius * radius * (half - std::sin(half) * std::cos(half));
  // t - sin t = t^3/6 - t^5/120 + ..., t = 2 half <= 0.5: the last term left out is below 1e-17 of the sum
  const double t = 2 * half, t2 = t * t;
  double series = 0;
  for (int n = 15; n >= 3; n -= 2) series = t2 * (1 - series) / (n * (n - 1));
  return 0.5 * radius * radius * t * series;
}

// Area of the disc x^2 + y^2 <= radius^2 in a rectangle of the first quadrant that its circle passes through.
double disc_area(double radius_squared, const Interval& x, const Interval& y) {
  const auto other = [&](double a) { return std::sqrt(std::max(0.0, radius_squared - a * a)); };
  // The arc runs from (xa, ya), where it enters through the top or left edge, to (xb, yb), at the right or
  // bottom.
  double xa = x.lo, ya = other(x.lo), xb = x.hi, yb = other(x.hi);
  if (ya > y.hi) {
    ya = y.hi;
    xa = std::clamp(other(y.hi), x.lo, x.hi);
  }
  if (xb * xb + y.lo * y.lo > radius_squared) {
    yb = y.lo;
    xb = std::clamp(other(y.lo), xa, x.hi);
  }
  const double dx = xb - xa, dy = ya - yb;
  const double chord = std::sqrt(dx * dx + dy * dy);
  return (xa - x.lo) * y.length() + 0.5 * dx * ((ya - y.lo) + (yb - y.lo)) +
         segment_area(std::sqrt(radius_squared), chord);
}

double octant_volume(const Interval& x, const Interval& y, const Interval& z) {
  static const DoubleExponentialRule rule;
  // Where the circle passes corners, in ascending order; unused entries make intervals of no length.
  std::array<double, 6> ends{z.lo, z.hi, z.hi, z.hi, z.hi, z.hi};
  int count = 1;
  for (const double a : {x.hi, x.lo})
    for (const double b : {y.hi, y.lo})
      ends[count++] = std::clamp(std::sqrt(std::max(0.0, 1 - a * a - b * b)), z.lo, z.hi);
  if (ends[2] > ends[3]) std::swap(ends[2], ends[3]);  // the first is the least, the last the greatest

  double volume = 0;
  for (int e = 0; e + 1 < 6; ++e) {
    const double from = ends[e], length = ends[e + 1] - from;
    if (!(length > 0)) continue;
    const double middle = from + 0.5 * length, square = (1 - middle) * (1 + middle);
    if (x.lo * x.lo + y.lo * y.lo >= square) continue;
    if (x.hi * x.hi + y.hi * y.hi <= square) {
      volume += x.length() * y.length() * length;
      continue;
    }
    double sum = 0;
    for (int i = 0; i < rule.kPoints; ++i) {
      const double at = from + length * rule.at[i];
      sum += rule.weight[i] * disc_area((1 - at) * (1 + at), x, y);
    }
    volume += length * sum;
  }
  return volume;
}

// [lo, hi] as up to two intervals of absolute coordinates: the ball is the same in all octants.
int fold(double lo, double hi, Interval* parts) {
  lo = std::clamp(lo, -1.0, 1.0);
  hi = std::clamp(hi, -1.0, 1.0);
  if (lo >= 0 || hi <= 0) {
    parts[0] = lo >= 0 ? Interval{lo, hi} : Interval{-hi, -lo};
    return 1;
  }
  parts[0] = {0, -lo};
  parts[1] = {0, hi};
  return 2;
}

}  // namespace

double unit_ball_in_box(const Vec3d& lo, const Vec3d& hi) {
  const Vec3d size = hi - lo;
  const int c = size.x < size.y ? (size.x < size.z ? 0 : 2) : (size.y < size.z ? 1 : 2);
  const int a = (c + 1) % 3, b = (c + 2) % 3;
  Interval x[2], y[2], z[2];
  const int nx = fold(lo[a], hi[a], x), ny = fold(lo[b], hi[b], y), nz = fold(lo[c], hi[c], z);
  double volume = 0;
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) volume += octant_volume(x[i], y[j], z[k]);
  return volume;
}

}  // namespace interstice::voxel
