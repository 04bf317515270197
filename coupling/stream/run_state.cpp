#include "coupling/stream/run_state.h"

#include "base/error.h"
#include "coupling/io/state_file.h"

namespace interstice::stream {
namespace {

template <class Map>
const auto& field_of(const Map& map, const std::string& name, const std::filesystem::path& path) {
  const auto it = map.find(name);
  if (it == map.end()) {
    throw InputError(path.string() + ": no entry '" + name +
                     "'; not a checkpoint of this version; start the run "
                     "anew with --overwrite");
  }
  return it->second;
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const dem::Simulation& sim,
                      const std::vector<PhasedRain>& rains, const RunState& state,
                      const std::string& fingerprint) {
  dem::SavedState saved = sim.save();
  io::State file;
  file.real = std::move(saved.real);
  file.integer = std::move(saved.integer);
  file.text["scene"] = fingerprint;
  file.integer["run"] = {static_cast<std::int64_t>(state.phase), state.phase_start, state.quiet_since};
  file.integer["field_frames"] = state.field_frames;
  file.real["run_cost"] = {state.particle_steps, state.step_seconds, state.wall_seconds};
  for (std::size_t i = 0; i < state.spans.size(); ++i) {
    file.real["span_times"].insert(file.real["span_times"].end(), {state.spans[i].start, state.spans[i].end});
    file.text["span_" + std::to_string(i)] = state.spans[i].ended_by;
  }
  for (const PhasedRain& r : rains) {
    file.integer["rain"].push_back(static_cast<std::int64_t>(r.rain.next));
    file.integer["rain"].push_back(static_cast<std::int64_t>(r.rain.random.counter()));
  }
  io::write_state(path, file);
}

void read_checkpoint(const std::filesystem::path& path, dem::Simulation& sim, std::vector<PhasedRain>& rains,
                     RunState& state, const std::string& fingerprint) {
  const io::State file = io::read_state(path);
  if (field_of(file.text, "scene", path) != fingerprint) {
    throw InputError(path.string() +
                     ": the checkpoint belongs to another scene or other settings; only the same "
                     "scene can be continued; use --overwrite to start anew");
  }
  const auto& run = field_of(file.integer, "run", path);
  const auto& cost = field_of(file.real, "run_cost", path);
  state.phase = static_cast<std::size_t>(run.at(0));
  state.phase_start = run.at(1);
  state.quiet_since = run.at(2);
  state.field_frames = field_of(file.integer, "field_frames", path);
  state.particle_steps = cost.at(0), state.step_seconds = cost.at(1), state.wall_seconds = cost.at(2);
  const auto& times = field_of(file.real, "span_times", path);
  for (std::size_t i = 0; 2 * i < times.size(); ++i) {
    state.spans.push_back(
        {"", times[2 * i], times.at(2 * i + 1), field_of(file.text, "span_" + std::to_string(i), path)});
  }
  for (std::size_t i = 0; i < rains.size(); ++i) {
    const auto& rain = field_of(file.integer, "rain", path);
    rains[i].rain.next = static_cast<std::size_t>(rain.at(2 * i));
    rains[i].rain.random.set_counter(static_cast<std::uint64_t>(rain.at(2 * i + 1)));
  }
  sim.restore({file.real, file.integer});
}

}  // namespace interstice::stream
