// A 3-vector over any number type (a scalar, or a SIMD pack on the CPU).
#pragma once

#include <cmath>

#include "base/host_device.h"

namespace interstice {

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  INTERSTICE_HD constexpr T& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
  INTERSTICE_HD constexpr const T& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
};

using Vec3d = Vec3<double>;

template <class T>
INTERSTICE_HD constexpr Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
INTERSTICE_HD constexpr Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
INTERSTICE_HD constexpr Vec3<T> operator-(const Vec3<T>& a) {
  return {-a.x, -a.y, -a.z};
}
template <class T>
INTERSTICE_HD constexpr Vec3<T> operator*(const T& s, const Vec3<T>& a) {
  return {s * a.x, s * a.y, s * a.z};
}
template <class T>
INTERSTICE_HD constexpr Vec3<T> operator*(const Vec3<T>& a, const T& s) {
  return s * a;
}
template <class T>
INTERSTICE_HD constexpr Vec3<T>& operator+=(Vec3<T>& a, const Vec3<T>& b) {
  return a = a + b;
}
template <class T>
INTERSTICE_HD constexpr Vec3<T>& operator-=(Vec3<T>& a, const Vec3<T>& b) {
  return a = a - b;
}
template <class T>
INTERSTICE_HD constexpr bool operator==(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z;
}

template <class T>
INTERSTICE_HD constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
INTERSTICE_HD constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
INTERSTICE_HD T norm(const Vec3<T>& a) {
  using std::sqrt;
  return sqrt(dot(a, a));
}

}  // namespace interstice
