// What a pair of materials contributes to a contact, derived once from the user's numbers, in double.
#pragma once

namespace interstice::dem {

struct Material {
  double density = 0;         // [kg/m^3]
  double youngs_modulus = 0;  // [Pa]
  double poisson_ratio = 0;   // [-]
};

/// What the user states for a pair of materials.
struct PairCoefficients {
  double restitution = 1;              // [-], 0..1
  double friction = 0;                 // [-]
  double rolling_friction = 0;         // [-]
  double cohesion_energy_density = 0;  // [J/m^3]
};

/// What the laws use.
struct PairConstants {
  double effective_modulus = 0;  // E* [Pa]
  double shear_modulus = 0;      // G* [Pa]
  double damping = 0;            // 2 sqrt(5/6) |beta| [-], see damping.h
  double friction = 0;
  double rolling_friction = 0;
  double cohesion_energy_density = 0;  // [J/m^3]
};

/// 1/E* = sum (1 - nu^2)/E and 1/G* = sum 2 (2 - nu)(1 + nu)/E (Johnson, Contact Mechanics, 1985, eqs 4.22
/// and 7.42).
PairConstants derive_pair_constants(const Material& a, const Material& b, const PairCoefficients& pair);

}  // namespace interstice::dem
