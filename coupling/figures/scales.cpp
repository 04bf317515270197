// Void fraction against averaging length, in two panels over one axis.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/figures/gnuplot.h"
#include "coupling/figures/layout.h"

namespace interstice::figures {
namespace {

constexpr double left = 110, right = 265, top = 108, foot = 72, gap = 22;
constexpr double upper_height = 330, lower_height = 280;
constexpr double kMicro = 1e6;

const char* length_label(WindowShape window) {
  return window == WindowShape::box ? "averaging length: edge of a cube [um]"
         : window == WindowShape::sphere
             ? "averaging length: diameter of a sphere [um]"
             : "averaging length: of a Gaussian, edge of the cube of like spread [um]";
}

/// Rows with too few windows side by side come second: they are drawn thin.
std::string data_of(const voxel::ScaleReport& report) {
  const std::string head =
      "# length [um], void fraction: mean, standard deviation, least, largest; standard deviation of grains "
      "at "
      "random, of one grain\n";
  std::string trusted = head, others;
  std::string last;
  for (const auto& row : report.rows) {
    const std::string line =
        fmt::format("{:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g} {:.9g}\n", kMicro * row.length, row.mean,
                    row.sd, row.min, row.max, row.sd_random, row.sd_one_grain);
    if (row.independent >= voxel::ScaleReport::kIndependent) {
      trusted += last = line;
    } else {
      others += line;
    }
  }
  return trusted + (last.empty() ? "NaN NaN NaN NaN NaN NaN NaN\n" : "") +
         "\n\n# fewer than eight side by side\n" + last +
         (last.empty() && others.empty() ? "NaN NaN NaN NaN NaN NaN NaN\n" : others);
}

struct Decades {
  double lo = 1e-4, hi = 1;
};

Decades deviations_of(const voxel::ScaleReport& report) {
  double least = INFINITY, most = 0;
  for (const auto& row : report.rows) {
    for (const double v : {row.sd, row.sd_random, row.sd_one_grain}) {
      if (v > 1e-7) least = std::min(least, v);
      most = std::max(most, v);
    }
  }
  if (!(most > 0) || !std::isfinite(least)) return {};
  return {std::max(std::pow(10, std::floor(std::log10(least))), 1e-6),
          std::pow(10, std::ceil(std::log10(most * 1.05)))};
}

/// The lengths that the report finds, as lines through both panels; the note says what they are.
std::string marks_of(const voxel::ScaleReport& report) {
  std::string commands;
  for (const double length : {report.many_grains_length, report.random_length}) {
    if (!std::isfinite(length)) continue;
    commands += fmt::format(
        "set arrow from first {0:.9g}, graph 0 to first {0:.9g}, graph 1 nohead front lc rgb '#505050' lw "
        "1.4 "
        "dt {1}\n",
        kMicro * length, length == report.many_grains_length ? "(8,6)" : "(2,4)");
  }
  return commands;
}

std::string note_of(const ScaleFigure& figure) {
  const auto& report = figure.report;
  std::string note = figure.note;
  if (std::isfinite(report.many_grains_length))
    note += fmt::format("; dashed vertical: from {:.3g} um on averages show the packing, not single grains",
                        kMicro * report.many_grains_length);
  if (std::isfinite(report.random_length))
    note += fmt::format("; dotted vertical: from {:.3g} um on they are no more uneven than grains at random",
                        kMicro * report.random_length);
  return note;
}

struct PlotElement {
  int block;
  const char* columns;
  std::string style, title;  // title: empty for none
};

std::string marked(const std::string& colour) {
  return fmt::format("linespoints lc rgb '{}' lw 2.4 pt 7 ps 0.7", colour);
}
std::string solid(const std::string& colour) { return fmt::format("lines lc rgb '{}' lw 1.8", colour); }
std::string dashed(const std::string& colour) {
  return fmt::format("lines lc rgb '{}' lw 1.2 dt (4,4)", colour);
}

std::string plot_of(const std::vector<PlotElement>& elements) {
  std::string commands = "plot ";
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const auto& [block, columns, style, title] = elements[e];
    commands +=
        fmt::format("{}data index {} using {} with {} {}", e > 0 ? ", \\\n     " : "", block, columns, style,
                    title.empty() ? std::string("notitle") : fmt::format("title {}", text_literal(title)));
  }
  return commands + "\n";
}

std::string upper_panel(const Canvas& canvas, const Frame& frame, const voxel::ScaleReport& report, double lo,
                        double hi) {
  double least = 0, most = 1;
  for (const auto& row : report.rows) least = std::min(least, row.min), most = std::max(most, row.max);
  std::string commands = place(canvas, frame);
  commands += fmt::format("set yrange [{:.4g}:{:.4g}]; unset logscale y; set ytics {:g}\n", least, most,
                          tick_step(most - least, 7));
  commands += write(canvas, {24, frame.top + 0.5 * frame.height, "void fraction", 15, "center rotate"});
  commands += "set format x ''; unset xlabel; set xtics nomirror\n";
  if (report.median_diameter > 0) {  // the same axis in grains
    const double d = kMicro * report.median_diameter;
    commands += fmt::format(
        "set border 7; set x2range [{:.9g}:{:.9g}]; set logscale x2; set x2tics out font ',14' "
        "(0.1,0.2,0.5,1,2,5,10,20,50,100,200,500); set format x2 '%g'\n",
        lo / d, hi / d);
    commands += write(canvas, {frame.left + 0.5 * frame.width, frame.top - 42,
                               fmt::format("averaging length in median grain diameters, D50 = {:.3g} um", d),
                               14, "center"});
  }
  commands += marks_of(report);
  const std::string mean = curve_colour(0), ends = curve_colour(1);
  const auto band = [&](double shade) {
    return fmt::format("filledcurves lc rgb '{}' fs transparent solid {} noborder", mean, shade);
  };
  commands += plot_of({{0, "1:($2-$3):($2+$3)", band(0.22), "mean ± standard deviation"},
                       {1, "1:($2-$3):($2+$3)", band(0.10), ""},
                       {0, "1:2", marked(mean), "mean"},
                       {1, "1:2", dashed(mean), ""},
                       {0, "1:4", solid(ends), "least and largest"},
                       {0, "1:5", solid(ends), ""},
                       {1, "1:4", dashed(ends), ""},
                       {1, "1:5", dashed(ends),
                        fmt::format("dotted: fewer than {:g} fit", voxel::ScaleReport::kIndependent)}});
  return commands + "unset label; unset arrow; unset x2tics; set border 3\n";
}

std::string lower_panel(const Canvas& canvas, const Frame& frame, const voxel::ScaleReport& report) {
  const Decades y = deviations_of(report);
  std::string commands = place(canvas, frame);
  commands += fmt::format("set logscale y; set yrange [{:g}:{:g}]; set ytics 10\n", y.lo, y.hi);
  commands += write(canvas, {24, frame.top + 0.5 * frame.height, "standard deviation", 15, "center rotate"});
  commands += fmt::format("set format x '%g'; set xlabel {}\n", text_literal(length_label(report.window)));
  commands += marks_of(report);
  commands += plot_of({{0, "1:3", marked(curve_colour(0)), "of the void fraction"},
                       {1, "1:3", dashed(curve_colour(0)), ""},
                       {0, "1:6", solid(curve_colour(3)), "of grains placed at random"},
                       {0, "1:7", solid(curve_colour(2)), "one grain more or less"}});
  return commands + "unset label; unset arrow\n";
}

}  // namespace

