#include "coupling/scene/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/scene/format_quantity.h"
#include "coupling/scene/schema_tables.h"

namespace interstice::scene {

const Key* Section::find(std::string_view key) const {
  for (const Key& candidate : keys)
    if (candidate.name == key) return &candidate;
  return nullptr;
}

std::vector<std::string> Section::key_names() const {
  std::vector<std::string> names;
  for (const Key& key : keys) names.emplace_back(key.name);
  return names;
}

std::span<const Section> all_sections() {
  static const std::vector<Section> sections = [] {
    std::vector<Section> all;
    for (const auto& part : {material_sections(), particle_sections(), course_sections()})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }();
  return sections;
}

const Section& section(std::string_view name) {
  for (const Section& candidate : all_sections())
    if (candidate.name == name) return candidate;
  throw std::logic_error(fmt::format("no section \"{}\" of a scene", name));
}

std::string text_of(const Range& range, Dimension dimension) {
  const bool low = std::isfinite(range.lo), high = std::isfinite(range.hi);
  const std::string lo = format_quantity(range.lo, dimension, 10),
                    hi = format_quantity(range.hi, dimension, 10);
  const std::string above = fmt::format("{} {}", range.lo_open ? "greater than" : "at least", lo);
  const std::string below = fmt::format("{} {}", range.hi_open ? "less than" : "at most", hi);
  if (low && high) return range.lo_open || range.hi_open ? above + " and " + below : lo + " to " + hi;
  return low ? above : high ? below : "any value";
}

std::vector<std::string> split_words(std::string_view words) {
  std::vector<std::string> list;
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    list.emplace_back(words.substr(0, end));
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return list;
}

}  // namespace interstice::scene
