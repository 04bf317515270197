// Void-fraction fields of spheres on a cubic lattice, as sparse OpenVDB grids.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "base/averaging_window.h"
#include "voxel/float_grid.h"
#include "voxel/lattice.h"
#include "voxel/precision.h"
#include "voxel/quantities.h"
#include "voxel/solids.h"
#include "voxel/spheres.h"

namespace interstice::voxel {

enum class Method { exact, centre, subsample, divided, kernel };

/// How places count that several spheres share: once for each, or once (union_overlaps.h).
enum class Overlap { sum, united };

struct FieldRequest {
  Lattice lattice;
  std::array<bool, 3> periodic{false, false, false};  // images of grains across the lattice box's faces
  Method method = Method::exact;
  int subsample = 0;      // points per voxel edge, for Method::subsample
  double least_void = 0;  // Method::divided: solid that would leave less void than this share of what walls
                          // leave of a voxel is deleted, as CFD couplings do; 0: kept
  double kernel_length = 0;  // [m] how far Method::kernel reaches from a centre along each axis
  Overlap overlap = Overlap::sum;
  Precision precision = Precision::real64;  // of Method::exact; the others work in double
  double average_length = 0;                // [m] as averaging_window.h reads it; 0: no averaged grids
  WindowShape average_window = WindowShape::box;
  double density = 0;  // [kg/m^3] used where spheres carry none; 0: no mass density
  QuantityRequest quantities;
};

/// Sums taken in double before anything is rounded to a grid's floats.
struct FieldSums {
  std::int64_t particles = 0;         // spheres that touch the box
  double solid_volume_particles = 0;  // [m^3] the spheres' volume inside the box, sphere by sphere
  double solid_volume_field = 0;      // [m^3] summed over voxels
  double available_volume = 0;        // [m^3] box minus walls
  double mass = 0;                    // [kg] inside the box
  double void_min = 0, void_max = 0;  // over all voxels
  std::int64_t negative_voxels = 0;   // voxels with void fraction < negative_below()
  double written_solid_volume = 0;    // [m^3] summed over the float grid
  double overlap_volume = 0;          // [m^3] taken off where spheres overlap, for Overlap::united
  double deleted_volume = 0;          // [m^3] deleted by FieldRequest::least_void
};

/// A computed field. `void_fraction = available - solid`, per cell volume. Grids have their origin voxel
/// (0,0,0) at the lattice's first cell and their integer indices at voxel centres; solid background 0, void
/// background 1. Active are: in the solid and mass grids voxels with solid, in the void grid voxels with
/// solid or wall, in the available grid voxels with wall (blocks that one wall fills are tiles there), in
/// averaged grids voxels whose average is not zero.
///
/// Quantities have values in voxels with solid. Their averages follow from sums over the same window: means
/// over solid are sums of what solid brings over the sum of solid, those per volume are over what is
/// available, as the solid fraction is; a temperature is then about the mean velocity of the window.
///
/// Averages are taken over a window centred on each voxel: sum of solid / sum of available, with voxels that
/// the window's surface cuts counted in part (average.h). Only what the window holds of the box and outside
/// walls counts, so at an edge that is not periodic it is cut off there; across a periodic edge it goes on at
/// the other side. A voxel inside a wall gets the average over what its window reaches outside the wall;
/// where the window reaches nothing that is available, the grids keep their background.
struct Field {
  Lattice lattice;
  FieldSums sums;
  FloatGridPtr solid_fraction;
  FloatGridPtr void_fraction;
  FloatGridPtr available_fraction;       // null without walls (then 1 everywhere)
  FloatGridPtr mass_density;             // [kg/m^3]; null where no density is known
  FloatGridPtr solid_fraction_averaged;  // sum of solid / sum of available; null unless asked for
  FloatGridPtr void_fraction_averaged;   // 1 - solid_fraction_averaged
  std::vector<QuantityGrid> quantities;  // as asked for: components one after the other
};

/// Computes the fields asked for. Same bits for any number of threads; a voxel's bits depend only on the
/// spheres that touch it (averages: up to rounding). Throws InputError on spheres that are not finite
/// and positive, cells that are not cubic, quantities whose columns are missing, or averages that would take
/// more than 4 GiB.
Field compute_field(const SpheresView& spheres, const Solids& solids, const FieldRequest& request);

}  // namespace interstice::voxel
