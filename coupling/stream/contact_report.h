// What the contact parameters of a scene mean in numbers that one can judge, before anything is computed.
#pragma once

#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "dem/contact_scales.h"
#include "dem/model.h"

namespace interstice::stream {

/// One pair of materials that can meet, at the median grain (of each).
struct PairReport {
  std::string first, second;  // materials; the second may be a wall's
  bool wall = false;          // grain against wall
  double diameter = 0;        // of the median grain of the first material [m]
  dem::Encounter encounter;
  double pull_off = 0;       // [N]; 0 without cohesion, like all below
  double bond = 0;           // pull-off over the median grain's weight; infinite without gravity
  double bond_smallest = 0;  // the same of the smallest and
  double bond_largest = 0;   // of the largest grain
  double tabor = 0;
  double sticking_speed = 0;       // [m/s]
  double equilibrium_overlap = 0;  // of the diameter [-]
  double impact_overlap = 0;       // at the scene's speed, of the diameter [-]
};

struct ContactReport {
  std::string laws;  // "hertz, mindlin, cdt, sjkr; damping with tension"
  bool own_kernel = false;
  std::vector<PairReport> pairs;
  std::vector<std::string> warnings;
};

/// `speed`: the largest that the scene will see [m/s]; `step`: the time step [s]. Throws InputError where
/// attraction outweighs the elastic force at every overlap, so that grains would fall into each other.
ContactReport report_contacts(const scene::Scene& scene, const dem::Model& model, double speed, double step);

}  // namespace interstice::stream
