// OpenVDB files that are whole or not there: openvdb::io::File looks at no result of a write, and leaves half
// a file under its name when the disk is full.
#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>

namespace interstice::io {

/// Writes the grids as openvdb::io::File would, aside first (atomic_file.h). Throws RunError when that fails.
void write_grids(const std::filesystem::path& path, const openvdb::GridCPtrVec& grids,
                 const openvdb::MetaMap& metadata);

}  // namespace interstice::io
