// What the field thread does with a snapshot: fields, their files, a row in the field's table, and at the end
// of a phase its figures.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/stream/field_stream.h"
#include "coupling/stream/growing_table.h"
#include "coupling/stream/run.h"

namespace interstice::stream {

class FieldOutput {
 public:
  /// With `keep_until` [s] the tables of an earlier session go on, without their later rows.
  FieldOutput(const scene::Scene& scene, std::filesystem::path folder, bool figures,
              std::optional<double> keep_until);

  /// Throws RunError when a file cannot be written, InputError when a slice lies outside its field.
  void write(const Snapshot& snapshot);

  /// After the last snapshot: the figures of the series.
  void finish(const std::vector<PhaseSpan>& phases);

 private:
  void write_field(const Snapshot& snapshot, const Snapshot::Due& due);

  const scene::Scene& scene_;
  std::filesystem::path folder_;
  bool figures_;
  std::vector<GrowingTable> tables_;  // one a field
};

}  // namespace interstice::stream
