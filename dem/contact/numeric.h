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

/// The length of a force or a torque. Scaled in single precision, where the square of the torque on a grain
/// of 1 um underflows.
INTERSTICE_HD inline double length_of(const Vec3<double>& v) { return norm(v); }
INTERSTICE_HD inline float length_of(const Vec3<float>& v) {
  const float largest = max_of(max_of(abs_of(v.x), abs_of(v.y)), max_of(abs_of(v.z), 1e-37f));
  return largest * norm(1 / largest * v);
}

template <class T>
INTERSTICE_HD inline T square(const T& a) {
  return a * a;
}

}  // namespace interstice::dem
