// Fields as an OpenVDB file.
#pragma once

#include <filesystem>

#include "coupling/io/field_files.h"

namespace interstice::io {

/// All grids of the field, compressed, with metadata on the file and on each grid: box, voxel [m], method,
/// source, units, version, and where there are any time [s] and average [m].
void write_vdb(const std::filesystem::path& path, const voxel::Field& field,
               const FieldFilesRequest& request);

}  // namespace interstice::io
