// What a run remembers beside its grains, and its checkpoint.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "coupling/stream/build_model.h"
#include "coupling/stream/run.h"
#include "dem/simulation.h"

namespace interstice::stream {

struct RunState {
  std::size_t phase = 0;
  std::int64_t phase_start = 0;            // step
  std::int64_t quiet_since = -1;           // step since which the grains have been at rest; -1: they move
  std::vector<std::int64_t> field_frames;  // frames made of each field
  std::vector<PhaseSpan> spans;            // phases so far; the last one is open
  double particle_steps = 0;
  double step_seconds = 0, wall_seconds = 0;  // of earlier sessions of this run
};

/// `fingerprint` is the resolved scene: a checkpoint continues the very scene that made it.
void write_checkpoint(const std::filesystem::path& path, const dem::Simulation& simulation,
                      const std::vector<PhasedRain>& rains, const RunState& state,
                      const std::string& fingerprint);

/// Throws InputError when the file is missing, damaged, or of another scene.
void read_checkpoint(const std::filesystem::path& path, dem::Simulation& simulation,
                     std::vector<PhasedRain>& rains, RunState& state, const std::string& fingerprint);

}  // namespace interstice::stream
