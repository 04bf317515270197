#include "dem/contact_scales.h"

#include <cmath>
#include <limits>

#include "dem/contact/contact.h"

namespace interstice::dem {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// sjkr as k A with A = 2 pi R* overlap, exact to first order in overlap / R.
double sjkr_slope(const PairConstants<double>& c, const Encounter& pair) {
  return 2 * M_PI * pair.effective_radius * c.cohesion_energy_density;  // [N/m]
}

/// The constant attraction in contact of dmt and van_der_waals [N].
double constant_attraction(const Laws& laws, const PairConstants<double>& c, const Encounter& pair) {
  return laws.cohesion == CohesionLaw::dmt
             ? dmt_attraction(c.work_of_adhesion, pair.effective_radius)
             : van_der_waals_attraction(c.hamaker_constant, c.cutoff, c.range, pair.effective_radius, 0.0);
}

double hertz_prefactor(const PairConstants<double>& c, const Encounter& pair) {
  return 4.0 / 3 * c.effective_modulus * std::sqrt(pair.effective_radius);  // F = this overlap^1.5
}

}  // namespace

double equilibrium_overlap(const Laws& laws, const PairConstants<double>& c, const Encounter& pair) {
  const bool hertz = laws.normal == NormalLaw::hertz;
  switch (laws.cohesion) {
    case CohesionLaw::none:
      return 0;
    case CohesionLaw::sjkr:
      if (!hertz) return sjkr_slope(c, pair) < c.stiffness ? 0 : kInfinity;
      return std::pow(sjkr_slope(c, pair) / hertz_prefactor(c, pair), 2);
    case CohesionLaw::jkr:  // a0^2 / (3 R*) with a0^3 = 9 pi w R*^2 / (2 E*)
      return std::pow(4.5 * M_PI * c.work_of_adhesion / c.effective_modulus, 2.0 / 3) *
             std::cbrt(pair.effective_radius) / 3;
    case CohesionLaw::dmt:
    case CohesionLaw::van_der_waals: {
      const double pull = constant_attraction(laws, c, pair);
      return hertz ? std::pow(pull / hertz_prefactor(c, pair), 2.0 / 3) : pull / c.stiffness;
    }
  }
  return 0;
}

double pull_off_force(const Laws& laws, const PairConstants<double>& c, const Encounter& pair) {
  switch (laws.cohesion) {
    case CohesionLaw::none:
      return 0;
    case CohesionLaw::sjkr: {
      const double overlap = equilibrium_overlap(laws, c, pair);
      if (laws.normal == NormalLaw::hooke) return overlap > 0 ? kInfinity : 0;
      return sjkr_slope(c, pair) * 4.0 / 9 * overlap / 3;  // least of F at 4/9 of the equilibrium overlap
    }
    case CohesionLaw::jkr:
      return jkr_pull_off(c.work_of_adhesion, pair.effective_radius);
    case CohesionLaw::dmt:
    case CohesionLaw::van_der_waals:
      return constant_attraction(laws, c, pair);
  }
  return 0;
}

double binding_energy(const Laws& laws, const PairConstants<double>& c, const Encounter& pair) {
  const double pull = pull_off_force(laws, c, pair), overlap = equilibrium_overlap(laws, c, pair);
  if (!std::isfinite(pull)) return kInfinity;
  switch (laws.cohesion) {
    case CohesionLaw::none:
      return 0;
    case CohesionLaw::sjkr:
      return sjkr_slope(c, pair) * overlap * overlap / 10;  // (1/2 - 2/5) of it
    case CohesionLaw::jkr:
      return 7.0922 * std::cbrt(std::pow(c.work_of_adhesion, 5) * std::pow(pair.effective_radius, 4) /
                                (c.effective_modulus * c.effective_modulus));
    case CohesionLaw::dmt:
    case CohesionLaw::van_der_waals: {
      const double elastic = (laws.normal == NormalLaw::hertz ? 0.4 : 0.5) * pull * overlap;
      const double outside =
          laws.cohesion == CohesionLaw::van_der_waals
              ? van_der_waals_work(c.hamaker_constant, c.cutoff, c.range, pair.effective_radius, 0.0)
              : 0;
      return outside + pull * overlap - elastic;
    }
  }
  return 0;
}

double sticking_speed(const Laws& laws, const PairConstants<double>& c, const Encounter& pair) {
  return std::sqrt(2 * binding_energy(laws, c, pair) / pair.effective_mass);
}

double bond_number(const Laws& laws, const PairConstants<double>& c, const Encounter& pair, double mass,
                   double gravity) {
  return pull_off_force(laws, c, pair) / (mass * gravity);
}

double tabor_number(const Laws& laws, const PairConstants<double>& c, const Encounter& pair) {
  const double w = c.work_of_adhesion > 0
                       ? c.work_of_adhesion
                       : pull_off_force(laws, c, pair) / (1.5 * M_PI * pair.effective_radius);
  const double relative = w / c.effective_modulus;
  return std::cbrt(pair.effective_radius * relative * relative) / kSurfaceForceRange;
}

double impact_overlap(const Laws& laws, const PairConstants<double>& c, const Encounter& pair, double speed) {
  if (laws.normal == NormalLaw::hooke) return speed * std::sqrt(pair.effective_mass / c.stiffness);
  return std::pow(15 * pair.effective_mass * speed * speed /
                      (16 * c.effective_modulus * std::sqrt(pair.effective_radius)),
                  0.4);
}

}  // namespace interstice::dem
