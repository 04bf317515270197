// Placement lists: CSV with the unit of each column in its header, "x [um], y [um], z [um], diameter [um]".
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

#include "coupling/scene/readers.h"

namespace interstice::scene {
namespace {

struct ColumnKind {
  std::string_view name;
  Dimension dimension;
  bool required;
};
constexpr std::array<ColumnKind, 10> kColumns{{{"x", Dimension::length, true},
                                               {"y", Dimension::length, true},
                                               {"z", Dimension::length, true},
                                               {"diameter", Dimension::length, true},
                                               {"vx", Dimension::velocity, false},
                                               {"vy", Dimension::velocity, false},
                                               {"vz", Dimension::velocity, false},
                                               {"wx", Dimension::angular_velocity, false},
                                               {"wy", Dimension::angular_velocity, false},
                                               {"wz", Dimension::angular_velocity, false}}};
constexpr std::size_t kDiameter = 3;
constexpr int kMostErrors = 20;  // of one list: a wrong column is wrong in every row

double& component(PlacedGrain& grain, std::size_t column) {
  if (column < 3) return grain.position[static_cast<int>(column)];
  if (column == kDiameter) return grain.diameter;
  if (column < 7) return grain.velocity[static_cast<int>(column) - 4];
  return grain.spin[static_cast<int>(column) - 7];
}

std::vector<std::string> column_names() {
  std::vector<std::string> names;
  for (const ColumnKind& column : kColumns) names.emplace_back(column.name);
  return names;
}

struct Cell {
  std::string_view text;
  int column = 1;  // where its text starts in the line
};

/// Into a vector that is used again for the next line: a list may have millions.
void split_cells(std::string_view line, std::vector<Cell>& cells) {
  cells.clear();
  for (std::size_t start = 0;;) {
    const std::size_t end = std::min(line.find(',', start), line.size());
    const std::string_view text = trim(line.substr(start, end - start));
    const std::size_t at = text.empty() ? start : static_cast<std::size_t>(text.data() - line.data());
    cells.push_back({text, static_cast<int>(at) + 1});
    if (end == line.size()) return;
    start = end + 1;
  }
}

/// Where grains are, to find one at the very place of another: places open-addressed, for a list of a known
/// length.
class PlaceTable {
 public:
  explicit PlaceTable(std::size_t rows) : slots_(std::bit_ceil(2 * rows + 2), kFree) {}

  /// The grain that is there already, or `index`, which then is.
  std::size_t try_add(const std::vector<PlacedGrain>& grains, const Vec3d& place, std::size_t index) {
    for (std::size_t slot = hash(place);; ++slot) {
      std::uint32_t& found = slots_[slot & (slots_.size() - 1)];
      if (found == kFree) return found = static_cast<std::uint32_t>(index), index;
      if (grains[found].position == place) return found;
    }
  }

 private:
  static constexpr std::uint32_t kFree = ~0u;
  static std::size_t hash(const Vec3d& place) {
    std::uint64_t hash = 0;
    for (const double p : {place.x, place.y, place.z}) {  // 0.0 added: -0 is the same place as 0
      hash = (hash ^ std::bit_cast<std::uint64_t>(p + 0.0)) * 0x9E3779B97F4A7C15;
      hash ^= hash >> 32;
    }
    return hash;
  }
  std::vector<std::uint32_t> slots_;  // indices of grains
};

class ListReader {
 public:
  ListReader(const Place& place, const std::string& key, Problems& problems)
      : place_(place), key_(key), problems_(problems) {}

  std::vector<PlacedGrain> read(std::string_view text) {
    const auto rows = 1 + static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
    grains_.reserve(rows);
    line_of_.reserve(rows);
    places_ = PlaceTable(rows);
    std::vector<Cell> cells;
    for (std::string_view rest = text; !rest.empty();) {
      const std::size_t end = std::min(rest.find('\n'), rest.size());
      std::string_view line = rest.substr(0, end);
      rest.remove_prefix(std::min(end + 1, rest.size()));
      ++line_;
      if (line_ == 1 && line.starts_with("\xEF\xBB\xBF")) line.remove_prefix(3);  // a byte-order mark
      if (trim(line).empty() || trim(line).front() == '#') continue;
      split_cells(line, cells);
      if (units_.empty()) {
        if (!read_header(cells)) return {};
      } else {
        read_row(cells);
      }
      if (errors_ >= kMostErrors) {
        ++line_;
        fail({}, "has more errors, not shown", "", "correct these first");
        break;
      }
    }
    if (units_.empty()) fail({}, "has no header", "columns with units are due", kHeaderExample);
    return errors_ == 0 ? std::move(grains_) : std::vector<PlacedGrain>{};
  }

