// Whether a ball touches a solid.
#pragma once

#include "base/shapes.h"
#include "voxel/solids.h"

namespace interstice::voxel {

/// Is some point of the solid (its inside included) within `reach` [m] of `center`? At the distance `reach`
/// itself: up to rounding.
bool within_reach(const Plane& plane, const Vec3d& center, double reach);
bool within_reach(const Box& box, const Vec3d& center, double reach);
bool within_reach(const Ball& ball, const Vec3d& center, double reach);
bool within_reach(const Cylinder& cylinder, const Vec3d& center, double reach);
bool within_reach(const MeshSolid& solid, const Vec3d& center, double reach);

}  // namespace interstice::voxel
