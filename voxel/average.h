// Averages of a field over a window (averaging_window.h) that is centred on each voxel in turn.
//
// A voxel's value counts with the share of the window that lies in the voxel, so the average is that of the
// field taken as constant in each voxel. Sums run along one axis at a time for boxes and Gaussians
// (average_axes.h), over rows of cells for spheres (average_sphere.h).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/averaging_window.h"
#include "voxel/lattice.h"

namespace interstice::voxel {

/// A window along one axis, in cells.
struct AxisWindow {
  bool periodic = false;
  std::int64_t reach = 0;       // cells farther than this from the centre's cell have no weight
  double outer = 1;             // box: the weight of the two cells at the reach; those within have 1
  std::vector<double> weights;  // Gaussian: of the cell itself, and of each of the two at 1, 2, ... reach
};

struct Window {
  WindowShape shape = WindowShape::box;
  std::array<AxisWindow, 3> axes;
  double radius = 0;  // sphere: in cells
};

inline constexpr double kMostWindowPeriods = 64;  // that a sphere may span

/// The window for a length of `cells` cells (cubic ones). A box or sphere of at most a cell is the cell
/// itself. Along a periodic axis a box is at most one period, a Gaussian's standard deviation at most two.
/// Throws InputError for a sphere of more than kMostWindowPeriods periods.
Window averaging_window(const Lattice& lattice, WindowShape shape, double cells,
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

/// What averaging keeps: one number a cell, one more with walls, one more for a sphere.
double doubles_a_cell(const Window& window, bool walls);

/// Room for the averages around `occupied` cells. Throws InputError, naming the remedies, when averaging
/// would take more than 4 GiB.
DenseShares dense_shares(const Lattice& lattice, const CellRange& occupied, const Window& window, bool walls);

/// The voxels whose averages are wanted: along x and y every `step`-th of the range.
struct Centres {
  CellRange range;
  std::int64_t step = 1;
};

/// Turns `shares.solid` into the averages sum(solid) / sum(available) over the window; 0 where nothing is
/// available. Only what the window holds inside the lattice's box counts, so a window at an edge that is not
/// periodic is cut off there; across a periodic edge it goes on at the other side. `shares.available`, where
/// there are walls, becomes the sum of available; of voxels that are not wanted both may hold anything. The
/// bits do not depend on the number of threads; rounding is about 1e-16 of the sum along a row of cells, and
/// an average is exactly 0 where the window holds no solid. `others`, indexed as the shares, are averaged
/// alike; empty ones stay so.
void average(const Lattice& lattice, const Window& window, const Centres& wanted, DenseShares& shares,
             std::span<std::vector<double>> others = {});

/// What the window, centred on a cell, holds of the lattice: the sum of its weights, in cells for boxes and
/// spheres, at most 1 for Gaussians.
double weight_inside(const Lattice& lattice, const Window& window, const std::array<std::int64_t, 3>& cell);

}  // namespace interstice::voxel
