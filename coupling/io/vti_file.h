// Fields as VTK image data (XML, appended, zlib), which ParaView opens; and .pvd series of them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "voxel/field.h"

namespace interstice::io {

/// Float32 cell data on the lattice: Origin its corner, Spacing its edge, one array per fraction and
/// quantity that the field has: velocity with 3 components, stress with 6 (xx yy zz xy yz xz, VTK's order); 0
/// where there is no solid (mass density follows from the solid fraction; it is in the .vdb). `time` [s] is
/// left out when not finite.
void write_vti(const std::filesystem::path& path, const voxel::Field& field, double time);

/// One file of a series, relative to the .pvd.
struct PvdEntry {
  double time = 0;  // [s]
  std::string file;
};

/// Adds an entry to the series at `path` (made when missing; an entry of the same file is replaced), in order
/// of time. The file is rewritten whole.
void append_to_pvd(const std::filesystem::path& path, const PvdEntry& entry);
void write_pvd(const std::filesystem::path& path, std::vector<PvdEntry> entries);
/// Entries of a series that write_pvd wrote; none when the file is missing.
std::vector<PvdEntry> read_pvd(const std::filesystem::path& path);

}  // namespace interstice::io
