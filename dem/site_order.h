// Where grains lie in memory: neighbours in space near each other, for the caches. Results do not depend on
// it.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/grains.h"

namespace interstice::dem {

/// The indices of the sites, slab after slab along the longest side of the bed, each about a grain thick, and
/// along a Morton curve within a slab. Working through them, the grains that touch those at hand lie in the
/// next slab at most.
std::vector<std::uint32_t> order_in_space(const std::vector<GrainSite>& sites);

}  // namespace interstice::dem
