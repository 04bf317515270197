// series.csv: one row per sample, growing while the run goes on. Definitions of the columns: docs/FILES.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupling/scene/scene.h"
#include "coupling/stream/growing_table.h"
#include "dem/simulation.h"

namespace interstice::stream {

class Series {
 public:
  /// A new file, or (keep_until given) the present one without the rows later than that time [s].
  Series(const std::filesystem::path& path, const scene::Scene& scene, std::optional<double> keep_until);

  /// Appends the present numbers. Throws RunError when the row cannot be written.
  void sample(const dem::Simulation& simulation);

 private:
  std::vector<std::size_t> watched_;  // walls
  bool energies_, sleeping_;          // are there columns of energies, of grains asleep?
  GrowingTable table_;
};

}  // namespace interstice::stream
