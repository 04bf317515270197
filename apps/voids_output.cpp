#include "apps/voids_output.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

#include "apps/voids_figures.h"
#include "base/version.h"
#include "coupling/io/atomic_file.h"
#include "coupling/io/vti_file.h"
#include "coupling/scene/format_quantity.h"
#include "coupling/stream/touching_grains.h"
#include "coupling/studies/bed_profile.h"
#include "coupling/studies/void_histogram.h"

namespace interstice::apps {

std::string place_of(const std::filesystem::path& path, std::int64_t frame) {
  return fmt::format("{}: frame {}", path.string(), frame);
}

std::string warning_of_periods(const io::ParticleFrame& frame, const VoidsOptions& options,
                               const std::string& where) {
  std::string axes;
  for (std::size_t a = 0; a < 3; ++a) {
    if (frame.periodic[a] && !options.periodic[a]) axes += "xyz"[a];
  }
  if (axes.empty()) return {};
  return fmt::format(
      "{}: periodic along {}; grains that reach across count on one side only; add --periodic {} (and --box "
      "where the field is to cover less)",
      where, axes, axes);
}

FrameOutput write_frame(const FrameTask& task, io::ParticleFrame& frame, FramePlan plan,
                        const VoidsOptions& options) {
  FrameOutput output{std::move(plan.request), {}, {}};
  auto& request = output.request;
  wrap(frame, request.computed);
  request.source = task.input.string();
  request.kind = task.kind;
  request.frame = task.number;
  request.version = kVersion;
  const auto begin = std::chrono::steady_clock::now();
  if (request.computed.quantities.coordination && frame.coordination.empty())
    frame.coordination = stream::touching_grains(frame, plan.solids, request.computed);
  auto view = io::view_of(frame);
  if (!plan.classes.of.empty()) view.group = plan.classes.of.data();
  const voxel::Field field = voxel::compute_field(view, plan.solids, request.computed);
  request.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  // The summary comes last: with it, the set is whole.
  std::error_code error;
  std::filesystem::create_directories(task.folder, error);
  const auto profile = studies::bed_profile(view, plan.solids, request);
  io::write_text_atomically(task.folder / studies::kBedProfileFile, studies::csv_of(profile));
  const auto histogram = studies::void_histogram(field, request.layers);
  io::write_text_atomically(task.folder / "histogram.csv", studies::csv_of(histogram));
  output.files = io::write_field_files(task.folder, field, view, plan.solids, request);
  if (options.figures) {
    output.missing_figures = draw_voids(
        task.folder,
        {request, output.files, histogram, frame, options.walls.solids, options.formats, options.contours});
  }
  return output;
}

studies::TimeSpaceText time_space_text(const std::filesystem::path& input, const VoidsOptions& options) {
  studies::TimeSpaceText text;
  text.title = fmt::format("Void fraction along the bed over time: {}", stem_of(input));
  text.note = fmt::format("slabs of {}, exact sphere volumes, averaged over the ",
                          scene::format_length(options.voxel));
  text.note += options.layers
                   ? fmt::format("layer from z = {} to {}", scene::format_length(options.layers->lo),
                                 scene::format_length(options.layers->hi))
                   : std::string("box across the bed and over its height");
  return text;
}

void add_to_series(const std::filesystem::path& series, const std::filesystem::path& inner,
                   const FrameOutput& output) {
  const auto& request = output.request;
  for (const auto& path : output.files.written) {
    if (path.extension() != ".vti") continue;
    const double step = static_cast<double>(request.step >= 0 ? request.step : request.frame);
    io::append_to_pvd(series / "fields.pvd", {std::isfinite(request.time) ? request.time : step,
                                              (inner / path.filename()).string()});
  }
}

void clear_results(const std::filesystem::path& folder) {
  std::error_code error;
  for (const char* name : {"fields.vdb", "fields.vti", "fields.pvd", "slices", "lines", "layers.csv",
                           "profile_x.csv", "profile_y.csv", "profile_bed.csv", "summary.json"}) {
    std::filesystem::remove_all(folder / name, error);
  }
  for (const char* stem : {"histogram", "time_space", "scales"}) {
    for (const char* kind : {".csv", ".png", ".pdf", ".svg", ".dat", ".gp"}) {
      std::filesystem::remove(folder / (std::string(stem) + kind), error);
    }
  }
  if (!std::filesystem::is_directory(folder, error)) return;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().rfind("frame_", 0) == 0)
      std::filesystem::remove_all(entry.path(), error);
  }
}

}  // namespace interstice::apps
