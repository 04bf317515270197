#include "coupling/figures/quantity_slices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "coupling/figures/figures.h"

namespace interstice::figures {
namespace {

constexpr double kLeftOut = 0.005;  // of the voxels, beyond the colours

/// A figure: which of the samples' quantities are its panels, and how they are called.
struct Subject {
  std::string file, title;
  std::vector<std::size_t> panels;       // indices into the samples' quantities
  std::vector<std::string> panel_names;  // empty: one panel, named after what it is
  bool signed_values = false;
};

struct Unit {
  double factor = 1;
  std::string name;  // empty: none
};

/// A unit in which the largest magnitude is a number between 1 and 1000, or the nearest to that.
Unit unit_for(const std::string& si, double largest) {
  struct Prefix {
    const char* name;
    double factor;
  };
  constexpr std::array<Prefix, 5> prefixes{{{"M", 1e-6}, {"k", 1e-3}, {"", 1}, {"m", 1e3}, {"µ", 1e6}}};
  if (si == "1") return {};
  const bool squared = si == "m^2/s^2";
  const std::string name = squared ? "m²/s²" : si;
  for (const Prefix& prefix : prefixes) {
    if (si.front() == 'm' && prefix.factor < 1) continue;  // no kilometres
    const double factor = squared ? prefix.factor * prefix.factor : prefix.factor;
    if (largest * factor >= 1) return {factor, prefix.name + name};
  }
  return si.front() == 'm' ? Unit{squared ? 1e12 : 1e6, "µ" + name} : Unit{1, name};
}

std::string words_of(const std::string& name) {
  std::string words = name;
  std::replace(words.begin(), words.end(), '_', ' ');
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z')
    words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

/// Velocity by its components, stress by its pressure, classes all in one.
std::vector<Subject> subjects_of(const voxel::Samples& samples) {
  constexpr std::string_view classes = "solid_fraction_";
  std::vector<Subject> subjects;
  Subject velocity{"velocity", "Velocity", {}, {}, true},
      groups{"classes", "Solid fraction by class", {}, {}};
  for (std::size_t q = 0; q < samples.quantities.size(); ++q) {
    const std::string& name = samples.quantities[q].name;
    if (name.starts_with("velocity_")) {
      velocity.panels.push_back(q);
      velocity.panel_names.push_back("along " + name.substr(9));
    } else if (name.starts_with(classes)) {
      groups.panels.push_back(q);
      groups.panel_names.push_back(words_of(name.substr(classes.size())));
    } else if (!name.starts_with("stress_") && name != "bonded_mask") {
      subjects.push_back({name,
                          name == "temperature" ? "Granular temperature" : words_of(name),
                          {q},
                          {},
                          name == "pressure"});
    }
  }
  for (Subject* many : {&velocity, &groups})
    if (!many->panels.empty()) subjects.push_back(std::move(*many));
  return subjects;
}

/// What a quantity's panels draw: components and classes by their averages where there are any, all else per
/// voxel and averaged.
std::vector<const std::vector<double>*> drawn(const Subject& subject, const voxel::SampledQuantity& q) {
  if (q.averaged.empty()) return {&q.values};
  if (!subject.panel_names.empty()) return {&q.averaged};
  return {&q.values, &q.averaged};
}

/// The end of the colours, and the largest magnitude of all.
struct Scale {
  double least = 0, end = 0, largest = 0;
};

Scale scale_of(const QuantitySlices& figures, const Subject& subject) {
  std::vector<double> values;
  for (const QuantitySlice& slice : figures.slices)
    for (const std::size_t q : subject.panels)
      for (const auto* panel : drawn(subject, slice.samples->quantities[q]))
        std::copy_if(panel->begin(), panel->end(), std::back_inserter(values),
                     [](double value) { return std::isfinite(value); });
  Scale scale;
  if (values.empty()) return scale;
  scale.least = *std::min_element(values.begin(), values.end());
  for (double& value : values) value = std::abs(value);
  scale.largest = *std::max_element(values.begin(), values.end());
  const auto at = static_cast<std::ptrdiff_t>((1 - kLeftOut) * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  scale.end = values[static_cast<std::size_t>(at)];
  if (scale.end == 0) scale.end = scale.largest;
  return scale;
}

/// Up to two digits: 0.0123 becomes 0.013.
double rounded_up(double value) {
  if (!(value > 0)) return 1;
  const double unit = std::pow(10, std::floor(std::log10(value)) - 1);
  return unit * std::ceil(value / unit - 1e-9);
}

std::vector<double> scaled(const std::vector<double>& values, double factor) {
  std::vector<double> out = values;
  for (double& value : out) value *= factor;
  return out;
}

SliceFigure figure_of(const QuantitySlices& figures, const QuantitySlice& slice, const Subject& subject,
                      const Scale& scale) {
  const auto& all = slice.samples->quantities;
  const Unit unit = unit_for(all[subject.panels.front()].units, scale.end);
  SliceFigure figure;
  figure.title = fmt::format("{} at {}", subject.title, slice.place);
  figure.note = figures.note;
  std::string label = subject.title;
  label[0] = static_cast<char>(label[0] - 'A' + 'a');
  figure.colour_label = unit.name.empty() ? label : fmt::format("{} [{}]", label, unit.name);
  figure.hi = rounded_up(unit.factor * scale.end);
  if (subject.signed_values && scale.least < 0) {
    figure.lo = -figure.hi;
    figure.diverging = true;
  }
  if (scale.largest * unit.factor > figure.hi * (1 + 1e-9))
    figure.note +=
        fmt::format("; colours end at {:g}, largest value {:.3g}", figure.hi, scale.largest * unit.factor);
  const auto add = [&](const std::string& title, const std::vector<double>& values) {
    SlicePanel panel{title,         *slice.samples, false,
                     figures.walls, figures.solids, scaled(values, unit.factor)};
    figure.panels.push_back(std::move(panel));
  };
  for (std::size_t p = 0; p < subject.panels.size(); ++p) {
    const auto& q = all[subject.panels[p]];
    for (const auto* values : drawn(subject, q)) {
      const std::string& way = values == &q.averaged ? figures.averaged_name : figures.voxel_name;
      add(subject.panel_names.empty() ? way : fmt::format("{}, {}", subject.panel_names[p], way), *values);
    }
  }
  return figure;
}

}  // namespace

void write_quantity_slices(const std::filesystem::path& folder, const QuantitySlices& figures,
                           const Formats& formats) {
  if (figures.slices.empty()) return;
  for (const Subject& subject : subjects_of(*figures.slices.front().samples)) {
    const Scale scale = scale_of(figures, subject);
    for (const QuantitySlice& slice : figures.slices)
      write_slices(folder / fmt::format("{}-{}.png", slice.stem, subject.file),
                   figure_of(figures, slice, subject, scale), formats);
  }
}

}  // namespace interstice::figures
