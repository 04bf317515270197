// Solids cut by a plane, as flat outlines.
#pragma once

#include "coupling/figures/outline.h"
#include "voxel/solids.h"

namespace interstice::figures {

/// What the plane axis = `at` cuts out of the solids, inside `extent`; `axes` are the figure's two axes.
/// Curves are polygons of some hundred sides. A cavity is an outline of its own inside its body's.
std::vector<Outline> sections(const voxel::Solids& solids, int axis, double at, std::array<int, 2> axes,
                              const Extent& extent);

}  // namespace interstice::figures
