#include "coupling/io/field_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace interstice::io {
namespace {

using Text = fmt::memory_buffer;

void add(Text& out, double value, char after = ',') {
  fmt::format_to(std::back_inserter(out), "{}{}", value, after);
}

// A value that came out of a grid of floats is printed as the float it is: 0.3, not 0.30000001192092896.
void add_stored(Text& out, double value, char after = ',') {
  const auto stored = static_cast<float>(value);
  if (static_cast<double>(stored) == value) {
    fmt::format_to(std::back_inserter(out), "{}{}", stored, after);
  } else {
    add(out, value, after);
  }
}

// One coordinate of the voxels of a slice: the same along a row, or the same in every row, so its digits are
// found once.
class Coordinate {
 public:
  explicit Coordinate(std::size_t columns) : known_(columns) {}

  void add(Text& out, std::size_t column, double value) {
    Known& known = known_[column];
    if (known.value != value) {
      const Known& beside = known_[column > 0 ? column - 1 : 0];
      known = beside.value == value ? beside : Known{value, fmt::format("{},", value)};
    }
    out.append(known.text);
  }

 private:
  struct Known {
    double value = std::numeric_limits<double>::quiet_NaN();
    std::string text;
  };
  std::vector<Known> known_;
};

std::string heading(const voxel::Samples& samples) {
  std::string head = "x_m,y_m,z_m,void_fraction,solid_fraction,mass_density_kg_m3";
  if (!samples.void_fraction_averaged.empty()) head += ",void_fraction_averaged";
  for (const auto& q : samples.quantities) {
    head += fmt::format(",{}", column_name(q.name, q.units));
    if (!q.averaged.empty()) head += fmt::format(",{}", column_name(q.name + "_averaged", q.units));
  }
  head += '\n';
  return head;
}

}  // namespace

std::string column_name(const std::string& quantity, const std::string& units) {
  if (units == "1") return quantity;
  std::string name = quantity + "_";
  for (const char c : units) {
    if (c != '^') name += c == '/' ? '_' : c;
  }
  return name;
}

std::string csv_of(const voxel::Samples& samples) {
  const bool dense = !samples.mass_density.empty();
  std::vector<const std::vector<double>*> others;
  if (!samples.void_fraction_averaged.empty()) others.push_back(&samples.void_fraction_averaged);
  for (const auto& q : samples.quantities) {
    others.push_back(&q.values);
    if (!q.averaged.empty()) others.push_back(&q.averaged);
  }
  const auto columns = static_cast<std::size_t>(std::max<std::int64_t>(1, samples.columns));
  std::vector<Coordinate> coordinates(3, Coordinate(columns));
  Text out;
  out.append(heading(samples));
  for (std::size_t i = 0; i < samples.center.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis)
      coordinates[static_cast<std::size_t>(axis)].add(out, i % columns, samples.center[i][axis]);
    add_stored(out, samples.void_fraction[i]);
    add_stored(out, samples.solid_fraction[i]);
    add_stored(out, dense ? samples.mass_density[i] : std::nan(""), others.empty() ? '\n' : ',');
    for (const auto* column : others) add_stored(out, (*column)[i], column == others.back() ? '\n' : ',');
  }
  return fmt::to_string(out);
}

std::string csv_of(const voxel::LayerColumns& columns) {
  Text out;
  out.append(
      std::string_view("x_m,y_m,solid_fraction,mass_density_kg_m3,solid_height_m,surface_height_m,"
                       "solid_fraction_below_surface\n"));
  const bool dense = !columns.mass_density.empty();
  for (std::size_t j = 0; j < columns.y.size(); ++j) {
    for (std::size_t i = 0; i < columns.x.size(); ++i) {
      const std::size_t c = i + columns.x.size() * j;
      add(out, columns.x[i]);
      add(out, columns.y[j]);
      add(out, columns.solid_fraction[c]);
      add(out, dense ? columns.mass_density[c] : std::nan(""));
      add(out, columns.solid_height[c]);
      add(out, columns.surface_height[c]);
      add(out, columns.solid_fraction_below_surface[c], '\n');
    }
  }
  return fmt::to_string(out);
}

std::string csv_of(const voxel::LayerProfile& profile, int axis) {
  Text out;
  fmt::format_to(std::back_inserter(out),
                 "{}_m,solid_fraction,solid_height_m,surface_height_m,solid_fraction_below_surface\n",
                 "xy"[axis]);
  for (std::size_t i = 0; i < profile.at.size(); ++i) {
    add(out, profile.at[i]);
    add(out, profile.solid_fraction[i]);
    add(out, profile.solid_height[i]);
    add(out, profile.surface_height[i]);
    add(out, profile.solid_fraction_below_surface[i], '\n');
  }
  return fmt::to_string(out);
}

std::string csv_of(const voxel::ScaleReport& report) {
  Text out;
  out.append(std::string_view(
      "length_m,windows,independent_windows,grains_per_window,void_fraction_mean,void_fraction_sd,"
      "void_fraction_min,void_fraction_max,sd_random,sd_one_grain\n"));
  for (const voxel::ScaleRow& row : report.rows) {
    fmt::format_to(std::back_inserter(out), "{},{},", row.length, row.windows);
    for (const double value :
         {row.independent, row.grains, row.mean, row.sd, row.min, row.max, row.sd_random})
      add(out, value);
    add(out, row.sd_one_grain, '\n');
  }
  return fmt::to_string(out);
}

std::string sentence_of(const voxel::ScaleReport& report) {
  const auto row_at = [&](double length) -> const voxel::ScaleRow* {
    for (const auto& row : report.rows)
      if (row.length == length) return &row;
    return nullptr;
  };
  constexpr std::array<const char*, 3> kPlural{"cubes", "spheres", "Gaussians"};
  std::string text =
      fmt::format("void fractions vary over {} ", kPlural[static_cast<std::size_t>(report.window)]);
  if (const auto* row = row_at(report.random_length))
    text += fmt::format(
        "by no more than that many grains placed at random would (standard deviation {:.3g}) from "
        "{:.4g} um on",
        row->sd, 1e6 * row->length);
  else
    text +=
        "by more than that many grains placed at random would at all lengths up to a third of the box or so";
  if (const auto* row = row_at(report.many_grains_length))
    text += fmt::format(
        "; from {:.4g} um on (some {:.3g} grains each, standard deviation {:.3g}) one grain more or "
        "less changes them by less than their standard deviation",
        1e6 * row->length, row->grains, row->sd);
  else
    text +=
        "; at no length with enough of them in the box do they stand for more than the place of single "
        "grains";
  return text;
}

}  // namespace interstice::io
