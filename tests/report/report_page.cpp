// report_page KIND OUT.md FILE.tsv...: a page of what the checks have found (report.h says how they are
// written), KIND `check` or `extreme`. Sections come in the order of the files' names, then of the rows; the
// same rows give the same bytes.
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using Row = std::vector<std::string>;

/// The columns of one kind of row after the kind itself, as report.cpp writes them.
struct Page {
  std::string kind;
  std::size_t columns;
  std::string heading, separator, introduction;
};
const Page kPages[] = {
    {"check", 7, "| quantity | reference | got | tolerance | passed |", "|---|---|---|---|---|",
     R"(# Verification

What the program computes, held against closed forms and published results. Made by

    tests/verification/make_page.sh BUILD_DIR

which runs the programs of tests/verification and writes down every check that they make, in VERIFICATION.md; with
`LONG=1` it runs those of the label `long`, assemblies of many grains that take minutes each, and writes
VERIFICATION_LONG.md.

`yes`: within the tolerance, which the test's source gives the reason for. `NO`: not; the test fails. `shown`: set
beside the reference and not held to it, for the reason in the column of the tolerance (a disagreement of models, a
point of a curve whose whole is held). In brackets is the back end: `double`, `reference` (serial, every pair tried)
and `mixed` (laws in single precision); those that agree to the last digit shown share a row.

)"},
    {"extreme", 4, "| tried | outcome | as it must be |", "|---|---|---|",
     R"(# Extremes

What the program does at the ends of what can be asked of it. Made by

    tests/extremes/make_page.sh BUILD_DIR

which runs the programs of tests/extremes and writes down what they tried, in EXTREMES.md; with `LONG=1` it runs the
long ones and writes EXTREMES_LONG.md.

)"},
};

const Page& page_of(const std::string& kind) {
  for (const Page& p : kPages) {
    if (p.kind == kind) return p;
  }
  throw std::runtime_error(fmt::format("'{}': the kind must be check or extreme", kind));
}

std::vector<Row> read_rows(const Page& page, const std::string& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error(fmt::format("{}: cannot be read", file));
  std::vector<Row> rows;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    Row cells;
    for (std::size_t begin = 0; begin <= line.size();) {
      const std::size_t end = std::min(line.find('\t', begin), line.size());
      cells.push_back(line.substr(begin, end - begin));
      begin = end + 1;
    }
    if (cells[0] != page.kind) continue;
    if (cells.size() != page.columns + 1) {
      throw std::runtime_error(
          fmt::format("{}, line {}: {} columns instead of {}", file, number, cells.size(), page.columns + 1));
    }
    rows.emplace_back(cells.begin() + 1, cells.end());
  }
  return rows;
}

/// What markdown would take for the end of a cell.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '|') out += '\\';
    out += c;
  }
  return out;
}

/// One case: its rows, and for checks the sources that they name, each once.
struct Section {
  std::string what;
  std::vector<std::string> sources;
  std::vector<Row> rows;
};

std::vector<Section> sections_of(const Page& page, std::vector<std::string> files) {
  const auto name = [](const std::string& f) { return std::filesystem::path(f).filename().string(); };
  std::sort(files.begin(), files.end(),
            [&](const auto& a, const auto& b) { return std::pair(name(a), a) < std::pair(name(b), b); });
  std::vector<Section> sections;
  for (const std::string& file : files) {
    for (Row& row : read_rows(page, file)) {
      auto section =
          std::find_if(sections.begin(), sections.end(), [&](const Section& s) { return s.what == row[0]; });
      if (section == sections.end()) section = sections.insert(section, {row[0], {}, {}});
      if (page.kind == "check") {
        std::vector<std::string>& sources = section->sources;
        if (std::find(sources.begin(), sources.end(), row[6]) == sources.end()) sources.push_back(row[6]);
        row.pop_back();
      }
      section->rows.emplace_back(row.begin() + 1, row.end());
    }
  }
  return sections;
}

/// The back end that a quantity names at its end, with the bracket before it: " (mixed)"; else nothing.
std::string back_end_of(const std::string& quantity) {
  for (const char* suffix : {" (double)", " (reference)", " (mixed)"}) {
    if (quantity.ends_with(suffix)) return suffix;
  }
  return "";
}

/// Rows that several back ends agree on to the last digit shown become one, which names them all.
std::vector<Row> joined(const std::vector<Row>& rows) {
  std::vector<Row> out;  // with the quantity's bare name
  std::vector<std::string> back_ends;
  for (Row row : rows) {
    const std::string suffix = back_end_of(row[0]);
    row[0].resize(row[0].size() - suffix.size());
    const std::string back_end = suffix.empty() ? "" : suffix.substr(2, suffix.size() - 3);
    const auto same = suffix.empty() ? out.end() : std::find(out.begin(), out.end(), row);
    if (same != out.end() && !back_ends[static_cast<std::size_t>(same - out.begin())].empty()) {
      back_ends[static_cast<std::size_t>(same - out.begin())] += ", " + back_end;
    } else {
      out.push_back(row);
      back_ends.push_back(back_end);
    }
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (!back_ends[i].empty()) out[i][0] += fmt::format(" ({})", back_ends[i]);
  }
  return out;
}

/// How many rows passed, were shown, or did not pass.
std::string summary(const std::vector<Section>& sections) {
  std::size_t passed = 0, shown = 0, failed = 0;
  for (const Section& s : sections) {
    for (const Row& r : s.rows) ++(r.back() == "yes" ? passed : r.back() == "shown" ? shown : failed);
  }
  std::string text = fmt::format("{} cases; {} checks passed, {} did not", sections.size(), passed, failed);
  if (shown > 0) text += fmt::format(", {} numbers are shown", shown);
  return text + ".\n";
}

void write_page(const Page& page, const std::vector<Section>& sections, const std::string& file) {
  std::ofstream out(file);
  out << page.introduction << summary(sections);
  for (const Section& s : sections) {
    out << "\n## " << s.what << "\n\n";
    for (const std::string& source : s.sources) out << "Reference: " << source << ".\n";
    if (!s.sources.empty()) out << '\n';
    out << page.heading << '\n' << page.separator << '\n';
    for (const Row& row : joined(s.rows)) {
      for (const std::string& cell : row) out << "| " << escaped(cell) << ' ';
      out << "|\n";
    }
  }
  if (!out.flush()) throw std::runtime_error(fmt::format("{}: cannot be written", file));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "report_page check|extreme OUT.md FILE.tsv...: writes the page OUT.md\n";
    return 2;
  }
  try {
    const Page& page = page_of(argv[1]);
    write_page(page, sections_of(page, {argv + 3, argv + argc}), argv[2]);
  } catch (const std::exception& e) {
    std::cerr << "report_page: " << e.what() << '\n';
    return 1;
  }
  return 0;
}
