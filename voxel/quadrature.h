// Adaptive integration of smooth pieces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace interstice::voxel {

// Gauss-Kronrod, 7 and 15 points on [-1, 1] (R. Piessens et al., QUADPACK, Springer 1983).
inline constexpr std::array<double, 8> kKronrodNode{
    0.9914553711208126, 0.9491079123427585, 0.8648644233597691, 0.7415311855993945,
    0.5860872354676911, 0.4058451513773972, 0.2077849550078985, 0.0};
inline constexpr std::array<double, 8> kKronrodWeight{
    0.0229353220105292, 0.0630920926299786, 0.1047900103222502, 0.1406532597155259,
    0.1690047266392679, 0.1903505780647854, 0.2044329400752989, 0.2094821410847278};
inline constexpr std::array<double, 4> kGaussWeight{0.1294849661688697, 0.2797053914892767,
                                                    0.3818300505051189, 0.4179591836734694};

/// The integral of `f` from lo to hi to an estimated error of `tolerance`, but no finer than `noise` on any
/// piece: what rounding of `f` itself would feign. Halves pieces at most 24 times.
template <class Function>
double integrate(const Function& f, double lo, double hi, double tolerance, double noise, int depth = 0) {
  constexpr int kDeepest = 24;
  const double middle = 0.5 * (lo + hi), half = 0.5 * (hi - lo);
  double fine = 0, coarse = 0;
  for (std::size_t n = 0; n < kKronrodNode.size(); ++n) {
    double value = f(middle + half * kKronrodNode[n]);
    if (n + 1 < kKronrodNode.size()) value += f(middle - half * kKronrodNode[n]);
    fine += kKronrodWeight[n] * value;
    if (n % 2 == 1) coarse += kGaussWeight[n / 2] * value;
  }
  if (half * std::abs(fine - coarse) <= std::max(tolerance, noise) || depth == kDeepest) return half * fine;
  return integrate(f, lo, middle, 0.5 * tolerance, noise, depth + 1) +
         integrate(f, middle, hi, 0.5 * tolerance, noise, depth + 1);
}

}  // namespace interstice::voxel
