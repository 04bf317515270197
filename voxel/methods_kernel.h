// The kernel method: a sphere's volume spread smoothly around its centre, whatever the voxels' size.
//
// The kernel is a product of one bump an axis,
//
//   k(u) = 15/16 (1 - u^2)^2 / L,  u = distance along the axis / L, for |u| < 1,
//
// so that a cell's weight, the kernel's integral over the cell, is a product of differences of a polynomial.
// Weights count as far as the cell is free of walls, and are divided by their sum over the lattice: what of
// the sphere lies in the box is kept, to rounding, also beside walls and at the box's ends.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "voxel/field.h"
#include "voxel/overlap.h"
#include "voxel/walls.h"

namespace interstice::voxel {

/// The walls' shares of all cells of the blocks that a wall fills in part, found once.
class WallShares {
 public:
  WallShares(const Solids& local, const Lattice& lattice, const std::vector<WallBlock>& blocks);

  /// What walls leave of a cell inside the lattice, 0 to 1.
  double available(std::int64_t i, std::int64_t j, std::int64_t k) const;
  bool none() const { return found_.empty(); }

 private:
  static constexpr std::size_t kFull = static_cast<std::size_t>(-1);
  BlockGrid grid_;
  std::unordered_map<std::uint64_t, std::size_t> found_;  // block: its first cell below
  std::vector<double> shares_;
};

struct KernelSpread {
  double length = 0;  // [m]
  WallShares walls;
  std::vector<double> reach;  // [m] per sphere: a ball of this radius holds all cells that it counts in
  std::vector<double> scale;  // per sphere: its volume in the box, in cells, over the sum of its weights;
                              // 0 where no weight is free: such a sphere counts where it is, exactly
};

/// Of spheres that check_spheres let pass. `inside` [m^3]: each sphere's volume in the box, images and all.
KernelSpread kernel_spread(const SpheresView& spheres, const std::vector<double>& inside,
                           const FieldRequest& request, const Solids& local,
                           const std::vector<WallBlock>& walls);

/// The cells that the kernel reaches, not clipped to any lattice.
CellRange kernel_cells(const Lattice& lattice, const PlacedSphere& sphere, double length);

/// Writes each cell's share of the sphere, in exact_fractions' order.
void kernel_fractions(const Lattice& lattice, const PlacedSphere& sphere, const KernelSpread& spread,
                      double scale, const CellRange& block, double* fractions);

}  // namespace interstice::voxel
