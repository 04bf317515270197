// The few operations that the contact laws need beyond + - * /, for a scalar on host and device. A SIMD pack
// type provides the same names by overload; the laws then run on it unchanged. Choices that may differ from
// contact to contact are selects, not branches, because the lanes of a pack may differ.
#pragma once

#include <cmath>

#include "base/host_device.h"
#include "base/vec3.h"

namespace interstice::dem {

INTERSTICE_HD inline double select(bool condition, double yes, double no) { return condition ? yes : no; }
INTERSTICE_HD inline float select(bool condition, float yes, float no) { return condition ? yes : no; }
template <class Condition, class T>
INTERSTICE_HD inline Vec3<T> select(const Condition& condition, const Vec3<T>& yes, const Vec3<T>& no) {
  return {select(condition, yes.x, no.x), select(condition, yes.y, no.y), select(condition, yes.z, no.z)};
}
/// Does a condition hold, in all lanes where there are several?
INTERSTICE_HD inline bool everywhere(bool condition) { return condition; }
INTERSTICE_HD inline double max_of(double a, double b) { return a > b ? a : b; }
INTERSTICE_HD inline double min_of(double a, double b) { return a < b ? a : b; }
INTERSTICE_HD inline double abs_of(double a) { return std::fabs(a); }
INTERSTICE_HD inline double sqrt_of(double a) { return std::sqrt(a); }
INTERSTICE_HD inline double cbrt_of(double a) { return std::cbrt(a); }

INTERSTICE_HD inline float max_of(float a, float b) { return a > b ? a : b; }
INTERSTICE_HD inline float min_of(float a, float b) { return a < b ? a : b; }
INTERSTICE_HD inline float abs_of(float a) { return std::fabs(a); }
INTERSTICE_HD inline float sqrt_of(float a) { return std::sqrt(a); }
INTERSTICE_HD inline float cbrt_of(float a) { return std::cbrt(a); }

/// 1/a and 1/sqrt(a) of a normal number (a > 0 for the root). Packs are a unit in the last place off
/// (simd/pack.h).
INTERSTICE_HD inline double inverse_of(double a) { return 1 / a; }
INTERSTICE_HD inline float inverse_of(float a) { return 1 / a; }
INTERSTICE_HD inline double inverse_root_of(double a) { return 1 / std::sqrt(a); }
INTERSTICE_HD inline float inverse_root_of(float a) { return 1 / std::sqrt(a); }

/// a b + c. Of packs rounded once where the machine can, in one way whatever the compiler would make of it.
INTERSTICE_HD inline double multiply_add(double a, double b, double c) { return a * b + c; }
INTERSTICE_HD inline float multiply_add(float a, float b, float c) { return a * b + c; }
template <class T>
INTERSTICE_HD inline Vec3<T> multiply_add(const T& a, const Vec3<T>& b, const Vec3<T>& c) {
  return {multiply_add(a, b.x, c.x), multiply_add(a, b.y, c.y), multiply_add(a, b.z, c.z)};
}
/// c - a b, with the bits of multiply_add(-a, b, c): an instruction of its own, which spares the minus.
INTERSTICE_HD inline double subtract_product(double a, double b, double c) { return c - a * b; }
INTERSTICE_HD inline float subtract_product(float a, float b, float c) { return c - a * b; }
template <class T>
INTERSTICE_HD inline Vec3<T> subtract_product(const T& a, const Vec3<T>& b, const Vec3<T>& c) {
  return {subtract_product(a, b.x, c.x), subtract_product(a, b.y, c.y), subtract_product(a, b.z, c.z)};
}

/// Added to the squares of lengths, so that none is zero, and by how much lengths of forces and torques are
/// scaled before: in single precision the square of a force on a grain of 100 nm, or of a torque on one of
/// 1 um, underflows.
template <class Real>
inline constexpr Real kLeastSquare = sizeof(Real) == 4 ? Real(1e-37) : Real(1e-300);
template <class Real>
inline constexpr Real kLengthScale = sizeof(Real) == 4 ? Real(4294967296.0) : Real(1);

/// 1/|v| of a spin [rad/s] below 1e18, by magnitude above 1e-18; large but finite where v is zero.
template <class T, class Real = T>
INTERSTICE_HD inline T inverse_spin(const Vec3<T>& v) {
  return inverse_root_of(
      multiply_add(v.z, v.z, multiply_add(v.y, v.y, multiply_add(v.x, v.x, T(kLeastSquare<Real>)))));
}
/// 1/|v| of a force [N] or a torque [N m] below 4e9; large but finite where v is zero.
template <class T, class Real = T>
INTERSTICE_HD inline T inverse_length(const Vec3<T>& v) {
  const T scale(kLengthScale<Real>);
  return scale * inverse_spin<T, Real>(scale * v);
}
INTERSTICE_HD inline double inverse_length_of(const Vec3<double>& v) { return inverse_length(v); }
INTERSTICE_HD inline float inverse_length_of(const Vec3<float>& v) { return inverse_length(v); }
INTERSTICE_HD inline double inverse_spin_of(const Vec3<double>& v) { return inverse_spin(v); }
INTERSTICE_HD inline float inverse_spin_of(const Vec3<float>& v) { return inverse_spin(v); }

template <class T>
INTERSTICE_HD inline T square(const T& a) {
  return a * a;
}

}  // namespace interstice::dem
