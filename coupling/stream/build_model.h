// From a scene to what the particle engine takes.
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "dem/model.h"
#include "dem/rain.h"

namespace interstice::stream {

std::size_t material_index(const scene::Scene& scene, const std::string& name);

/// Materials, laws, domain and walls. The scene's walls come first and keep their order; bounding walls
/// follow.
dem::Model build_model(const scene::Scene& scene);

/// The model with all places relative to `origin`. The engine computes near the origin of its coordinates,
/// whatever those of the scene are, so that no digits of an overlap are lost to a far domain.
dem::Model relative_to(const Vec3d& origin, dem::Model model);

/// One queue per rained entry of the scene, in the scene's order, with the sizes drawn.
struct PhasedRain {
  std::string phase;
  double interval = 0;  // [s]
  dem::Rain rain;
};
std::vector<PhasedRain> build_rain(const scene::Scene& scene, const Vec3d& origin = {0, 0, 0});

/// The grains placed from lists.
std::vector<dem::NewGrain> build_placed_grains(const scene::Scene& scene, const Vec3d& origin = {0, 0, 0});

}  // namespace interstice::stream
