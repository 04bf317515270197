#include "voxel/lattice.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/error.h"
#include "voxel/text.h"

namespace interstice::voxel {

namespace {

// OpenVDB coordinates are 32-bit; the last whole leaf must fit as well.
constexpr double kMaxCells = 2147483648.0 - 16.0;
constexpr double kMaxCellsInAll = 0x1p62;

std::string axis_name(int axis) { return std::string(1, "xyz"[axis]); }

// The number of cells that cover `length`. A length that is a multiple of the edge up to the rounding of its
// inputs (say 18 mm in 1 mm voxels) must not gain a cell for it.
double cells_over(double length, double voxel) {
  const double quotient = length / voxel;
  const double nearest = std::round(quotient);
  if (nearest >= 1 && std::abs(quotient - nearest) <= 1e-9 * nearest) return nearest;
  return std::max(1.0, std::ceil(quotient));
}

}  // namespace

Lattice cubic_lattice(const Box& box, double voxel) {
  if (!(std::isfinite(voxel) && voxel > 0))
    throw InputError("voxel edge is " + shown(voxel) + " m; it must be finite and positive");
  Lattice lattice{box.lo, {voxel, voxel, voxel}, {0, 0, 0}};
  for (int axis = 0; axis < 3; ++axis) {
    const double length = box.hi[axis] - box.lo[axis];
    if (!(std::isfinite(box.lo[axis]) && std::isfinite(box.hi[axis]) && length > 0))
      throw InputError("the box is empty or not finite along " + axis_name(axis) + "; give lo < hi");
    const double n = cells_over(length, voxel);
    if (n > kMaxCells)
      throw InputError("more than 2^31 voxels along " + axis_name(axis) +
                       "; choose a larger voxel or a smaller box");
    lattice.n[axis] = static_cast<std::int64_t>(n);
  }
  check_lattice(lattice);
  return lattice;
}

void check_lattice(const Lattice& lattice) {
  double cells = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(std::isfinite(lattice.h[axis]) && lattice.h[axis] > 0) || !std::isfinite(lattice.lo[axis]))
      throw InputError("the lattice's cells are not finite and positive along " + axis_name(axis));
    const double n = static_cast<double>(lattice.n[axis]);
    if (n < 1 || n > kMaxCells)
      throw InputError("the lattice has " + std::to_string(lattice.n[axis]) + " cells along " +
                       axis_name(axis) + "; 1 to 2^31 - 16 are possible");
    cells *= n;
  }
  if (cells > kMaxCellsInAll)
    throw InputError("the lattice has more than 2^62 cells; choose a larger voxel or a smaller box");
}

std::int64_t cell_along(const Lattice& lattice, int axis, double at) {
  const std::int64_t n = lattice.n[axis];
  const double quotient = (at - lattice.lo[axis]) / lattice.h[axis], nearest = std::round(quotient);
  // A coordinate that was meant to be a face is one, however its last bit was rounded.
  const double cells = std::abs(quotient - nearest) <= 1e-9 ? nearest : quotient;
  if (!(cells >= 0 && cells <= static_cast<double>(n)))
    throw InputError(axis_name(axis) + " = " + shown(at) + " m is outside the field, which spans " +
                     shown(lattice.lo[axis]) + " to " + shown(lattice.box().hi[axis]) + " m");
  return std::min(floor_index(cells), n - 1);
}

}  // namespace interstice::voxel
