#include "coupling/io/columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <numeric>

#include "base/error.h"

namespace interstice::io {
namespace {

bool same_letters(const std::string& a, const std::string& b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char p, char q) { return lower(p) == lower(q); });
}

// Index of the one column called `name`, in any case of letters; -1: none. Two are an error: either could be
// meant.
std::ptrdiff_t index_of(const std::vector<std::string>& present, const std::string& name,
                        const std::string& where) {
  const auto fits = [&](const std::string& other) { return same_letters(name, other); };
  const auto first = std::find_if(present.begin(), present.end(), fits);
  if (first == present.end()) return -1;
  if (std::find_if(first + 1, present.end(), fits) != present.end()) {
    throw InputError(fmt::format("{}: two columns are called `{}`; each name must occur once; rename one",
                                 where, shown(name)));
  }
  return first - present.begin();
}

void map_one(const ColumnNames& wanted, const std::vector<std::string>& present,
             const std::map<std::string, std::string>& given, const std::string& where, ColumnMap& map) {
  std::vector<std::string> candidates = wanted.names;
  if (const auto it = given.find(wanted.ours); it != given.end()) {
    if (index_of(present, it->second, where) < 0) {
      throw InputError(
          fmt::format("{}: --columns {}={}: no such column; the columns are {}; name one of them", where,
                      wanted.ours, it->second, list_of(present)));
    }
    candidates = {it->second};
  }
  for (const auto& name : candidates) {
    const std::ptrdiff_t at = index_of(present, name, where);
    if (at < 0) continue;
    auto& column = map.columns[static_cast<std::size_t>(at)];
    if (column.quantity != Quantity::none) {
      throw InputError(fmt::format(
          "{}: column `{}` is asked for as two things; one use each; correct --columns", where, shown(name)));
    }
    column.quantity = wanted.quantity;
    return;
  }
}

}  // namespace

std::vector<double>* real_column(ParticleFrame& frame, Quantity quantity) {
  switch (quantity) {
    case Quantity::x:
      return &frame.x;
    case Quantity::y:
      return &frame.y;
    case Quantity::z:
      return &frame.z;
    case Quantity::radius:
    case Quantity::diameter:
    case Quantity::volume:
      return &frame.radius;
    case Quantity::vx:
      return &frame.vx;
    case Quantity::vy:
      return &frame.vy;
    case Quantity::vz:
      return &frame.vz;
    case Quantity::wx:
      return &frame.wx;
    case Quantity::wy:
      return &frame.wy;
    case Quantity::wz:
      return &frame.wz;
    case Quantity::density:
      return &frame.density;
    case Quantity::coordination:
      return &frame.coordination;
    default:
      break;
  }
  if (!is_stress(quantity)) return nullptr;
  return &frame.stress[static_cast<std::size_t>(quantity) - static_cast<std::size_t>(Quantity::stress_xx)];
}

std::vector<std::int32_t>* whole_column(ParticleFrame& frame, Quantity quantity) {
  switch (quantity) {
    case Quantity::material:
      return &frame.material;
    case Quantity::layer:
      return &frame.layer;
    case Quantity::bonded:
      return &frame.bonded;
    default:
      return nullptr;
  }
}

std::vector<ColumnNames> with_field_columns(std::vector<ColumnNames> names) {
  for (const auto& [quantity, name] : {std::pair{Quantity::layer, "layer"},
                                       {Quantity::bonded, "bonded"},
                                       {Quantity::coordination, "coordination"},
                                       {Quantity::stress_xx, "stress_xx"},
                                       {Quantity::stress_yy, "stress_yy"},
                                       {Quantity::stress_zz, "stress_zz"},
                                       {Quantity::stress_xy, "stress_xy"},
                                       {Quantity::stress_yz, "stress_yz"},
                                       {Quantity::stress_xz, "stress_xz"}})
    names.push_back({quantity, name, {name}});
  return names;
}

bool is_length(Quantity quantity) {
  return quantity == Quantity::x || quantity == Quantity::y || quantity == Quantity::z ||
         quantity == Quantity::radius || quantity == Quantity::diameter;
}
bool is_velocity(Quantity quantity) {
  return quantity == Quantity::vx || quantity == Quantity::vy || quantity == Quantity::vz;
}
bool is_spin(Quantity quantity) {
  return quantity == Quantity::wx || quantity == Quantity::wy || quantity == Quantity::wz;
}
bool is_size(Quantity quantity) {
  return quantity == Quantity::radius || quantity == Quantity::diameter || quantity == Quantity::volume;
}

