// Where grains lie in memory: neighbours in space near each other, for the caches. Results do not depend on
// it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dem/grains.h"

namespace interstice::dem {

/// Grains in a slab across the whole bed, at most, and about how many in one of a column where there are
/// more: what a step has in use of two slabs must stay in a thread's share of the last cache, and pairs
/// between columns cost twice as much as others.
inline constexpr std::size_t kMostInSlab = 4096, kGrainsInSlabOfColumn = 2048;

/// The indices of the sites: slab after slab along the longest side of the bed, each about a grain thick, and
/// row after row within a slab, along its shorter side; column after column of slabs where whole ones would
/// hold too many. So a grain of the mean size touches none that lies farther than a slab and two rows away,
/// but in another column or through the periodic ends of the longest side.
std::vector<std::uint32_t> order_in_space(const std::vector<GrainSite>& sites,
                                          const std::array<bool, 3>& periodic);

}  // namespace interstice::dem
