#include "coupling/studies/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "base/error.h"

namespace interstice::studies {
namespace {

struct Cell {
  std::string text;
  std::size_t column = 1;  // where it begins in its line, from 1
};

/// Splits a line at its commas; a cell in quotes may hold commas and doubled quotes.
std::vector<Cell> split(std::string_view line) {
  std::vector<Cell> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back().text += line[++i];
    } else if (c == '"' && (quoted || cells.back().text.empty())) {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.push_back({"", i + 2});
    } else {
      cells.back().text += c;
    }
  }
  return cells;
}

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::optional<double> number(std::string_view text) {
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Takes the next line off `rest`; false at the end, and at a cut-short line of a file that grows.
bool next_line(std::string_view& rest, std::string_view& line, bool growing) {
  if (rest.empty()) return false;
  const auto end = rest.find('\n');
  if (end == std::string_view::npos) {
    if (growing) return false;
    line = rest;
    rest = {};
  } else {
    line = rest.substr(0, end);
    rest.remove_prefix(end + 1);
  }
  return true;
}

std::string content_of(const std::filesystem::path& path) {
  std::error_code ignored;
  std::ifstream file(path, std::ios::binary);
  if (!file || std::filesystem::is_directory(path, ignored)) {
    throw InputError(fmt::format("{}: cannot be opened; a CSV file is wanted here", path.string()));
  }
  std::ostringstream text;
  text << file.rdbuf();
  return std::move(text).str();
}

}  // namespace

const Table::Column* Table::find(std::string_view name) const {
  const auto at =
      std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
  return at == columns_.end() ? nullptr : &*at;
}

const Table::Column& Table::require(std::string_view name) const {
  if (const Column* column = find(name)) return *column;
  std::string names;
  for (const auto& column : columns_) names += (names.empty() ? "" : ", ") + column.name;
  throw InputError(fmt::format("{}:1: no column {}; there are {}", source_, name, names));
}

const std::vector<double>& Table::numbers(std::string_view name) const { return require(name).numbers; }
const std::vector<std::string>& Table::texts(std::string_view name) const { return require(name).texts; }

Table read_table(const std::filesystem::path& path, const TableOptions& options) {
  const std::string content = content_of(path);
  std::string_view rest = content, line;
  if (!next_line(rest, line, false) || trimmed(line).empty()) {
    throw InputError(fmt::format("{}:1:1: no header; the first line must name the columns", path.string()));
  }
  std::vector<Table::Column> columns;
  std::vector<bool> is_text;
  for (const auto& cell : split(line)) {
    const std::string name(trimmed(cell.text));
    columns.push_back({name, {}, {}});
    is_text.push_back(std::find(options.text_columns.begin(), options.text_columns.end(), name) !=
                      options.text_columns.end());
  }

  std::size_t rows = 0;
  for (std::size_t at_line = 2; next_line(rest, line, options.growing); ++at_line) {
    if (trimmed(line).empty()) continue;
    const auto cells = split(line);
    if (cells.size() != columns.size()) {
      throw InputError(
          fmt::format("{}:{}:1: {} cells; the header names {} columns; repair or remove this line",
                      path.string(), at_line, cells.size(), columns.size()));
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const auto text = trimmed(cells[c].text);
      if (is_text[c]) {
        columns[c].texts.emplace_back(text);
      } else if (const auto value = number(text)) {
        columns[c].numbers.push_back(*value);
      } else {
        throw InputError(fmt::format("{}:{}:{}: {}: '{}' is no number", path.string(), at_line,
                                     cells[c].column, columns[c].name, text));
      }
    }
    ++rows;
  }
  return {path.string(), std::move(columns), rows};
}

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\r\n") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) {
    if (c == '"') cell += '"';
    cell += c;
  }
  return cell + '"';
}

std::string csv_cell(double value) { return std::isnan(value) ? std::string() : fmt::format("{}", value); }

}  // namespace interstice::studies