bool is_stress(Quantity quantity) {
  return quantity >= Quantity::stress_xx && quantity <= Quantity::stress_xz;
}

double radius_of(Quantity quantity, double size) {
  constexpr double pi = 3.14159265358979323846;
  if (quantity == Quantity::diameter) return 0.5 * size;
  if (quantity == Quantity::volume) return std::cbrt(size * (3 / (4 * pi)));
  return size;
}

std::string shown(std::string_view text) {
  std::string out;
  for (const char c : text.substr(0, 40)) out += (c >= ' ' && c < 127) ? c : '?';
  return out + (text.size() > 40 ? "..." : "");
}

const ColumnMap::Column* ColumnMap::find(Quantity quantity) const {
  for (const auto& column : columns) {
    if (column.quantity == quantity) return &column;
  }
  return nullptr;
}

std::string Place::text() const {
  return frame < 0 ? lines.where() : fmt::format("{}: frame {}", lines.where(), frame);
}

std::string list_of(const std::vector<std::string>& names) {
  std::string all;
  for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 40); ++i) {
    all += (all.empty() ? "" : ", ") + shown(names[i]);
  }
  return all + (names.size() > 40 ? ", ..." : "");
}

std::vector<std::string_view> split(std::string_view line, Separator separator) {
  std::vector<std::string_view> cells;
  const auto blank = [](char c) { return c == ' ' || c == '\t'; };
  std::size_t at = 0;
  if (separator.blanks()) {
    while (at < line.size()) {
      while (at < line.size() && blank(line[at])) ++at;
      const std::size_t from = at;
      while (at < line.size() && !blank(line[at])) ++at;
      if (at > from) cells.push_back(line.substr(from, at - from));
    }
    return cells;
  }
  for (;;) {
    std::size_t to = line.find(separator.character, at);
    if (to == std::string_view::npos) to = line.size();
    std::string_view cell = line.substr(at, to - at);
    while (!cell.empty() && blank(cell.front())) cell.remove_prefix(1);
    while (!cell.empty() && blank(cell.back())) cell.remove_suffix(1);
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    cells.push_back(cell);
    if (to == line.size()) return cells;
    at = to + 1;
  }
}

ColumnMap map_columns(const std::vector<std::string>& present, const std::vector<ColumnNames>& known,
                      const std::map<std::string, std::string>& given, const std::string& where) {
  std::vector<std::string> ours;
  for (const auto& wanted : known) ours.push_back(wanted.ours);
  for (const auto& [name, file_name] : given) {
    if (std::find(ours.begin(), ours.end(), name) == ours.end()) {
      throw InputError(
          fmt::format("--columns {}={}: `{}` is no quantity; allowed are {}; correct the left side", name,
                      file_name, name, list_of(ours)));
    }
  }
  ColumnMap map;
  for (const auto& name : present) map.columns.push_back({Quantity::none, name, 1});
  for (const auto& wanted : known) map_one(wanted, present, given, where, map);

  constexpr std::array<std::pair<Quantity, const char*>, 3> needed{
      {{Quantity::x, "x"}, {Quantity::y, "y"}, {Quantity::z, "z"}}};
  for (const auto& [quantity, name] : needed) {
    if (map.find(quantity) == nullptr) {
      throw InputError(
          fmt::format("{}: no column `{}`; the columns are {}; write it out, or name it with --columns "
                      "{}=NAME",
                      where, name, list_of(present), name));
    }
  }
  constexpr std::array<Quantity, 3> sizes{Quantity::radius, Quantity::diameter, Quantity::volume};
  const auto size =
      std::find_if(sizes.begin(), sizes.end(), [&](Quantity q) { return map.find(q) != nullptr; });
  if (size == sizes.end()) {
    throw InputError(
        fmt::format("{}: no column `radius` or `diameter`; the columns are {}; add one to the dump, or "
                    "name it with --columns radius=NAME",
                    where, list_of(present)));
  }
  // With several sizes present the first of the list is taken; the others are not read twice.
  for (auto& column : map.columns) {
    if (is_size(column.quantity) && column.quantity != *size) column.quantity = Quantity::none;
  }
  return map;
}

bool parse_number(std::string_view text, double& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range && end == text.data() + text.size()) {
    value =
        std::strtod(std::string(text).c_str(), nullptr);  // tells underflow (fine) from overflow (infinite)
    return true;
  }
  return error == std::errc() && end == text.data() + text.size();
}

