// Averages of a field over a cube that is centred on each voxel in turn.
#pragma once

#include <array>
#include <vector>

#include "voxel/lattice.h"

namespace interstice::voxel {

/// The averaging window along one axis, in cells: weight 1 up to `whole` cells away from the centre cell,
/// weight `rest` for the two cells after that. A window of at most a cell's edge is the cell itself.
struct Window {
  std::int64_t whole = 0;
  double rest = 0;
  bool periodic = false;

  std::int64_t reach() const { return whole + (rest > 0 ? 1 : 0); }
};

/// The windows for a cube of edge `length` [m] along the three axes; along a periodic axis at most one
/// period.
std::array<Window, 3> averaging_windows(const Lattice& lattice, double length,
                                        const std::array<bool, 3>& periodic);

/// Shares of cells as dense doubles over part of a lattice, last axis fastest.
struct DenseShares {
  CellRange range;
  std::vector<double> solid;
  std::vector<double> available;  // empty: 1 everywhere

  std::size_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>(((i - range.lo[0]) * range.size(1) + (j - range.lo[1])) * range.size(2) +
                                    (k - range.lo[2]));
  }
};

/// What averages may hold in memory, in numbers: 4 GiB.
inline constexpr double kMostAverageDoubles = 0x1p29;

/// Room for the averages around `occupied` cells. Throws InputError, naming the remedies, when that would
/// take more than 4 GiB (2^29 doubles: half as many cells with walls, since then two numbers a cell are
/// kept).
DenseShares dense_shares(const Lattice& lattice, const CellRange& occupied,
                         const std::array<Window, 3>& windows, bool walls);

/// Turns `shares.solid` into the averages sum(solid) / sum(available) over the window; 0 where nothing is
/// available. Only what the window holds inside the lattice's box counts, so a window at an edge that is not
/// periodic is narrower there; across a periodic edge it goes on at the other side. `shares.available` is
/// used up. Sums run along one axis at a time by differences of prefix sums: the cost does not depend on the
/// window, the bits not on the number of threads; rounding about 1e-16 of the sum along a row of cells, and
/// exactly 0 where the window holds no solid.
void average(const Lattice& lattice, const std::array<Window, 3>& windows, DenseShares& shares);

}  // namespace interstice::voxel
