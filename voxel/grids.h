// The OpenVDB side of a field: grids with their transform and metadata, and leaves put into their trees.
#pragma once

#include <openvdb/openvdb.h>

#include <string>
#include <vector>

#include "voxel/accumulate.h"

namespace interstice::voxel {

/// An empty grid on the lattice: integer indices at voxel centres. Metadata: name, units, box, voxel, method,
/// version.
openvdb::FloatGrid::Ptr new_grid(const FieldRequest& request, const std::string& name,
                                 const std::string& units, float background);

/// Moves the blocks' leaves into the field's grids, which this creates; quantities in the channels' order.
void fill_grids(const FieldRequest& request, bool walls, const Channels& channels,
                std::vector<BlockResult>& blocks, Field& field);

/// Creates the averaged grids from finished averages: active where the average is not zero. Of quantities
/// that are means over solid, where solid is more than 1e-9 of the window.
void fill_averaged_grids(const FieldRequest& request, const Channels& channels, const DenseParts& averages,
                         Field& field);

}  // namespace interstice::voxel