bool parse_number(std::string_view text, std::int64_t& value) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return true;
  double real = 0;  // some writers print whole numbers as "12.0" or "1e6"
  if (!parse_number(text, real) || !(std::abs(real) < 0x1p53) || real != std::floor(real)) return false;
  value = static_cast<std::int64_t>(real);
  return true;
}

namespace {

[[noreturn]] void bad_cell(const Place& place, const ColumnMap::Column& column, std::string_view cell,
                           const char* what, const char* allowed, const ParticleFrame& frame, bool id_known) {
  const std::string who =
      id_known && !frame.id.empty() ? fmt::format(" of particle {}", frame.id.back()) : "";
  throw InputError(fmt::format("{}: {}{}: `{}` {}; {}; correct or remove the row", place.text(),
                               shown(column.name), who, shown(cell), what, allowed));
}

void append_cell(std::string_view cell, const ColumnMap::Column& column, const Place& place,
                 ParticleFrame& frame, bool id_known, WrittenDigits* digits) {
  std::vector<std::int32_t>* const whole_numbers = whole_column(frame, column.quantity);
  if (column.quantity == Quantity::id || whole_numbers != nullptr) {
    std::int64_t whole = 0;
    if (!parse_number(cell, whole)) {
      bad_cell(place, column, cell, "is no whole number", "whole numbers only", frame, id_known);
    }
    if (column.quantity == Quantity::id) {
      frame.id.push_back(whole);
    } else {
      if (whole < INT32_MIN || whole > INT32_MAX) {
        bad_cell(place, column, cell, "is too large", "at most 2147483647", frame, id_known);
      }
      whole_numbers->push_back(static_cast<std::int32_t>(whole));
    }
    return;
  }
  double value = 0;
  if (!parse_number(cell, value))
    bad_cell(place, column, cell, "is no number", "numbers only", frame, id_known);
  const double as_written = value;
  value *= column.factor;
  if (!std::isfinite(value))
    bad_cell(place, column, cell, "is not finite", "finite numbers only", frame, id_known);
  if (is_size(column.quantity)) {
    value = radius_of(column.quantity, value);
    if (!(value > 0)) bad_cell(place, column, cell, "is not positive", "sizes above 0", frame, id_known);
  }
  if (digits != nullptr && column.quantity >= Quantity::x && column.quantity <= Quantity::z) {
    digits->add(static_cast<std::size_t>(column.quantity) - static_cast<std::size_t>(Quantity::x), cell,
                as_written);
  }
  real_column(frame, column.quantity)->push_back(value);
}

}  // namespace

void append_row(std::string_view line, Separator separator, const ColumnMap& map, const Place& place,
                ParticleFrame& frame, WrittenDigits* digits) {
  const auto cells = split(line, separator);
  if (cells.size() != map.columns.size()) {
    throw InputError(
        fmt::format("{}: {} values in a row; the header names {} columns; complete or remove the row",
                    place.text(), cells.size(), map.columns.size()));
  }
  // The id first: a message about any other cell can then say whose it is.
  bool id_known = false;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (map.columns[c].quantity != Quantity::id) continue;
    append_cell(cells[c], map.columns[c], place, frame, false, nullptr);
    id_known = true;
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto& column = map.columns[c];
    if (column.quantity == Quantity::none || column.quantity == Quantity::id ||
        column.quantity == Quantity::time)
      continue;
    append_cell(cells[c], column, place, frame, id_known, digits);
  }
}

std::int64_t sort_by_id(ParticleFrame& frame) {
  if (frame.id.empty()) return 0;
  if (!std::is_sorted(frame.id.begin(), frame.id.end())) {
    std::vector<std::size_t> order(frame.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return frame.id[a] < frame.id[b]; });
    const auto apply = [&](auto& column) {
      if (column.empty()) return;
      auto sorted = column;
      for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = column[order[i]];
      column = std::move(sorted);
    };
    for (auto* c : {&frame.x, &frame.y, &frame.z, &frame.radius, &frame.vx, &frame.vy, &frame.vz, &frame.wx,
                    &frame.wy, &frame.wz, &frame.density, &frame.coordination}) {
      apply(*c);
    }
    for (auto& c : frame.stress) apply(c);
    for (auto* c : {&frame.material, &frame.layer, &frame.bonded}) apply(*c);
    apply(frame.id);
  }
  std::int64_t repeated = 0;
  for (std::size_t i = 1; i < frame.id.size(); ++i) repeated += frame.id[i] == frame.id[i - 1] ? 1 : 0;
  return repeated;
}

}  // namespace interstice::io
