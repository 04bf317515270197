// HDF5 over a GuardedFile: whatever the library writes takes effect at GuardedFile::commit(), or never.
#pragma once

#include <filesystem>
#include <functional>

#include "coupling/io/guarded_file.h"
#include "coupling/io/hdf5_handles.h"

namespace interstice::io {

/// File access in the oldest format whose bytes go through `file`, which must outlive the HDF5 file opened
/// with it.
Hdf5Handle guarded_access(GuardedFile& file);

/// Opens (or, where `guarded` is new, creates) the HDF5 file, runs write(file), closes and commits.
/// Throws RunError for what HDF5 refuses, std::system_error for what the disk refuses.
void write_guarded(const std::filesystem::path& path, GuardedFile& guarded,
                   const std::function<void(hid_t file)>& write);

}  // namespace interstice::io
