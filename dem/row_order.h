// Where grains lie in memory: neighbours in space near each other, for the caches. Results do not depend on
// it.
#pragma once

#include <vector>

#include "dem/grains.h"

namespace interstice::dem {

/// Sorts both columns along a Morton curve.
void sort_rows_in_space(std::vector<GrainRow>& rows, std::vector<GrainMotion>& motions);

}  // namespace interstice::dem
