#include "dem/contact/pair_constants.h"

#include "dem/contact/damping.h"

namespace interstice::dem {

PairConstants derive_pair_constants(const Material& a, const Material& b, const PairCoefficients& pair) {
  const auto compliance = [](const Material& m) {
    return (1 - m.poisson_ratio * m.poisson_ratio) / m.youngs_modulus;
  };
  const auto shear_compliance = [](const Material& m) {
    return 2 * (2 - m.poisson_ratio) * (1 + m.poisson_ratio) / m.youngs_modulus;
  };
  PairConstants c;
  c.effective_modulus = 1 / (compliance(a) + compliance(b));
  c.shear_modulus = 1 / (shear_compliance(a) + shear_compliance(b));
  c.damping = damping_coefficient(pair.restitution);
  c.friction = pair.friction;
  c.rolling_friction = pair.rolling_friction;
  c.cohesion_energy_density = pair.cohesion_energy_density;
  return c;
}

}  // namespace interstice::dem
