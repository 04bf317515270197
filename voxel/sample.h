// Reading a field out: planes of voxels, rows of voxels.
#pragma once

#include <string>
#include <vector>

#include "voxel/field.h"

namespace interstice::voxel {

/// A quantity of field.h at the same voxels, NaN where it has no value.
struct SampledQuantity {
  std::string name, units;               // "velocity_x", "m/s"
  std::vector<double> values, averaged;  // averaged: empty unless the field has it
};

/// Values at voxel centres, no interpolation. `j` is the faster axis for a slice; a line has rows == 1.
struct Samples {
  int normal_axis = -1;           // slice: the axis it is normal to; line: -1
  std::array<int, 2> axes{0, 0};  // slice: the plane's row axis and column axis; line: twice its own axis
  std::int64_t rows = 0, columns = 0;
  std::vector<Vec3d> center;  // [m], rows * columns
  std::vector<double> void_fraction, solid_fraction;
  std::vector<double> available_fraction;      // what walls leave of each voxel; empty without walls
  std::vector<double> mass_density;            // [kg/m^3], empty where unknown
  std::vector<double> void_fraction_averaged;  // empty unless the field has it
  std::vector<SampledQuantity> quantities;     // in the field's order
};

/// The plane of voxels that holds the coordinate `at` [m] on `axis`. A coordinate on a face between two
/// voxels belongs to the upper one, the lattice's own upper face to its last. Throws InputError when outside.
Samples sample_slice(const Field& field, int axis, double at);

/// The row of voxels along `axis` through `at` [m] (its component on `axis` is ignored). Throws InputError as
/// above.
Samples sample_line(const Field& field, int axis, const Vec3d& at);

/// `values` of the samples with NaN where walls leave nothing of the voxel: there is neither powder nor void.
std::vector<double> outside_walls(const Samples& samples, std::vector<double> values);
/// The void fraction with NaN where walls take any part of the voxel: what is missing there is no powder.
std::vector<double> clear_of_walls(const Samples& samples);

}  // namespace interstice::voxel
