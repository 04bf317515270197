// Figures as PNG (and PDF, SVG) through gnuplot; beside each figure its data and the script that drew it
// (FIGURE.gp, FIGURE.dat). Every write_* makes the folder it needs, throws InputError where the figure itself
// makes no sense (nothing to draw, a range that is none) and RunError where it cannot be drawn (gnuplot
// missing or failing, a folder that cannot be written). See docs/FIGURES.md.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/figures/formats.h"
#include "coupling/io/particle_frame.h"
#include "voxel/sample.h"
#include "voxel/scales.h"
#include "voxel/solids.h"

namespace interstice::figures {

/// A filled map of void fraction on one or more slices, one panel each, one shared colour bar and fixed
/// range.
struct SlicePanel {
  std::string title;  // "X2: x = 9 mm"
  voxel::Samples samples;
  bool averaged = false;            // draw void_fraction_averaged instead of void_fraction
  std::vector<io::WallPose> walls;  // outlines, cut by the slice
  voxel::Solids solids = {};        // further ones
  std::vector<double> values{};     // drawn instead, one a cell, NaN stays blank; empty: void fraction
};
struct SliceFigure {
  std::string title;
  std::string note;  // printed small: voxel, averaging length, method
  std::vector<SlicePanel> panels;
  double lo = 0, hi = 1;
  std::vector<double> contours;  // levels drawn as lines, on averaged panels where there are any
  std::string colour_label = "void fraction";
  bool diverging = false;  // for differences: two-sided palette, white in the middle of [lo, hi]
};
void write_slices(const std::filesystem::path& png, const SliceFigure& figure, const Formats& formats = {});

/// Curves over a common axis.
struct Curve {
  std::string name;
  std::vector<double> x, y;  // NaN breaks the line
  bool steps = false;        // a histogram's outline: x are the middles of its bins
};
/// Without what is NaN at either end: an axis need not reach there.
Curve trimmed(Curve curve);
struct CurveFigure {
  std::string title, x_label, y_label, note;
  std::vector<Curve> curves;
  std::optional<std::pair<double, double>> y_range;
  bool log_y = false;  // needs a y_range above zero
  struct Mark {
    double x;
    std::string label;
  };  // vertical lines (ends of phases)
  std::vector<Mark> marks;
};
/// `panels` stacked one above the other, sharing their x axis. The first panel's title heads the figure, the
/// titles of the others their panels; the last non-empty x label and note are printed once, below.
void write_curves(const std::filesystem::path& png, const std::vector<CurveFigure>& panels,
                  const Formats& formats = {});

enum class GrainView { above, side };  // seen along -z, along +y
enum class GrainColour { diameter, speed, layer };
struct GrainFigure {
  std::string title;
  GrainView view = GrainView::above;
  GrainColour colour = GrainColour::diameter;
  Box window;                                      // what to show [m]; grains outside are left out
  std::optional<std::pair<double, double>> range;  // of the colour, in um or mm/s
  std::string note;                                // printed small
};
/// Grains as discs to scale, farther ones first, walls as outlines. A long thin window is cut into rows, one
/// below the other, so that single grains can still be told apart.
void write_grains(const std::filesystem::path& png, const io::ParticleFrame& frame, const GrainFigure& figure,
                  const Formats& formats = {});

/// A quantity over place and time, one row of cells a moment.
struct MapFigure {
  std::string title, x_label, y_label, colour_label, note;
  std::vector<double> x;                    // the cells' centres, equally spaced
  std::vector<double> y;                    // moments, rising; rows reach to half way between them
  std::vector<std::vector<double>> values;  // [row][column]; NaN stays blank
  double lo = 0, hi = 1;
};
void write_map(const std::filesystem::path& png, const MapFigure& figure, const Formats& formats = {});

/// Void fraction against averaging length: mean, standard deviation and extremes, and below them the standard
/// deviation beside that of grains placed at random and of one grain more or less.
struct ScaleFigure {
  std::string title, note;
  voxel::ScaleReport report;
};
void write_scales(const std::filesystem::path& png, const ScaleFigure& figure, const Formats& formats = {});

/// True when gnuplot is found on PATH. Where it is not, callers skip their figures and say so once.
bool plotting_available();

}  // namespace interstice::figures
