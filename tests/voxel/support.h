// What the tests of the voxel library share.
#pragma once

#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "base/shapes.h"
#include "voxel/spheres.h"

namespace interstice::voxel::test {

inline double ball_volume(double r) { return 4 * std::numbers::pi / 3 * r * r * r; }

/// Columns that own their numbers.
struct Spheres {
  std::vector<double> x, y, z, radius, density;

  void add(const Vec3d& center, double r) {
    x.push_back(center.x);
    y.push_back(center.y);
    z.push_back(center.z);
    radius.push_back(r);
  }
  Vec3d center(std::size_t s) const { return {x[s], y[s], z[s]}; }
  std::size_t size() const { return radius.size(); }
  double volume() const {
    double sum = 0;
    for (const double r : radius) sum += ball_volume(r);
    return sum;
  }
  SpheresView view() const {
    return {radius.size(), x.data(),      y.data(),
            z.data(),      radius.data(), density.empty() ? nullptr : density.data()};
  }
};

/// Spheres with centres anywhere in `box` and radii evenly spread from `smallest` to `largest`.
inline Spheres random_spheres(std::size_t count, const Box& box, double smallest, double largest,
                              std::uint64_t seed) {
  Spheres spheres;
  for (std::size_t s = 0; s < count; ++s) {
    Random random(seed, s);
    spheres.add({random.uniform(box.lo.x, box.hi.x), random.uniform(box.lo.y, box.hi.y),
                 random.uniform(box.lo.z, box.hi.z)},
                random.uniform(smallest, largest));
  }
  return spheres;
}

/// A micrometre-scale box whose edges are no multiple of the voxels used here, and spheres across its faces.
inline Box bed_box() { return {{-40e-6, 15e-6, 3e-6}, {230e-6, 231e-6, 151e-6}}; }
inline Spheres bed(std::size_t count = 300, std::uint64_t seed = 1) {
  return random_spheres(count, bed_box(), 2.5e-6, 32.5e-6, seed);
}

}  // namespace interstice::voxel::test
