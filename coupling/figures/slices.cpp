// Maps of void fraction on slices: one panel a slice, one colour bar for all.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/figures/gnuplot.h"
#include "coupling/figures/layout.h"
#include "coupling/figures/outline.h"
#include "coupling/figures/section.h"

namespace interstice::figures {
namespace {

constexpr double left = 110, right = 165, top = 56, panel_head = 40, foot = 66;
constexpr double kTitleSize = 15;  // [pt]
constexpr double full_width = Canvas{}.width - left - right;
constexpr const char* axis_names = "xyz";

/// One panel, its geometry worked out: h is the horizontal axis, v the vertical one.
struct Panel {
  const SlicePanel* source = nullptr;
  std::array<int, 2> axes{0, 1};
  std::array<std::int64_t, 2> n{0, 0};
  Point cell{0, 0};  // [m]
  Extent extent;     // [m] of the cells, and of a strip of wall where a wall is next to them
  std::array<LengthUnit, 2> unit;
  int stretch = 1;  // the vertical axis is drawn this many times too long
  Frame frame;
  bool shares_axis_with_next = false;

  std::size_t index(std::int64_t h, std::int64_t v) const {
    const auto& s = source->samples;
    return static_cast<std::size_t>(s.axes[0] == axes[0] ? h * s.columns + v : v * s.columns + h);
  }
  const std::vector<double>& values() const {
    if (!source->values.empty()) return source->values;
    return source->averaged ? source->samples.void_fraction_averaged : source->samples.void_fraction;
  }
  Point scale() const { return {unit[0].per_metre, unit[1].per_metre}; }
};

void check(const SliceFigure& figure) {
  if (figure.panels.empty()) throw InputError("a slice figure without slices");
  if (!(figure.lo < figure.hi)) {
    throw InputError(
        fmt::format("colour range {} to {}: the first must be the smaller", figure.lo, figure.hi));
  }
  for (const auto& panel : figure.panels) {
    const auto& s = panel.samples;
    const auto cells = static_cast<std::size_t>(std::max<std::int64_t>(0, s.rows * s.columns));
    if (s.normal_axis < 0 || cells == 0 || s.center.size() != cells) {
      throw InputError(fmt::format("panel '{}' is no slice", panel.title));
    }
    if (!panel.values.empty()) {
      if (panel.values.size() == cells) continue;
      throw InputError(
          fmt::format("panel '{}' has {} values for {} cells", panel.title, panel.values.size(), cells));
    }
    if ((panel.averaged ? s.void_fraction_averaged : s.void_fraction).size() != cells) {
      throw InputError(fmt::format("panel '{}' has no {}", panel.title,
                                   panel.averaged ? "void_fraction_averaged" : "void_fraction"));
    }
  }
}

/// Cell edges from the spacing of the centres; a single row or column of cells is as thick as the others are
/// long.
Point cell_size(const Panel& panel) {
  const auto& center = panel.source->samples.center;
  Point size{0, 0};
  for (std::size_t k = 0; k < 2; ++k) {
    if (panel.n[k] < 2) continue;
    const std::size_t last = k == 0 ? panel.index(panel.n[0] - 1, 0) : panel.index(0, panel.n[1] - 1);
    size[k] = (center[last][panel.axes[k]] - center[panel.index(0, 0)][panel.axes[k]]) /
              static_cast<double>(panel.n[k] - 1);
  }
  for (std::size_t k = 0; k < 2; ++k) {
    if (!(size[k] > 0)) size[k] = size[1 - k] > 0 ? size[1 - k] : 1e-6;
  }
  return size;
}

/// How much a thin layer must be stretched to be read: a round factor that brings it to about 1 : 5.
int stretch_for(double aspect) {
  if (aspect <= 6) return 1;
  for (const int factor : {2, 3, 4, 5, 6, 8, 10, 12, 15, 20, 25, 30, 40, 50, 60, 80, 100}) {
    if (aspect / factor <= 5.5) return factor;
  }
  return 100;
}

Panel geometry(const SlicePanel& source) {
  Panel panel;
  panel.source = &source;
  const auto& s = source.samples;
  panel.axes = {std::min(s.axes[0], s.axes[1]), std::max(s.axes[0], s.axes[1])};
  panel.n = s.axes[0] == panel.axes[0] ? std::array{s.rows, s.columns} : std::array{s.columns, s.rows};
  panel.cell = cell_size(panel);
  Extent cells;
  for (std::size_t k = 0; k < 2; ++k) {
    cells.lo[k] = s.center.front()[panel.axes[k]] - 0.5 * panel.cell[k];
    cells.hi[k] = cells.lo[k] + static_cast<double>(panel.n[k]) * panel.cell[k];
  }
  panel.stretch = stretch_for(cells.width() / cells.height());
  const double margin = 0.07 * std::min(cells.width(), panel.stretch * cells.height());
  panel.extent = widened_to_walls(source.walls, s.normal_axis, s.center.front()[s.normal_axis], panel.axes,
                                  cells, {margin, margin / panel.stretch});
  panel.unit = {length_unit(panel.extent.width()), length_unit(panel.extent.height())};
  return panel;
}

/// How far to the right panels and their titles reach; titles no farther than the widest panel could.
double right_edge(const std::vector<Panel>& panels) {
  double edge = 0;
  for (const Panel& panel : panels) {
    const double title = std::min(full_width, text_width(panel.source->title, kTitleSize));
    edge = std::max({edge, panel.frame.left + panel.frame.width, left + title});
  }
  return edge;
}

/// All panels of a figure, stacked; returns them with the canvas that holds them.
std::vector<Panel> stacked(const SliceFigure& figure, Canvas& canvas) {
  std::vector<Panel> panels;
  for (const auto& source : figure.panels) panels.push_back(geometry(source));
  const double tallest = panels.size() == 1 ? 640 : panels.size() <= 3 ? 340 : 260;
  double y = top;
  for (std::size_t i = 0; i < panels.size(); ++i) {
    Panel& panel = panels[i];
    const double ratio = panel.stretch * panel.extent.height() / panel.extent.width();
    const double width = std::min(full_width, tallest / ratio);
    panel.shares_axis_with_next = i + 1 < panels.size() && panels[i + 1].axes[0] == panel.axes[0] &&
                                  panels[i + 1].extent.lo[0] == panel.extent.lo[0] &&
                                  panels[i + 1].extent.hi[0] == panel.extent.hi[0] &&
                                  panels[i + 1].n == panel.n;
    panel.frame = {left, y + panel_head, width, std::max(24.0, width * ratio)};
    y = panel.frame.top + panel.frame.height + (panel.shares_axis_with_next ? 8 : foot);
  }
  canvas.width = std::max(700.0, right_edge(panels) + right);
  canvas.height = y + (figure.note.empty() ? 6 : foot_note_height(canvas, left, figure.note));
  return panels;
}

std::string data_of(const SliceFigure& figure, const std::vector<Panel>& panels) {
  std::string data = fmt::format("# {} on slices, one block a panel\n", figure.colour_label);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Panel& p = panels[i];
    if (i > 0) data += "\n\n";
    data += fmt::format("# block {}: {}\n# {}_{} {}_{} value\n", i, p.source->title, axis_names[p.axes[0]],
                        p.unit[0].name, axis_names[p.axes[1]], p.unit[1].name);
    for (std::int64_t v = 0; v < p.n[1]; ++v) {
      if (v > 0) data += "\n";
      for (std::int64_t h = 0; h < p.n[0]; ++h) {
        const std::size_t at = p.index(h, v);
        const Vec3d& c = p.source->samples.center[at];
        const double value = p.values()[at];
        data += fmt::format("{:.8g} {:.8g} ", c[p.axes[0]] * p.scale()[0], c[p.axes[1]] * p.scale()[1]);
        data += std::isfinite(value) ? fmt::format("{:.9g}\n", value) : "NaN\n";
      }
    }
  }
  return data;
}

/// Lines through a field of single voxels follow every grain; they are drawn on averages where there are any.
bool contoured(const SliceFigure& figure, const Panel& panel) {
  const bool any =
      std::any_of(figure.panels.begin(), figure.panels.end(), [](auto& p) { return p.averaged; });
  return !figure.contours.empty() && (panel.source->averaged || !any);
}

/// The levels of the lines, marked on the colour bar in the lines' own colours.
std::string level_marks(const SliceFigure& figure, const Canvas& canvas, const Frame& bar) {
  std::string commands;
  for (const double level : figure.contours) {
    if (!(level > figure.lo && level < figure.hi)) continue;
    const double y = bar.top + bar.height * (figure.hi - level) / (figure.hi - figure.lo);
    for (const char* line : {"'#000000' lw 1.8", "'#ffffff' lw 0.8"}) {
      commands += fmt::format(
          "set arrow from screen {0:.5f}, screen {2:.5f} to screen {1:.5f}, screen {2:.5f} nohead front lc "
          "rgb "
          "{3}\n",
          canvas.across(bar.left), canvas.across(bar.left + bar.width), canvas.up(y), line);
    }
  }
  return commands;
}

/// Contour lines are worked out before the panels are drawn, into data blocks of gnuplot's own.
std::string contour_tables(const SliceFigure& figure, const std::vector<Panel>& panels) {
  if (figure.contours.empty()) return "";
  std::string levels;
  for (const double level : figure.contours)
    levels += fmt::format("{}{:g}", levels.empty() ? "" : ",", level);
  std::string commands = "set contour base; unset surface; set cntrparam levels discrete " + levels + "\n";
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (panels[i].n[0] < 2 || panels[i].n[1] < 2 || !contoured(figure, panels[i])) continue;
    const Extent& e = panels[i].extent;
    const Point scale = panels[i].scale();
    // Ranges are given, for gnuplot refuses to find its own where no cell has a value.
    commands += fmt::format(
        "set table $contours{0}; splot [{1:.8g}:{2:.8g}][{3:.8g}:{4:.8g}][-10:10] data index {0} using "
        "1:2:3; "
        "unset table\n",
        i, e.lo[0] * scale[0], e.hi[0] * scale[0], e.lo[1] * scale[1], e.hi[1] * scale[1]);
  }
  return commands + "unset contour; set surface\n";
}

