// Maps of what a field holds beside void fraction: one figure a slice and quantity, with its unit.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/figures/formats.h"
#include "coupling/io/particle_frame.h"
#include "voxel/sample.h"

namespace interstice::figures {

struct QuantitySlice {
  std::string stem;   // of the file: "x=0.0045"
  std::string place;  // in the title: "x = 4.5 mm, t = 3 ms"
  const voxel::Samples* samples = nullptr;
};

struct QuantitySlices {
  std::vector<QuantitySlice> slices;
  std::string voxel_name, averaged_name;  // "per voxel of 17 um", "averaged over 120 um"
  std::string note;                       // printed small: voxel, averaging length, method
  std::vector<io::WallPose> walls;
  voxel::Solids solids = {};  // further ones
};

/// FOLDER/STEM-velocity.png and so on, a file for each slice and quantity that its samples hold. All slices
/// of one quantity share a colour range: what all but the 0.5 % of voxels with the largest magnitudes need,
/// so that single voxels do not take the colours of all others; the note says where it ends before the
/// largest. Voxels without a value stay blank. Throws as write_slices does.
void write_quantity_slices(const std::filesystem::path& folder, const QuantitySlices& figures,
                           const Formats& formats = {});

}  // namespace interstice::figures
