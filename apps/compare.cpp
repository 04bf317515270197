// `interstice compare DIR_A DIR_B -o DIR`: two runs, or what `voids` made of two files, side by side.
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/error.h"
#include "coupling/studies/compare_runs.h"

namespace interstice::apps {
namespace {

namespace fs = std::filesystem;

struct CompareWords {
  std::string a, b, output;
  std::vector<std::string> labels;
  bool json = false, overwrite = false, no_figures = false;
};

/// Results must not land in (or, with --overwrite, clear) a run that is compared.
void refuse_own_inputs(const CompareWords& words) {
  const auto real = [](const fs::path& path) { return fs::weakly_canonical(path); };
  const auto output = real(words.output);
  for (const auto& run : {words.a, words.b}) {
    const auto input = real(run);
    const auto [end, ignored] = std::mismatch(output.begin(), output.end(), input.begin(), input.end());
    if (end == output.end()) {
      throw InputError(
          fmt::format("-o: {} holds {}, which is compared; name another folder", words.output, run));
    }
  }
}

studies::Labels labels_of(const CompareWords& words) {
  if (words.labels.empty()) return studies::default_labels(words.a, words.b);
  if (words.labels.size() != 2 || words.labels[0].empty() || words.labels[1].empty() ||
      words.labels[0] == words.labels[1]) {
    throw InputError(
        "--labels: two different names are wanted, for A and for B, such as --labels static,compactors");
  }
  return {words.labels[0], words.labels[1]};
}

nlohmann::ordered_json json_of(const studies::Comparison& comparison, const studies::ComparisonFiles& files) {
  const auto number = [](double v) { return std::isfinite(v) ? nlohmann::ordered_json(v) : nullptr; };
  nlohmann::ordered_json json;
  for (std::size_t r = 0; r < 2; ++r) {
    json[r == 0 ? "A" : "B"] = {{"label", comparison.labels[r]}, {"folder", comparison.folders[r].string()}};
  }
  json["quantities"] = nlohmann::ordered_json::array();
  for (const auto& q : comparison.quantities) {
    json["quantities"].push_back({{"quantity", q.name},
                                  {"A", number(q.a)},
                                  {"B", number(q.b)},
                                  {"difference", number(q.difference())},
                                  {"ratio", number(q.ratio())},
                                  {"meaning", q.meaning}});
  }
  json["difference_fields"] = nlohmann::ordered_json::array();
  for (const auto& [field, d] : comparison.differences) {
    nlohmann::ordered_json entry{{"field", field}};
    if (d.obstacle.empty()) {
      entry.update({{"whole_box", d.whole}, {"mean", d.mean}, {"rms", d.rms}, {"largest", d.largest}});
    } else {
      entry["none_because"] = d.obstacle;
    }
    json["difference_fields"].push_back(entry);
  }
  json["remarks"] = comparison.remarks;
  json["files"] = nlohmann::ordered_json::array();
  for (const auto& path : files.written) json["files"].push_back(path.string());
  return json;
}

void compare(const CompareWords& words) {
  const auto labels = labels_of(words);
  refuse_own_inputs(words);
  auto comparison = studies::compare_runs(words.a, words.b, labels);
  if (words.no_figures) comparison.figures.clear();
  prepare_output_folder(words.output, words.overwrite);
  const auto files = studies::write_comparison(words.output, comparison);
  if (!files.warning.empty()) fmt::print(stderr, "warning: {}\n", files.warning);
  if (words.json) {
    fmt::print("{}\n", json_of(comparison, files).dump(2));
  } else {
    fmt::print("{}\n{} files in {}\n", studies::report(comparison), files.written.size(), words.output);
  }
}

}  // namespace

void add_compare(CLI::App& root) {
  auto words = std::make_shared<CompareWords>();
  auto* c = root.add_subcommand("compare",
                                "Two runs, or two particle files by their fields, side by side: numbers, "
                                "figures, difference of their fields");
  c->add_option("A", words->a, "folder that `interstice run` wrote, or `interstice voids` of one frame")
      ->required();
  c->add_option("B", words->b, "another; differences are B - A, ratios B / A")->required();
  c->add_option("-o,--output", words->output, "folder for the results")->required();
  c->add_option("--labels", words->labels, "names of A and B in figures and text, such as static,compactors")
      ->delimiter(',');
  c->add_flag("--json", words->json, "print the result as one JSON object");
  c->add_flag("--overwrite", words->overwrite, "replace results in the folder");
  c->add_flag("--no-figures", words->no_figures, "no PNG files");
  c->callback([words] { compare(*words); });
}

}  // namespace interstice::apps
