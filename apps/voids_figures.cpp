#include "apps/voids_figures.h"

#include <fmt/format.h>

#include <exception>

#include "coupling/figures/figures.h"
#include "coupling/scene/format_quantity.h"

namespace interstice::apps {
namespace {

std::string note_of(const io::FieldFilesRequest& request) {
  std::string note = fmt::format("voxel {}, {}", scene::format_length(request.computed.lattice.h.x),
                                 io::name_of(request.computed));
  if (request.computed.average_length > 0) {
    note += fmt::format(", averaged over {}", scene::format_length(request.computed.average_length));
  }
  return note;
}

void draw_slice(const std::filesystem::path& png, const scene::Slice& slice, const voxel::Samples& samples,
                const io::FieldFilesRequest& request, const io::ParticleFrame& frame) {
  figures::SliceFigure figure;
  const std::string where = fmt::format("{} = {}", "xyz"[slice.axis], scene::format_length(slice.at));
  figure.title = fmt::format("Void fraction at {}", where);
  figure.note = note_of(request);
  figure.panels.push_back({"per voxel", samples, false, frame.walls});
  if (!samples.void_fraction_averaged.empty())
    figure.panels.push_back({"averaged", samples, true, frame.walls});
  figures::write_slices(png, figure);
}

void draw_line(const std::filesystem::path& png, const scene::Line& line, const voxel::Samples& samples,
               const io::FieldFilesRequest& request) {
  figures::CurveFigure figure;
  const int a = line.axis == 0 ? 1 : 0, b = line.axis == 2 ? 1 : 2;
  figure.title = fmt::format("Void fraction along {} at {} = {}, {} = {}", "xyz"[line.axis], "xyz"[a],
                             scene::format_length(line.at[a]), "xyz"[b], scene::format_length(line.at[b]));
  figure.x_label = fmt::format("{} [mm]", "xyz"[line.axis]);
  figure.y_label = "void fraction [-]";
  figure.note = note_of(request);
  figure.y_range = {0, 1};
  std::vector<double> at;
  for (const auto& center : samples.center) at.push_back(1e3 * center[line.axis]);
  figure.curves.push_back({"per voxel", at, samples.void_fraction});
  if (!samples.void_fraction_averaged.empty()) {
    figure.curves.push_back({"averaged", at, samples.void_fraction_averaged});
  }
  figures::write_curves(png, {figure});
}

}  // namespace

std::string draw_voids(const std::filesystem::path& folder, const io::FieldFilesRequest& request,
                       const io::FieldFilesResult& result, const io::ParticleFrame& frame) {
  if (request.slices.empty() && request.lines.empty()) return {};
  if (!figures::plotting_available())
    return "figures are left out: gnuplot is not on PATH; the CSV files hold them";
  try {
    for (std::size_t i = 0; i < request.slices.size(); ++i) {
      const auto& slice = request.slices[i];
      draw_slice(folder / "slices" / (io::name_of(slice) + ".png"), slice, result.slices[i], request, frame);
    }
    for (std::size_t i = 0; i < request.lines.size(); ++i) {
      const auto& line = request.lines[i];
      draw_line(folder / "lines" / (io::name_of(line) + ".png"), line, result.lines[i], request);
    }
  } catch (const std::exception& error) {  // the numbers are written; a picture is no reason to fail
    return fmt::format("{}: a figure is missing: {}", folder.string(), error.what());
  }
  return {};
}

}  // namespace interstice::apps
