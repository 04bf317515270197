// Where grains lie in memory: neighbours in space near each other, for the caches. Results do not depend on
// it.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/grains.h"

namespace interstice::dem {

/// Grains in a slab across the whole bed, at most, and about how many in one of a column where there are
/// more: what a step has in use of two slabs must stay in a thread's share of the last cache, and pairs
/// between columns cost twice as much as others.
inline constexpr std::size_t kMostInSlab = 4096, kGrainsInSlabOfColumn = 2048;

/// The indices of the sites: slab after slab along the longest side of the bed, each about a grain thick, and
/// along a Morton curve within a slab; column after column of slabs where whole ones would hold too many.
/// Working through them, the grains that touch those at hand lie in the next slab at most, or in another
/// column.
std::vector<std::uint32_t> order_in_space(const std::vector<GrainSite>& sites);

}  // namespace interstice::dem