void write_scales(const std::filesystem::path& png, const ScaleFigure& figure, const Formats& formats) {
  const auto& report = figure.report;
  if (report.rows.empty()) throw InputError("a figure of averaging lengths without any");
  const std::string note = note_of(figure);
  Canvas canvas;
  canvas.height = top + upper_height + gap + lower_height + foot + foot_note_height(canvas, left, note);
  const Frame upper{left, top, canvas.width - left - right, upper_height};
  const Frame lower{left, top + upper_height + gap, upper.width, lower_height};
  const double lo = kMicro * report.rows.front().length,
               hi = std::max(kMicro * report.rows.back().length, 1.5 * lo);
  std::string script = fmt::format("set logscale x; set xrange [{:.9g}:{:.9g}]\n", lo, hi);
  script +=
      "set xtics (1,2,5,10,20,50,100,200,500,1000,2000,5000,10000,20000,50000,100000)\n"
      "set tics out nomirror font ',14' scale 0.6; set border 3 lw 1.1; set format y '%g'\n"
      "set grid xtics ytics lc rgb '#e4e4e4' lw 0.8 lt 1\nset multiplot\n";
  script += headline(canvas, left, figure.title) + foot_note(canvas, left, note);
  const auto key = [&](const Frame& frame) {
    return fmt::format(
        "set key at screen {:.5f}, screen {:.5f} left top Left reverse font ',13' samplen 2 spacing 1.3\n",
        canvas.across(frame.left + frame.width + 12), canvas.up(frame.top - 4));
  };
  script += key(upper) + upper_panel(canvas, upper, report, lo, hi);
  script += key(lower) + lower_panel(canvas, lower, report);
  script += "unset multiplot\n";
  draw(png, {canvas.width, canvas.height, data_of(report), script, formats});
}

}  // namespace interstice::figures
