#include "coupling/studies/bed_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "coupling/studies/table.h"

namespace interstice::studies {
namespace {

constexpr std::int64_t most_slabs = 20000;
constexpr double clearly_longer =
    1.5;  // so that a bed that is about square does not turn from frame to frame

}  // namespace

BedProfile bed_profile(const voxel::SpheresView& spheres, const voxel::Solids& solids,
                       const io::FieldFilesRequest& request) {
  const auto& lattice = request.computed.lattice;
  voxel::LayerRequest layer;
  layer.box = lattice.box();
  if (request.layers) layer.box = request.layers->box;
  layer.periodic = request.computed.periodic;
  BedProfile profile;
  const Vec3d size = layer.box.size();
  profile.axis = size.y > clearly_longer * size.x ? 1 : 0;
  const int along = profile.axis;
  layer.box.lo[along] = lattice.box().lo[along];
  layer.box.hi[along] = lattice.box().hi[along];
  layer.columns = {1, 1};
  layer.columns[static_cast<std::size_t>(along)] =
      std::min(lattice.n[static_cast<std::size_t>(along)], most_slabs);
  const auto columns = voxel::layer_columns(spheres, solids, layer);
  profile.at = along == 0 ? columns.x : columns.y;
  for (std::size_t i = 0; i < profile.at.size(); ++i) {
    const double solid = columns.available_volume[i] > 0 ? columns.solid_fraction[i] : NAN;
    profile.solid_fraction.push_back(solid);
    profile.void_fraction.push_back(1 - solid);
  }
  return profile;
}

std::string csv_of(const BedProfile& profile) {
  std::string text = fmt::format("{}_m,void_fraction,solid_fraction\n", "xy"[profile.axis]);
  for (std::size_t i = 0; i < profile.at.size(); ++i) {
    text += fmt::format("{},{},{}\n", profile.at[i], profile.void_fraction[i], profile.solid_fraction[i]);
  }
  return text;
}

BedProfile read_bed_profile(const std::filesystem::path& path) {
  const Table table = read_table(path);
  BedProfile profile;
  profile.axis = table.has("x_m") ? 0 : 1;
  profile.at = table.numbers(profile.axis == 0 ? "x_m" : "y_m");
  profile.void_fraction = table.numbers("void_fraction");
  profile.solid_fraction = table.numbers("solid_fraction");
  if (profile.at.empty()) {
    throw InputError(path.string() + ": no rows; a row per slab is due; compute the frame again");
  }
  return profile;
}

}  // namespace interstice::studies
