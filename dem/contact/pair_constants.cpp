#include "dem/contact/pair_constants.h"

#include <cmath>

#include "dem/contact/damping.h"

namespace interstice::dem {

PairConstants<double> derive_pair_constants(const Material& a, const Material& b,
                                            const PairCoefficients& pair, NormalLaw normal,
                                            DampingRule damping) {
  const auto compliance = [](const Material& m) {
    return (1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
  };
  const auto shear_compliance = [](const Material& m) {
    return 2 * (2 - m.poisson_ratio) * (1 + m.poisson_ratio) / m.youngs_modulus;
  };
  PairConstants<double> c;
  c.effective_modulus = 1 / (compliance(a) + compliance(b));
  c.shear_ratio = 4 * (compliance(a) + compliance(b)) / (shear_compliance(a) + shear_compliance(b));
  c.shear_damping = std::sqrt(c.shear_ratio);
  const double ratio = damping == DampingRule::exact_with_tension ? damping_ratio(pair.restitution)
                                                                  : clipped_damping_ratio(pair.restitution);
  // gamma = 2 zeta sqrt(k m*) for the linear spring; sqrt(5/6) of that for Hertz, with S for k.
  c.damping = 2 * ratio * (normal == NormalLaw::hertz ? std::sqrt(5.0 / 6) : 1);
  c.friction = pair.friction;
  c.rolling_friction = pair.rolling_friction;
  c.cohesion_energy_density = pair.cohesion_energy_density;
  c.work_of_adhesion = pair.work_of_adhesion;
  c.hamaker_constant = pair.hamaker_constant;
  c.cutoff = pair.cutoff;
  c.range = pair.range;
  c.stiffness = pair.stiffness;
  return c;
}

}  // namespace interstice::dem
