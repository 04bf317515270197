// How many grains, or pairs of grains, are worked on together: a lane of a vector each.
#pragma once

#include <cstddef>
#include <cstdint>

namespace interstice::dem {

inline constexpr std::size_t kLanes = 16;
/// A bit a lane.
inline constexpr std::uint32_t kAllLanes = (1u << kLanes) - 1;

/// How many groups of kLanes hold n.
constexpr std::size_t groups_for(std::size_t n) { return (n + kLanes - 1) / kLanes; }

}  // namespace interstice::dem
