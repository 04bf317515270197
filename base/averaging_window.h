// The volume that a field is averaged over, by name.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

namespace interstice {

/// What an averaging length L means: a cube of edge L; a sphere of diameter L; or a Gaussian with the second
/// moments of that cube, standard deviation L / sqrt(12) along each axis, cut off at kGaussianCut standard
/// deviations along each.
enum class WindowShape { box, sphere, gaussian };

/// Beyond this many standard deviations an axis loses 6.3e-5 of the Gaussian (erfc(4 / sqrt(2))); what is
/// left is normalised.
inline constexpr double kGaussianCut = 4;

inline constexpr std::array<std::string_view, 3> kWindowNames{"box", "sphere", "gaussian"};

/// "box", "sphere", "gaussian".
inline std::string_view name_of(WindowShape shape) { return kWindowNames[static_cast<std::size_t>(shape)]; }

inline std::optional<WindowShape> window_named(std::string_view name) {
  for (std::size_t w = 0; w < kWindowNames.size(); ++w)
    if (kWindowNames[w] == name) return static_cast<WindowShape>(w);
  return std::nullopt;
}

}  // namespace interstice
