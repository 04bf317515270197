// Grains as discs to scale, seen from above or from the side.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/figures/gnuplot.h"
#include "coupling/figures/layout.h"
#include "coupling/figures/outline.h"

namespace interstice::figures {
namespace {

constexpr double left = 100, right = 165, top = 66, row_gap = 48, foot = 66;
constexpr double full_width = Canvas{}.width - left - right;

/// The figure's axes: what runs right, what runs up, what runs away from the eye (and whether far is low or
/// high).
struct Sight {
  std::array<int, 2> axes;
  int depth;
  double far;  // +1: grains with larger coordinates are farther away
};

Sight sight_of(GrainView view) {
  return view == GrainView::above ? Sight{{0, 1}, 2, -1.0} : Sight{{0, 2}, 1, 1.0};
}

struct Colouring {
  std::vector<double> value;  // one per grain of the frame
  std::string label;
  double lo = 0, hi = 1;
  bool integers = false;
};

Colouring colouring(const io::ParticleFrame& frame, const GrainFigure& figure,
                    const std::vector<std::size_t>& shown) {
  Colouring c;
  c.value.resize(frame.size());
  switch (figure.colour) {
    case GrainColour::diameter:
      c.label = "diameter [µm]";
      for (const std::size_t i : shown) c.value[i] = 2e6 * frame.radius[i];
      break;
    case GrainColour::speed:
      if (frame.vx.size() != frame.size())
        throw InputError("these particles have no velocities to be coloured by");
      c.label = "speed [mm/s]";
      for (const std::size_t i : shown) c.value[i] = 1e3 * norm(Vec3d{frame.vx[i], frame.vy[i], frame.vz[i]});
      break;
    case GrainColour::layer:
      if (frame.layer.size() != frame.size())
        throw InputError("these particles have no layers to be coloured by");
      c.label = "layer";
      c.integers = true;
      for (const std::size_t i : shown) c.value[i] = frame.layer[i];
      break;
  }
  if (figure.range) {
    std::tie(c.lo, c.hi) = *figure.range;
    if (!(c.lo < c.hi))
      throw InputError(fmt::format("colour range {} to {}: the first must be the smaller", c.lo, c.hi));
    return c;
  }
  if (!shown.empty()) {
    const auto less = [&](std::size_t a, std::size_t b) { return c.value[a] < c.value[b]; };
    c.lo = c.value[*std::min_element(shown.begin(), shown.end(), less)];
    c.hi = c.value[*std::max_element(shown.begin(), shown.end(), less)];
  }
  if (figure.colour == GrainColour::speed) c.lo = 0;
  if (c.integers) {  // one colour a layer, its number in the middle
    c.lo -= 0.5;
    c.hi += 0.5;
  }
  if (!(c.hi - c.lo > 1e-9 * std::abs(c.hi))) {
    c.lo -= 0.5;
    c.hi += 0.5;
  }
  return c;
}

/// Indices of the grains in the window, the farthest first, so that nearer discs cover them.
std::vector<std::size_t> far_to_near(const io::ParticleFrame& frame, const GrainFigure& figure,
                                     const Sight& sight) {
  std::vector<std::size_t> shown;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (figure.window.contains({frame.x[i], frame.y[i], frame.z[i]})) shown.push_back(i);
  }
  const auto& depth = sight.depth == 2 ? frame.z : frame.y;
  std::stable_sort(shown.begin(), shown.end(),
                   [&](std::size_t a, std::size_t b) { return sight.far * depth[a] > sight.far * depth[b]; });
  return shown;
}

/// A long thin window in as many rows as fit a page: more rows, larger grains.
int rows_for(const Extent& window) {
  const double aspect = window.width() / window.height();
  if (aspect <= 6) return 1;
  int rows = 1;
  for (int r = 2; r <= 6; ++r) {
    if (r * (r * full_width / aspect + row_gap) <= 950) rows = r;
  }
  return rows;
}

struct Layout {
  Canvas canvas;
  std::vector<Frame> frames;
  std::vector<Extent> parts;  // [m] what each row shows
  LengthUnit unit;
};

Layout laid_out(const Extent& window, const std::string& note) {
  Layout layout;
  const int rows = rows_for(window);
  const double part = window.width() / rows;
  const double width = std::min(full_width, 700 * part / window.height());
  const double height = std::max(30.0, width * window.height() / part);
  layout.unit = length_unit(window.width());
  for (int r = 0; r < rows; ++r) {
    layout.frames.push_back({left, top + r * (height + row_gap), width, height});
    layout.parts.push_back(
        {{window.lo[0] + r * part, window.lo[1]}, {window.lo[0] + (r + 1) * part, window.hi[1]}});
  }
  layout.canvas.width = std::max(700.0, left + width + right);
  layout.canvas.height =
      layout.frames.back().top + height + foot + foot_note_height(layout.canvas, left, note);
  return layout;
}

std::string data_of(const io::ParticleFrame& frame, const std::vector<std::size_t>& shown, const Sight& sight,
                    const Colouring& colour, double scale) {
  const std::array<const std::vector<double>*, 3> position{&frame.x, &frame.y, &frame.z};
  const auto &across = *position[sight.axes[0]], &up = *position[sight.axes[1]];
  std::string data = fmt::format("# {} grains, the farthest first\n# {} {} radius {}\n", shown.size(),
                                 "xyz"[sight.axes[0]], "xyz"[sight.axes[1]], colour.label);
  for (const std::size_t i : shown) {
    data += fmt::format("{:.7g} {:.7g} {:.6g} {:.6g}\n", across[i] * scale, up[i] * scale,
                        frame.radius[i] * scale, colour.value[i]);
  }
  if (shown.empty()) data += "NaN NaN NaN NaN\n";
  return data;
}

std::string row_of(const io::ParticleFrame& frame, const Layout& layout, std::size_t r, const Sight& sight) {
  const Extent& part = layout.parts[r];
  const Frame& place_of = layout.frames[r];
  const double scale = layout.unit.per_metre;
  const bool last = r + 1 == layout.parts.size();
  std::string commands = place(layout.canvas, place_of);
  for (std::size_t k = 0; k < 2; ++k) {
    const double lo = part.lo[k] * scale, hi = part.hi[k] * scale;
    const double pixels = k == 0 ? place_of.width : place_of.height;
    const double step = tick_step(hi - lo, std::clamp(static_cast<int>(pixels / (k == 0 ? 90 : 45)), 1, 12));
    commands +=
        fmt::format("set {0}range [{1:.8g}:{2:.8g}]; set {0}tics {3:g}\n", k == 0 ? "x" : "y", lo, hi, step);
  }
  const auto name = [&](std::size_t k) {
    return fmt::format("{} [{}]", "xyz"[sight.axes[k]], layout.unit.name);
  };
  commands += y_label(layout.canvas, place_of, name(1));
  if (last) commands += x_label(layout.canvas, place_of, name(0));
  commands += edges(silhouette(frame.walls, sight.depth, sight.axes, part), {scale, scale});
  return commands +
         "plot data using 1:2:3:4 with circles fillstyle solid 1.0 border lc rgb '#202020' lc palette lw "
         "0.5\n"
         "unset label; unset object; unset colorbox\n";
}

std::string colour_axis(const Colouring& colour) {
  const double step = tick_step(colour.hi - colour.lo, 6);
  std::string commands = fmt::format("set cbrange [{:g}:{:g}]\n", colour.lo, colour.hi);
  if (!colour.integers)
    return sequential_palette() + commands + fmt::format("set cbtics {:g} font ',14'\n", step);
  const int bands = static_cast<int>(std::clamp(std::lround(colour.hi - colour.lo), 1L, 1000L));
  return banded_palette(bands) + commands +
         fmt::format("set cbtics {:g},{:g} font ',14'\n", std::ceil(colour.lo),
                     std::max(1.0, std::ceil(step)));
}

}  // namespace

