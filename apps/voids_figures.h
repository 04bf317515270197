// Figures of one field: each slice and line that `voids` writes as CSV, drawn beside it.
#pragma once

#include <filesystem>
#include <string>

#include "coupling/io/field_files.h"
#include "coupling/io/particle_frame.h"

namespace interstice::apps {

/// Draws into folder/slices and folder/lines. Returns a line saying why a figure is missing; empty when all
/// are there.
std::string draw_voids(const std::filesystem::path& folder, const io::FieldFilesRequest& request,
                       const io::FieldFilesResult& result, const io::ParticleFrame& frame);

}  // namespace interstice::apps