std::string axes_of(const Panel& panel, const Canvas& canvas) {
  const Point scale = panel.scale();
  std::string commands;
  for (std::size_t k = 0; k < 2; ++k) {
    const char* name = k == 0 ? "x" : "y";
    const double lo = panel.extent.lo[k] * scale[k], hi = panel.extent.hi[k] * scale[k];
    const double room = k == 0 ? panel.frame.width / 90 : panel.frame.height / 45;
    const double step = tick_step(hi - lo, std::clamp(static_cast<int>(room), 1, k == 0 ? 10 : 6));
    commands += fmt::format("set {}range [{:.8g}:{:.8g}]; set {}tics {:g}\n", name, lo, hi, name, step);
  }
  const std::string stretched = panel.stretch > 1 ? fmt::format("\nstretched {}×", panel.stretch) : "";
  commands += y_label(canvas, panel.frame,
                      fmt::format("{} [{}]{}", axis_names[panel.axes[1]], panel.unit[1].name, stretched));
  if (panel.shares_axis_with_next) return commands + "set format x ''\n";
  return commands + "set format x '%g'\n" +
         x_label(canvas, panel.frame, fmt::format("{} [{}]", axis_names[panel.axes[0]], panel.unit[0].name));
}

std::string plot_of(const SliceFigure& figure, const Panel& panel, std::size_t i) {
  std::string commands = fmt::format("plot data index {} using ", i);
  const bool grid = panel.n[0] > 1 && panel.n[1] > 1;
  const auto& values = panel.values();
  const bool blanks = std::any_of(values.begin(), values.end(), [](double v) { return !std::isfinite(v); });
  if (grid && !blanks) {
    commands +=
        "1:2:3 with " + cells_style(values.size());  // no seams between the cells, but it knows no blanks
  } else {  // nor one row or column; boxes reach a little into each other, or seams would show
    const double half = grid ? 0.53 : 0.5;
    commands += fmt::format("1:2:({:.8g}):({:.8g}):3 with boxxyerror fillstyle solid 1.0 noborder lc palette",
                            half * panel.cell[0] * panel.scale()[0], half * panel.cell[1] * panel.scale()[1]);
  }
  if (grid && contoured(figure, panel)) {  // white on black: seen on every colour of the map
    for (const char* line : {"'#000000' lw 1.8", "'#ffffff' lw 0.8"}) {
      commands += fmt::format(", $contours{} using 1:2 with lines lc rgb {}", i, line);
    }
  }
  return commands + "\n";
}

