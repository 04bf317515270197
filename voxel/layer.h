// How a spread layer is packed, column by column, straight from the spheres (exact volumes, no voxels).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/shapes.h"
#include "voxel/solids.h"
#include "voxel/spheres.h"

namespace interstice::voxel {

struct LayerRequest {
  Box box;                              // columns stand in x and y over it; z is the layer (the gap)
  std::array<std::int64_t, 2> columns;  // NX, NY
  std::array<bool, 3> periodic{false, false, false};
  double density = 0;  // [kg/m^3] used where spheres carry none
};

/// One number per column, x fastest: index = i + NX * j.
struct LayerColumns {
  std::array<std::int64_t, 2> columns{0, 0};
  std::vector<double> x, y;              // centres [m], NX and NY values
  std::vector<double> available_volume;  // [m^3] of the gap, not taken by walls
  std::vector<double>
      solid_fraction;                // solid volume in the gap / available volume; 0 where none is available
  std::vector<double> mass_density;  // [kg/m^3], same volume
  std::vector<double>
      solid_height;  // solid volume above the floor, at any height, per area free of walls [m]
  std::vector<double> surface_height;  // highest point of powder in the column above the floor [m]; 0: none
  std::vector<double> solid_fraction_below_surface;  // solid height / surface height; 0 without powder
};

/// Means over the area that walls leave free (so that a wall closing in on the same powder makes the layer
/// higher), and the sample standard deviation (N - 1) of the gap's solid fraction over the columns that are
/// mostly free.
struct LayerSummary {
  double solid_fraction_gap = 0;            // sum of solid / sum of available in the gap
  double solid_fraction_sd = 0;             // over columns
  double solid_height = 0;                  // [m]
  double surface_height = 0;                // [m]
  double solid_fraction_below_surface = 0;  // sum of solid / sum of (surface height * area)
};

/// A profile along x (or y): each of the columns' numbers averaged over the other axis; fractions are ratios
/// of sums, as in the summary.
struct LayerProfile {
  std::vector<double> at;  // [m]
  std::vector<double> solid_fraction, solid_height, surface_height, solid_fraction_below_surface;
};

/// Columns periodic in x and y continue at the other side of the box; periodic[2] is ignored (a layer has a
/// floor and a top). Throws InputError on an empty box, columns outside 1 to 10^6, or spheres that are not
/// finite and positive.
LayerColumns layer_columns(const SpheresView& spheres, const Solids& solids, const LayerRequest& request);
LayerSummary layer_summary(const LayerColumns& columns);
LayerProfile layer_profile(const LayerColumns& columns, int axis);  // axis 0: along x, 1: along y

}  // namespace interstice::voxel
