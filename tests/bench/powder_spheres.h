// The spheres that field benchmarks work on: diameters normal by number, mean 39.4 um, sd 10.5 um, cut to 5
// to 65 um (paper 004's powder), on voxels of 17.3 um.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.h"
#include "voxel/field.h"

namespace interstice::bench {

inline constexpr double kVoxel = 17.3e-6;

struct Bed {
  std::vector<double> x, y, z, radius;
  Box box;

  std::size_t size() const { return radius.size(); }
  voxel::SpheresView view() const {
    return {radius.size(), x.data(), y.data(), z.data(), radius.data(), nullptr};
  }
};

/// Random positions in a layer 0.3 mm high that the spheres would fill to a solid fraction of 0.45. They
/// overlap, which costs the field no more and no less than if they did not.
inline Bed make_bed(std::size_t count) {
  Bed bed;
  double volume = 0;
  Random random(4, 0);
  while (bed.size() < count) {
    const double normal =
        std::sqrt(-2 * std::log(random.uniform())) * std::cos(2 * std::numbers::pi * random.uniform());
    const double diameter = 39.4e-6 + 10.5e-6 * normal;
    if (diameter < 5e-6 || diameter > 65e-6) continue;
    bed.radius.push_back(0.5 * diameter);
    volume += std::numbers::pi / 6 * diameter * diameter * diameter;
  }
  const double height = 0.3e-3, area = volume / (0.45 * height), width = std::sqrt(area / 2.6);
  bed.box = {{0, 0, 0}, {area / width, width, height}};
  for (const double r : bed.radius) {
    bed.x.push_back(random.uniform(r, bed.box.hi.x - r));
    bed.y.push_back(random.uniform(r, width - r));
    bed.z.push_back(random.uniform(r, height - r));
  }
  return bed;
}

inline voxel::FieldRequest request_for(const Bed& bed,
                                       voxel::Precision precision = voxel::Precision::real64) {
  voxel::FieldRequest request;
  request.lattice = voxel::cubic_lattice(bed.box, kVoxel);
  request.precision = precision;
  return request;
}

}  // namespace interstice::bench
