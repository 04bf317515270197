// Two rates of steps: grains smaller than a limit are *quick*, and take several short steps, *beats*, for
// each step of the others. What a quick grain touches is worked on in every beat, all else once a step:
// reversible reference system propagation (Tuckerman, Berne & Martyna, J. Chem. Phys. 97, 1990, 1992),
// with the forces between slow bodies as the slow part.
//
// A slow grain near a quick one moves in every beat, too; the others, on which nothing acts between two
// steps, are moved by as many beats at once, to the same bits. So which slow grains move in beats depends on
// the lists, and nothing else does.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/lanes.h"

namespace interstice::dem {

struct Rates {
  double quick_below = 0;  // radius [m]
  int beats = 1;           // a step

  bool two() const { return beats > 1; }
  bool is_quick(double radius) const { return radius < quick_below; }
};

/// Which slots take part in beats, as of the last lists.
struct QuickSlots {
  std::vector<std::uint32_t> ends;     // by group and stand: how many of a grain's first ends are quick
  std::vector<std::uint32_t> most;     // by group: the largest of these
  std::vector<std::uint16_t> quick;    // by group, a bit a lane: quick grains
  std::vector<std::uint16_t> beating;  // the same: those that move in beats

  std::size_t bytes() const {
    return (ends.capacity() + most.capacity()) * 4 + (quick.capacity() + beating.capacity()) * 2;
  }
};
static_assert(kLanes == 16);

}  // namespace interstice::dem
