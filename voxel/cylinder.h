// The volume of a finite cylinder in a box.
#pragma once

#include <span>

#include "base/shapes.h"

namespace interstice::voxel {

/// A solid cylinder with flat ends at `from` and `to` [m], which differ.
struct Cylinder {
  Vec3d from, to;
  double radius = 0;  // [m]
};

struct Point2 {
  double x = 0, y = 0;
};

/// Area of the disc of `radius` around the origin inside a polygon, whose corners go round counter-clockwise
/// (clockwise: negative). Edge by edge: a triangle to the origin where the edge is in the disc, a sector
/// where it is outside. Error about 1e-16 (radius times the polygon's size).
double disc_polygon_area(double radius, std::span<const Point2> polygon);

/// Volume [m^3] of the cylinder inside `cell`. In closed form where the axis is parallel to an axis of the
/// cell: the area of a disc in a rectangle times a height. Else the area of the disc in the cell's section
/// across the cylinder is integrated along the cylinder, to an error below 1e-9 of the cell (R/h < 1e5).
double cylinder_volume(const Cylinder& cylinder, const Box& cell);

/// The axis that the cylinder is parallel to, or -1.
int parallel_axis(const Cylinder& cylinder);

bool contains(const Cylinder& cylinder, const Vec3d& point);
Box bounds_of(const Cylinder& cylinder);

/// How far the point is from the cylinder; 0 inside.
double distance(const Cylinder& cylinder, const Vec3d& point);

}  // namespace interstice::voxel
