// The few operations that the contact laws need beyond + - * /, for a scalar on host and device. A SIMD pack
// type provides the same names by overload; the laws then run on it unchanged. Choices are selects, not
// branches, because the lanes of a pack may differ.
#pragma once

#include <cmath>

#include "base/host_device.h"

namespace interstice::dem {

template <class T>
INTERSTICE_HD inline T select(bool condition, const T& yes, const T& no) {
  return condition ? yes : no;
}
INTERSTICE_HD inline double max_of(double a, double b) { return a > b ? a : b; }
INTERSTICE_HD inline double abs_of(double a) { return std::fabs(a); }
INTERSTICE_HD inline double sqrt_of(double a) { return std::sqrt(a); }

}  // namespace interstice::dem
