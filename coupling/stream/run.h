// A scene from its first step to its last, with everything that is written on the way.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "coupling/scene/scene.h"

namespace interstice::stream {

struct Progress {
  double time = 0, end = 0;  // simulated, and when it ends at the latest [s]
  std::string phase;
  std::size_t grains = 0;
  double rate = 0;          // particle-steps per second since the last report
  double seconds_left = 0;  // wall clock, from the rate of simulated time
};

struct RunOptions {
  std::filesystem::path folder;
  bool resume = false;
  bool reference = false;  // serial loops, neighbours by brute force
  bool mixed = false;      // laws and forces in single precision
  bool figures = true;
  std::optional<double> until;       // stop at this time [s]
  std::optional<double> time_limit;  // wall clock [s]
  int threads = 1;                   // recorded in run.json
  std::string backend = "cpu", precision = "double", isa;
  const std::atomic<bool>* stop = nullptr;  // set by a signal
  std::function<void(const Progress&)> progress;
  std::function<void(const std::string&)> warn;
};

struct PhaseSpan {
  std::string name;
  double start = 0, end = 0;  // [s]
  std::string ended_by;       // "duration", "inserted and settled", "at_most"
};

struct RunResult {
  bool finished = false;    // false: stopped early, can be resumed
  std::string exit_reason;  // "finished", "signal", "time limit", "until"
  double time = 0;          // [s]
  std::int64_t steps = 0;
  std::int64_t grains = 0, grains_inserted = 0, grains_lost = 0;
  double wall_seconds = 0, step_seconds = 0, field_seconds = 0, field_wait_seconds = 0, file_seconds = 0;
  double particle_steps = 0;
  std::vector<PhaseSpan> phases;
};

/// Runs the scene into options.folder, which exists. Throws InputError, RunError, UnstableError; with the
/// last two a checkpoint of the last good state is left behind where one could be written.
RunResult run_scene(const scene::Scene& scene, const RunOptions& options);

}  // namespace interstice::stream
