#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "coupling/studies/compare_figures.h"
#include "coupling/studies/moment_files.h"

namespace interstice::studies {
namespace {

/// One moment of one field in both runs, and how figures of it are named and noted.
struct Moment {
  const RunFolder &a, &b;
  const Labels& labels;
  std::string field;
  MomentPair pair;

  bool both() const { return pair.a != nullptr && pair.b != nullptr; }
  std::string file(const std::string& what) const { return fmt::format("{}_{}_{}", field, pair.name, what); }
  std::string title(const std::string& what) const {
    if (!a.simulated && !b.simulated) return what;
    return fmt::format("{}, {}{}", what, pair.name == "end" ? "at the " : "end of ", pair.name);
  }
  std::string note() const {
    std::string text = how_computed(pair.a != nullptr ? *pair.a : *pair.b);
    for (const auto& [moment, label] : {std::pair{pair.a, labels[0]}, std::pair{pair.b, labels[1]}}) {
      if (moment == nullptr || std::isnan(moment->time)) continue;
      text += fmt::format("{}{}: t = {:.6g} ms", text.empty() ? "" : "; ", label, moment->time * 1e3);
      if (!moment->phase.empty()) text += fmt::format(" ({})", moment->phase);
    }
    return text;
  }
};

std::vector<std::string> names_in(const Moment& m, const char* folder) {
  std::vector<std::string> names;
  for (const FieldMoment* side : {m.pair.a, m.pair.b}) {
    if (side == nullptr) continue;
    for (const auto& name : tables_in(side->folder / folder)) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
  }
  return names;
}

/// Whether a table of this name is there, and its path.
std::optional<std::filesystem::path> table_of(const FieldMoment* side,
                                              const std::filesystem::path& relative) {
  if (side == nullptr) return std::nullopt;
  const auto path = side->folder / relative;
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) ? std::optional(path) : std::nullopt;
}

bool same_cells(const voxel::Samples& a, const voxel::Samples& b) {
  if (a.center.size() != b.center.size() || a.axes != b.axes || a.columns != b.columns) return false;
  for (const std::size_t i : {std::size_t{0}, a.center.size() - 1}) {
    if (norm(a.center[i] - b.center[i]) > 1e-9) return false;
  }
  return true;
}

/// B - A in place of the void fractions.
voxel::Samples difference(const voxel::Samples& a, const voxel::Samples& b) {
  voxel::Samples d = b;
  for (std::size_t i = 0; i < d.void_fraction.size(); ++i) d.void_fraction[i] -= a.void_fraction[i];
  const bool averaged = a.void_fraction_averaged.size() == b.void_fraction_averaged.size();
  if (!averaged) d.void_fraction_averaged.clear();
  for (std::size_t i = 0; i < d.void_fraction_averaged.size(); ++i) {
    d.void_fraction_averaged[i] -= a.void_fraction_averaged[i];
  }
  return d;
}

/// A range symmetric about zero that holds nearly all differences, on a round number.
double symmetric_range(const std::vector<figures::SlicePanel>& panels) {
  std::vector<double> sizes;
  for (const auto& panel : panels) {
    const auto& values = panel.averaged ? panel.samples.void_fraction_averaged : panel.samples.void_fraction;
    for (const double v : values) {
      if (std::isfinite(v)) sizes.push_back(std::abs(v));
    }
  }
  if (sizes.empty()) return 1;
  const auto most = sizes.begin() + static_cast<std::ptrdiff_t>(0.99 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), most, sizes.end());
  for (const double range : {0.05, 0.1, 0.2, 0.3, 0.5}) {
    if (*most <= range) return range;
  }
  return 1;
}

