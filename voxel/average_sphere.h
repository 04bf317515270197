// Window sums of spheres: rows of cells, gathered by symmetry.
//
// A cell at the offset (a, b, c) from the centre's cell has the same share of the sphere as those at (+-a,
// +-b,
// +-c) and (+-b, +-a, +-c). So the rows of cells at up to eight offsets (dx, dy) are added up once, before
// anything is weighed; what has the share 1 is added to one sum for each length of such a row, what the
// surface cuts to one sum for each c, and only these few sums are shifted along z. For a sphere of D cells'
// diameter that is some 1.1 D^2 additions a voxel, whole rows at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "voxel/average.h"

namespace interstice::voxel {

/// The rows at the offsets (+-a, +-b) and (+-b, +-a), a >= b >= 0: cells at |c| < whole are inside the
/// sphere, cut[c - whole] is the share of those that follow; farther ones have none.
struct BallRow {
  std::int64_t a = 0, b = 0, whole = 0;
  std::vector<double> cut;
};

/// All rows of a sphere of `radius` cells around the centre of a cell, as far as offsets up to `most` along
/// the axes need them (negative: any offset).
std::vector<BallRow> ball_rows(double radius, const std::array<std::int64_t, 3>& most);

/// Replaces the values of the cells that are wanted by the sums over the sphere centred on each; of others
/// nothing can be said afterwards. Needs room for as many values again.
void sum_over_sphere(std::vector<double>& values, const CellRange& range, const Window& window,
                     const Centres& wanted);

}  // namespace interstice::voxel
