#include "coupling/io/edem_csv_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "coupling/io/columns.h"

namespace interstice::io {
namespace {

using Words = std::vector<std::string_view>;

/// A heading such as "Q01 : Particle Position X (mm)", taken apart.
struct Heading {
  std::string plain;  // "position x": small letters, without "particle" and marks
  std::string unit;   // "mm"; "" where there is none
};

std::string squeezed(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const char small = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const bool letter = (small >= 'a' && small <= 'z') || (small >= '0' && small <= '9') || (c & 0x80) != 0;
    if (letter) out += small;
    if (!letter && !out.empty() && out.back() != ' ') out += ' ';
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

Heading heading_of(std::string_view cell) {
  Heading heading;
  if (const auto mark = cell.rfind(':'); mark != std::string_view::npos) cell.remove_prefix(mark + 1);
  const auto open = cell.find_last_of("([");
  if (open != std::string_view::npos && !cell.empty() && (cell.back() == ')' || cell.back() == ']')) {
    heading.unit = std::string(cell.substr(open + 1, cell.size() - open - 2));
    cell = cell.substr(0, open);
  }
  std::string text = squeezed(cell);
  for (const std::string noise : {"particle ", "particles ", "magnitude "}) {
    if (text.rfind(noise, 0) == 0) text.erase(0, noise.size());
  }
  heading.plain = text;
  return heading;
}

const std::vector<ColumnNames>& edem_names() {
  static const std::vector<ColumnNames> names{
      {Quantity::x, "x", {"position x", "x position", "x coordinate", "coordinate x", "centre x", "x"}},
      {Quantity::y, "y", {"position y", "y position", "y coordinate", "coordinate y", "centre y", "y"}},
      {Quantity::z, "z", {"position z", "z position", "z coordinate", "coordinate z", "centre z", "z"}},
      {Quantity::id, "id", {"id"}},
      {Quantity::radius, "radius", {"radius"}},
      {Quantity::diameter, "diameter", {"diameter"}},
      {Quantity::volume, "volume", {"volume"}},
      {Quantity::vx, "vx", {"velocity x", "x velocity"}},
      {Quantity::vy, "vy", {"velocity y", "y velocity"}},
      {Quantity::vz, "vz", {"velocity z", "z velocity"}},
      {Quantity::wx, "wx", {"angular velocity x", "x angular velocity"}},
      {Quantity::wy, "wy", {"angular velocity y", "y angular velocity"}},
      {Quantity::wz, "wz", {"angular velocity z", "z angular velocity"}},
      {Quantity::density, "density", {"density"}},
      {Quantity::time, "time", {"time"}}};
  return names;
}

// SI per unit; 0: not known for such a quantity.
double factor_of(Quantity quantity, const std::string& unit) {
  static const std::map<std::string, double> lengths{{"m", 1},     {"cm", 1e-2},        {"mm", 1e-3},
                                                     {"um", 1e-6}, {"\xc2\xb5m", 1e-6}, {"\xce\xbcm", 1e-6},
                                                     {"nm", 1e-9}};
  static const std::map<std::string, double> spins{
      {"rad/s", 1}, {"deg/s", 3.14159265358979323846 / 180}, {"rpm", 3.14159265358979323846 / 30}};
  static const std::map<std::string, double> densities{
      {"kg/m^3", 1}, {"kg/m3", 1}, {"kg/m\xc2\xb3", 1}, {"g/cm^3", 1e3}, {"g/cm3", 1e3}};
  static const std::map<std::string, double> times{{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}};
  const auto in = [](const std::map<std::string, double>& units, const std::string& name) {
    const auto it = units.find(name);
    return it == units.end() ? 0.0 : it->second;
  };
  const auto without = [&](const std::string& end) {
    const bool there =
        unit.size() > end.size() && unit.compare(unit.size() - end.size(), end.size(), end) == 0;
    return there ? unit.substr(0, unit.size() - end.size()) : std::string();
  };
  if (is_length(quantity)) return in(lengths, unit);
  if (is_velocity(quantity)) return in(lengths, without("/s"));
  if (is_spin(quantity)) return in(spins, unit);
  if (quantity == Quantity::density) return in(densities, unit);
  if (quantity == Quantity::time) return in(times, unit);
  if (quantity != Quantity::volume) return 1;
  for (const std::string cube : {"^3", "3", "\xc2\xb3"}) {
    if (const double length = in(lengths, without(cube)); length > 0) return length * length * length;
  }
  return 0;
}

bool names_positions(const Words& cells) {
  std::array<bool, 3> seen{};
  for (const auto& cell : cells) {
    const std::string plain = heading_of(cell).plain;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto& names = edem_names()[a].names;
      // a plain "x" alone is any program's CSV
      seen[a] = seen[a] || std::find(names.begin(), names.end() - 1, plain) != names.end() - 1;
    }
  }
  return seen[0] && seen[1] && seen[2];
}

// "Time: 0.15 s", "TIME STEP, 0.15", "Time (s): 0.15": a line with the word time and one number.
bool parse_time(std::string_view line, double& time) {
  if (squeezed(line).find("time") == std::string::npos) return false;
  std::string text(line);
  std::replace_if(
      text.begin(), text.end(),
      [](char c) { return c == ',' || c == ';' || c == ':' || c == '=' || c == '"' || c == '(' || c == ')'; },
      ' ');
  int numbers = 0;
  double unit = 1;
  for (const auto& word : split(text, {})) {
    double value = 0;
    if (parse_number(word, value) && std::isfinite(value)) {
      time = value;
      ++numbers;
    } else if (word == "ms") {
      unit = 1e-3;
    }
  }
  time *= unit;
  return numbers == 1;
}

class EdemReader : public ParticleReader {
 public:
  EdemReader(const std::filesystem::path& path, ReaderOptions options)
      : lines_(path), options_(std::move(options)) {}

