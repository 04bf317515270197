// Triangle surfaces from STL files, ASCII or binary.
#pragma once

#include <filesystem>

#include "voxel/mesh.h"

namespace interstice::io {

/// Reads a closed surface whose coordinates are in units of `unit` [m]. A file is binary where its length is
/// what a binary header says, whatever it begins with; facets' normals, colours and names are not used, the
/// order of the corners says which side is out. Throws InputError that names the file, and the line where
/// there are lines: a file that cannot be read, is cut off or damaged, or a surface that is not closed
/// (voxel::closed_mesh).
voxel::TriangleMesh read_stl(const std::filesystem::path& path, double unit);

}  // namespace interstice::io