void add_slices(std::vector<NamedFigure>& all, const Moment& m) {
  const auto walls_a = m.pair.a == nullptr ? std::vector<io::WallPose>{} : walls_at(m.a, m.pair.a->time);
  const auto walls_b = m.pair.b == nullptr ? std::vector<io::WallPose>{} : walls_at(m.b, m.pair.b->time);
  figures::SliceFigure plain, averaged, change;
  for (const auto& name : names_in(m, "slices")) {
    const std::filesystem::path relative = std::filesystem::path("slices") / (name + ".csv");
    std::optional<voxel::Samples> samples[2];
    const FieldMoment* sides[2] = {m.pair.a, m.pair.b};
    for (std::size_t r = 0; r < 2; ++r) {
      const auto path = table_of(sides[r], relative);
      if (!path) continue;
      samples[r] = read_slice(*path);
      const auto title = fmt::format("{}: {}", m.labels[r], spoken(name));
      const auto& walls = r == 0 ? walls_a : walls_b;
      plain.panels.push_back({title, *samples[r], false, walls});
      if (!samples[r]->void_fraction_averaged.empty())
        averaged.panels.push_back({title, *samples[r], true, walls});
    }
    if (samples[0] && samples[1] && same_cells(*samples[0], *samples[1])) {
      const auto d = difference(*samples[0], *samples[1]);
      change.panels.push_back({spoken(name), d, !d.void_fraction_averaged.empty(), {}});
    }
  }
  const auto keep = [&](figures::SliceFigure& figure, const char* file, const std::string& title) {
    if (figure.panels.empty()) return;
    figure.title = m.title(title);
    figure.note = m.note();
    all.push_back({m.file(file), std::move(figure)});
  };
  averaged.contours = {0.4, 0.5, 0.6};
  averaged.colour_label = "void fraction, averaged";
  change.hi = symmetric_range(change.panels);
  change.lo = -change.hi;
  change.diverging = true;
  const bool of_averages = !change.panels.empty() && change.panels.front().averaged;
  change.colour_label = fmt::format("{} − {}", m.labels[1], m.labels[0]);
  keep(plain, "slices", "Void fraction");
  keep(averaged, "slices_averaged", "Averaged void fraction (lines: 0.4, 0.5, 0.6)");
  keep(change, "slices_difference",
       of_averages ? "Difference of averaged void fraction" : "Difference of void fraction");
}

/// A panel with the column `value` against `at` of one table of A and of B.
figures::CurveFigure overlay(const Moment& m, const std::filesystem::path& relative, const std::string& at,
                             const std::string& value, double scale) {
  figures::CurveFigure panel;
  const FieldMoment* sides[2] = {m.pair.a, m.pair.b};
  for (std::size_t r = 0; r < 2; ++r) {
    const auto path = table_of(sides[r], relative);
    if (!path) continue;
    const Table table = read_table(*path);
    if (!table.has(value)) continue;
    figures::Curve curve{m.labels[r], table.numbers(at), line_values(table, value)};
    for (double& x : curve.x) x *= 1e3;
    for (double& y : curve.y) y *= scale;
    panel.curves.push_back(figures::trimmed(std::move(curve)));
  }
  return panel;
}

std::pair<double, double> fraction_range(const figures::CurveFigure& panel) {
  double lo = 0, hi = 1;
  for (const auto& curve : panel.curves) {
    for (const double y : curve.y) {
      if (!std::isfinite(y)) continue;
      lo = std::min(lo, y);
      hi = std::max(hi, y);
    }
  }
  return {lo, hi};
}

/// Lines along one axis share a figure; one for the voxels' own values, one for the averaged.
void add_lines(std::vector<NamedFigure>& all, const Moment& m) {
  constexpr std::string_view axes = "xyz";
  for (const char* value : {"void_fraction", "void_fraction_averaged"}) {
    const bool averaged = value == std::string_view("void_fraction_averaged");
    std::map<int, std::vector<figures::CurveFigure>> by_axis;
    for (const auto& name : names_in(m, "lines")) {
      const int axis = axis_of(name);
      if (axis < 0) continue;
      auto panel = overlay(m, std::filesystem::path("lines") / (name + ".csv"),
                           fmt::format("{}_m", axes[axis]), value, 1);
      if (panel.curves.empty()) continue;
      panel.title = spoken(name);
      panel.y_label = "void fraction";
      panel.y_range = fraction_range(panel);
      by_axis[axis].push_back(std::move(panel));
    }
    for (auto& [axis, panels] : by_axis) {
      panels.back().x_label = fmt::format("{} [mm]", axes[axis]);
      panels.back().note = m.note();
      const std::string what = averaged ? "Averaged void fraction " : "Void fraction ";
      panels.front().title = m.title(what + panels.front().title);
      all.push_back(
          {m.file(fmt::format("lines_{}{}", axes[axis], averaged ? "_averaged" : "")), std::move(panels)});
    }
  }
}

