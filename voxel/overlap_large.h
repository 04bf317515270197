// The volume of the unit ball in a box that is small beside it, without cancellation.
//
// The closed form of overlap.h subtracts corner values of order 1 to get a volume of order h^3. Here the area
// of the disc z = const in the box's rectangle (trapezoid and circular segment: closed form, and as small as
// the box) is integrated over the box's shortest axis, from one z to the next at which the circle passes a
// corner of the rectangle. In between the area is smooth, except that at or just beyond an end it may start
// as t^(3/2), where circle and edge touch; double-exponential points do not mind. The error is about 1e-16 /
// h of the box; a box costs some microseconds.
#pragma once

#include "base/vec3.h"

namespace interstice::voxel {

/// Volume of the unit ball inside the box [lo, hi].
double unit_ball_in_box(const Vec3d& lo, const Vec3d& hi);

}  // namespace interstice::voxel
