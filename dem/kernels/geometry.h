// What the pair and the wall loop share: constants in the type of the laws, and the end of a contact.
#pragma once

#include "dem/kernels/kernels.h"

namespace interstice::dem {

template <class Real>
const PairConstants<Real>& constants_of(const StepView& v, std::size_t a, std::size_t b) {
  if constexpr (std::is_same_v<Real, float>) {
    return v.constants_single[a * v.material_count + b];
  } else {
    return v.constants[a * v.material_count + b];
  }
}

/// Is a JKR neck at this (negative) overlap still whole?
template <class T>
auto neck_holds(const PairConstants<T>& c, const T& effective_radius, const T& overlap) {
  return -overlap <= jkr_reach(c.effective_modulus, c.work_of_adhesion, effective_radius);
}

/// What tears with the neck: the work that drawing it out has taken [J].
template <class T>
T tear_heat(const PairConstants<T>& c, const T& effective_radius) {
  const T reach = jkr_reach(c.effective_modulus, c.work_of_adhesion, effective_radius);
  const T a = jkr_contact_radius(c.effective_modulus, c.work_of_adhesion, effective_radius, -reach);
  return jkr_energy(c.effective_modulus, c.work_of_adhesion, effective_radius, a);
}

}  // namespace interstice::dem
