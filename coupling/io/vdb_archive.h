// OpenVDB files that are whole or not there: openvdb::io::File looks at no result of a write, and leaves half
// a file under its name when the disk is full.
#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>

namespace interstice::io {

/// Adds what OpenVDB says of a grid's extent (file_bbox_min, file_voxel_count and so on). That is a walk over
/// all active voxels, so it is copied from a grid before it that has the same ones.
void add_statistics(openvdb::GridBase& grid, const openvdb::GridCPtrVec& before);

/// Writes the grids, with the metadata they have and their values uncompressed, aside first (atomic_file.h).
/// Throws RunError when that fails.
void write_grids(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids,
                 const openvdb::MetaMap& metadata);

}  // namespace interstice::io
