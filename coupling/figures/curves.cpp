// Curves in stacked panels over one common x axis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/figures/gnuplot.h"
#include "coupling/figures/layout.h"

namespace interstice::figures {
namespace {

constexpr double left = 110, top_margin = 62, gap = 16, panel_head = 38, foot = 72;
constexpr double legend_size = 14;

struct Range {
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
  void include(double value) {
    if (!std::isfinite(value)) return;
    lo = std::min(lo, value);
    hi = std::max(hi, value);
  }
  bool empty() const { return lo > hi; }
};

void check(const std::vector<CurveFigure>& panels) {
  if (panels.empty()) throw InputError("a curve figure without panels");
  for (const auto& panel : panels) {
    for (const auto& curve : panel.curves) {
      if (curve.x.size() == curve.y.size()) continue;
      throw InputError(fmt::format("curve '{}' has {} x values and {} y values", curve.name, curve.x.size(),
                                   curve.y.size()));
    }
    if (panel.y_range && !(panel.y_range->first < panel.y_range->second)) {
      throw InputError(fmt::format("y range {} to {}: the first must be the smaller", panel.y_range->first,
                                   panel.y_range->second));
    }
    if (panel.log_y && !(panel.y_range && panel.y_range->first > 0)) {
      throw InputError("a logarithmic axis needs a y range above zero");
    }
  }
}

/// The common x range, as far as the data go.
Range x_range(const std::vector<CurveFigure>& panels) {
  Range range;
  for (const auto& panel : panels) {
    for (const auto& curve : panel.curves) {
      for (const double x : curve.x) range.include(x);
      if (!curve.steps || curve.x.size() < 2) continue;
      const double half = 0.5 * (curve.x[1] - curve.x[0]);  // of a bin
      range.include(curve.x.front() - half);
      range.include(curve.x.back() + half);
    }
  }
  if (range.empty()) return {0, 1};
  const double slack = 0.02 * (range.hi - range.lo);  // a phase may end just after the last sample
  for (const auto& mark : panels.front().marks) {
    if (mark.x > range.hi && mark.x <= range.hi + slack) range.hi = mark.x;
  }
  if (range.lo == range.hi) {
    const double half = range.lo == 0 ? 1 : 0.05 * std::abs(range.lo);
    return {range.lo - half, range.hi + half};
  }
  return range;
}

/// A panel's y range: as given, or the data with a little air, from zero where they start near it.
Range y_range(const CurveFigure& panel) {
  if (panel.y_range) return {panel.y_range->first, panel.y_range->second};
  Range range;
  for (const auto& curve : panel.curves) {
    for (const double y : curve.y) range.include(y);
  }
  if (range.empty()) return {0, 1};
  const double span = range.hi - range.lo;
  if (!(span > 0)) {
    const double half = range.lo == 0 ? 1 : 0.1 * std::abs(range.lo);
    return {range.lo - half, range.hi + half};
  }
  const bool from_zero = range.lo >= 0 && range.lo < 0.4 * range.hi;
  return {from_zero ? 0 : range.lo - 0.06 * span,
          range.hi <= 0 && range.hi > 0.4 * range.lo ? 0 : range.hi + 0.06 * span};
}

bool same_names(const CurveFigure& a, const CurveFigure& b) {
  return std::equal(a.curves.begin(), a.curves.end(), b.curves.begin(), b.curves.end(),
                    [](const Curve& c, const Curve& d) { return c.name == d.name; });
}

double legend_width(const std::vector<CurveFigure>& panels) {
  double widest = 0;
  for (const auto& panel : panels) {
    for (const auto& curve : panel.curves) widest = std::max(widest, text_width(curve.name, legend_size));
  }
  return widest > 0 ? std::min(widest, 300.0) + 62 : 30;
}

struct Layout {
  Canvas canvas;
  std::vector<Frame> frames;
};

Layout laid_out(const std::vector<CurveFigure>& panels, bool marks, const std::string& note) {
  Layout layout;
  const double height = panels.size() == 1 ? 470 : panels.size() == 2 ? 320 : panels.size() == 3 ? 250 : 200;
  const double width = layout.canvas.width - left - legend_width(panels);
  double y = top_margin + (marks ? 30 : 0);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    if (i > 0) y += panels[i].title.empty() ? gap : panel_head;
    layout.frames.push_back({left, y, width, height});
    y += height;
  }
  layout.canvas.height = y + foot + foot_note_height(layout.canvas, left, note);
  return layout;
}

std::string data_of(const std::vector<CurveFigure>& panels) {
  std::string data;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    for (const auto& curve : panels[p].curves) {
      if (!data.empty()) data += "\n\n";
      data += fmt::format("# panel {}: {}\n# x y\n", p, curve.name);
      if (curve.x.empty()) data += "NaN NaN\n";  // keeps the block, and so the numbers of those after it
      for (std::size_t i = 0; i < curve.x.size(); ++i) {
        const auto number = [](double v) {
          return std::isfinite(v) ? fmt::format("{:.9g}", v) : std::string("NaN");
        };
        data += number(curve.x[i]) + " " + number(curve.y[i]) + "\n";
      }
    }
  }
  return data;
}

