#include "coupling/io/table_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "coupling/io/columns.h"

namespace interstice::io {
namespace {

const std::vector<ColumnNames>& table_names() {
  static const std::vector<ColumnNames> names =
      with_field_columns({{Quantity::id, "id", {"id"}},
                          {Quantity::x, "x", {"x", "Points:0"}},
                          {Quantity::y, "y", {"y", "Points:1"}},
                          {Quantity::z, "z", {"z", "Points:2"}},
                          {Quantity::radius, "radius", {"radius", "r"}},
                          {Quantity::diameter, "diameter", {"diameter", "d"}},
                          {Quantity::vx, "vx", {"vx"}},
                          {Quantity::vy, "vy", {"vy"}},
                          {Quantity::vz, "vz", {"vz"}},
                          {Quantity::wx, "wx", {"wx"}},
                          {Quantity::wy, "wy", {"wy"}},
                          {Quantity::wz, "wz", {"wz"}},
                          {Quantity::density, "density", {"density"}},
                          {Quantity::material, "material", {"material", "matId", "type"}}});
  return names;
}

enum class Dimension { none, length, velocity, spin, density, stress };

Dimension dimension_of(Quantity quantity) {
  switch (quantity) {
    case Quantity::x:
    case Quantity::y:
    case Quantity::z:
    case Quantity::radius:
    case Quantity::diameter:
      return Dimension::length;
    case Quantity::vx:
    case Quantity::vy:
    case Quantity::vz:
      return Dimension::velocity;
    case Quantity::wx:
    case Quantity::wy:
    case Quantity::wz:
      return Dimension::spin;
    case Quantity::density:
      return Dimension::density;
    default:
      return is_stress(quantity) ? Dimension::stress : Dimension::none;
  }
}

// SI units per unit in a header's brackets; 0: not known. A longer table than this belongs to the scene's
// parser.
double unit_factor(Dimension dimension, std::string_view unit) {
  // the micro sign has two code points that print alike
  const bool micro = unit.substr(0, 2) == "\xc2\xb5" || unit.substr(0, 2) == "\xce\xbc";
  std::string plain = micro ? "u" : "";
  plain += unit.substr(micro ? 2 : 0);
  if (dimension == Dimension::velocity) {
    if (plain.size() < 3 || plain.substr(plain.size() - 2) != "/s") return 0;
    plain.resize(plain.size() - 2);
  }
  if (dimension == Dimension::length || dimension == Dimension::velocity) {
    if (plain == "m") return 1;
    if (plain == "cm") return 1e-2;
    if (plain == "mm") return 1e-3;
    if (plain == "um") return 1e-6;
    if (plain == "nm") return 1e-9;
  }
  if (dimension == Dimension::spin && (plain == "rad/s" || plain == "1/s")) return 1;
  if (dimension == Dimension::density) {
    if (plain == "kg/m^3" || plain == "kg/m3") return 1;
    if (plain == "g/cm^3" || plain == "g/cm3") return 1e3;
  }
  if (dimension == Dimension::stress) {
    if (plain == "Pa") return 1;
    if (plain == "kPa") return 1e3;
    if (plain == "MPa") return 1e6;
  }
  return 0;
}

bool numeric(const std::vector<std::string_view>& cells) {
  double value = 0;
  return !cells.empty() &&
         std::all_of(cells.begin(), cells.end(), [&](auto c) { return parse_number(c, value); });
}

// The commonest of the separators that a header line or a row can have.
Separator separator_of(std::string_view line) {
  for (const char c : {',', ';', '\t'}) {
    if (line.find(c) != std::string_view::npos) return {c};
  }
  return {};
}

std::string_view trimmed(std::string_view line) {
  while (!line.empty() && (line.front() == ' ' || line.front() == '\t')) line.remove_prefix(1);
  while (!line.empty() && (line.back() == ' ' || line.back() == '\t')) line.remove_suffix(1);
  return line;
}

/// Does a comment name the columns as yade.export does? Further comments may follow it.
bool has_format(const std::string& comment) { return comment.rfind("format ", 0) == 0; }

class TableReader : public ParticleReader {
 public:
  TableReader(const std::filesystem::path& path, ReaderOptions options)
      : lines_(path), options_(std::move(options)) {}

  std::string kind() const override { return yade_ ? "YADE text" : "CSV"; }
  std::int64_t frames() const override { return 1; }
  bool next(ParticleFrame& frame) override;

 private:
  bool next_line(std::string_view& line);
  void read_header(ParticleFrame& frame);
  std::vector<std::string> names_in_comment(std::size_t cells) const;
  void set_columns(const std::vector<std::string>& headings);
  [[noreturn]] void wrong(const std::string& what) const { throw InputError(lines_.where() + ": " + what); }

