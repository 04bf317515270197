// Compiled once per instruction set: foreach_target.h includes this file again for each.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "voxel/small_spheres.cpp"
#include <hwy/foreach_target.h>
// The line above must come first.
#include <hwy/highway.h>

#include "voxel/small_spheres.h"
#include "voxel/small_spheres_kernel.h"

#if HWY_ONCE
#include <algorithm>

namespace interstice::voxel {

HWY_EXPORT(add_spheres);
HWY_EXPORT(add_block);
HWY_EXPORT(target_name);

void CellRows::reset(const CellRange& cells, int channels) {
  cells_ = cells;
  stride_ = cells.size(2) + 2 * kRoom;
  plane_ = cells.size(0) * cells.size(1) * stride_;
  values_.assign(static_cast<std::size_t>(plane_ * channels), 0.0);
}

void add_small_spheres(const Lattice& lattice, const SmallSphere* spheres, std::size_t count,
                       Precision precision, const Channels& channels, CellRows& rows) {
  HWY_DYNAMIC_DISPATCH(add_spheres)(lattice, spheres, count, precision, channels, rows);
}

void add_shares(const double* shares, const CellRange& block, std::size_t sphere, const Channels& channels,
                CellRows& rows) {
  HWY_DYNAMIC_DISPATCH(add_block)(shares, block, sphere, channels, rows);
}

const char* small_spheres_target() { return HWY_DYNAMIC_DISPATCH(target_name)(); }

}  // namespace interstice::voxel
#endif
