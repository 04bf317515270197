#include "coupling/stream/run_report.h"

#include <unistd.h>

#include <nlohmann/json.hpp>

#include "base/version.h"
#include "coupling/io/atomic_file.h"

namespace interstice::stream {
namespace {

std::string host_name() {
  char name[256] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

}  // namespace

nlohmann::ordered_json run_report(const scene::Scene& scene, const RunOptions& o, const StepChoice& step,
                                  const RunResult& r) {
  const double busy = r.wall_seconds > 0 ? r.wall_seconds : 1;
  nlohmann::ordered_json j;
  j["title"] = scene.title;
  j["version"] = kVersion;
  j["commit"] = kCommit;
  j["host"] = host_name();
  j["backend"] = o.backend;
  j["instruction_set"] = o.isa;
  j["precision"] = o.precision;
  j["threads"] = o.threads;
  j["seed"] = scene.seed;
  j["time_step_s"] = step.step;
  if (scene.step.short_below) j["short_steps"] = step.short_steps;
  j["time_step_limited_by"] = step.limited_by;
  j["time_step_rayleigh_fraction"] = step.rayleigh_fraction;
  j["time_step_collision_fraction"] = step.collision_fraction;
  j["rayleigh_time_s"] = step.limits.rayleigh_time;
  j["collision_time_s"] = std::isfinite(step.limits.collision_time)
                              ? nlohmann::ordered_json(step.limits.collision_time)
                              : nlohmann::ordered_json(nullptr);
  j["exit_reason"] = r.exit_reason;
  j["time_s"] = r.time;
  j["steps"] = r.steps;
  j["grains"] = r.grains;
  j["grains_inserted"] = r.grains_inserted;
  j["grains_lost"] = r.grains_lost;
  j["phases"] = nlohmann::ordered_json::array();
  for (const PhaseSpan& p : r.phases) {
    j["phases"].push_back(
        {{"name", p.name}, {"start_s", p.start}, {"end_s", p.end}, {"ended_by", p.ended_by}});
  }
  j["wall_s"] = r.wall_seconds;
  j["particle_steps_per_s"] = r.step_seconds > 0 ? r.particle_steps / r.step_seconds : 0;
  j["share_stepping"] = r.step_seconds / busy;
  j["share_fields_waited"] = r.field_wait_seconds / busy;
  j["share_fields_beside"] = r.field_seconds / busy;
  j["share_files"] = r.file_seconds / busy;
  return j;
}

void write_run_report(const std::filesystem::path& path, const scene::Scene& scene, const RunOptions& options,
                      const StepChoice& step, const RunResult& result) {
  io::write_text_atomically(path, run_report(scene, options, step, result).dump(2) + "\n");
}

}  // namespace interstice::stream
