// Maps of a quantity over place and time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/figures/gnuplot.h"
#include "coupling/figures/layout.h"

namespace interstice::figures {
namespace {

constexpr double right = 165, top = 62, foot = 72, plot_height = 470;

void check(const MapFigure& figure) {
  if (figure.x.empty() || figure.y.empty()) throw InputError("a map without cells");
  if (figure.values.size() != figure.y.size())
    throw InputError("a map whose rows and moments differ in number");
  for (const auto& row : figure.values) {
    if (row.size() != figure.x.size()) throw InputError("a map whose rows differ in length");
  }
  for (std::size_t i = 1; i < figure.y.size(); ++i) {
    if (!(figure.y[i] > figure.y[i - 1])) throw InputError("a map whose moments do not rise");
  }
  if (!(figure.lo < figure.hi)) {
    throw InputError(
        fmt::format("colour range {} to {}: the first must be the smaller", figure.lo, figure.hi));
  }
}

/// Half way between neighbours; the outer edges as far out as the nearest inner ones.
std::vector<double> edges_of(const std::vector<double>& centres) {
  if (centres.size() == 1) return {centres[0] - 0.5, centres[0] + 0.5};
  std::vector<double> edges{centres[0] - 0.5 * (centres[1] - centres[0])};
  for (std::size_t i = 1; i < centres.size(); ++i) edges.push_back(0.5 * (centres[i - 1] + centres[i]));
  edges.push_back(centres.back() + 0.5 * (centres.back() - centres[centres.size() - 2]));
  return edges;
}

bool equally_spaced(const std::vector<double>& values) {
  if (values.size() < 2) return false;
  const double step = (values.back() - values.front()) / static_cast<double>(values.size() - 1);
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (std::abs(values[i] - values[i - 1] - step) > 0.01 * step) return false;
  }
  return true;
}

std::string data_of(const MapFigure& figure, const std::vector<double>& x, const std::vector<double>& y) {
  std::string data = fmt::format("# {} over {} and {}\n# x y value, then the cell's edges: x0 x1 y0 y1\n",
                                 figure.colour_label, figure.x_label, figure.y_label);
  for (std::size_t r = 0; r < figure.y.size(); ++r) {
    if (r > 0) data += "\n";
    for (std::size_t c = 0; c < figure.x.size(); ++c) {
      const double value = figure.values[r][c];
      data += fmt::format("{:.9g} {:.9g} {} {:.9g} {:.9g} {:.9g} {:.9g}\n", figure.x[c], figure.y[r],
                          std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string("NaN"), x[c],
                          x[c + 1], y[r], y[r + 1]);
    }
  }
  return data;
}

/// Evenly spaced cells make a bitmap, which has no seams but knows no blanks. Others are boxes, each drawn a
/// little into the next, which then covers what is too much.
std::string plot_of(const MapFigure& figure, double x_step) {
  const auto has_blanks = [](const auto& row) {
    return std::any_of(row.begin(), row.end(), [](double v) { return !std::isfinite(v); });
  };
  const bool blanks = std::any_of(figure.values.begin(), figure.values.end(), has_blanks);
  if (!blanks && equally_spaced(figure.x) && equally_spaced(figure.y))
    return fmt::format("plot data using 1:2:3 with {}\n", cells_style(figure.x.size() * figure.y.size()));
  return fmt::format(
      "plot data using 1:2:4:($5+{:.6g}):6:($7+0.1*($7-$6)):3 with boxxyerror fillstyle solid 1.0 noborder "
      "lc palette\n",
      0.1 * x_step);
}

/// How wide the numbers beside the y axis print.
double tics_width(double lo, double hi, double step) {
  double widest = 0;
  for (double n = std::ceil(lo / step); n * step <= hi; ++n)
    widest = std::max(widest, text_width(fmt::format("{:g}", n * step), 14));
  return widest;
}

}  // namespace

void write_map(const std::filesystem::path& png, const MapFigure& figure, const Formats& formats) {
  check(figure);
  const auto x = edges_of(figure.x), y = edges_of(figure.y);
  const double y_step = tick_step(y.back() - y.front(), 10);
  const double y_label_away = std::max(80.0, tics_width(y.front(), y.back(), y_step) + 32),
               left = y_label_away + 30;
  Canvas canvas;
  canvas.height = top + plot_height + foot + foot_note_height(canvas, left, figure.note);
  const Frame frame{left, top, canvas.width - left - right, plot_height};
  std::string script = sequential_palette();
  script += fmt::format("set cbrange [{:g}:{:g}]; set cbtics {:g} font ',14'\n", figure.lo, figure.hi,
                        tick_step(figure.hi - figure.lo, 6));
  script += "unset key; set tics out nomirror font ',14' scale 0.6; set border lw 1.1; set format '%g'\n";
  script += headline(canvas, left, figure.title) + foot_note(canvas, left, figure.note);
  script += place(canvas, frame);
  script += colour_bar(canvas, {canvas.width - right + 34, top, 22, plot_height}, figure.colour_label);
  script +=
      fmt::format("set xrange [{:.9g}:{:.9g}]; set xtics {:g}; set yrange [{:.9g}:{:.9g}]; set ytics {:g}\n",
                  x.front(), x.back(), tick_step(x.back() - x.front(), 9), y.front(), y.back(), y_step);
  script += x_label(canvas, frame, figure.x_label) + y_label(canvas, frame, figure.y_label, y_label_away);
  script += plot_of(figure, x[1] - x[0]);
  draw(png, {canvas.width, canvas.height, data_of(figure, x, y), script, formats});
}

}  // namespace interstice::figures
