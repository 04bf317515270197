#include "coupling/stream/run_figures.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupling/figures/figures.h"
#include "coupling/figures/quantity_slices.h"
#include "coupling/studies/table.h"

namespace interstice::stream {
namespace {

using figures::Curve;
using figures::CurveFigure;

constexpr double kMilli = 1e3, kMicro = 1e6;

/// The grains' own bounds, so that an empty part of the domain takes no room in the picture.
Box window_of(const io::ParticleFrame& f) {
  Box w{{1e300, 1e300, 1e300}, {-1e300, -1e300, -1e300}};
  for (std::size_t i = 0; i < f.size(); ++i) {
    const Vec3d p{f.x[i], f.y[i], f.z[i]};
    for (int axis = 0; axis < 3; ++axis) {
      w.lo[axis] = std::min(w.lo[axis], p[axis] - f.radius[i]);
      w.hi[axis] = std::max(w.hi[axis], p[axis] + f.radius[i]);
    }
  }
  return w;
}

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> out(values);
  for (double& v : out) v *= factor;
  return out;
}

std::vector<CurveFigure::Mark> phase_marks(const std::vector<PhaseSpan>& phases) {
  std::vector<CurveFigure::Mark> marks;
  for (const PhaseSpan& p : phases) marks.push_back({p.end * kMilli, "end of " + p.name});
  return marks;
}

CurveFigure panel(const std::string& title, const std::string& y_label, std::vector<Curve> curves,
                  const std::vector<CurveFigure::Mark>& marks) {
  CurveFigure f;
  f.title = title;
  f.x_label = "time [ms]";
  f.y_label = y_label;
  f.curves = std::move(curves);
  f.marks = marks;
  return f;
}

void draw_forces(const scene::Scene& scene, const std::filesystem::path& folder,
                 const std::vector<CurveFigure::Mark>& marks) {
  const studies::Table table = studies::read_table(folder / "series.csv");
  if (table.rows() < 2) return;
  const std::vector<double> t = scaled(table.numbers("time_s"), kMilli);
  const auto curve = [&](const std::string& name, const std::string& column, double factor) {
    return Curve{name, t, scaled(table.numbers(column), factor)};
  };
  figures::write_curves(
      folder / "figures" / "series-grains.png",
      {panel("Between grains", "force per contact [uN]", {curve("mean", "contact_force_mean_N", kMicro)},
             marks),
       panel("", "coordination", {curve("mean coordination", "coordination_mean", 1)}, marks),
       panel("", "kinetic energy [nJ]", {curve("kinetic energy", "kinetic_energy_J", 1e9)}, marks),
       panel("", "grains", {curve("in the domain", "particles", 1), curve("lost", "particles_lost", 1)},
             marks)});
  for (const scene::Wall& w : scene.walls) {
    if (!w.watch) continue;
    figures::write_curves(
        folder / "figures" / ("series-" + w.name + ".png"),
        {panel("Powder on the " + w.name, "total force [uN]",
               {curve("normal", w.name + "_normal_force_N", kMicro),
                curve("shear", w.name + "_shear_force_N", kMicro)},
               marks),
         panel("", "grains touching", {curve("grains", w.name + "_particles", 1)}, marks),
         panel("", "footprint [mm^2]", {curve("50 um cells", w.name + "_footprint_area_m2", 1e6)}, marks)});
  }
}

void draw_layer(const scene::Field& field, const std::filesystem::path& folder,
                const std::vector<CurveFigure::Mark>& marks) {
  studies::TableOptions options;
  options.text_columns = {"phase"};
  const studies::Table table = studies::read_table(folder / "fields" / (field.name + ".csv"), options);
  if (table.rows() < 2) return;
  const std::vector<double> t = scaled(table.numbers("time_s"), kMilli);
  const auto curve = [&](const std::string& name, const std::string& column, double factor) {
    return Curve{name, t, scaled(table.numbers(column), factor)};
  };
  figures::write_curves(folder / "figures" / (field.name + "-over-time.png"),
                        {panel("Field '" + field.name + "' over time", "height [um]",
                               {curve("solid height", "solid_height_m", kMicro),
                                curve("surface height", "surface_height_m", kMicro)},
                               marks),
                         panel("", "solid fraction",
                               {curve("in the gap", "solid_fraction_gap", 1),
                                curve("below the surface", "solid_fraction_below_surface", 1)},
                               marks)});
}

std::string length(double metres) { return fmt::format("{:.4g} um", metres * kMicro); }

/// "averaged over 120 um", with the window's name where it is no cube.
std::string averaged_name(const scene::Field& field) {
  return fmt::format("averaged over {}{}", length(field.average),
                     field.average_window == WindowShape::box
                         ? std::string()
                         : fmt::format(" ({})", name_of(field.average_window)));
}

/// "along y at x = 4.5 mm, z = 0.035 mm".
std::string place_of(const scene::Line& line) {
  const int a = line.axis == 0 ? 1 : 0, b = line.axis == 2 ? 1 : 2;
  return fmt::format("along {} at {} = {:.4g} mm, {} = {:.4g} mm", "xyz"[line.axis], "xyz"[a],
                     line.at[a] * kMilli, "xyz"[b], line.at[b] * kMilli);
}

void draw_quantities(const scene::Field& field, const std::filesystem::path& folder,
                     const io::FieldFilesResult& files, const io::ParticleFrame& frame,
                     const std::string& phase) {
  figures::QuantitySlices figure;
  figure.voxel_name = fmt::format("per voxel of {}", length(field.voxel));
  figure.averaged_name = averaged_name(field);
  figure.note = fmt::format("voxel {}, method {}", length(field.voxel), scene::method_text(field.recipe));
  if (field.average > 0) figure.note += fmt::format(", {}", averaged_name(field));
  figure.walls = frame.walls;
  for (std::size_t s = 0; s < files.slices.size(); ++s) {
    const scene::Slice& slice = field.slices[s];
    figure.slices.push_back({fmt::format("{}-{}-{}", field.name, phase, io::name_of(slice)),
                             fmt::format("{} = {:.4g} mm, end of phase '{}', t = {:.4g} ms",
                                         "xyz"[slice.axis], slice.at * kMilli, phase, frame.time * kMilli),
                             &files.slices[s]});
  }
  figures::write_quantity_slices(folder, figure);
}

}  // namespace

