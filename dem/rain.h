// Rain: grains put into a box at random places, over time, as room is found.
#pragma once

#include <cstdint>
#include <vector>

#include "base/random.h"
#include "dem/simulation.h"

namespace interstice::dem {

/// A queue of grains to come; they are placed in this order, so that the size distribution is never biased by
/// room.
struct Rain {
  std::vector<double> radii;  // [m]
  Box box;                    // grains lie wholly inside
  Vec3d velocity{0, 0, 0};    // [m/s]
  std::uint16_t material = 0;
  std::int32_t layer = 0;
  std::size_t next = 0;  // index of the next grain in `radii`
  Random random{1, 0};

  bool finished() const { return next == radii.size(); }
};

/// Places grains until one finds no room in `tries` random places. Returns how many were added.
std::size_t pour(Simulation& simulation, Rain& rain, int tries = 100);

}  // namespace interstice::dem
