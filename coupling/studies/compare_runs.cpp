#include "coupling/studies/compare_runs.h"

#include <fmt/format.h>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/io/atomic_file.h"

namespace interstice::studies {
namespace {

namespace fs = std::filesystem;

/// Both folders are read before either is complained of, so that all faults are told at once.
std::array<RunFolder, 2> read_both(const fs::path& a, const fs::path& b) {
  std::array<RunFolder, 2> runs;
  std::vector<std::string> faults;
  const fs::path paths[2] = {a, b};
  for (std::size_t r = 0; r < 2; ++r) {
    try {
      runs[r] = read_run_folder(paths[r]);
    } catch (const InputError& error) {
      faults.insert(faults.end(), error.messages().begin(), error.messages().end());
    }
  }
  if (!faults.empty()) throw InputError(faults);
  return runs;
}

/// What only one of the runs has.
void add_remarks(std::vector<std::string>& remarks, const std::string& kind,
                 const std::vector<std::string>& names, const std::array<RunFolder, 2>& runs,
                 const Labels& labels, const auto& has) {
  for (const auto& name : names) {
    for (std::size_t r = 0; r < 2; ++r) {
      if (!has(runs[r], name)) remarks.push_back(fmt::format("{} '{}' is not in {}.", kind, name, labels[r]));
    }
  }
}

std::vector<std::string> remarks_on(const std::array<RunFolder, 2>& runs, const Labels& labels) {
  std::vector<std::string> remarks;
  const auto& [a, b] = runs;
  for (std::size_t r = 0; r < 2; ++r) {
    const std::string& reason = runs[r].exit_reason;
    if (!reason.empty() && reason != "done" && reason != "completed" && reason != "finished") {
      remarks.push_back(fmt::format("{} did not come to its end: {}.", labels[r], reason));
    }
    if (runs[r].simulated && runs[r].series.rows() == 0)
      remarks.push_back(fmt::format("{} has no samples in series.csv.", labels[r]));
  }
  add_remarks(remarks, "phase", phases_of_both(a, b), runs, labels,
              [](const RunFolder& run, const std::string& name) { return run.phase(name) != nullptr; });
  add_remarks(remarks, "field", fields_of_both(a, b), runs, labels,
              [](const RunFolder& run, const std::string& name) { return run.field(name) != nullptr; });
  add_remarks(
      remarks, "watched wall", walls_of_both(a, b), runs, labels,
      [](const RunFolder& run, const std::string& name) { return run.series.has(name + "_normal_force_N"); });
  return remarks;
}

void add_differences(Comparison& comparison, const std::array<RunFolder, 2>& runs) {
  for (const auto& field : fields_of_both(runs[0], runs[1])) {
    const auto pairs = moment_pairs(runs[0], runs[1], field);
    if (pairs.empty() || pairs.back().a == nullptr || pairs.back().b == nullptr) continue;
    std::error_code ignored;
    if (!fs::exists(pairs.back().a->vdb, ignored) || !fs::exists(pairs.back().b->vdb, ignored)) {
      comparison.remarks.push_back(
          fmt::format("field '{}': no difference field, for want of its .vdb file in both runs.", field));
      continue;
    }
    comparison.differences.push_back({field, field_difference(pairs.back().a->vdb, pairs.back().b->vdb)});
  }
}

void make_folder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (problem) throw RunError(fmt::format("cannot make {}: {}", folder.string(), problem.message()));
}

void draw(const fs::path& png, const NamedFigure& named) {
  if (const auto* slices = std::get_if<figures::SliceFigure>(&named.figure)) {
    figures::write_slices(png, *slices);
  } else {
    figures::write_curves(png, std::get<std::vector<figures::CurveFigure>>(named.figure));
  }
}

/// Folder names come into file names; anything that is no plain file name letter becomes an underscore.
std::string file_name(std::string name) {
  for (char& c : name) {
    if (c == '/' || c == '\\' || static_cast<unsigned char>(c) < 0x20) c = '_';
  }
  return name;
}

}  // namespace

Labels default_labels(const fs::path& a, const fs::path& b) {
  const auto name = [](const fs::path& path) {
    const auto normal = fs::absolute(path).lexically_normal();
    return (normal.has_filename() ? normal.filename() : normal.parent_path().filename()).string();
  };
  Labels labels{name(a), name(b)};
  if (labels[0] == labels[1] || labels[0].empty() || labels[1].empty()) labels = {"A", "B"};
  return labels;
}

Comparison compare_runs(const fs::path& a, const fs::path& b, const Labels& labels) {
  const auto runs = read_both(a, b);
  Comparison comparison;
  comparison.folders = {a, b};
  comparison.labels = labels;
  comparison.remarks = remarks_on(runs, labels);
  comparison.quantities = compare_quantities(runs[0], runs[1]);
  comparison.figures = series_figures(runs[0], runs[1], labels);
  auto of_fields = field_figures(runs[0], runs[1], labels);
  std::move(of_fields.begin(), of_fields.end(), std::back_inserter(comparison.figures));
  add_differences(comparison, runs);
  return comparison;
}

ComparisonFiles write_comparison(const fs::path& folder, const Comparison& comparison) {
  ComparisonFiles files;
  const auto text = [&](const char* name, const std::string& content) {
    io::write_text_atomically(folder / name, content);
    files.written.push_back(folder / name);
  };
  make_folder(folder);
  text("comparison.csv", comparison_csv(comparison.quantities));
  text("report.md", report(comparison));
  for (const auto& [field, difference] : comparison.differences) {
    if (!difference.obstacle.empty()) continue;
    make_folder(folder / "fields");
    const auto path = folder / "fields" / (file_name(field) + "_difference");
    write_difference(
        path, difference,
        fmt::format("{} minus {}", comparison.folders[1].string(), comparison.folders[0].string()));
    for (const char* ending : {".vdb", ".vti"}) {
      auto written = path;
      written += ending;
      files.written.push_back(written);
    }
  }
  if (!figures::plotting_available()) {
    files.warning = "gnuplot is not on PATH: no figures were drawn; install gnuplot-nox and run this again";
    return files;
  }
  for (const auto& figure : comparison.figures) {
    const auto png = folder / "figures" / (file_name(figure.name) + ".png");
    draw(png, figure);
    files.written.push_back(png);
  }
  return files;
}

}  // namespace interstice::studies
