// Reading a field out: planes of voxels, rows of voxels.
#pragma once

#include <vector>

#include "voxel/field.h"

namespace interstice::voxel {

/// Values at voxel centres, no interpolation. `j` is the faster axis for a slice; a line has rows == 1.
struct Samples {
  int normal_axis = -1;              // slice: the axis it is normal to; line: -1
  std::array<int, 2> axes{0, 0};     // slice: the two axes in the plane (row axis, column axis); line: both its axis
  std::int64_t rows = 0, columns = 0;
  std::vector<Vec3d> center;         // [m], rows * columns
  std::vector<double> void_fraction, solid_fraction, mass_density;  // mass_density [kg/m^3], empty where unknown
  std::vector<double> void_fraction_averaged;                       // empty unless the field has it
};

/// The plane of voxels that holds the coordinate `at` [m] on `axis`. Throws InputError when outside the lattice.
Samples sample_slice(const Field& field, int axis, double at);

/// The row of voxels along `axis` through `at` [m] (its component on `axis` is ignored).
Samples sample_line(const Field& field, int axis, const Vec3d& at);

}  // namespace interstice::voxel
