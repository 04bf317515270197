// Two runs side by side: numbers, figures, the difference of their fields, and a summary in plain sentences.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "coupling/studies/compare_figures.h"
#include "coupling/studies/difference_field.h"
#include "coupling/studies/quantities.h"

namespace interstice::studies {

struct NamedDifference {
  std::string field;
  FieldDifference difference;  // of the last frames
};

/// All that a comparison consists of, before anything is written.
struct Comparison {
  std::array<std::filesystem::path, 2> folders;
  Labels labels;
  std::vector<Quantity> quantities;
  std::vector<NamedDifference> differences;
  std::vector<NamedFigure> figures;
  std::vector<std::string> remarks;  // what the two runs do not share, and what that leaves out
};

/// Labels where none are given: the folders' names, or A and B where these are the same.
Labels default_labels(const std::filesystem::path& a, const std::filesystem::path& b);

/// Reads both folders. Throws InputError, with every fault that was found, where one is missing or broken.
Comparison compare_runs(const std::filesystem::path& a, const std::filesystem::path& b, const Labels& labels);

struct ComparisonFiles {
  std::vector<std::filesystem::path> written;
  std::string warning;  // why there are no figures; empty where there are
};

/// comparison.csv, report.md, fields/FIELD_difference.vdb and .vti, figures/*.png (with their data and
/// scripts).
ComparisonFiles write_comparison(const std::filesystem::path& folder, const Comparison& comparison);

/// The summary: a few sentences with the numbers that matter.
std::string report(const Comparison& comparison);

}  // namespace interstice::studies
