#include "coupling/studies/run_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"

namespace interstice::studies {
namespace {

namespace fs = std::filesystem;

nlohmann::json read_json(const fs::path& path) {
  std::ifstream file(path);
  if (!file) throw InputError(fmt::format("{}: cannot be opened", path.string()));
  try {
    return nlohmann::json::parse(file);
  } catch (const nlohmann::json::exception& error) {
    throw InputError(fmt::format("{}: no JSON: {}", path.string(), error.what()));
  }
}

/// `now`: the run's own time, where a phase ends that was still going on when the run stopped.
PhaseSpan phase_from(const fs::path& file, const nlohmann::json& entry, std::size_t index, double now) {
  const auto number = [&](const char* key) {
    const auto at = entry.find(key);
    if (at == entry.end() || !at->is_number()) {
      throw InputError(fmt::format("{}: phases[{}].{}: no number", file.string(), index, key));
    }
    return at->get<double>();
  };
  if (!entry.is_object() || !entry.contains("name") || !entry["name"].is_string()) {
    throw InputError(fmt::format("{}: phases[{}].name: missing; a text is wanted", file.string(), index));
  }
  PhaseSpan phase{entry["name"].get<std::string>(), number("start_s"), number("end_s")};
  const auto ended = entry.find("ended_by");
  if (ended != entry.end() && ended->is_string() && ended->get<std::string>().empty()) phase.end = now;
  if (!(phase.start <= phase.end)) {
    throw InputError(fmt::format("{}: phases[{}]: it ends ({} s) before it starts ({} s)", file.string(),
                                 index, phase.end, phase.start));
  }
  return phase;
}

void read_info(RunFolder& run) {
  const fs::path file = run.path / "run.json";
  const auto info = read_json(file);
  const auto text = [&](const char* key) {
    const auto at = info.find(key);
    return at != info.end() && at->is_string() ? at->get<std::string>() : std::string();
  };
  const auto number = [&](const char* key) -> std::optional<double> {
    const auto at = info.find(key);
    if (at == info.end() || !at->is_number()) return std::nullopt;
    return at->get<double>();
  };
  run.title = text("title");
  run.exit_reason = text("exit_reason");
  run.grains_inserted = number("grains_inserted");
  run.grains_lost = number("grains_lost");
  if (!info.is_object() || !info.contains("phases") || !info["phases"].is_array()) {
    throw InputError(
        fmt::format("{}: phases: missing; a list of {{name, start_s, end_s}} is wanted", file.string()));
  }
  for (const auto& entry : info["phases"]) {
    run.phases.push_back(phase_from(file, entry, run.phases.size(), number("time_s").value_or(0)));
  }
}

FieldRecord read_field(const fs::path& fields, const std::string& name) {
  FieldRecord record{name, read_table(fields / (name + ".csv"), {{"phase"}, true}), {}};
  const auto& frames = record.numbers.numbers("frame");
  const auto& times = record.numbers.numbers("time_s");
  const auto& phases = record.numbers.texts("phase");
  for (std::size_t row = 0; row < record.numbers.rows(); ++row) {
    if (!(frames[row] >= 0) || !std::isfinite(times[row])) {
      throw InputError(fmt::format("{}: row {}: frame and time_s must be numbers",
                                   (fields / (name + ".csv")).string(), row + 1));
    }
    const std::string stem = fmt::format("{}_{:06}", name, static_cast<long long>(frames[row]));
    record.moments.push_back({row, times[row], phases[row], fields / stem, fields / (stem + ".vdb")});
  }
  std::stable_sort(record.moments.begin(), record.moments.end(),
                   [](const FieldMoment& a, const FieldMoment& b) { return a.time < b.time; });
  return record;
}

/// The folder of one frame that `voids` wrote, which holds summary.json: `path`, or the only such one in it.
fs::path frame_folder(const fs::path& path) {
  if (fs::exists(path / "summary.json")) return path;
  std::vector<fs::path> frames;
  for (const auto& entry : fs::directory_iterator(path)) {
    if (fs::exists(entry.path() / "summary.json")) frames.push_back(entry.path());
  }
  if (frames.size() == 1) return frames.front();
  throw InputError(
      fmt::format("{}: there is no run.json in it, {}; give a folder that `interstice run` wrote, or that of "
                  "one frame that `interstice voids` wrote",
                  path.string(), frames.empty() ? "nor summary.json" : "and more frames than one"));
}

RunFolder read_frame_folder(const fs::path& path) {
  RunFolder run;
  run.path = frame_folder(path);
  run.simulated = false;
  const fs::path file = run.path / "summary.json";
  const auto summary = read_json(file);
  std::vector<Table::Column> columns;
  const std::pair<const char*, const char*> numbers[] = {
      {"time_s", "time_s"},
      {"solid_fraction_gap", "layer_mean"},
      {"solid_fraction_sd", "layer_sd"},
      {"solid_height_m", "solid_height_m"},
      {"surface_height_m", "surface_height_m"},
      {"solid_fraction_below_surface", "solid_fraction_below_surface"},
      {"solid_fraction_mean", "solid_fraction_mean"},
      {"void_fraction_mean", "void_fraction_mean"},
      {"void_fraction_min", "void_fraction_min"}};
  for (const auto& [column, key] : numbers) {
    const auto at = summary.find(key);
    if (at != summary.end() && at->is_number()) columns.push_back({column, {at->get<double>()}, {}});
  }
  FieldRecord field{"fields", Table(file.string(), std::move(columns), 1), {}};
  const double time = field.numbers.has("time_s") ? field.numbers.numbers("time_s").front() : std::nan("");
  field.moments.push_back({0, time, "", run.path, run.path / "fields.vdb"});
  run.fields.push_back(std::move(field));
  return run;
}

}  // namespace

const PhaseSpan* RunFolder::phase(std::string_view name) const {
  const auto at =
      std::find_if(phases.begin(), phases.end(), [&](const PhaseSpan& p) { return p.name == name; });
  return at == phases.end() ? nullptr : &*at;
}

const FieldRecord* RunFolder::field(std::string_view name) const {
  const auto at =
      std::find_if(fields.begin(), fields.end(), [&](const FieldRecord& f) { return f.name == name; });
  return at == fields.end() ? nullptr : &*at;
}

std::vector<std::string> RunFolder::watched_walls() const {
  constexpr std::string_view suffix = "_normal_force_N";
  std::vector<std::string> walls;
  for (const auto& column : series.columns()) {
    if (column.name.ends_with(suffix))
      walls.push_back(column.name.substr(0, column.name.size() - suffix.size()));
  }
  return walls;
}

RunFolder read_run_folder(const fs::path& path) {
  std::error_code ignored;
  if (!fs::is_directory(path, ignored)) {
    throw InputError(fmt::format(
        "{}: no such folder; give one that `interstice run` or `interstice voids` wrote", path.string()));
  }
  if (!fs::exists(path / "run.json", ignored)) return read_frame_folder(path);
  RunFolder run;
  run.path = path;
  read_info(run);
  run.series = read_table(path / "series.csv", {{}, true});
  run.series.numbers("time_s");
  for (const auto& name : tables_in(path / "fields")) run.fields.push_back(read_field(path / "fields", name));
  return run;
}

std::vector<std::string> tables_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  if (!fs::is_directory(folder, ignored)) return names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_regular_file() && entry.path().extension() == ".csv")
      names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace interstice::studies
