#include "dem/time_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dem/contact/hooke.h"

namespace interstice::dem {
namespace {

double mass_of(double radius, double density) {
  return 4.0 / 3.0 * M_PI * radius * radius * radius * density;
}

}  // namespace

double rayleigh_time(double radius, const Material& m) {
  const double shear_modulus = m.youngs_modulus / (2 * (1 + m.poisson_ratio));
  return M_PI * radius * std::sqrt(m.density / shear_modulus) / (0.1631 * m.poisson_ratio + 0.8766);
}

double collision_time(double effective_mass, double effective_radius, double effective_modulus,
                      double speed) {
  // 2.94328 (integral of the collision) * (15/16)^(2/5)
  return 2.86827 * std::pow(effective_mass * effective_mass /
                                (effective_radius * effective_modulus * effective_modulus * speed),
                            0.2);
}

StepLimits step_limits(const Model& model, const std::vector<SmallestGrain>& smallest, double speed) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  StepLimits limits{inf, inf};
  const bool hooke = model.laws.normal == NormalLaw::hooke;
  const auto time = [&](std::size_t a, std::size_t b, double mass, double radius) {
    const PairConstants<double> c = model.constants(a, b);
    // The damping only lengthens a linear contact: without it the limit is safe.
    return hooke ? hooke_contact_time(mass, c.stiffness, 0)
                 : collision_time(mass, radius, c.effective_modulus, speed);
  };
  for (const SmallestGrain& a : smallest) {
    const double mass_a = mass_of(a.radius, model.materials[a.material].density);
    limits.rayleigh_time =
        std::min(limits.rayleigh_time, rayleigh_time(a.radius, model.materials[a.material]));
    if (!(speed > 0) && !hooke) continue;
    for (const SmallestGrain& b : smallest) {
      const double mass_b = mass_of(b.radius, model.materials[b.material].density);
      limits.collision_time =
          std::min(limits.collision_time, time(a.material, b.material, mass_a * mass_b / (mass_a + mass_b),
                                               a.radius * b.radius / (a.radius + b.radius)));
    }
    for (const Wall& wall : model.walls) {
      limits.collision_time =
          std::min(limits.collision_time, time(a.material, wall.material, mass_a, a.radius));
    }
  }
  return limits;
}

}  // namespace interstice::dem