void write_grains(const std::filesystem::path& png, const io::ParticleFrame& frame, const GrainFigure& figure,
                  const Formats& formats) {
  const Vec3d size = figure.window.size();
  if (!(size.x > 0 && size.y > 0 && size.z > 0)) throw InputError("the window to show grains in is empty");
  const Sight sight = sight_of(figure.view);
  const Extent window{{figure.window.lo[sight.axes[0]], figure.window.lo[sight.axes[1]]},
                      {figure.window.hi[sight.axes[0]], figure.window.hi[sight.axes[1]]}};
  const auto shown = far_to_near(frame, figure, sight);
  const Colouring colour = colouring(frame, figure, shown);
  const Layout layout = laid_out(window, figure.note);

  std::string script = colour_axis(colour);
  script +=
      "unset key; set tics out nomirror font ',14' scale 0.6; set border lw 1.1; set format '%g'\n"
      "set multiplot\n";
  script += headline(layout.canvas, left, figure.title);
  script += foot_note(layout.canvas, left, figure.note);
  const double bottom = layout.frames.back().top + layout.frames.back().height;
  const Frame bar{layout.canvas.width - right + 34, top, 22, std::clamp(bottom - top, 120.0, 560.0)};
  script += colour_bar(layout.canvas, bar, colour.label);
  for (std::size_t r = 0; r < layout.parts.size(); ++r) script += row_of(frame, layout, r, sight);
  script += "unset multiplot\n";
  draw(png, {layout.canvas.width, layout.canvas.height,
             data_of(frame, shown, sight, colour, layout.unit.per_metre), script, formats});
}

}  // namespace interstice::figures