std::string script_of(const SliceFigure& figure, const std::vector<Panel>& panels, const Canvas& canvas) {
  std::string script = contour_tables(figure, panels);
  script += figure.diverging ? diverging_palette() : sequential_palette();
  script += fmt::format("set cbrange [{:g}:{:g}]; set cbtics {:g} font ',14'\n", figure.lo, figure.hi,
                        tick_step(figure.hi - figure.lo, 6));
  script +=
      "unset key; set tics out nomirror font ',14' scale 0.6; set border lw 1.1; set format y '%g'\n"
      "set multiplot\n";
  script += headline(canvas, left, figure.title);
  script += foot_note(canvas, left, figure.note);
  const double bar_top = panels.front().frame.top;
  const double bar_bottom = panels.back().frame.top + panels.back().frame.height;
  const double bar_height = std::clamp(bar_bottom - bar_top, 180.0, 460.0);
  const Frame bar{right_edge(panels) + 34, std::max(bar_top, 0.5 * (bar_top + bar_bottom - bar_height)), 22,
                  std::min(bar_height, canvas.height - bar_top - 40)};
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const Panel& panel = panels[i];
    const auto& s = panel.source->samples;
    script += place(canvas, panel.frame);
    script += write(canvas, {left, panel.frame.top - 18, panel.source->title, kTitleSize, "left"});
    script += i == 0 ? colour_bar(canvas, bar, figure.colour_label) + level_marks(figure, canvas, bar)
                     : "unset colorbox\n";
    script += axes_of(panel, canvas);
    const double at = s.center.front()[s.normal_axis];
    script += hatched(cut(panel.source->walls, s.normal_axis, at, panel.axes, panel.extent), panel.scale());
    script +=
        hatched(sections(panel.source->solids, s.normal_axis, at, panel.axes, panel.extent), panel.scale());
    script += plot_of(figure, panel, i) + "unset label; unset object; unset arrow\n";
  }
  return script + "unset multiplot\n";
}

}  // namespace

void write_slices(const std::filesystem::path& png, const SliceFigure& figure, const Formats& formats) {
  check(figure);
  Canvas canvas;
  const auto panels = stacked(figure, canvas);
  draw(png,
       {canvas.width, canvas.height, data_of(figure, panels), script_of(figure, panels, canvas), formats});
}

}  // namespace interstice::figures