void draw_grains(const scene::Scene& scene, const std::filesystem::path& folder,
                 const io::ParticleFrame& frame, const std::string& phase) {
  if (frame.size() == 0) return;
  figures::GrainFigure figure;
  figure.window = window_of(frame);
  figure.note = fmt::format("{} grains, t = {:.4g} ms", frame.size(), frame.time * kMilli);
  for (const auto view : {figures::GrainView::above, figures::GrainView::side}) {
    for (const auto colour : {figures::GrainColour::diameter, figures::GrainColour::speed}) {
      figure.view = view;
      figure.colour = colour;
      figure.title = fmt::format("{}: end of phase '{}'", scene.title, phase);
      figures::write_grains(
          folder / fmt::format("grains-{}-{}-{}.png", phase,
                               view == figures::GrainView::above ? "above" : "side",
                               colour == figures::GrainColour::diameter ? "diameter" : "speed"),
          frame, figure);
    }
  }
}

void draw_field(const scene::Field& field, const std::filesystem::path& folder,
                const io::FieldFilesResult& files, const io::ParticleFrame& frame, const std::string& phase) {
  for (const bool averaged : {false, true}) {
    if (files.slices.empty() || (averaged && !(field.average > 0))) continue;
    figures::SliceFigure figure;
    figure.title =
        fmt::format("Void fraction at the end of phase '{}', t = {:.4g} ms", phase, frame.time * kMilli);
    figure.note = fmt::format("voxel {}, {}, method {}", length(field.voxel),
                              averaged ? averaged_name(field) : "per voxel, not averaged",
                              scene::method_text(field.recipe));
    for (std::size_t s = 0; s < files.slices.size(); ++s) {
      figures::SlicePanel panel;
      panel.title =
          fmt::format("X{}: {} = {:.4g} mm", s + 1, "xyz"[field.slices[s].axis], field.slices[s].at * kMilli);
      panel.samples = files.slices[s];
      panel.averaged = averaged;
      panel.walls = frame.walls;
      figure.panels.push_back(std::move(panel));
    }
    if (averaged) figure.contours = {0.2, 0.4, 0.6, 0.8};
    figures::write_slices(
        folder / fmt::format("{}-slices-{}{}.png", field.name, phase, averaged ? "-averaged" : ""), figure);
  }
  if (files.scales && !files.scales->rows.empty())
    figures::write_scales(
        folder / fmt::format("{}-scales-{}.png", field.name, phase),
        {fmt::format("Void fraction against averaging length at the end of phase '{}'", phase),
         fmt::format("voxel {}, exact sphere volumes; all windows inside the box with at "
                     "least half of their volume outside walls",
                     length(field.voxel)),
         *files.scales});
  draw_quantities(field, folder, files, frame, phase);
  if (files.lines.empty()) return;
  std::vector<CurveFigure> panels;
  for (std::size_t l = 0; l < files.lines.size(); ++l) {
    const voxel::Samples& line = files.lines[l];
    const int axis = field.lines[l].axis;
    std::vector<double> at;
    for (const Vec3d& c : line.center) at.push_back(c[axis] * kMilli);
    CurveFigure figure;
    figure.title = place_of(field.lines[l]);
    if (l == 0) figure.title = fmt::format("Void fraction at the end of phase '{}', {}", phase, figure.title);
    figure.x_label = fmt::format("{} [mm]", "xyz"[axis]);
    figure.y_label = "void fraction";
    figure.y_range = {{0, 1.02}};
    figure.curves.push_back(
        figures::trimmed({"per voxel (" + length(field.voxel) + ")", at, voxel::clear_of_walls(line)}));
    if (!line.void_fraction_averaged.empty()) {
      figure.curves.push_back(figures::trimmed(
          {averaged_name(field), at, voxel::outside_walls(line, line.void_fraction_averaged)}));
    }
    panels.push_back(std::move(figure));
  }
  figures::write_curves(folder / fmt::format("{}-lines-{}.png", field.name, phase), panels);
}

void draw_series(const scene::Scene& scene, const std::filesystem::path& folder,
                 const std::vector<PhaseSpan>& phases) {
  const std::vector<CurveFigure::Mark> marks = phase_marks(phases);
  if (scene.output.series > 0) draw_forces(scene, folder, marks);
  for (const scene::Field& f : scene.fields) draw_layer(f, folder, marks);
}

}  // namespace interstice::stream
