// The numbers by which one judges whether a set of contact parameters makes sense: how strong adhesion is
// against weight, which adhesion theory holds, at what speed grains stick, how deep they press into each
// other.
#pragma once

#include "dem/contact/laws.h"
#include "dem/contact/pair_constants.h"

namespace interstice::dem {

/// Two grains, or a grain and a wall (then effective_radius = radius and effective_mass = mass).
struct Encounter {
  double effective_radius = 0;  // R* [m]
  double effective_mass = 0;    // m* [kg]
};

/// Largest attraction of the pair [N]; 0 without cohesion, infinite where sjkr outweighs a linear spring.
double pull_off_force(const Laws& laws, const PairConstants<double>& c, const Encounter& pair);

/// Energy by which adhesion binds the pair [J]: for jkr the work from first touch to tear-off, 7.0922
/// (w^5 R*^4 / E*^2)^(1/3), that is lost in every impact; for the others the depth of the potential.
double binding_energy(const Laws& laws, const PairConstants<double>& c, const Encounter& pair);

/// Speed whose kinetic energy is the binding energy [m/s]: slower impacts of jkr stick (for the others, where
/// damping takes part of it; Thornton & Ning, Powder Technol. 99, 1998).
double sticking_speed(const Laws& laws, const PairConstants<double>& c, const Encounter& pair);

/// Pull-off over the weight of the lighter body.
double bond_number(const Laws& laws, const PairConstants<double>& c, const Encounter& pair, double mass,
                   double gravity);

/// (R* w^2 / (E*^2 z0^3))^(1/3), z0 = 0.4 nm the range of surface forces: jkr holds above about 5, dmt below
/// about 0.1. For laws without w, w is that of the same pull-off force (3/2 pi w R*).
double tabor_number(const Laws& laws, const PairConstants<double>& c, const Encounter& pair);
inline constexpr double kSurfaceForceRange = 0.4e-9;  // [m]

/// Overlap at which elastic force and adhesion balance [m]; 0 without cohesion.
double equilibrium_overlap(const Laws& laws, const PairConstants<double>& c, const Encounter& pair);

/// Deepest overlap of an undamped impact [m].
double impact_overlap(const Laws& laws, const PairConstants<double>& c, const Encounter& pair, double speed);

}  // namespace interstice::dem
