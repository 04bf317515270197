// What the pair and the wall loop share: numbers from double positions into the type of the laws, and the end
// of a contact.
#pragma once

#include "dem/kernels/kernels.h"

namespace interstice::dem {

template <class Real>
Vec3<Real> as(const Vec3d& v) {
  return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}
template <class Real>
Vec3d as_double(const Vec3<Real>& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
template <class Real>
TangentialSpring<Real> as(const TangentialSpring<double>& s) {
  return {as<Real>(s.force), static_cast<Real>(s.stiffness)};
}
template <class Real>
TangentialSpring<double> as_double(const TangentialSpring<Real>& s) {
  return {as_double(s.force), static_cast<double>(s.stiffness)};
}

template <class Real>
const PairConstants<Real>& constants_of(const StepView& v, std::size_t a, std::size_t b) {
  if constexpr (std::is_same_v<Real, float>) {
    return v.constants_single[a * v.materials + b];
  } else {
    return v.constants[a * v.materials + b];
  }
}

/// Is a JKR neck at this (negative) overlap still whole?
template <class Real>
bool neck_holds(const PairConstants<Real>& c, Real effective_radius, Real overlap) {
  return -overlap <= jkr_reach(c.effective_modulus, c.work_of_adhesion, effective_radius);
}

/// What tears with the neck: the work that drawing it out has taken [J].
template <class Real>
double tear_heat(const PairConstants<Real>& c, Real effective_radius) {
  const Real reach = jkr_reach(c.effective_modulus, c.work_of_adhesion, effective_radius);
  const Real a = jkr_contact_radius(c.effective_modulus, c.work_of_adhesion, effective_radius, -reach);
  return static_cast<double>(jkr_energy(c.effective_modulus, c.work_of_adhesion, effective_radius, a));
}

}  // namespace interstice::dem
