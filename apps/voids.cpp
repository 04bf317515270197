// interstice voids INPUT... -o DIR: void fraction from any particle file.
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "apps/voids_flags.h"
#include "apps/voids_output.h"
#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/io/field_files.h"
#include "coupling/scene/format_quantity.h"

namespace interstice::apps {
namespace {

using Json = nlohmann::ordered_json;

/// An input that was read once from end to end, so that nothing is written for a file that is wrong.
struct Input {
  std::filesystem::path path;
  std::string stem, kind;
  std::int64_t first = 0, count = 0;  // the frames to compute
  bool one_of_many = false;           // frames get a folder each
};

void print_warning(const std::string& line) { fmt::print(stderr, "warning: {}\n", line); }

// Reads all frames that are asked for, and checks that each goes together with the options.
Input inspect(const std::filesystem::path& path, const VoidsOptions& options) {
  Input input{path, stem_of(path), "", 0, 0, false};
  const auto reader = io::open_particles(path, options.reader);
  input.kind = reader->kind();
  io::ParticleFrame frame, latest;
  std::int64_t seen = 0;
  if (options.frames == Frames::last && reader->frames() > 0) {
    while (seen < reader->frames() - 1 && reader->skip()) ++seen;
  }
  if (options.frames == Frames::one) {
    while (seen < options.frame && reader->skip()) ++seen;
  }
  double resolution = 0;
  while (reader->next(frame)) {
    resolution = std::max(options.frames == Frames::all ? resolution : 0, reader->position_resolution());
    if (options.frames == Frames::all) plan_frame(frame, options, place_of(path, seen));
    std::swap(frame, latest);
    ++seen;
    if (options.frames == Frames::one) break;
  }
  const bool missing = options.frames == Frames::one && seen <= options.frame;
  if (seen == 0 || missing) {
    throw InputError(seen == 0
                         ? fmt::format("{}: no frames; at least one is needed; check the file", path.string())
                         : fmt::format("{}: --frame {}: no such frame; 0 to {}; correct it, or use last",
                                       path.string(), options.frame, seen - 1));
  }
  const FramePlan plan = plan_frame(latest, options, place_of(path, seen - 1));
  input.first = options.frames == Frames::all ? 0 : seen - 1;
  input.count = seen - input.first;
  input.one_of_many = input.count > 1;
  for (const auto& line : reader->warnings()) print_warning(line);
  if (const auto line = resolution_warning(path.string(), resolution, options.voxel); !line.empty()) {
    print_warning(line);
  }
  for (const auto& line : warnings_of_walls(options.walls, plan.request.box)) print_warning(line);
  const std::string periods = warning_of_periods(latest, options, path.string());
  if (!periods.empty()) print_warning(periods);
  return input;
}

std::vector<Input> inspect_all(const VoidsOptions& options) {
  std::vector<Input> inputs;
  std::vector<std::string> errors;
  for (const auto& path : options.inputs) {
    try {
      inputs.push_back(inspect(path, options));
    } catch (const InputError& error) {
      errors.insert(errors.end(), error.messages().begin(), error.messages().end());
    }
  }
  if (!errors.empty()) throw InputError(errors);
  return inputs;
}

void print_summary(const Json& s) {
  const auto length = [](const Json& v) { return scene::format_length(v.get<double>()); };
  const auto& box = s["box_m"];
  fmt::print("{} (frame {}) -> {}\n", s["source"].get<std::string>(), s["frame"].dump(),
             s["folder"].get<std::string>());
  fmt::print("  particles         {} in the box, {} in the file\n", s["particles"].get<std::int64_t>(),
             s["particles_in_file"].get<std::int64_t>());
  fmt::print("  box               x {} .. {}, y {} .. {}, z {} .. {}{}\n", length(box[0]), length(box[1]),
             length(box[2]), length(box[3]), length(box[4]), length(box[5]),
             s["box_extended"].get<bool>() ? " (extended upward to whole voxels)" : "");
  fmt::print("  voxels            {} x {} x {} of {}, {}\n", s["shape"][0].dump(), s["shape"][1].dump(),
             s["shape"][2].dump(), length(s["voxel_m"]), s["method"].get<std::string>());
  fmt::print("  solid volume      {:.9g} m^3, conserved to {:.1e} (as written {:.1e})\n",
             s["solid_volume_particles_m3"].get<double>(), s["relative_conservation_error"].get<double>(),
             s["written_conservation_error"].get<double>());
  fmt::print("  solid fraction    {:.6g}; void fraction {:.6g}, from {:.4g} to {:.4g}",
             s["solid_fraction_mean"].get<double>(), s["void_fraction_mean"].get<double>(),
             s["void_fraction_min"].get<double>(), s["void_fraction_max"].get<double>());
  fmt::print("; {} negative voxels\n", s["negative_voxels"].get<std::int64_t>());
  if (!s["layer_mean"].is_null()) {
    fmt::print("  layer             solid fraction {:.6g}, standard deviation over columns {:.4g}\n",
               s["layer_mean"].get<double>(), s["layer_sd"].is_null() ? NAN : s["layer_sd"].get<double>());
  }
  for (const auto& line : s["lines"]) {
    if (!line.contains("void_fraction_mean")) {
      fmt::print("  line {:<12} lies in walls\n", line["name"].get<std::string>());
      continue;
    }
    fmt::print("  line {:<12} void fraction mean {:.6g}, least {:.6g}\n", line["name"].get<std::string>(),
               line["void_fraction_mean"].get<double>(), line["void_fraction_min"].get<double>());
  }
  for (const auto& message : s["messages"]) fmt::print("  note: {}\n", message.get<std::string>());
  fmt::print("  {:.3g} s\n", s["seconds"].get<double>());
}

class Voids {
 public:
  Voids(const VoidsOptions& options, const ComputeOptions& compute) : options_(options), compute_(compute) {}

