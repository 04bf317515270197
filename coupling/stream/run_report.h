// run.json: what was run, on what, how fast, and how it ended.
#pragma once

#include <filesystem>

#include <nlohmann/json_fwd.hpp>

#include "coupling/stream/run.h"
#include "coupling/stream/step_choice.h"

namespace interstice::stream {

nlohmann::ordered_json run_report(const scene::Scene& scene, const RunOptions& options,
                                  const StepChoice& step, const RunResult& result);

void write_run_report(const std::filesystem::path& path, const scene::Scene& scene, const RunOptions& options,
                      const StepChoice& step, const RunResult& result);

}  // namespace interstice::stream
