// Figures of one field: each slice and line that `voids` writes as CSV, drawn beside it, and the histogram of
// its void fraction.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/figures/formats.h"
#include "coupling/io/field_files.h"
#include "coupling/io/particle_frame.h"
#include "coupling/studies/void_histogram.h"

namespace interstice::apps {

struct VoidsFigures {
  const io::FieldFilesRequest& request;
  const io::FieldFilesResult& result;
  const studies::VoidHistogram& histogram;
  const io::ParticleFrame& frame;
  const voxel::Solids& solids;  // besides the frame's walls
  figures::Formats formats;
  std::vector<double> contours;  // levels on slices of the averaged field
};

/// Draws into folder/slices, folder/lines and folder. Returns a line saying why a figure is missing; empty
/// when all are there.
std::string draw_voids(const std::filesystem::path& folder, const VoidsFigures& figures);

/// "voxel 17.3 µm, exact, averaged over 120 µm": what every figure of a field says at its foot.
std::string note_of(const io::FieldFilesRequest& request);

}  // namespace interstice::apps
