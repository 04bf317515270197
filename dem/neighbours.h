// Finds all pairs of grains nearer than a skin: one grid a size class, each with cells of that class's size,
// so that small grains are not searched at the largest grain's cost.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/shapes.h"
#include "dem/grains.h"

namespace interstice::dem {

/// Slots of two grains that may touch, the lower id first.
struct PairRef {
  std::uint32_t a, b;
};

struct SearchSpace {
  Box domain;
  std::array<bool, 3> periodic{false, false, false};
  double skin = 0;  // [m]
};

/// All pairs whose surfaces are nearer than `skin`, in an order that depends on the rows' order alone.
std::vector<PairRef> find_pairs(const std::vector<GrainRow>& rows, const SearchSpace& space);

/// The same by trying every pair: the reference that find_pairs is held against.
std::vector<PairRef> find_pairs_brute_force(const std::vector<GrainRow>& rows, const SearchSpace& space);

/// Shortest vector from b to a [m], through the periodic faces where there are any.
inline Vec3d separation(const Vec3d& a, const Vec3d& b, const SearchSpace& space) {
  Vec3d d = a - b;
  for (int axis = 0; axis < 3; ++axis) {
    if (!space.periodic[axis]) continue;
    const double length = space.domain.hi[axis] - space.domain.lo[axis];
    if (d[axis] > 0.5 * length) d[axis] -= length;
    if (d[axis] < -0.5 * length) d[axis] += length;
  }
  return d;
}

}  // namespace interstice::dem
