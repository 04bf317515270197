// What a sum over spheres counts too often: places that several spheres share.
//
// Spheres that lie wholly inside another are left out altogether. Of the others, each pair that overlaps
// shares a lens, whose volume is known in closed form. A lens inside one cell is taken off that cell as it
// is; one that spans cells is integrated cell by cell (error of a cell below 5e-7 of its volume), and what is
// missing to the closed form (some 1e-9) goes to the cell with the largest part, so that the lens is exact in
// total. Where a third sphere reaches into a lens, the cells that it touches are integrated with all spheres
// at once (error below 1e-5 of a cell, for more than 16 spheres in one cell below 1e-3).
// What spheres bring into a cell beside their volume becomes less in proportion (accumulate.cpp).
//
// Cells without overlap are not mentioned, so their sums stay as they are.
#pragma once

#include <cstdint>
#include <vector>

#include "voxel/bins.h"

namespace interstice::voxel {

/// What to take off the sum in one cell.
struct CellOverlap {
  std::uint64_t region = 0;  // key of the region that the cell is in
  std::array<std::int64_t, 3> cell{0, 0, 0};
  double share = 0;  // of the cell
};

struct Overlaps {
  std::vector<std::uint8_t> hidden;  // per sphere: wholly inside another (of equal ones, all but the first)
  std::vector<CellOverlap> cells;    // ascending by region, then by cell
  double volume = 0;                 // [m^3] of what `cells` take off: closed forms where they are known
  std::int64_t pairs = 0,
               shared_by_many = 0;  // lenses in the lattice; cells where more than two spheres meet
};

/// `bins` are of the same spheres, by regions of `edge` cells. The same bits for any number of threads.
Overlaps find_overlaps(const SpheresView& spheres, const Lattice& lattice, const Bins& bins,
                       std::int64_t edge);

/// The entries of one region: [first, last).
struct OverlapRange {
  const CellOverlap* first = nullptr;
  const CellOverlap* last = nullptr;
};
OverlapRange overlaps_in(const Overlaps& overlaps, std::uint64_t region);

/// `bins` without hidden spheres.
void drop_hidden(const Overlaps& overlaps, Bins& bins);

}  // namespace interstice::voxel
