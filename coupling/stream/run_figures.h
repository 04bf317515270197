// The figures of one run, named after the phase that they close.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/io/field_files.h"
#include "coupling/io/particle_frame.h"
#include "coupling/scene/scene.h"
#include "coupling/stream/run.h"

namespace interstice::stream {

/// The grains from above and from the side, by diameter and by speed.
void draw_grains(const scene::Scene& scene, const std::filesystem::path& folder,
                 const io::ParticleFrame& frame, const std::string& phase);

/// Slices (per voxel, and averaged where the field is) and lines.
void draw_field(const scene::Field& field, const std::filesystem::path& folder,
                const io::FieldFilesResult& files, const io::ParticleFrame& frame, const std::string& phase);

/// Forces between grains and on each watched wall, from series.csv; the layer over time from the fields'
/// tables.
void draw_series(const scene::Scene& scene, const std::filesystem::path& folder,
                 const std::vector<PhaseSpan>& phases);

}  // namespace interstice::stream
