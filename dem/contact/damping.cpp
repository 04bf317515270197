#include "dem/contact/damping.h"

namespace interstice::dem {

double damping_ratio(double restitution) {
  if (restitution <= 0) return 1;
  const double log_e = std::log(restitution);
  return -log_e / std::sqrt(log_e * log_e + M_PI * M_PI);
}

double clipped_restitution(double zeta) {
  if (zeta <= 0) return 1;
  if (std::fabs(zeta - 1) < 1e-7) return std::exp(-2.0);  // the limit from both sides
  if (zeta > 1) {
    const double root = std::sqrt(zeta * zeta - 1);
    return std::exp(-2 * zeta / root * std::log(zeta + root));
  }
  // The time until the force vanishes, as an angle of the damped oscillation: cos of half of it is -zeta.
  const double root = std::sqrt(1 - zeta * zeta);
  return std::exp(-zeta / root * 2 * std::acos(zeta));
}

double clipped_damping_ratio(double restitution) {
  double lo = 0, hi = kLargestClippedRatio;
  if (restitution <= clipped_restitution(hi)) return hi;
  for (int i = 0; i < 60; ++i) {  // monotonic: halve until the interval is one rounding wide
    const double mid = 0.5 * (lo + hi);
    (clipped_restitution(mid) > restitution ? lo : hi) = mid;
  }
  return 0.5 * (lo + hi);
}

}  // namespace interstice::dem
