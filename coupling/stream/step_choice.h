// The time step of a scene: what it may be, what it is, and why.
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "dem/time_step.h"

namespace interstice::stream {

struct StepChoice {
  double step = 0;                // [s]
  double speed = 0;               // the largest of wall, insertion and fall speed [m/s]
  dem::StepLimits limits;         // Rayleigh and collision times [s]
  double rayleigh_fraction = 0;   // step over each
  double collision_fraction = 0;  // 0 where nothing moves fast enough to collide
  std::string limited_by;         // "Rayleigh time", "collision time" or "the scene"
  std::vector<std::string> warnings;
};

/// Chooses the step, or judges the one that the scene asks for. Throws InputError above 0.2 of the collision
/// time unless the scene allows it, and where a wall would cross half the smallest grain in one step.
StepChoice choose_step(const scene::Scene& scene, const dem::Model& model);

}  // namespace interstice::stream
