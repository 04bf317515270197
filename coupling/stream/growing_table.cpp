#include "coupling/stream/growing_table.h"

#include <cstdlib>
#include <vector>

#include "base/error.h"

namespace interstice::stream {
namespace {

/// The complete lines of a file whose last one may have been cut by a kill.
std::vector<std::string> complete_lines(const std::filesystem::path& path) {
  std::ifstream in(path);
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) {
    if (in.eof()) break;  // no newline after it: cut short
    lines.push_back(line);
  }
  return lines;
}

double number_in_column(const std::string& row, int column) {
  std::size_t at = 0;
  for (int c = 0; c < column && at != std::string::npos; ++c) at = row.find(',', at) + 1;
  return std::strtod(row.c_str() + at, nullptr);
}

}  // namespace

GrowingTable::GrowingTable(std::filesystem::path path, const std::string& header,
                           std::optional<double> keep_until, int time_column)
    : path_(std::move(path)) {
  std::string kept = header + "\n";
  if (keep_until && std::filesystem::exists(path_)) {
    const std::vector<std::string> lines = complete_lines(path_);
    if (!lines.empty() && lines.front() != header) {
      throw InputError(path_.string() +
                       ":1: not a table of this scene; only a run of the same scene can be "
                       "continued; use --overwrite to start anew");
    }
    for (std::size_t i = 1; i < lines.size(); ++i) {
      if (number_in_column(lines[i], time_column) <= *keep_until) kept += lines[i] + "\n";
    }
  }
  out_.open(path_, std::ios::trunc);
  out_ << kept << std::flush;
  if (!out_) throw RunError("cannot write " + path_.string() + "; is the folder writable, the disk full?");
}

void GrowingTable::append(const std::string& row) {
  out_ << row << '\n' << std::flush;
  if (!out_) throw RunError("cannot write " + path_.string() + "; is the disk full?");
}

}  // namespace interstice::stream
