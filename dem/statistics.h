// Numbers of a simulation at its present time. Sums run in the order of ids, so they are the same bits
// whatever the threads and lists. Valid after Simulation::advance().
#pragma once

#include <cstdint>

#include "dem/simulation.h"

namespace interstice::dem {

/// Particle-particle contacts only.
struct ContactStatistics {
  std::int64_t contacts = 0;
  double force_mean = 0;         // of |F|, normal and tangential together, per contact [N]
  double force_max = 0;          // [N]
  double normal_force_mean = 0;  // of |F . n| per contact [N]
};

/// Forces of the powder on one wall.
struct WallStatistics {
  double normal_force = 0;  // sum of the pressing parts of the contact forces (cohesion counts negative) [N]
  double shear_force = 0;   // magnitude of the vector sum of the tangential parts [N]
  double shear_force_sum = 0;  // sum of their magnitudes [N]
  std::int64_t contacts = 0;
  std::int64_t particles = 0;  // grains that touch it
  double contact_area = 0;     // sum of pi a^2, a the contact radius [m^2]
  double footprint_area = 0;   // 50 um cells of the surface that powder touches [m^2]
};

struct MotionStatistics {
  double kinetic_energy = 0;    // translation and rotation [J]
  double fall_energy_mean = 0;  // mean of m g d over grains [J]
  double fastest = 0;           // [m/s]
};

/// How fine the time step is for the contacts as they are.
struct StepCheck {
  double ratio = 0;                         // dt over sqrt(m*/S) of the stiffest contact; 0 without contacts
  std::int64_t grain_a = -1, grain_b = -1;  // of that contact; b < 0: a wall
  double frequency = 0;  // dt times a bound of the highest frequency of the contact network (Gershgorin); the
                         // integration is stable below 2
  std::int64_t frequency_grain = -1;  // the grain whose contacts give it
  double damping = 0;  // dt times a bound of the fastest decay that dashpots ask for; sound below 1: beyond,
                       // a grain among many contacts may vibrate on
  std::int64_t damping_grain = -1;
};

ContactStatistics contact_statistics(const Simulation& simulation);
WallStatistics wall_statistics(const Simulation& simulation, std::size_t wall);
MotionStatistics motion_statistics(const Simulation& simulation);
StepCheck check_step(const Simulation& simulation);

}  // namespace interstice::dem
