// How the share of a cell that a sphere fills is found: exactly, or cheaper. All methods share one signature,
// that of exact_fractions, and one loop, that of accumulate.h.
#pragma once

#include "voxel/field.h"
#include "voxel/overlap.h"

namespace interstice::voxel {

/// The whole sphere counts in the cell that holds its centre; nothing where that is outside the lattice. A
/// cell smaller than the sphere gets shares above 1: with cells of 0.4 sphere diameters the RMS error is
/// about 2 (200 %).
void centre_fractions(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& block,
                      double* fractions);

/// The share of `points`^3 evenly spaced points of the cell, half a spacing off its faces, that are in the
/// sphere. RMS error in a packed bed: 0.02 at 4 points and cells of 0.4 diameters, 0.005 at 8 points.
void subsample_fractions(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& block,
                         int points, double* fractions);

/// The method that the request names.
inline void method_fractions(const FieldRequest& request, const PlacedSphere& sphere, const CellRange& block,
                             double* fractions) {
  switch (request.method) {
    case Method::exact:
      return exact_fractions(request.lattice, sphere, block, fractions);
    case Method::centre:
      return centre_fractions(request.lattice, sphere, block, fractions);
    case Method::subsample:
      return subsample_fractions(request.lattice, sphere, block, request.subsample, fractions);
  }
}

}  // namespace interstice::voxel
