// Tables of numbers in CSV files, as this tool writes them: a header, then rows of as many cells.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace interstice::studies {

/// Columns of equal length. A column holds numbers, or text where the reader was told so.
class Table {
 public:
  struct Column {
    std::string name;
    std::vector<double> numbers;
    std::vector<std::string> texts;
  };

  Table() = default;
  Table(std::string source, std::vector<Column> columns, std::size_t rows)
      : source_(std::move(source)), columns_(std::move(columns)), rows_(rows) {}

  std::size_t rows() const { return rows_; }
  const std::vector<Column>& columns() const { return columns_; }
  bool has(std::string_view name) const { return find(name) != nullptr; }

  /// Throws InputError("FILE: no column NAME; ...") where there is none.
  const std::vector<double>& numbers(std::string_view name) const;
  const std::vector<std::string>& texts(std::string_view name) const;

 private:
  const Column* find(std::string_view name) const;
  const Column& require(std::string_view name) const;

  std::string source_;
  std::vector<Column> columns_;
  std::size_t rows_ = 0;
};

struct TableOptions {
  std::vector<std::string>
      text_columns;      // the others must hold numbers ("nan" included; an empty cell is NaN)
  bool growing = false;  // a row that a kill cut short (no line end) is left out instead of being an error
};

/// Throws InputError("FILE:LINE:COLUMN: what; allowed; remedy").
Table read_table(const std::filesystem::path& path, const TableOptions& options = {});

/// A cell of a CSV file: quoted where it holds a comma, a quote or a line break.
std::string csv_cell(std::string_view text);
/// The shortest text that reads back as the same number; nothing for NaN.
std::string csv_cell(double number);

}  // namespace interstice::studies
