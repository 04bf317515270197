// How long a time step may be.
#pragma once

#include "dem/model.h"

namespace interstice::dem {

/// The extremes of what a scene holds.
struct StepLimits {
  double rayleigh_time = 0;   // the shortest Rayleigh time present [s]
  double collision_time = 0;  // the shortest duration of a contact, Hertz or Hooke [s]
};

/// Rayleigh time of a grain [s]: pi r sqrt(rho/G) / (0.1631 nu + 0.8766) (Thornton & Randall 1988; Ning
/// 1995).
double rayleigh_time(double radius, const Material& material);

/// Hertz collision time [s]: 2.8683 (m*^2 / (R* E*^2 v))^(1/5) (Johnson, Contact Mechanics, 1985, eq. 11.24).
double collision_time(double effective_mass, double effective_radius, double effective_modulus, double speed);

/// A material and the radius of its smallest grain [m].
struct SmallestGrain {
  std::size_t material = 0;
  double radius = 0;
};

/// Limits for grains as small as `smallest`, meeting each other and the model's walls at up to `speed` [m/s].
StepLimits step_limits(const Model& model, const std::vector<SmallestGrain>& smallest, double speed);

}  // namespace interstice::dem