  TextLines lines_;
  ReaderOptions options_;
  Separator separator_;
  ColumnMap map_;
  WrittenDigits digits_;
  std::string
      comment_;  // the last comment line before the table (or the one with the format), without its mark
  bool yade_ = false;
  bool done_ = false;
};

// The next line that is neither empty nor a comment.
bool TableReader::next_line(std::string_view& line) {
  while (lines_.next(line)) {
    if (lines_.line_number() == 1 && line.substr(0, 3) == "\xef\xbb\xbf") line.remove_prefix(3);
    line = trimmed(line);
    if (line.empty()) continue;
    if (line.front() != '#') return true;
    if (!has_format(comment_)) comment_ = trimmed(line.substr(1));
  }
  if (!lines_.damage().empty()) wrong(lines_.damage() + "; a whole file is needed; write it again");
  return false;
}

// Column names for a table that begins with numbers: yade.export writes "#format x_y_z_r_matId", or nothing
// and then x y z r; numpy.savetxt puts its header into a comment.
std::vector<std::string> TableReader::names_in_comment(std::size_t cells) const {
  std::vector<std::string> names;
  if (has_format(comment_)) {
    for (const auto& name : split(std::string_view(comment_).substr(7), {'_'})) names.emplace_back(name);
    return names;
  }
  for (const auto& name : split(comment_, separator_of(comment_))) names.emplace_back(name);
  if (names.size() == cells && std::find(names.begin(), names.end(), "x") != names.end()) return names;
  if (cells == 4 && (separator_.blanks() || separator_.character == '\t')) return {"x", "y", "z", "r"};
  return {};
}

void TableReader::set_columns(const std::vector<std::string>& headings) {
  std::vector<std::string> names, units;
  for (const auto& heading : headings) {
    const auto open = heading.find_first_of("[(");
    const bool bracketed =
        open != std::string::npos && open > 0 && (heading.back() == ']' || heading.back() == ')');
    names.emplace_back(trimmed(std::string_view(heading).substr(0, bracketed ? open : heading.size())));
    units.emplace_back(bracketed
                           ? trimmed(std::string_view(heading).substr(open + 1, heading.size() - open - 2))
                           : std::string_view());
  }
  map_ = map_columns(names, table_names(), options_.columns, lines_.where());
  for (std::size_t c = 0; c < names.size(); ++c) {
    auto& column = map_.columns[c];
    const Dimension dimension = dimension_of(column.quantity);
    if (dimension == Dimension::none) continue;
    if (units[c].empty()) {
      const bool scaled = dimension == Dimension::length || dimension == Dimension::velocity;
      column.factor = scaled ? options_.length_unit : 1;
      continue;
    }
    column.factor = unit_factor(dimension, units[c]);
    if (column.factor == 0) {
      wrong(
          fmt::format("column `{}`: unit `{}` is not known here; m, cm, mm, um, nm (and those per s), rad/s, "
                      "kg/m^3, Pa, kPa, MPa, "
                      "g/cm^3 are; correct the header",
                      list_of({names[c]}), list_of({units[c]})));
    }
  }
}

// Finds the columns; where the table begins with numbers, also reads its first row.
void TableReader::read_header(ParticleFrame& frame) {
  std::string_view line;
  if (!next_line(line)) wrong("no table in the file; a header with x, y, z, radius is due; check the file");
  separator_ = separator_of(line);
  const auto cells = split(line, separator_);
  if (!numeric(cells)) {
    // "x [um] y [um]" with blanks between the columns: the unit belongs to the name before it
    std::vector<std::string> headings;
    for (const auto& cell : cells) {
      if (separator_.blanks() && !headings.empty() && (cell.front() == '[' || cell.front() == '(')) {
        headings.back() += ' ';
        headings.back() += cell;
      } else {
        headings.emplace_back(cell);
      }
    }
    set_columns(headings);
    return;
  }
  const auto names = names_in_comment(cells.size());
  if (names.empty()) {
    wrong(fmt::format(
        "{} numbers and no header before them; a line naming the columns (x,y,z,radius) is needed; add "
        "it, or export x y z r",
        cells.size()));
  }
  yade_ = separator_.blanks() || separator_.character == '\t';
  set_columns(names);
  append_row(line, separator_, map_, {lines_}, frame, &digits_);
}

bool TableReader::next(ParticleFrame& frame) {
  frame = ParticleFrame{};
  if (done_) return false;
  read_header(frame);
  std::string_view line;
  while (next_line(line)) {
    append_row(line, separator_, map_, {lines_}, frame, &digits_);
    if (!lines_.line_was_whole()) {
      warn(lines_.where() + ": the last line has no line end; if the file was cut, its last number is wrong");
    }
  }
  const auto factor = [&](Quantity q) { return map_.find(q)->factor; };
  position_resolution_ = digits_.resolution({factor(Quantity::x), factor(Quantity::y), factor(Quantity::z)});
  finish(frame, lines_.path().string(), lines_.path());
  done_ = true;
  return true;
}

}  // namespace

std::unique_ptr<ParticleReader> open_table(const std::filesystem::path& path, const ReaderOptions& options) {
  return std::make_unique<TableReader>(path, options);
}

}  // namespace interstice::io
