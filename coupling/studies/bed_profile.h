// Void fraction along the bed: averaged over the whole box, or over the layer where one is given, in slabs
// one voxel thick. Straight from the spheres (exact volumes), so it depends on no method.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/io/field_files.h"

namespace interstice::studies {

constexpr const char* kBedProfileFile = "profile_bed.csv";

/// `axis` is x, or y in boxes that are clearly longer in y. Fractions are of the volume that walls leave
/// free; NaN where they leave none.
struct BedProfile {
  int axis = 0;
  std::vector<double> at;  // [m] the slabs' centres, equally spaced
  std::vector<double> void_fraction, solid_fraction;
};

BedProfile bed_profile(const voxel::SpheresView& spheres, const voxel::Solids& solids,
                       const io::FieldFilesRequest& request);

/// x_m (or y_m), void_fraction, solid_fraction.
std::string csv_of(const BedProfile& profile);
/// Throws InputError for a file that is no such table.
BedProfile read_bed_profile(const std::filesystem::path& path);

}  // namespace interstice::studies
