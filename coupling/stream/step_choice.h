// The time step of a scene: what it may be, what it is, and why.
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "dem/time_step.h"

namespace interstice::stream {

struct StepChoice {
  double step = 0;                // [s]
  int short_steps = 1;            // that small grains take in it
  double speed = 0;               // the largest of wall, insertion and fall speed [m/s]
  dem::StepLimits limits;         // Rayleigh and collision times [s]
  double rayleigh_fraction = 0;   // step (of small grains where there are two) over each
  double collision_fraction = 0;  // 0 where nothing moves fast enough to collide
  std::string limited_by;         // "Rayleigh time", "collision time" or "the scene"
  std::vector<std::string> warnings;

  double short_step() const { return step / short_steps; }  // [s]
};

/// More short steps than these would bring a whole step near half the time in which a small grain swings in
/// its contacts, where the two resonate (Biesiadecki & Skeel, J. Comput. Phys. 109, 1993, 318).
inline constexpr int kMostShortSteps = 8;

/// How many steps of small grains to make one of others that may take steps so many times as long.
int short_steps_in(double times_as_long);

/// Chooses the step, or judges the one that the scene asks for. Throws InputError above 0.2 of the collision
/// time unless the scene allows it, and where a wall would cross half the smallest grain in one step.
StepChoice choose_step(const scene::Scene& scene, const dem::Model& model);

}  // namespace interstice::stream