void add_profiles(std::vector<NamedFigure>& all, const Moment& m) {
  struct Number {
    const char *column, *label;
    double scale;
  };
  const Number numbers[] = {{"solid_fraction", "solid fraction in the gap", 1},
                            {"solid_height_m", "solid height [µm]", 1e6},
                            {"surface_height_m", "surface height [µm]", 1e6},
                            {"solid_fraction_below_surface", "solid fraction below surface", 1}};
  for (const char* axis : {"x", "y"}) {
    std::vector<figures::CurveFigure> panels;
    for (const auto& number : numbers) {
      auto panel = overlay(m, fmt::format("profile_{}.csv", axis), fmt::format("{}_m", axis), number.column,
                           number.scale);
      if (panel.curves.empty()) continue;
      panel.y_label = number.label;
      panels.push_back(std::move(panel));
    }
    if (panels.empty()) continue;
    panels.front().title = m.title(fmt::format("The layer along {}", axis));
    panels.back().x_label = fmt::format("{} [mm]", axis);
    panels.back().note = m.note();
    all.push_back({m.file(fmt::format("profile_{}", axis)), std::move(panels)});
  }
}

/// The layer's numbers from frame to frame.
void add_history(std::vector<NamedFigure>& all, const RunFolder& a, const RunFolder& b, const Labels& labels,
                 const std::string& field) {
  const std::pair<const char*, const char*> numbers[] = {
      {"solid_fraction_gap", "solid fraction in the gap"},
      {"solid_fraction_sd", "its sd over columns"},
      {"solid_fraction_below_surface", "solid fraction below surface"},
      {"void_fraction_mean", "mean void fraction"}};
  const TimeZero zero = time_zero(a, b);
  std::vector<figures::CurveFigure> panels;
  std::size_t longest = 0;
  for (const auto& [column, label] : numbers) {
    figures::CurveFigure panel;
    panel.y_label = label;
    for (const RunFolder* run : {&a, &b}) {
      const std::size_t r = run == &a ? 0 : 1;
      const FieldRecord* record = run->field(field);
      if (record == nullptr || !record->numbers.has(column)) continue;
      figures::Curve curve{labels[r], {}, {}};
      for (const auto& moment : record->moments) {
        curve.x.push_back(1e3 * (moment.time - (r == 0 ? zero.a : zero.b)));
        curve.y.push_back(record->numbers.numbers(column)[moment.row]);
      }
      longest = std::max(longest, curve.x.size());
      panel.curves.push_back(std::move(curve));
    }
    panel.marks = phase_marks(a, b, labels, zero);
    if (!panel.curves.empty()) panels.push_back(std::move(panel));
  }
  if (longest < 2) return;
  panels.front().title = fmt::format("Field '{}' over time", field);
  panels.back().x_label = zero.label();
  all.push_back({field + "_over_time", std::move(panels)});
}

}  // namespace

std::vector<NamedFigure> field_figures(const RunFolder& a, const RunFolder& b, const Labels& labels) {
  std::vector<NamedFigure> all;
  for (const auto& field : fields_of_both(a, b)) {
    for (const auto& pair : moment_pairs(a, b, field)) {
      const Moment m{a, b, labels, field, pair};
      // The end is a moment of its own only where the runs ended in different phases, or have none.
      if (pair.name == "end" && m.both() && pair.a->phase == pair.b->phase && !pair.a->phase.empty())
        continue;
      add_slices(all, m);
      add_lines(all, m);
      add_profiles(all, m);
    }
    add_history(all, a, b, labels, field);
  }
  return all;
}

}  // namespace interstice::studies
