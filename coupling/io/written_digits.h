// How finely positions in a text are told apart: a dump of six digits rounds a grain at 12.3456 mm to 0.1 um.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace interstice::io {

/// Digits of a number as written, from the first that is not 0: "0.0120e-3" has 3.
inline int significant_digits(std::string_view number) {
  int digits = 0;
  for (const char c : number) {
    if (c == 'e' || c == 'E') break;
    if ((c >= '1' && c <= '9') || (c == '0' && digits > 0)) ++digits;
  }
  return digits;
}

/// Gathers a frame's positions as they are read. Most writers drop zeros at the end (%g), so that a single
/// number does not tell how many digits its writer had; the longest of the frame does.
class WrittenDigits {
 public:
  void add(std::size_t axis, std::string_view written, double value) {
    most_ = std::max(most_, significant_digits(written));
    largest_[axis] = std::max(largest_[axis], std::abs(value));
  }

  /// The largest distance between neighbouring numbers of so many digits among the positions, each axis in
  /// units of `unit`; 0 where there are no positions but 0.
  double resolution(const std::array<double, 3>& unit) const {
    double coarsest = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      if (largest_[a] > 0) {
        coarsest =
            std::max(coarsest, unit[a] * std::pow(10.0, std::floor(std::log10(largest_[a])) + 1 - most_));
      }
    }
    return coarsest;
  }

 private:
  int most_ = 0;
  std::array<double, 3> largest_{};
};

/// The same for positions kept as 32-bit floats (24 binary digits), the farthest at `largest`.
inline double float_resolution(double largest) {
  return largest > 0 ? std::ldexp(1.0, std::ilogb(largest) - 23) : 0;
}

}  // namespace interstice::io
