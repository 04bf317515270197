#include "coupling/studies/moment_files.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "coupling/io/trajectory.h"

namespace interstice::studies {
namespace {

constexpr std::string_view axis_names = "xyz";

std::string length(double metres) {
  return std::abs(metres) < 0.3e-3 && metres != 0 ? fmt::format("{:.6g} µm", metres * 1e6)
                                                  : fmt::format("{:.6g} mm", metres * 1e3);
}

/// "x=0.0045" as "x = 4.5 mm"; what is no such pair stays as it is.
std::string spoken_pair(std::string_view pair) {
  double value = 0;
  if (pair.size() < 3 || pair[1] != '=') return std::string(pair);
  const auto [end, failure] = std::from_chars(pair.data() + 2, pair.data() + pair.size(), value);
  if (failure != std::errc() || end != pair.data() + pair.size()) return std::string(pair);
  return fmt::format("{} = {}", pair[0], length(value));
}

/// The number of points before the slow coordinate changes for the first time.
std::size_t run_length(const voxel::Samples& s, int slow) {
  std::size_t n = 1;
  while (n < s.center.size() && s.center[n][slow] == s.center[0][slow]) ++n;
  return n;
}

}  // namespace

int axis_of(const std::string& name) {
  const auto at = name.empty() ? std::string_view::npos : axis_names.find(name[0]);
  return at == std::string_view::npos || name.size() < 2 || (name[1] != '=' && name[1] != '@')
             ? -1
             : static_cast<int>(at);
}

voxel::Samples read_slice(const std::filesystem::path& csv) {
  const Table table = read_table(csv);
  const int axis = axis_of(csv.stem().string());
  if (axis < 0 || table.rows() == 0) {
    throw InputError(
        fmt::format("{}: no slice; a name like x=0.0045.csv and a row per voxel are wanted", csv.string()));
  }
  voxel::Samples s;
  s.normal_axis = axis;
  s.axes = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
  s.void_fraction = table.numbers("void_fraction");
  if (table.has("void_fraction_averaged")) s.void_fraction_averaged = table.numbers("void_fraction_averaged");
  const auto &x = table.numbers("x_m"), &y = table.numbers("y_m"), &z = table.numbers("z_m");
  for (std::size_t i = 0; i < table.rows(); ++i) s.center.push_back({x[i], y[i], z[i]});
  // Which of the two axes runs faster is the writer's choice: the first step tells.
  if (s.center.size() > 1 && s.center[1][s.axes[1]] == s.center[0][s.axes[1]])
    std::swap(s.axes[0], s.axes[1]);
  s.columns = static_cast<std::int64_t>(run_length(s, s.axes[0]));
  s.rows = static_cast<std::int64_t>(s.center.size()) / s.columns;
  if (s.rows * s.columns != static_cast<std::int64_t>(s.center.size())) {
    throw InputError(fmt::format("{}: {} rows are no whole number of voxel rows of {}", csv.string(),
                                 s.center.size(), s.columns));
  }
  return s;
}

std::vector<double> line_values(const Table& line, const std::string& column) {
  constexpr double digits = 1e-6;  // to which tables tell that a voxel is whole
  std::vector<double> values = line.numbers(column);
  if (!line.has("solid_fraction") || !line.has("void_fraction")) return values;
  const auto &solid = line.numbers("solid_fraction"), &empty = line.numbers("void_fraction");
  const double enough = column == "void_fraction" ? 1 - digits : digits;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (solid[i] + empty[i] < enough) values[i] = std::nan("");
  return values;
}

std::string spoken(const std::string& name) {
  const auto at = name.find('@');
  if (at == std::string::npos) return spoken_pair(name);
  std::string result = "along " + name.substr(0, at) + " at ";
  const std::string_view rest = std::string_view(name).substr(at + 1);
  const auto comma = rest.find(',');
  result += spoken_pair(rest.substr(0, comma));
  if (comma != std::string_view::npos) result += ", " + spoken_pair(rest.substr(comma + 1));
  return result;
}

std::vector<io::WallPose> walls_at(const RunFolder& run, double time) {
  const auto file = run.path / "trajectory.h5part";
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return {};
  try {
    const io::TrajectoryReader reader(file);
    std::int64_t nearest = -1;
    for (std::int64_t f = 0; f < reader.frames(); ++f) {
      if (nearest < 0 || std::abs(reader.time(f) - time) < std::abs(reader.time(nearest) - time)) nearest = f;
    }
    return nearest < 0 ? std::vector<io::WallPose>{} : reader.read(nearest).walls;
  } catch (const std::runtime_error&) {
    return {};
  }
}

std::string how_computed(const FieldMoment& moment) {
  std::ifstream file(moment.folder / "summary.json");
  const auto summary = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
  if (!summary.is_object()) return "";
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (const auto v = summary.find("voxel_m"); v != summary.end() && v->is_number()) {
    add("voxel " + length(v->get<double>()));
  }
  if (const auto m = summary.find("method"); m != summary.end() && m->is_string()) add(m->get<std::string>());
  if (const auto l = summary.find("average_m"); l != summary.end() && l->is_number()) {
    const auto window = summary.find("average_window");
    const bool named = window != summary.end() && window->is_string() && *window != "box";
    add("averaged fields over " + length(l->get<double>()) +
        (named ? fmt::format(" ({})", window->get<std::string>()) : std::string()));
  }
  return text;
}

}  // namespace interstice::studies
