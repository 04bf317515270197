// Walls and tools as flat outlines: what a slice cuts out of them, or what they look like from one side.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "coupling/io/particle_frame.h"

namespace interstice::figures {

using Point = std::array<double, 2>;  // [m], horizontal and vertical axis of the figure
using Outline = std::vector<Point>;   // a closed polygon

/// A rectangle [m].
struct Extent {
  Point lo{0, 0}, hi{0, 0};
  double width() const { return hi[0] - lo[0]; }
  double height() const { return hi[1] - lo[1]; }
};

/// What of a polygon lies inside `extent` (of one that is not convex, parts may stay joined along its edges).
Outline clipped(const Outline& polygon, const Extent& extent);

/// The solid of `walls` in the plane axis = `at`, inside `extent`; `axes` are the figure's two axes.
std::vector<Outline> cut(const std::vector<io::WallPose>& walls, int axis, double at, std::array<int, 2> axes,
                         const Extent& extent);

/// The walls seen along `axis`, inside `extent`. Planes that are not parallel to the line of sight are left
/// out: they would fill the figure.
std::vector<Outline> silhouette(const std::vector<io::WallPose>& walls, int axis, std::array<int, 2> axes,
                                const Extent& extent);

/// `extent` widened by `margin` [m per axis] towards each side on which a wall's solid begins within
/// `margin`: a floor right under the powder is then seen as a floor.
Extent widened_to_walls(const std::vector<io::WallPose>& walls, int axis, double at, std::array<int, 2> axes,
                        const Extent& extent, Point margin);

/// gnuplot polygons over the plot: grey, hatched, with a dark edge. Coordinates are multiplied by `scale`.
std::string hatched(const std::vector<Outline>& outlines, Point scale);
/// Their edges alone.
std::string edges(const std::vector<Outline>& outlines, Point scale);

}  // namespace interstice::figures
