// Dense random packings made by geometry, for benchmarks and starts: spheres pushed apart until they hardly
// overlap.
#pragma once

#include <cstdint>
#include <vector>

#include "dem/columns.h"

namespace interstice::dem {

/// Places spheres of the given radii [m] in a cell of the given ground [m], periodic in x and y, between a
/// floor at z = 0 and a lid that gives the solid fraction asked for. What overlap is left is a small share of
/// a radius for solid fractions up to about 0.6. Iterative overlap removal, as Jodrey & Tory (Phys. Rev. A
/// 32, 2347, 1985).
std::vector<NewGrain> pack_in_cell(const std::vector<double>& radii, double length_x, double length_y,
                                   double solid_fraction, std::uint64_t seed);

}  // namespace interstice::dem
