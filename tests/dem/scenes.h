// Small models that several tests start from.
#pragma once

#include "base/random.h"
#include "dem/simulation.h"

namespace interstice::dem::testing {

/// One material, everything modelled, a wide open domain without gravity.
inline Model plain_model(const Material& material, const PairCoefficients& pair, const Laws& laws) {
  Model m;
  m.domain = {{-1, -1, -1}, {1, 1, 1}};
  m.gravity = {0, 0, 0};
  m.materials = {material};
  m.pairs = {pair};
  m.laws = laws;
  return m;
}

inline Material powder() { return {8200, 1e9, 0.3}; }
inline Laws with_friction() { return {.tangential = TangentialLaw::mindlin}; }
inline Laws with_rolling() { return {.tangential = TangentialLaw::mindlin, .rolling = RollingLaw::cdt}; }
inline Laws with_sjkr() { return {.cohesion = CohesionLaw::sjkr}; }
inline Laws everything() {
  return {.tangential = TangentialLaw::mindlin, .rolling = RollingLaw::cdt, .cohesion = CohesionLaw::sjkr};
}

/// A loose random cloud of grains of 10 to 65 um above a floor, falling and colliding: all laws at work.
inline Simulation falling_cloud(std::size_t count, const SimulationOptions& options = {}) {
  Model m = plain_model(powder(), {0.35, 0.3, 0.005, 1e6}, everything());
  m.domain = {{0, 0, -1e-4}, {6e-4, 6e-4, 5e-2}};
  m.boundary = {AxisBoundary::periodic, AxisBoundary::periodic, AxisBoundary::open};
  m.gravity = {0.5, 0, -9.81};
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}, {Box{{1e-4, 1e-4, -1e-4}, {3e-4, 5e-4, 1e-4}}, 0}};
  Simulation sim(m, 1e-8, options);
  Random random(7, 0);
  std::vector<NewGrain> grains;
  for (std::size_t i = 0; i < count; ++i) {
    NewGrain g;
    g.radius = random.uniform(5e-6, 32e-6);
    const double side = 75e-6;
    const std::size_t nx = 8, layer = i / (nx * nx), in_layer = i % (nx * nx);
    g.position = {(0.5 + static_cast<double>(in_layer % nx)) * side,
                  (0.5 + static_cast<double>(in_layer / nx)) * side,
                  1.6e-4 + static_cast<double>(layer) * side};
    g.velocity = {random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), -2};
    g.spin = {random.uniform(-1e3, 1e3), 0, random.uniform(-1e3, 1e3)};
    grains.push_back(g);
  }
  sim.add_grains(grains);
  return sim;
}

}  // namespace interstice::dem::testing
