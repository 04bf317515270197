// The exact volume of a sphere in axis-aligned boxes: in one, or in all cells of a lattice that it touches.
//
// Let F(a,b,c) be the volume of the unit ball in [0,a] x [0,b] x [0,c], odd in each argument. The volume in a
// box is F's mixed difference over the box's eight corners, so neighbouring cells share corners.
// For a, b, c in [0, 1], inside the ball (a^2 + b^2 + c^2 <= 1),
//
//   F = abc,
//
// and elsewhere an octant, less what lies beyond each plane, plus what was taken off twice:
//
//   F = pi/6 - [cap(a) + cap(b) + cap(c)]/4 + [W(a,b) + W(b,c) + W(c,a)]/2.
//
// cap(a) is the ball beyond the plane x = a, W(a,b) the ball where x > a and y > b. Where a^2 + b^2 >= 1 that
// is nothing; else, integrating the circular segments y > b of the discs at constant x > a,
//
//   cap(a) = pi (1-a)^2 (2+a) / 3,
//   W(a,b) = [2 atan2(s, ab) - a(3-a^2) atan2(s, b) - b(3-b^2) atan2(s, a) + 2abs] / 3,
//   s      = sqrt(1 - a^2 - b^2).
//
// So all that is transcendental sits in three tables over pairs of lattice planes; a corner costs additions.
//
// Error: about 1e-16 (R/h)^3 of a cell, from cancellation between corners. Spheres of more than some 50
// cells' radius go another way, overlap_large.h.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/shapes.h"
#include "voxel/lattice.h"
#include "voxel/quarter_angle.h"

namespace interstice::voxel {

/// A sphere on a lattice: its centre is `offset` [m] above the lower corner of cell `cell` (which may lie
/// outside the lattice). Differences of coordinates are formed once here, so that accuracy does not depend on
/// the distance from the origin; and a periodic image is the same sphere in another cell, bit for bit.
struct PlacedSphere {
  std::array<std::int64_t, 3> cell{0, 0, 0};
  Vec3d offset;
  double radius = 0;
};

inline PlacedSphere place(const Lattice& lattice, const Vec3d& center, double radius) {
  PlacedSphere sphere;
  sphere.radius = radius;
  const Vec3d local = center - lattice.lo;
  for (int axis = 0; axis < 3; ++axis) {
    sphere.cell[axis] = floor_index(local[axis] / lattice.h[axis]);
    sphere.offset[axis] = std::fma(-static_cast<double>(sphere.cell[axis]), lattice.h[axis], local[axis]);
  }
  return sphere;
}

/// Cells of the sphere's bounding box, not clipped to any lattice.
inline CellRange bounding_cells(const Lattice& lattice, const PlacedSphere& sphere) {
  CellRange range;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = lattice.h[axis], at = sphere.offset[axis];
    range.lo[axis] = sphere.cell[axis] + floor_index((at - sphere.radius) / h);
    range.hi[axis] = sphere.cell[axis] + floor_index((at + sphere.radius) / h) + 1;
  }
  return range;
}

/// True when some point of `range` is closer to the centre than the radius.
inline bool touches(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& range) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = lattice.h[axis], at = sphere.offset[axis];
    const double below = static_cast<double>(range.lo[axis] - sphere.cell[axis]) * h - at;
    const double above = at - static_cast<double>(range.hi[axis] - sphere.cell[axis]) * h;
    const double distance = std::max({below, above, 0.0});
    squared += distance * distance;
  }
  return squared < sphere.radius * sphere.radius;
}

/// Does the sphere fill all cells of the range?
inline bool covers_range(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& range) {
  double squared = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double h = lattice.h[axis], at = sphere.offset[axis];
    const double below = at - static_cast<double>(range.lo[axis] - sphere.cell[axis]) * h;
    const double above = static_cast<double>(range.hi[axis] - sphere.cell[axis]) * h - at;
    const double farthest = std::max(std::abs(below), std::abs(above));
    squared += farthest * farthest;
  }
  return squared <= sphere.radius * sphere.radius;
}

/// Volume [m^3] of the sphere inside `box` [m]; edges may be infinite.
double sphere_box_volume(const Vec3d& center, double radius, const Box& box);

/// Volume [m^3] of the sphere inside the cells of `range`, taken as one box.
double sphere_range_volume(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& range);

/// Cells are worked on in blocks of at most kBlock along an axis: OpenVDB's leaf.
inline constexpr int kBlock = 8;
inline constexpr int kBlockCells = kBlock * kBlock * kBlock;

/// Writes the share of each cell of `block` that the sphere fills, 0 to 1, last axis fastest, without gaps:
/// fractions[(i * size(1) + j) * size(2) + k]. Exactly 0 where the sphere does not reach, exactly 1 inside
/// it. A cell's number does not depend on the block that it is computed in.
void exact_fractions(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& block,
                     double* fractions);

/// Calls visit(i, j, k, volume) with the volume [m^3] of the sphere in each cell of `range` that it touches.
template <class Visit>
void for_each_overlap(const Lattice& lattice, const Vec3d& center, double radius, const CellRange& range,
                      const Visit& visit) {
  const PlacedSphere sphere = place(lattice, center, radius);
  const CellRange touched = intersection(bounding_cells(lattice, sphere), range);
  const double cell = lattice.cell_volume();
  double fractions[kBlockCells];
  std::array<std::int64_t, 3> at;
  for (at[0] = touched.lo[0]; at[0] < touched.hi[0]; at[0] += kBlock)
    for (at[1] = touched.lo[1]; at[1] < touched.hi[1]; at[1] += kBlock)
      for (at[2] = touched.lo[2]; at[2] < touched.hi[2]; at[2] += kBlock) {
        const CellRange block = intersection(touched, {at, {at[0] + kBlock, at[1] + kBlock, at[2] + kBlock}});
        if (!touches(lattice, sphere, block)) continue;
        exact_fractions(lattice, sphere, block, fractions);
        const double* next = fractions;
        for (std::int64_t i = block.lo[0]; i < block.hi[0]; ++i)
          for (std::int64_t j = block.lo[1]; j < block.hi[1]; ++j)
            for (std::int64_t k = block.lo[2]; k < block.hi[2]; ++k, ++next)
              if (*next > 0) visit(i, j, k, *next * cell);
      }
}

/// cap(a) above, for a in [0, 1].
inline double ball_cap(double a) { return std::numbers::pi / 3 * ((1 - a) * (1 - a) * (2 + a)); }

/// W(a, b) above, for a, b in [0, 1] with a^2 + b^2 <= 1.
inline double ball_wedge(double a, double b) {
  const double s = std::sqrt(std::max(0.0, 1 - a * a - b * b));
  return (2 * quarter_angle(s, a * b) - a * (3 - a * a) * quarter_angle(s, b) -
          b * (3 - b * b) * quarter_angle(s, a) + 2 * a * b * s) /
         3;
}

}  // namespace interstice::voxel