  std::string kind() const override { return "EDEM CSV"; }
  bool next(ParticleFrame& frame) override;

 private:
  bool next_line();
  void set_columns(const Words& cells);
  bool find_rows();
  bool is_row(const Words& cells) const;
  void read_rows(ParticleFrame& frame);
  void end_frame(ParticleFrame& frame);
  [[noreturn]] void wrong(const std::string& what) const { throw InputError(lines_.where() + ": " + what); }

  TextLines lines_;
  ReaderOptions options_;
  std::string line_;      // the line that is looked at; kept when it belongs to the next frame
  bool pending_ = false;  // it is still to be looked at
  Separator separator_{','};
  ColumnMap map_;
  std::ptrdiff_t time_column_ = -1;
  double time_ = std::numeric_limits<double>::quiet_NaN();  // of the block that is read
  WrittenDigits digits_;
  std::int64_t frame_ = 0;
};

bool EdemReader::next_line() {
  if (pending_) {
    pending_ = false;
    return true;
  }
  std::string_view line;
  if (lines_.next(line)) {
    line_ = line;
    return true;
  }
  if (!lines_.damage().empty()) wrong(lines_.damage() + "; a whole file is needed; write it again");
  return false;
}

void EdemReader::set_columns(const Words& cells) {
  std::vector<std::string> names;
  std::vector<Heading> headings;
  auto given = options_.columns;
  for (const auto& cell : cells) {
    headings.push_back(heading_of(cell));
    names.push_back(headings.back().plain);
    // --columns may give the name as it stands in the file, brackets and all
    for (auto& [ours, theirs] : given) {
      if (theirs == cell) theirs = names.back();
    }
  }
  if (!names.empty() && names.back().empty()) names.back() = "(empty)";  // a comma at the end of the lines
  map_ = map_columns(names, edem_names(), given, lines_.where());
  time_column_ = -1;
  for (std::size_t c = 0; c < names.size(); ++c) {
    auto& column = map_.columns[c];
    if (column.quantity == Quantity::none) continue;
    if (column.quantity == Quantity::time) time_column_ = static_cast<std::ptrdiff_t>(c);
    const bool bare = headings[c].unit.empty();
    const double l = options_.length_unit;
    column.factor = !bare                                 ? factor_of(column.quantity, headings[c].unit)
                    : column.quantity == Quantity::volume ? l * l * l
                    : is_length(column.quantity) || is_velocity(column.quantity) ? l
                                                                                 : 1;
    if (column.factor > 0) continue;
    wrong(fmt::format(
        "column `{}`: unit `{}` is not known here; m, cm, mm, um, nm (per s, cubed), rad/s, deg/s, "
        "rpm, kg/m^3, g/cm^3, s, ms are; export in one of them",
        shown(cells[c]), shown(headings[c].unit)));
  }
}

bool EdemReader::is_row(const Words& cells) const {
  double value = 0;
  return !map_.columns.empty() && cells.size() >= 4 && parse_number(cells[0], value);
}

// Passes over headings to the first row of the next frame; false at the end of the file. A heading whose next
// row would be another heading or time stands for a time step without particles.
bool EdemReader::find_rows() {
  bool named = false, timed = false;
  while (next_line()) {
    if (names_positions(split(line_, {';'}))) separator_ = {';'};
    const auto cells = split(line_, separator_);
    const bool heading = names_positions(cells);
    double time = 0;
    const bool clock = !heading && !is_row(cells) && parse_time(line_, time);
    if (is_row(cells) || (named && (heading || (clock && timed)))) {
      pending_ = true;
      return true;
    }
    if (heading) {
      set_columns(cells);
      named = true;
    } else if (clock) {
      time_ = time;
      timed = true;
    }
  }
  return named;
}

void EdemReader::read_rows(ParticleFrame& frame) {
  bool first = true;
  while (next_line()) {
    const auto cells = split(line_, separator_);
    if (cells.size() == 1 && cells[0].empty()) continue;
    double time = 0;
    if (!is_row(cells)) {
      if (!names_positions(cells) && !parse_time(line_, time)) {
        wrong(fmt::format(
            "`{}` where a row of {} numbers or the next time step is due; correct or remove the line",
            shown(line_), map_.columns.size()));
      }
      pending_ = true;
      return;
    }
    if (time_column_ >= 0 && static_cast<std::size_t>(time_column_) < cells.size()) {
      const auto c = static_cast<std::size_t>(time_column_);
      if (!parse_number(cells[c], time) || !std::isfinite(time)) {
        wrong(fmt::format("time `{}` is no finite number; correct the row", shown(cells[c])));
      }
      time *= map_.columns[c].factor;
      if (!first && time != time_) {
        pending_ = true;
        return;
      }
      time_ = time;
    }
    append_row(line_, separator_, map_, {lines_, frame_}, frame, &digits_);
    if (!lines_.line_was_whole()) {
      warn(lines_.where() + ": the last line has no line end; if the file was cut, its last number is wrong");
    }
    first = false;
  }
}

void EdemReader::end_frame(ParticleFrame& frame) {
  frame.time = time_;
  std::array<double, 3> unit{};
  for (std::size_t a = 0; a < 3; ++a) unit[a] = map_.find(edem_names()[a].quantity)->factor;
  position_resolution_ = digits_.resolution(unit);
  digits_ = {};
  finish(frame, fmt::format("{}: frame {}", lines_.path().string(), frame_), lines_.path());
  ++frame_;
}

bool EdemReader::next(ParticleFrame& frame) {
  frame = ParticleFrame{};
  if (!find_rows()) {
    if (frame_ == 0) wrong("no row of particles in the file; export them with the data; check the file");
    return false;
  }
  read_rows(frame);
  end_frame(frame);
  return true;
}

}  // namespace

bool looks_like_edem_csv(const std::string& head) {
  std::size_t at = 0;
  while (at < head.size()) {
    const std::size_t end = std::min(head.find('\n', at), head.size());
    std::string_view line = std::string_view(head).substr(at, end - at);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (names_positions(split(line, {','})) || names_positions(split(line, {';'}))) return true;
    at = end + 1;
  }
  return false;
}

std::unique_ptr<ParticleReader> open_edem_csv(const std::filesystem::path& path,
                                              const ReaderOptions& options) {
  return std::make_unique<EdemReader>(path, options);
}

}  // namespace interstice::io
