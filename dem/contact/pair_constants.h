// What a pair of materials contributes to a contact, derived once from the user's numbers, in double.
#pragma once

#include "dem/contact/laws.h"

namespace interstice::dem {

struct Material {
  double density = 0;         // [kg/m^3]
  double youngs_modulus = 0;  // [Pa]
  double poisson_ratio = 0;   // [-]
};

/// What the user states for a pair of materials; zero where no law needs it.
struct PairCoefficients {
  double restitution = 1;              // [-], 0..1
  double friction = 0;                 // [-]
  double rolling_friction = 0;         // [-]
  double cohesion_energy_density = 0;  // sjkr [J/m^3]
  double work_of_adhesion = 0;         // jkr, dmt: w = 2 gamma [J/m^2]
  double hamaker_constant = 0;         // van_der_waals [J]
  double cutoff = 0;                   // van_der_waals: below this separation the force is constant [m]
  double range = 0;                    // van_der_waals: beyond this separation there is none [m]
  double stiffness = 0;                // hooke [N/m]
};

/// How `PairCoefficients::restitution` becomes a damping coefficient.
enum class DampingRule {
  exact_with_tension,  // returns it when the force may attract until the bodies part
  exact_when_clipped,  // returns it when the force is cut off at zero
};

/// What the laws use, in the number type that they run in.
template <class T>
struct PairConstants {
  T effective_modulus = 0;  // E* [Pa]
  T shear_ratio = 0;        // tangential over normal tangent stiffness, 4 G*/E* [-]
  T shear_damping = 0;      // tangential over normal dashpot, the root of that [-]
  T damping = 0;            // dashpot over sqrt(S m*) [-], see damping.h
  T friction = 0;
  T rolling_friction = 0;
  T cohesion_energy_density = 0;  // [J/m^3]
  T work_of_adhesion = 0;         // [J/m^2]
  T hamaker_constant = 0;         // [J]
  T cutoff = 0, range = 0;        // [m]
  T stiffness = 0;                // [N/m]

  template <class U>
  PairConstants<U> as() const {
    PairConstants<U> c;
    c.effective_modulus = static_cast<U>(effective_modulus);
    c.shear_ratio = static_cast<U>(shear_ratio);
    c.shear_damping = static_cast<U>(shear_damping);
    c.damping = static_cast<U>(damping);
    c.friction = static_cast<U>(friction);
    c.rolling_friction = static_cast<U>(rolling_friction);
    c.cohesion_energy_density = static_cast<U>(cohesion_energy_density);
    c.work_of_adhesion = static_cast<U>(work_of_adhesion);
    c.hamaker_constant = static_cast<U>(hamaker_constant);
    c.cutoff = static_cast<U>(cutoff);
    c.range = static_cast<U>(range);
    c.stiffness = static_cast<U>(stiffness);
    return c;
  }
};

/// 1/E* = sum (1 - nu^2)/E and 1/G* = sum 2 (2 - nu)(1 + nu)/E (Johnson, Contact Mechanics, 1985, eqs 4.22
/// and 7.42); the ratio of tangential to normal stiffness is Mindlin's, 8 G* a / (2 E* a).
PairConstants<double> derive_pair_constants(const Material& a, const Material& b,
                                            const PairCoefficients& pair, NormalLaw normal = NormalLaw::hertz,
                                            DampingRule damping = DampingRule::exact_with_tension);

}  // namespace interstice::dem
