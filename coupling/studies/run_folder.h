// A folder that `interstice run` wrote, or `voids` of one frame, as far as comparing it needs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupling/studies/table.h"

namespace interstice::studies {

struct PhaseSpan {
  std::string name;
  double start = 0, end = 0;  // [s]
};

/// One moment of a field.
struct FieldMoment {
  std::size_t row = 0;           // in FieldRecord::numbers
  double time = 0;               // [s]; NaN where the particle file says none
  std::string phase;             // empty: of `voids`
  std::filesystem::path folder;  // fields/NAME_000012: slices, lines, profiles
  std::filesystem::path vdb;     // fields/NAME_000012.vdb; of `voids` fields.vdb
};

struct FieldRecord {
  std::string name;
  Table numbers;                     // fields/NAME.csv; of `voids` those of summary.json
  std::vector<FieldMoment> moments;  // one per row, in order of time
};

/// What `voids` wrote is one field, `fields`, at one moment: no phases, no series.
struct RunFolder {
  std::filesystem::path path;
  bool simulated = true;  // by `run`
  std::string title;
  std::string exit_reason;
  std::vector<PhaseSpan> phases;
  std::optional<double> grains_inserted, grains_lost;
  Table series;
  std::vector<FieldRecord> fields;

  const PhaseSpan* phase(std::string_view name) const;
  const FieldRecord* field(std::string_view name) const;
  /// Names of the watched walls: those of columns NAME_normal_force_N.
  std::vector<std::string> watched_walls() const;
};

/// Of `voids` either the frame's folder or the one above, where it holds one frame only. Throws InputError
/// naming the file that is missing or wrong.
RunFolder read_run_folder(const std::filesystem::path& path);

/// The CSV files of a folder, by name without extension and in order; none where there is no such folder.
std::vector<std::string> tables_in(const std::filesystem::path& folder);

}  // namespace interstice::studies