 private:
  static constexpr std::string_view kHeaderExample = "start it with x [um], y [um], z [um], diameter [um]";

  void fail(const Cell& cell, std::string_view what, std::string_view allowed, std::string_view remedy) {
    ++errors_;
    if (key_.empty()) {  // a file of its own
      problems_.error({place_.source, std::max(line_, 1), cell.column}, "", what, allowed, remedy);
    } else {
      problems_.error(place_, fmt::format("{} (line {})", key_, std::max(line_, 1)), what, allowed, remedy);
    }
  }

  bool read_header(const std::vector<Cell>& cells) {
    std::array<bool, kColumns.size()> seen{};
    for (const Cell& cell : cells) read_column(cell, seen);
    const bool all_known = errors_ == 0;  // else the missing one may be the misspelt one
    for (std::size_t i = 0; i < kColumns.size(); ++i)
      if (all_known && kColumns[i].required && !seen[i])
        fail({}, fmt::format("column {} is missing", kColumns[i].name),
             "x, y, z and diameter are due; vx, vy, vz, wx, wy, wz may follow", kHeaderExample);
    return errors_ == 0;
  }

  void read_column(const Cell& cell, std::array<bool, kColumns.size()>& seen) {
    const std::size_t bracket = std::min(cell.text.find('['), cell.text.size());
    const std::string name(trim(cell.text.substr(0, bracket)));
    std::size_t index = 0;
    while (index < kColumns.size() && kColumns[index].name != name) ++index;
    if (index == kColumns.size()) {
      const std::string near = nearest(name, column_names());
      return fail(cell, fmt::format("column \"{}\" is unknown", name), "allowed: " + listed(column_names()),
                  near.empty() ? "remove it" : fmt::format("did you mean \"{}\"?", near));
    }
    if (std::exchange(seen[index], true))
      return fail(cell, fmt::format("column {} is there twice", name), "each column once", "remove one");
    const ColumnKind& kind = kColumns[index];
    const std::string_view example = kind.dimension == Dimension::length     ? "um"
                                     : kind.dimension == Dimension::velocity ? "m/s"
                                                                             : "rad/s";
    const std::string write = fmt::format("write {} [{}]", name, example);
    if (bracket == cell.text.size() || cell.text.back() != ']')
      return fail(cell, fmt::format("column {} has no unit", name),
                  fmt::format("{} in brackets is due", info(kind.dimension).noun), write);
    QuantityProblem problem;
    const std::string_view text = cell.text.substr(bracket + 1, cell.text.size() - bracket - 2);
    const auto unit = Unit::parse(text, kind.dimension, problem);
    if (!unit) return fail(cell, fmt::format("column {}: {}", name, problem.what), problem.allowed, write);
    units_.push_back(*unit);
    columns_.push_back(index);
  }

  void read_row(const std::vector<Cell>& cells) {
    if (cells.size() != units_.size())
      return fail(cells.back(), fmt::format("the row has {} values", cells.size()),
                  fmt::format("{} are due, as in the header", units_.size()), "add or remove values");
    PlacedGrain grain;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string_view name = kColumns[columns_[i]].name;
      const auto value = units_[i].value(cells[i].text);
      if (!value)
        return fail(cells[i], fmt::format("{} = \"{}\" is not a finite number", name, cells[i].text),
                    "a plain number is due; the unit stands in the header", "correct it");
      if (columns_[i] == kDiameter && !(*value > 0))
        return fail(cells[i],
                    fmt::format("diameter = {} cannot be: grains are of finite size", cells[i].text),
                    "allowed: greater than 0", "correct or remove the row");
      component(grain, columns_[i]) = *value;
    }
    const std::size_t there = places_.try_add(grains_, grain.position, grains_.size());
    if (there != grains_.size())
      return fail(cells.front(),
                  fmt::format("the grain has the very place of the one in line {}", line_of_[there]),
                  "two centres cannot coincide: there would be no direction to push them apart",
                  "move or remove one");
    line_of_.push_back(line_);
    grains_.push_back(grain);
  }

  Place place_;
  std::string key_;
  Problems& problems_;
  int line_ = 0, errors_ = 0;
  std::vector<Unit> units_;
  std::vector<std::size_t> columns_;
  PlaceTable places_{0};
  std::vector<int> line_of_;  // by grain
  std::vector<PlacedGrain> grains_;
};

}  // namespace

std::vector<PlacedGrain> read_grain_list(std::string_view text, const Place& place, const std::string& key,
                                         Problems& problems) {
  return ListReader(place, key, problems).read(text);
}

}  // namespace interstice::scene
