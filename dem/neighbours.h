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

  /// Of the domain [m]; 0 along axes that are not periodic.
  Vec3d period() const {
    const Vec3d length = domain.size();
    return {periodic[0] ? length.x : 0, periodic[1] ? length.y : 0, periodic[2] ? length.z : 0};
  }
};

/// All pairs whose surfaces are nearer than `skin`, in an order that depends on the sites' order alone.
std::vector<PairRef> find_pairs(const std::vector<GrainSite>& sites, const SearchSpace& space);

/// The same by trying every pair: the reference that find_pairs is held against.
std::vector<PairRef> find_pairs_brute_force(const std::vector<GrainSite>& sites, const SearchSpace& space);

/// The shortest of a vector's images through the periodic faces: at most one period is added or taken away
/// along each axis; a period of 0 changes nothing.
inline Vec3d nearest_image(const Vec3d& d, const Vec3d& period) {
  const auto wrap = [](double x, double length) {
    return x > 0.5 * length ? x - length : x < -0.5 * length ? x + length : x;
  };
  return {wrap(d.x, period.x), wrap(d.y, period.y), wrap(d.z, period.z)};
}

/// Shortest vector from b to a [m], through the periodic faces where there are any.
inline Vec3d separation(const Vec3d& a, const Vec3d& b, const SearchSpace& space) {
  return nearest_image(a - b, space.period());
}

/// Are the surfaces of two grains nearer than the skin?
class NearTest {
 public:
  explicit NearTest(const SearchSpace& space) : period_(space.period()), skin_(space.skin) {}

  template <class A, class B>
  bool operator()(const A& a, const B& b) const {
    const Vec3d d = nearest_image({a.x - b.x, a.y - b.y, a.z - b.z}, period_);
    const double reach = a.radius + b.radius + skin_;
    return dot(d, d) < reach * reach;
  }

 private:
  Vec3d period_;
  double skin_;
};

}  // namespace interstice::dem