  void run() {
    const auto inputs = inspect_all(options_);
    prepare_output_folder(options_.output, options_.overwrite);
    for (const auto& input : inputs) {
      if (options_.overwrite) clear_results(options_.output / input.stem);
      run_input(input);
    }
    if (compute_.json) print_json();
  }

 private:
  void run_input(const Input& input) {
    const auto reader = io::open_particles(input.path, options_.reader);
    io::ParticleFrame frame;
    for (std::int64_t i = 0; i < input.first; ++i) reader->skip();
    for (std::int64_t i = 0; i < input.count; ++i) {
      if (!reader->next(frame)) throw RunError(input.path.string() + ": changed while it was read");
      run_frame(input, input.first + i, frame);
      if (!compute_.quiet && input.one_of_many) {
        fmt::print(stderr, "{}: {} of {} frames\n", input.path.string(), i + 1, input.count);
      }
    }
    if (input.one_of_many) draw_over_time(input);
  }

  void draw_over_time(const Input& input) {
    try {
      studies::write_time_space(options_.output / input.stem, moments_, time_space_text(input.path, options_),
                                options_.figures && figures::plotting_available(), options_.formats);
    } catch (const std::exception& error) {  // the frames are written; a picture is no reason to fail
      print_warning(fmt::format("{}: the map over time is missing: {}", input.path.string(), error.what()));
    }
    moments_.clear();
  }

  void run_frame(const Input& input, std::int64_t number, io::ParticleFrame& frame) {
    const std::string inner = fmt::format("frame_{:06}", number);
    const auto series = options_.output / input.stem;
    const auto folder = input.one_of_many ? series / inner : series;
    const FrameOutput output =
        write_frame({input.path, input.kind, number, folder}, frame,
                    plan_frame(frame, options_, place_of(input.path, number)), options_);
    if (input.one_of_many) moments_.push_back({number, output.request.time, output.request.step, folder});
    if (input.one_of_many) add_to_series(series, inner, output);
    if (!output.missing_figures.empty() && !figures_warned_) print_warning(output.missing_figures);
    figures_warned_ = figures_warned_ || !output.missing_figures.empty();
    Json summary = output.files.summary;
    summary["folder"] = folder.string();
    if (!compute_.json) print_summary(summary);
    results_.push_back(std::move(summary));
  }

  // With one result its numbers also stand at top level, where a script looks first.
  void print_json() const {
    Json all = results_.size() == 1 ? results_[0] : Json::object();
    all["results"] = results_;
    fmt::print("{}\n", all.dump(2));
  }

  const VoidsOptions& options_;
  const ComputeOptions& compute_;
  Json results_ = Json::array();
  std::vector<studies::TimeSpaceFrame> moments_;  // of the input in hand
  bool figures_warned_ = false;
};

void voids(const VoidsWords& words) {
  apply_compute_options(words.compute);
  const VoidsOptions options = read_voids_options(words);
  Voids(options, words.compute).run();
}

}  // namespace

void add_voids(CLI::App& root) {
  auto words = std::make_shared<VoidsWords>();
  CLI::App* c = root.add_subcommand("voids", "void fraction from particle files");
  add_voids_flags(*c, *words);
  c->callback([words] { voids(*words); });
}

}  // namespace interstice::apps
