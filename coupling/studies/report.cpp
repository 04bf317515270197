// The summary of a comparison in plain sentences.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "coupling/studies/compare_runs.h"
#include "coupling/studies/moment_files.h"

namespace interstice::studies {
namespace {

/// 1.79e-06 N as "1.79 µN".
std::string with_unit(double value, const std::string& unit) {
  if (unit.empty()) return fmt::format("{:.4g}", value);
  const std::pair<double, const char*> prefixes[] = {{1e6, "M"},  {1e3, "k"},  {1, ""},     {1e-3, "m"},
                                                     {1e-6, "µ"}, {1e-9, "n"}, {1e-12, "p"}};
  for (const auto& [power, prefix] : prefixes) {
    if (std::abs(value) >= power * (1 - 1e-12))
      return fmt::format("{:.4g} {}{}", value / power, prefix, unit);
  }
  return fmt::format("{:.4g} {}", value, unit);
}

std::string unit_of(const std::string& name) {
  for (const char* unit : {"N", "Pa", "m", "s"}) {
    if (name.ends_with(std::string("_") + unit)) return unit;
  }
  return "";
}

/// "0.412 in A, 0.533 in B (B is 1.294 times A)".
std::string values(const Quantity& q, const Labels& labels) {
  const std::string unit = unit_of(q.name);
  if (std::isnan(q.a))
    return fmt::format("{} in {}; {} has none", with_unit(q.b, unit), labels[1], labels[0]);
  if (std::isnan(q.b))
    return fmt::format("{} in {}; {} has none", with_unit(q.a, unit), labels[0], labels[1]);
  std::string text =
      fmt::format("{} in {}, {} in {}", with_unit(q.a, unit), labels[0], with_unit(q.b, unit), labels[1]);
  if (std::isfinite(q.ratio())) text += fmt::format(" (ratio {:.4g})", q.ratio());
  return text;
}

/// Ends of names worth a sentence, in order, and what the sentence calls them.
const std::pair<const char*, const char*> told[] = {
    {"contact_force_mean_N", "the mean inter-particle force"},
    {"normal_force_per_contact_N", "the normal force per contact on {}"},
    {"shear_force_per_contact_N", "the shear force per contact on {}"},
    {"normal_stress_contact_area_Pa", "the normal stress on {} (per contact area)"},
    {"shear_stress_contact_area_Pa", "the shear stress on {} (per contact area)"},
    {"solid_fraction_gap", "the solid fraction in the layer gap"},
    {"solid_fraction_sd", "its standard deviation over columns"},
    {"solid_height_m", "the solid height"},
    {"surface_height_m", "the surface height"},
    {"solid_fraction_below_surface", "the solid fraction below the surface"},
    {"void_fraction_mean", "the mean void fraction"},
    {"void_fraction_min", "the smallest void fraction"},
    {"void_fraction_averaged_min", "the smallest averaged void fraction"},
};

std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    parts.push_back(name.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

/// A bullet, and the heading it belongs under; no text for what is not worth a sentence.
struct Sentence {
  std::string heading, text;
};

/// MOMENT/FIELD/lines/LINE/NUMBER and MOMENT/FIELD/NUMBER are of fields, PHASE/WALL/NUMBER of walls,
/// PHASE/NUMBER of the bed. Lines are told at the end only: comparison.csv has the rest.
Sentence sentence(const Quantity& q, const Labels& labels) {
  const auto parts = parts_of(q.name);
  if (parts.size() < 2) return {};
  const auto at =
      std::find_if(std::begin(told), std::end(told), [&](const auto& t) { return parts.back() == t.first; });
  if (at == std::end(told)) return {};
  std::string what = at->second;
  const bool line = parts.size() == 5 && parts[2] == "lines";
  const auto gap = what.find("{}");
  if (gap != std::string::npos) what.replace(gap, 2, parts[1]);
  const bool of_field = line || (parts.size() == 3 && gap == std::string::npos);
  if (line && parts[0] != "end") return {};
  Sentence result;
  result.heading = !of_field           ? fmt::format("During {}", parts[0])
                   : parts[0] == "end" ? fmt::format("Field '{}' at the end", parts[1])
                                       : fmt::format("Field '{}' after {}", parts[1], parts[0]);
  what[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(what[0])));
  const std::string where = line ? fmt::format(" {}", spoken(parts[3])) : "";
  result.text = fmt::format("- {}{}: {}.\n", what, where, values(q, labels));
  return result;
}

}  // namespace

std::string report(const Comparison& comparison) {
  const Labels& labels = comparison.labels;
  std::string text =
      fmt::format("# {} against {}\n\n- A is {} ({}).\n- B is {} ({}).\n", labels[1], labels[0], labels[0],
                  comparison.folders[0].string(), labels[1], comparison.folders[1].string());
  for (const auto& q : comparison.quantities) {
    if (q.name == "grains_lost") text += fmt::format("- Grains lost: {}.\n", values(q, labels));
  }
  std::string last;
  for (const auto& q : comparison.quantities) {
    const auto [heading, line] = sentence(q, labels);
    if (line.empty()) continue;
    if (heading != last) text += fmt::format("\n## {}\n\n", heading);
    last = heading;
    text += line;
  }
  if (!comparison.differences.empty() || !comparison.remarks.empty()) text += "\n## Notes\n\n";
  for (const auto& [field, d] : comparison.differences) {
    if (!d.obstacle.empty()) {
      text += fmt::format("- Field '{}' has no voxel-by-voxel difference: {}.\n", field, d.obstacle);
      continue;
    }
    text += fmt::format(
        "- Field '{}', last frames{}: the void fraction differs by {:+.4g} in the mean, {:.4g} rms, at "
        "most {:+.4g} in one voxel.\n",
        field, d.whole ? "" : ", on the box that both cover", d.mean, d.rms, d.largest);
  }
  for (const auto& remark : comparison.remarks) text += fmt::format("- {}\n", remark);
  return text;
}

}  // namespace interstice::studies