/// A line, with some ten marks on it so that curves stay apart in grey; on curves of few points every point
/// is marked.
std::string curve_of(const Curve& curve, std::size_t index, std::size_t block, double below_axis) {
  const std::size_t points = curve.x.size();
  const std::size_t every = points <= 40 ? 1 : points / 10;
  // Curves of many points are mostly noise: thinner lines, and no mark at the same place twice.
  const double line = points > 400 ? 1.1 : 1.7;
  if (curve.steps) {
    return fmt::format(
        "data index {0} using 1:(($2)>0?($2):{1:g}) with histeps lc rgb '{2}' lw 1.7 dt {3} title {4}", block,
        below_axis, curve_colour(index), index % 2 == 0 ? "solid" : "(10,4)", text_literal(curve.name));
  }
  return fmt::format(
      "data index {0} using 1:2 with lines lc rgb '{1}' lw {2} notitle, "
      "data index {0} every {3}::{4} using 1:2 with points lc rgb '{1}' pt {5} ps 1.5 lw 1.2 notitle, "
      "NaN with linespoints lc rgb '{1}' lw 1.8 pt {5} ps 1.5 title {6}",
      block, curve_colour(index), line, every, every > 1 ? (index * every / 3) % every : 0,
      curve_point_type(index), text_literal(curve.name));
}

/// Vertical lines through every panel; their labels above the first, raised where they would touch.
std::string marks_of(const CurveFigure& panel, const Layout& layout, const Frame& frame, const Range& x,
                     bool labels) {
  std::string commands;
  std::vector<double> occupied(3, -1e9);
  for (const auto& mark : panel.marks) {
    if (!(mark.x >= x.lo && mark.x <= x.hi)) continue;
    commands += fmt::format(
        "set arrow from first {0:.9g}, graph 0 to first {0:.9g}, graph 1 nohead back lc rgb '#707070' lw 1.1 "
        "dt (8,6)\n",
        mark.x);
    if (!labels) continue;
    const double at = frame.left + frame.width * (mark.x - x.lo) / (x.hi - x.lo);
    const double width = text_width(mark.label, 13);
    std::size_t row = 0;
    while (row + 1 < occupied.size() && at - width / 2 < occupied[row] + 12) ++row;
    occupied[row] = at + width / 2;
    commands += write(layout.canvas, {at, frame.top - 14 - 20 * static_cast<double>(row), mark.label, 13,
                                      "center tc rgb '#404040'"});
  }
  return commands;
}

