#include "voxel/methods.h"

#include <algorithm>
#include <numbers>

namespace interstice::voxel {

void centre_fractions(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& block,
                      double* fractions) {
  std::fill_n(fractions, block.cells(), 0.0);
  std::int64_t at = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t i = sphere.cell[axis] - block.lo[axis];
    if (i < 0 || i >= block.size(axis)) return;
    at = at * block.size(axis) + i;
  }
  const double r = sphere.radius;
  fractions[at] = 4 * std::numbers::pi / 3 * ((r / lattice.h.x) * (r / lattice.h.y) * (r / lattice.h.z));
}

void subsample_fractions(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& block,
                         int points, double* fractions) {
  const double inverse = 1.0 / points, r = sphere.radius;
  // squared distance, in radii and along one axis, of point p of cell i
  const auto squared = [&](int axis, std::int64_t i, int p) {
    const double at = static_cast<double>(i - sphere.cell[axis]) + (p + 0.5) * inverse;
    const double d = (at * lattice.h[axis] - sphere.offset[axis]) / r;
    return d * d;
  };
  for (std::int64_t i = block.lo[0]; i < block.hi[0]; ++i)
    for (std::int64_t j = block.lo[1]; j < block.hi[1]; ++j)
      for (std::int64_t k = block.lo[2]; k < block.hi[2]; ++k) {
        std::int64_t inside = 0;
        if (touches(lattice, sphere, {{i, j, k}, {i + 1, j + 1, k + 1}}))
          for (int p = 0; p < points; ++p)
            for (int q = 0; q < points; ++q) {
              const double xy = squared(0, i, p) + squared(1, j, q);
              if (xy > 1) continue;
              for (int s = 0; s < points; ++s) inside += xy + squared(2, k, s) <= 1;
            }
        *fractions++ = static_cast<double>(inside) * (inverse * inverse * inverse);
      }
}

}  // namespace interstice::voxel
