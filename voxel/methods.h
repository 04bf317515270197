// How the share of a cell that a sphere fills is found: exactly, or cheaper. All methods share one signature,
// that of exact_fractions, and one loop, that of accumulate.h. docs/METHODS.md says what each costs and errs.
#pragma once

#include <string>

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

/// The points of the "divided" model, relative to the centre and in radii: the centre, then 14 at each of two
/// distances.
inline constexpr int kDividedPoints = 29;
const std::array<Vec3d, kDividedPoints>& divided_points();

/// The "divided" model of CFD couplings (C. Goniva et al., Particuology 10, 2012, 582; the points as
/// CFDEMcoupling publishes them): each point carries 1/29 of the sphere to the cell that holds it. A point
/// outside the lattice gives its part to the centre's cell; a sphere whose centre is outside gives nothing.
/// Neither holds across periodic faces, where images are found.
void divided_fractions(const Lattice& lattice, const PlacedSphere& sphere,
                       const std::array<bool, 3>& periodic, const CellRange& block, double* fractions);

/// The method that the request names; not for Method::kernel, which looks beyond the sphere
/// (methods_kernel.h).
void method_fractions(const FieldRequest& request, const PlacedSphere& sphere, const CellRange& block,
                      double* fractions);

/// "exact", "centre", "subsample:4", "divided", "divided:0.1", "kernel:6e-05m": what the command's --method
/// takes.
std::string method_name(const FieldRequest& request);

/// Throws InputError on a request whose method has impossible numbers, or does not go with union overlaps.
void check_method(const FieldRequest& request);

}  // namespace interstice::voxel
