// What contacts do to each grain: how many it has, and the mean stress that they keep up inside it. Walls
// that it touches count as other grains do. Valid after Simulation::advance().
#pragma once

#include <array>
#include <vector>

#include "dem/simulation.h"

namespace interstice::dem {

/// Columns in the order of ascending id.
struct GrainStresses {
  std::vector<double> contacts;  // that touch; forces across a gap make stress, but no contact
  /// xx yy zz xy yz xz, tension positive [Pa]: sum over contacts of r (x) f over the grain's volume, r from
  /// its centre to the contact and f the force on it, made symmetric (A. E. H. Love 1927; J. Weber 1966). The
  /// line between two centres is divided in proportion to the radii; against a wall r ends on its surface.
  std::array<std::vector<double>, 6> stress;
};

/// The same bits for any number of threads.
GrainStresses grain_stresses(const Simulation& simulation);

}  // namespace interstice::dem
