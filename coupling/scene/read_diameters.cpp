// How large the grains of a group are.
#include <fmt/format.h>

#include <cmath>

#include "coupling/scene/format_quantity.h"
#include "coupling/scene/readers.h"

namespace interstice::scene {
namespace {

SizeLaw law_of(std::string_view word) {
  if (word == "normal") return SizeLaw::normal;
  if (word == "lognormal") return SizeLaw::lognormal;
  if (word == "uniform") return SizeLaw::uniform;
  if (word == "bimodal") return SizeLaw::bimodal;
  if (word == "table") return SizeLaw::table;
  return SizeLaw::single;
}

/// min < max, and the centres between them. Comparisons are false for what was no number (and is reported
/// already).
void check_cut(const TableReader& table, const Diameters& d) {
  if (d.min >= d.max)
    table.error("max", fmt::format("{} is not above min, {}", format_length(d.max), format_length(d.min)),
                "min must be less than max", "swap the two, or write diameter = \"40 um\" for one size");
  if (!(d.min < d.max)) return;
  const auto inside = [&](std::string_view key, double center) {
    if (center < d.min || center > d.max)
      table.error(key, fmt::format("{} is outside the distribution's cut", format_length(center)),
                  fmt::format("{} to {} is allowed (min to max)", format_length(d.min), format_length(d.max)),
                  "move it, or min or max");
  };
  if (d.law == SizeLaw::lognormal) inside("median", d.mean);
  if (d.law == SizeLaw::normal || d.law == SizeLaw::bimodal) inside("mean", d.mean);
  if (d.law == SizeLaw::bimodal) inside("mean2", d.mean2);
}

void read_classes(const TableReader& table, Diameters& d) {
  d.table_diameter = table.list("diameters");
  d.table_share = table.list("shares");
  if (!table.has("diameters") || !table.has("shares")) return;
  const std::size_t edges = d.table_diameter.size(), shares = d.table_share.size();
  if (edges < 2 || edges != shares + 1) {
    table.error("diameters", fmt::format("has {} edges for {} shares", edges, shares),
                "n classes have n + 1 edges, and there is at least one class",
                "add or remove edges or shares");
    return;
  }
  double sum = 0;
  for (const double share : d.table_share) sum += share;
  if (sum == 0 || std::isinf(sum))
    table.error("shares", sum == 0 ? "are all zero" : "sum to infinity", "their sum is finite and above 0",
                "give the share of each class");
  for (std::size_t i = 1; i < edges; ++i)
    if (d.table_diameter[i] <= d.table_diameter[i - 1])
      table.error("diameters",
                  fmt::format("{} follows {}", format_length(d.table_diameter[i]),
                              format_length(d.table_diameter[i - 1])),
                  "the edges must rise", "sort them, each once");
  d.min = d.table_diameter.front();
  d.max = d.table_diameter.back();
}

}  // namespace

Diameters read_diameters(const Value& value, const std::string& path, Problems& problems) {
  Diameters d;
  const Section& single = section("particles.diameter (single)");
  if (value.kind != Value::Kind::table) {  // the short form, or what is not even that
    static constexpr Section no_keys{};
    const TableReader table(nullptr, no_keys, path, value.place, problems);
    Key key = *single.find("mean");
    key.name = "diameter";
    d.mean = d.min = d.max = table.number(value, key, path);
    return d;
  }
  // the word decides which keys there are, so it is checked first
  const Value* word = value.find("distribution");
  const Key& laws = *single.find("distribution");
  const std::string law = word ? word->text : "normal";
  const auto known = split_words(laws.words);
  if (word && std::find(known.begin(), known.end(), law) == known.end()) {
    const std::string near = nearest(law, known);
    problems.error(word->place, path + ".distribution", fmt::format("\"{}\" is unknown", law),
                   "allowed: " + listed(known),
                   near.empty() ? "choose one of them" : fmt::format("did you mean \"{}\"?", near));
    return d;
  }
  const TableReader table(&value, section(fmt::format("particles.diameter ({})", law)), path, value.place,
                          problems);
  d.law = law_of(law);
  if (d.law == SizeLaw::single) {
    d.mean = d.min = d.max = table.quantity("mean");
    return d;
  }
  d.weight = table.choice("weight") == "mass" ? SizeWeight::mass : SizeWeight::number;
  if (d.law == SizeLaw::table) {
    read_classes(table, d);
    return d;
  }
  if (d.law == SizeLaw::lognormal) d.mean = table.quantity("median"), d.sd = table.quantity("sigma");
  if (d.law == SizeLaw::normal || d.law == SizeLaw::bimodal)
    d.mean = table.quantity("mean"), d.sd = table.quantity("sd");
  if (d.law == SizeLaw::bimodal) {
    d.mean2 = table.quantity("mean2");
    d.sd2 = table.quantity("sd2");
    d.share2 = table.quantity("share2");
  }
  d.min = table.quantity("min");
  d.max = table.quantity("max");
  check_cut(table, d);
  return d;
}

}  // namespace interstice::scene