std::string panel_of(const std::vector<CurveFigure>& panels, std::size_t p, const Layout& layout,
                     const Range& x, std::size_t first_block) {
  const CurveFigure& panel = panels[p];
  const Frame& frame = layout.frames[p];
  const Range y = y_range(panel);
  const bool last = p + 1 == panels.size();
  std::string along;
  for (const auto& each : panels) along = each.x_label.empty() ? along : each.x_label;

  std::string commands = place(layout.canvas, frame);
  if (panel.log_y) {
    commands += fmt::format("set logscale y; set yrange [{:.9g}:{:.9g}]; set ytics 10\n", y.lo, y.hi);
  } else {
    commands += fmt::format("unset logscale y; set yrange [{:.9g}:{:.9g}]; set ytics {:g}\n", y.lo, y.hi,
                            tick_step(y.hi - y.lo, std::max(2, static_cast<int>(frame.height / 45))));
  }
  // Not gnuplot's own label, which long numbers on the axis push over the edge.
  commands += write(layout.canvas, {24, frame.top + 0.5 * frame.height,
                                    wrapped(panel.y_label, 15, frame.height), 15, "center rotate"});
  commands +=
      last ? "set format x '%g'\n" + x_label(layout.canvas, frame, along) : std::string("set format x ''\n");
  if (p > 0) commands += write(layout.canvas, {left, frame.top - 16, panel.title, 15, "left"});
  commands += marks_of(panel, layout, frame, x, p == 0);
  const bool legend = p == 0 || !same_names(panel, panels[p - 1]);
  commands += legend ? fmt::format(
                           "set key at screen {:.5f}, screen {:.5f} left top Left reverse font ',{:g}' "
                           "samplen 2 spacing 1.25\n",
                           layout.canvas.across(frame.left + frame.width + 8),
                           layout.canvas.up(frame.top - 4), legend_size)
                     : "unset key\n";
  commands += "plot ";
  for (std::size_t c = 0; c < panel.curves.size(); ++c) {
    commands += (c > 0 ? ", \\\n     " : "") +
                curve_of(panel.curves[c], c, first_block + c, panel.log_y ? 0.1 * y.lo : 0);
  }
  if (panel.curves.empty()) commands += "NaN notitle";
  return commands + "\nunset label; unset arrow\n";
}

}  // namespace

Curve trimmed(Curve curve) {
  std::size_t first = 0, last = curve.y.size();
  while (first < last && std::isnan(curve.y[first])) ++first;
  while (last > first && std::isnan(curve.y[last - 1])) --last;
  for (auto* values : {&curve.x, &curve.y}) {
    values->erase(values->begin() + static_cast<std::ptrdiff_t>(last), values->end());
    values->erase(values->begin(), values->begin() + static_cast<std::ptrdiff_t>(first));
  }
  return curve;
}

void write_curves(const std::filesystem::path& png, const std::vector<CurveFigure>& panels,
                  const Formats& formats) {
  check(panels);
  std::string note;
  for (const auto& panel : panels) note = panel.note.empty() ? note : panel.note;
  const auto layout = laid_out(panels, !panels.front().marks.empty(), note);
  const Range x = x_range(panels);
  std::string script =
      fmt::format("set xrange [{:.9g}:{:.9g}]; set xtics {:g}\n", x.lo, x.hi, tick_step(x.hi - x.lo, 10));
  script +=
      "set tics out nomirror font ',14' scale 0.6; set border 3 lw 1.1; set format y '%g'\n"
      "set grid lc rgb '#e4e4e4' lw 0.8 lt 1\nset multiplot\n";
  script += headline(layout.canvas, left, panels.front().title);
  script += foot_note(layout.canvas, left, note);
  std::size_t block = 0;
  for (std::size_t p = 0; p < panels.size(); ++p) {
    script += panel_of(panels, p, layout, x, block);
    block += panels[p].curves.size();
  }
  script += "unset multiplot\n";
  draw(png, {layout.canvas.width, layout.canvas.height, data_of(panels), script, formats});
}

}  // namespace interstice::figures
