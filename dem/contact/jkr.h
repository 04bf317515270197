// Adhesive elastic spheres (Johnson, Kendall & Roberts, Proc. R. Soc. A 324, 1971), with w the work of
// adhesion (w = 2 gamma for equal surfaces): in terms of the contact radius a (Johnson, Contact Mechanics,
// 1985, ch. 5.5)
//   overlap = a^2/R* - sqrt(2 pi w a / E*),   F = 4 E* a^3 / (3 R*) - sqrt(8 pi w E* a^3).
// A contact begins at touch (overlap 0) and ends at tear-off, at the overlap -jkr_reach(); the difference is
// the hysteresis.
#pragma once

#include "dem/contact/numeric.h"

namespace interstice::dem {

/// Contact radius [m] for an overlap >= -jkr_reach(). With u = sqrt(a/R*), o = overlap/R*, c^2 = 2 pi w/(E*
/// R*) the overlap's equation is the quartic u^4 - c u - o = 0; its largest root by Ferrari's way, in forms
/// that lose no digits on either side of o = 0 and turn into Hertz's a = sqrt(R* overlap) at w = 0.
template <class T>
INTERSTICE_HD inline T jkr_contact_radius(const T& effective_modulus, const T& work_of_adhesion,
                                          const T& effective_radius, const T& overlap) {
  const T o = overlap / effective_radius;
  const T c2 = T(2 * M_PI) * work_of_adhesion / (effective_modulus * effective_radius);
  const T h = c2 / T(16);
  // The resolvent m^3 + o m = 2 h has one real root m > 0 wherever the bodies can be in contact.
  const T cube = max_of(h * h + o * o * o / T(27), T(0));
  const T big = max_of(cbrt_of(h + sqrt_of(cube)), T(1e-15));
  const T small = o / (T(3) * big);
  const T m = T(2) * h / (big * big + big * small + small * small);
  const auto apart = o < T(0);
  const T inner = sqrt_of(select(apart, T(2) * h / select(apart, m, T(1)), o + m * m));
  const T u = T(0.5) * (sqrt_of(T(2) * m) + sqrt_of(max_of(T(4) * inner - T(2) * m, T(0))));
  return effective_radius * u * u;
}

/// Force at the contact radius a [N], negative where it attracts.
template <class T>
INTERSTICE_HD inline T jkr_force(const T& effective_modulus, const T& work_of_adhesion,
                                 const T& effective_radius, const T& a) {
  const T pressing = T(4.0 / 3.0) * effective_modulus * a * a * a / effective_radius;
  return pressing - a * sqrt_of(T(8 * M_PI) * work_of_adhesion * effective_modulus * a);
}

/// Pull-off force 3/2 pi w R* [N].
template <class T>
INTERSTICE_HD inline T jkr_pull_off(const T& work_of_adhesion, const T& effective_radius) {
  return T(1.5 * M_PI) * work_of_adhesion * effective_radius;
}

/// How far the surfaces can be drawn apart before the neck tears [m]:
/// 3/4 (pi^2 w^2 R* / E*^2)^(1/3), where d(overlap)/da = 0.
template <class T>
INTERSTICE_HD inline T jkr_reach(const T& effective_modulus, const T& work_of_adhesion,
                                 const T& effective_radius) {
  const T ratio = T(M_PI) * work_of_adhesion / effective_modulus;
  return T(0.75) * cbrt_of(ratio * ratio * effective_radius);
}

/// Integral of the force over the overlap from first touch to the contact radius a [J]; negative between, and
/// positive as the neck is drawn out.
template <class T>
INTERSTICE_HD inline T jkr_energy(const T& effective_modulus, const T& work_of_adhesion,
                                  const T& effective_radius, const T& a) {
  const auto integral = [&](const T& r) {  // of F d(overlap)/da
    const T q = sqrt_of(T(2 * M_PI) * work_of_adhesion * effective_modulus * r);
    return r * r *
           (r * r * r * T(8.0 / 15.0) * effective_modulus / (effective_radius * effective_radius) -
            T(4.0 / 3.0) * q * r / effective_radius + T(M_PI) * work_of_adhesion);
  };
  return integral(a) -
         integral(jkr_contact_radius(effective_modulus, work_of_adhesion, effective_radius, T(0)));
}

}  // namespace interstice::dem
