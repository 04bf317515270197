// The files of one computed field: grids for OpenVDB and ParaView, slices, lines and layer tables as CSV, and
// a summary. Used by `voids` and by `run`. Every file appears under its name only when whole.
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "coupling/scene/scene.h"
#include "voxel/field.h"
#include "voxel/layer.h"
#include "voxel/sample.h"
#include "voxel/scales.h"

namespace interstice::io {

struct FieldFilesRequest {
  // What the field was computed from, for metadata and the summary.
  voxel::FieldRequest computed;
  Box box;                  // as asked for; the lattice may reach beyond it
  std::string source;       // the file or scene it comes from
  std::string kind;         // of the source, as the reader calls it
  std::int64_t frame = -1;  // number in its source; -1: the source has no frames
  std::int64_t step = -1;
  double time = std::numeric_limits<double>::quiet_NaN();  // [s]
  double seconds = 0;                                      // what computing the field took
  std::string version;                                     // of this program
  std::vector<std::string> walls;                          // names of the solids around the grains

  // What to write, and where.
  std::string stem = "fields";  // STEM.vdb and STEM.vti, straight in the folder
  std::string tables;           // folder inside the folder for all else; empty: the folder itself
  bool vdb = true;
  bool vti = true;
  std::int64_t vti_most_cells = std::int64_t{64} << 20;  // larger lattices get no .vti
  std::vector<scene::Slice> slices;
  std::vector<scene::Line> lines;
  std::optional<voxel::LayerRequest> layers;
  bool scales = false;  // void fraction against averaging length
};

struct FieldFilesResult {
  std::vector<std::filesystem::path> written;
  std::vector<std::string> messages;   // what was left out and why, one line each
  std::vector<voxel::Samples> slices;  // in the order of the request, for figures
  std::vector<voxel::Samples> lines;
  std::optional<voxel::LayerColumns> layers;
  std::optional<voxel::ScaleReport> scales;
  nlohmann::ordered_json summary;  // what summary.json holds
};

/// Throws InputError for a slice, line or layer that the field does not hold (before anything is written),
/// and RunError for a file that cannot be written.
FieldFilesResult write_field_files(const std::filesystem::path& folder, const voxel::Field& field,
                                   const voxel::SpheresView& spheres, const voxel::Solids& solids,
                                   const FieldFilesRequest& request);

/// As `--method` takes it (voxel::method_name).
std::string name_of(const voxel::FieldRequest& computed);
/// "x=0.0045" and "y@x=0.009,z=3.5e-05": names of files, values in metres.
std::string name_of(const scene::Slice& slice);
std::string name_of(const scene::Line& line);

}  // namespace interstice::io
