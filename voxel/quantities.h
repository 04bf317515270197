// What a field holds beside volume fractions, each only where it is asked for: sums over spheres of their
// shares of a voxel times a number that each sphere carries, and what follows from such sums. docs/METHODS.md
// defines each.
#pragma once

#include <string>
#include <vector>

#include "voxel/float_grid.h"
#include "voxel/spheres.h"

namespace interstice::voxel {

struct QuantityRequest {
  bool velocity = false;            // mean over the solid [m/s]
  bool temperature = false;         // granular temperature, with the velocity that it is about [m^2/s^2]
  bool diameter = false;            // mean over the solid [m]
  bool coordination = false;        // mean over the solid
  bool stress = false;              // contact stress and its pressure, per volume of the voxel [Pa]
  bool bonded = false;              // share of the solid, and a mask
  std::vector<std::string> groups;  // names of the classes that SpheresView::group counts: a fraction each

  /// How many grids they make.
  std::size_t grids() const {
    return (velocity || temperature ? 3U : 0U) + temperature + diameter + coordination + (stress ? 7U : 0U) +
           (bonded ? 2U : 0U) + groups.size();
  }
};

/// One number a voxel. A mean over solid has no value in voxels without any: they are not active.
struct QuantityGrid {
  std::string name;       // "velocity", "solid_fraction_size_20um_40um"
  std::string component;  // "x", "xy"; empty: the quantity is one number
  std::string units;      // "m/s"; "1": none
  bool per_solid = true;  // a mean over the solid; else per volume of the voxel, as the solid fraction is
  FloatGridPtr grid;
  FloatGridPtr averaged;  // over the averaging length; null unless asked for
  double integral = 0;    // over the solid in the box, or over the box [its units times m^3]
  double mean = 0;        // integral / volume of solid, or / volume that walls leave; NaN where that is 0

  std::string full_name() const { return component.empty() ? name : name + "_" + component; }
};

/// Throws InputError naming the columns that a quantity needs and `spheres` lacks, or a sphere whose number
/// is not finite.
void check_quantities(const SpheresView& spheres, const QuantityRequest& request);

}  // namespace interstice::voxel
