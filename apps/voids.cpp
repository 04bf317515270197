// interstice voids INPUT... -o DIR: void fraction from any particle file.
#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/voids_figures.h"
#include "apps/voids_frame.h"
#include "apps/voids_options.h"
#include "base/error.h"
#include "base/version.h"
#include "coupling/io/field_files.h"
#include "coupling/io/vti_file.h"
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

std::string place_of(const std::filesystem::path& path, std::int64_t frame) {
  return fmt::format("{}: frame {}", path.string(), frame);
}

void print_warning(const std::string& line) { fmt::print(stderr, "warning: {}\n", line); }

// A dump knows its periodic axes, but only the user knows whether the box of the field is the box that
// repeats.
void warn_of_periods(const io::ParticleFrame& frame, const VoidsOptions& options, const std::string& where) {
  std::string axes;
  for (std::size_t a = 0; a < 3; ++a) {
    if (frame.periodic[a] && !options.periodic[a]) axes += "xyz"[a];
  }
  if (axes.empty()) return;
  print_warning(
      fmt::format("{}: periodic along {}; grains that reach across count on one side only; add --periodic {} "
                  "(and --box where the field is to cover less)",
                  where, axes, axes));
}

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
  while (reader->next(frame)) {
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
  if (options.frames != Frames::all) plan_frame(latest, options, place_of(path, seen - 1));
  input.first = options.frames == Frames::all ? 0 : seen - 1;
  input.count = seen - input.first;
  input.one_of_many = input.count > 1;
  for (const auto& line : reader->warnings()) print_warning(line);
  warn_of_periods(latest, options, path.string());
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

// What an earlier call left in an input's folder must not lie between new files.
void clear_results(const std::filesystem::path& folder) {
  std::error_code error;
  for (const char* name : {"fields.vdb", "fields.vti", "fields.pvd", "slices", "lines", "layers.csv",
                           "profile_x.csv", "profile_y.csv", "summary.json"}) {
    std::filesystem::remove_all(folder / name, error);
  }
  if (!std::filesystem::is_directory(folder, error)) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().rfind("frame_", 0) == 0)
      std::filesystem::remove_all(entry.path(), error);
  }
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
  }

  void run_frame(const Input& input, std::int64_t number, io::ParticleFrame& frame) {
    FramePlan plan = plan_frame(frame, options_, place_of(input.path, number));
    auto& request = plan.request;
    wrap(frame, request.computed);
    request.source = input.path.string();
    request.kind = input.kind;
    request.frame = number;
    request.version = kVersion;
    const auto view = view_of(frame);
    const auto begin = std::chrono::steady_clock::now();
    const voxel::Field field = voxel::compute_field(view, plan.solids, request.computed);
    request.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

    const std::string inner = fmt::format("frame_{:06}", number);
    const auto series = options_.output / input.stem;
    const auto folder = input.one_of_many ? series / inner : series;
    auto result = io::write_field_files(folder, field, view, plan.solids, request);
    if (input.one_of_many) add_to_series(series, inner, request, result);
    if (options_.figures) {
      const std::string missing = draw_voids(folder, request, result, frame);
      if (!missing.empty() && !figures_warned_) print_warning(missing);
      figures_warned_ = figures_warned_ || !missing.empty();
    }
    Json summary = result.summary;
    summary["folder"] = folder.string();
    if (!compute_.json) print_summary(summary);
    results_.push_back(std::move(summary));
  }

  // ParaView opens the frames as one animation through fields.pvd; without a time, steps or numbers order
  // them.
  static void add_to_series(const std::filesystem::path& folder, const std::string& inner,
                            const io::FieldFilesRequest& request, const io::FieldFilesResult& result) {
    for (const auto& path : result.written) {
      if (path.extension() != ".vti") continue;
      const double step = static_cast<double>(request.step >= 0 ? request.step : request.frame);
      io::append_to_pvd(folder / "fields.pvd", {std::isfinite(request.time) ? request.time : step,
                                                inner + "/" + path.filename().string()});
    }
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
  c->add_option("inputs", words->inputs,
                "particle files: trajectory.h5part, LIGGGHTS/LAMMPS text dumps, CSV, YADE text; also .gz")
      ->required();
  c->add_option("-o,--output", words->output, "folder for the results")->required();
  c->add_option("--voxel", words->voxel, "edge of a voxel, such as 20um")->required();
  c->add_option("--box", words->box, "x0,x1,y0,y1,z0,z1 with units (default: the particles' bounds)");
  c->add_option("--periodic", words->periodic, "axes along which the box repeats, such as xy");
  c->add_option("--method", words->method, "exact, centre or subsample:N");
  c->add_option("--overlap", words->overlap, "how overlapping spheres count: sum");
  c->add_option("--average", words->average, "also fields averaged over a cube of this edge");
  c->add_option("--walls", words->walls, "not in this version")->allow_extra_args(false);
  c->add_option("--slice", words->slices, "plane of voxels, such as x=4.5mm (repeatable)")
      ->allow_extra_args(false);
  c->add_option("--line", words->lines, "row of voxels, such as y@x=9mm,z=35um (repeatable)")
      ->allow_extra_args(false);
  c->add_option("--layers", words->layers, "z0,z1,NX,NY: packing of NX by NY columns between two heights");
  c->add_option("--density", words->density, "of the grains, where the file has none, such as 7800kg/m^3");
  c->add_option("--length-unit", words->length_unit, "unit of length of files that carry none (default m)");
  c->add_option("--frame", words->frame, "number from 0, last or all (default last)");
  c->add_option("--columns", words->columns, "OURS=THEIRS,...: columns by other names, such as radius=c_r");
  c->add_flag("--overwrite", words->overwrite, "replace results in the folder");
  c->add_flag("--no-figures", words->no_figures, "no PNG files");
  add_compute_options(*c, words->compute);
  c->callback([words] { voids(*words); });
}

}  // namespace interstice::apps
