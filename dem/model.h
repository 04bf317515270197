// What is simulated, apart from the grains: materials, laws, walls, the domain. Plain numbers in SI.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/shapes.h"
#include "dem/contact/pair_constants.h"

namespace interstice::dem {

enum class AxisBoundary { open, periodic };  // a bounding wall is a plane among the walls

struct Wall {
  Shape shape;  // as it stands at time 0
  std::uint16_t material = 0;
};

struct Model {
  Box domain;
  std::array<AxisBoundary, 3> boundary{AxisBoundary::open, AxisBoundary::open, AxisBoundary::open};
  Vec3d gravity{0, 0, -9.81};  // [m/s^2]
  std::vector<Material> materials;
  std::vector<PairCoefficients> pairs;  // materials x materials, symmetric
  Laws laws;
  DampingRule damping = DampingRule::exact_with_tension;
  double slider_velocity = 1e-3;  // below it the slider's friction is in proportion to the slip [m/s]
  std::vector<Wall> walls;

  const PairCoefficients& pair(std::size_t a, std::size_t b) const { return pairs[a * materials.size() + b]; }
  PairConstants<double> constants(std::size_t a, std::size_t b) const {
    return derive_pair_constants(materials[a], materials[b], pair(a, b), laws.normal, damping);
  }
};

}  // namespace interstice::dem
