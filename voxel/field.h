// Void-fraction fields of spheres on a cubic lattice, as sparse OpenVDB grids.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include "voxel/lattice.h"
#include "voxel/solids.h"
#include "voxel/spheres.h"

#include <openvdb/openvdb.h>

namespace interstice::voxel {

enum class Method { exact, centre, subsample };

struct FieldRequest {
  Lattice lattice;
  std::array<bool, 3> periodic{false, false, false};  // images of grains across the lattice box's faces
  Method method = Method::exact;
  int subsample = 0;                                  // points per voxel edge, for Method::subsample
  double average_length = 0;                          // edge of the averaging cube [m]; 0: no averaged grids
  double density = 0;                                 // [kg/m^3] used where spheres carry none; 0: no mass density
};

/// Sums taken in double before anything is rounded to a grid's floats.
struct FieldSums {
  std::int64_t particles = 0;           // spheres that touch the box
  double solid_volume_particles = 0;    // [m^3] the spheres' volume inside the box, sphere by sphere
  double solid_volume_field = 0;        // [m^3] summed over voxels
  double available_volume = 0;          // [m^3] box minus walls
  double mass = 0;                      // [kg] inside the box
  double void_min = 0, void_max = 0;    // over all voxels
  std::int64_t negative_voxels = 0;     // voxels with void fraction < -1e-12
  double written_solid_volume = 0;      // [m^3] summed over the float grid
};

/// A computed field. `void_fraction = available - solid`, per cell volume. Grids have their origin voxel (0,0,0) at
/// the lattice's first cell and their integer indices at voxel centres; solid background 0, void background 1.
struct Field {
  Lattice lattice;
  FieldSums sums;
  openvdb::FloatGrid::Ptr solid_fraction;
  openvdb::FloatGrid::Ptr void_fraction;
  openvdb::FloatGrid::Ptr available_fraction;       // null without walls (then 1 everywhere)
  openvdb::FloatGrid::Ptr mass_density;             // [kg/m^3]; null where no density is known
  openvdb::FloatGrid::Ptr solid_fraction_averaged;  // null unless asked for
  openvdb::FloatGrid::Ptr void_fraction_averaged;   // solid averaged over what is available: 1 - solid/available
};

/// Computes the fields asked for. Same bits for any number of threads. Throws InputError on non-finite spheres.
Field compute_field(const SpheresView& spheres, const Solids& solids, const FieldRequest& request);

}  // namespace interstice::voxel
