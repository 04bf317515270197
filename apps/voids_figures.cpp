#include "apps/voids_figures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "coupling/figures/figures.h"
#include "coupling/figures/quantity_slices.h"
#include "coupling/scene/format_quantity.h"

namespace interstice::apps {
namespace {

using scene::format_length;

std::string moment_of(const io::FieldFilesRequest& request) {
  if (std::isfinite(request.time)) return fmt::format(", t = {}", scene::format_time(request.time));
  return request.step >= 0 ? fmt::format(", step {}", request.step) : std::string();
}

std::string averaged_name(const io::FieldFilesRequest& request) {
  return fmt::format("averaged over {}{}", format_length(request.computed.average_length),
                     request.computed.average_window == WindowShape::box
                         ? std::string()
                         : fmt::format(" ({})", name_of(request.computed.average_window)));
}
std::string voxel_name(const io::FieldFilesRequest& request) {
  return fmt::format("per voxel of {}", format_length(request.computed.lattice.h.x));
}

void draw_slice(const std::filesystem::path& png, const scene::Slice& slice, const voxel::Samples& samples,
                const VoidsFigures& f) {
  figures::SliceFigure figure;
  figure.title = fmt::format("Void fraction at {} = {}{}", "xyz"[slice.axis], format_length(slice.at),
                             moment_of(f.request));
  figure.note = note_of(f.request);
  figure.panels.push_back({voxel_name(f.request), samples, false, f.frame.walls, f.solids});
  if (!samples.void_fraction_averaged.empty()) {
    figure.panels.push_back({averaged_name(f.request), samples, true, f.frame.walls, f.solids});
    figure.contours = f.contours;
    std::string levels;
    for (const double level : f.contours) levels += fmt::format("{}{:g}", levels.empty() ? "" : ", ", level);
    if (!levels.empty()) figure.note += fmt::format("; lines: averaged void fraction {}", levels);
  }
  figures::write_slices(png, figure, f.formats);
}

void draw_quantities(const std::filesystem::path& folder, const VoidsFigures& f) {
  figures::QuantitySlices figure{
      {}, voxel_name(f.request), averaged_name(f.request), note_of(f.request), f.frame.walls, f.solids};
  for (std::size_t i = 0; i < f.request.slices.size(); ++i) {
    const auto& slice = f.request.slices[i];
    const std::string place =
        fmt::format("{} = {}{}", "xyz"[slice.axis], format_length(slice.at), moment_of(f.request));
    figure.slices.push_back({io::name_of(slice), place, &f.result.slices[i]});
  }
  figures::write_quantity_slices(folder, figure, f.formats);
}

void draw_line(const std::filesystem::path& png, const scene::Line& line, const voxel::Samples& samples,
               const VoidsFigures& f) {
  figures::CurveFigure figure;
  const int a = line.axis == 0 ? 1 : 0, b = line.axis == 2 ? 1 : 2;
  figure.title =
      fmt::format("Void fraction along {} at {} = {}, {} = {}{}", "xyz"[line.axis], "xyz"[a],
                  format_length(line.at[a]), "xyz"[b], format_length(line.at[b]), moment_of(f.request));
  figure.x_label = fmt::format("{} [mm]", "xyz"[line.axis]);
  figure.y_label = "void fraction";
  figure.note = note_of(f.request);
  figure.y_range = {0, 1.02};
  std::vector<double> at;
  for (const auto& center : samples.center) at.push_back(1e3 * center[line.axis]);
  figure.curves.push_back(figures::trimmed({voxel_name(f.request), at, voxel::clear_of_walls(samples)}));
  if (!samples.void_fraction_averaged.empty()) {
    figure.curves.push_back(figures::trimmed(
        {averaged_name(f.request), at, voxel::outside_walls(samples, samples.void_fraction_averaged)}));
  }
  figures::write_curves(png, {figure}, f.formats);
}

void draw_histogram(const std::filesystem::path& png, const VoidsFigures& f) {
  const auto& histogram = f.histogram;
  if (histogram.cells == 0) return;
  const double cells = static_cast<double>(histogram.cells);
  constexpr int bins = studies::VoidHistogram::bins;
  figures::CurveFigure figure;
  figure.title = "How often each void fraction occurs" + moment_of(f.request);
  figure.x_label = "void fraction";
  figure.y_label = fmt::format("share of the voxels, per bin of {:g}", studies::VoidHistogram::bin_edge(1));
  figure.note = note_of(f.request);
  if (histogram.layer) {
    figure.note += fmt::format("; voxels with their centre at z from {} to {}",
                               format_length((*histogram.layer)[0]), format_length((*histogram.layer)[1]));
  } else {
    figure.note += "; all voxels of the box, void above the powder included";
  }
  figure.note += fmt::format("; {} voxels", histogram.cells);
  if (histogram.voxels.negative > 0) {
    figure.note += fmt::format(", {} below zero (grains overlap) not shown", histogram.voxels.negative);
  }
  figure.log_y = true;
  figure.y_range = {std::pow(10, std::floor(std::log10(std::max(0.5 / cells, 1e-8)))), 1};
  const auto add = [&](const std::string& name, const studies::VoidHistogram::Counts& counts) {
    figures::Curve curve{name, {}, {}, true};
    for (int b = 0; b < bins; ++b) {
      curve.x.push_back((b + 0.5) / bins);
      curve.y.push_back(static_cast<double>(counts.in_bin[static_cast<std::size_t>(b)]) / cells);
    }
    figure.curves.push_back(std::move(curve));
  };
  add(voxel_name(f.request), histogram.voxels);
  if (histogram.averaged) add(averaged_name(f.request), *histogram.averaged);
  figures::write_curves(png, {figure}, f.formats);
}

void draw_scales(const std::filesystem::path& png, const VoidsFigures& f) {
  if (!f.result.scales || f.result.scales->rows.empty()) return;
  figures::write_scales(
      png,
      {"Void fraction against averaging length" + moment_of(f.request),
       fmt::format("voxel {}, method {}; all windows inside the box with at least half of "
                   "their volume outside walls",
                   format_length(f.request.computed.lattice.h.x), io::name_of(f.request.computed)),
       *f.result.scales},
      f.formats);
}

}  // namespace

std::string note_of(const io::FieldFilesRequest& request) {
  std::string note = fmt::format("voxel {}, method {}", format_length(request.computed.lattice.h.x),
                                 io::name_of(request.computed));
  if (request.computed.average_length > 0) {
    constexpr std::array<const char*, 3> kWindows{"a cube of", "a sphere of diameter",
                                                  "a Gaussian of length"};
    note += fmt::format(", averaged over {} {}",
                        kWindows[static_cast<std::size_t>(request.computed.average_window)],
                        format_length(request.computed.average_length));
  }
  return note;
}

std::string draw_voids(const std::filesystem::path& folder, const VoidsFigures& f) {
  if (!figures::plotting_available())
    return "figures are left out: gnuplot is not on PATH; the CSV files hold them";
  try {
    for (std::size_t i = 0; i < f.request.slices.size(); ++i) {
      const auto& slice = f.request.slices[i];
      draw_slice(folder / "slices" / (io::name_of(slice) + ".png"), slice, f.result.slices[i], f);
    }
    draw_quantities(folder / "slices", f);
    for (std::size_t i = 0; i < f.request.lines.size(); ++i) {
      const auto& line = f.request.lines[i];
      draw_line(folder / "lines" / (io::name_of(line) + ".png"), line, f.result.lines[i], f);
    }
    draw_histogram(folder / "histogram.png", f);
    draw_scales(folder / "scales.png", f);
  } catch (const std::exception& error) {  // the numbers are written; a picture is no reason to fail
    return fmt::format("{}: a figure is missing: {}", folder.string(), error.what());
  }
  return {};
}

}  // namespace interstice::apps
