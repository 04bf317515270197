#include "coupling/scene/problems.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "base/error.h"

namespace interstice::scene {
namespace {

/// Edit distance with swaps of neighbours (optimal string alignment), in the usual table of prefixes.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i)
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replace = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, replace});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  return d[a.size()][b.size()];
}

}  // namespace

std::string text_of(const Place& place) {
  const std::string source = place.source ? *place.source : std::string("scene");
  return place.line > 0 ? fmt::format("{}:{}:{}", source, place.line, place.column) : source;
}

void Problems::error(const Place& place, std::string_view key, std::string_view what,
                     std::string_view allowed, std::string_view remedy) {
  std::string message = text_of(place) + ": ";
  if (!key.empty()) message += fmt::format("{}: ", key);
  message += what;
  if (!allowed.empty()) message += fmt::format("; {}", allowed);
  if (!remedy.empty()) message += fmt::format("; {}", remedy);
  errors_.push_back({place, std::move(message)});
}

void Problems::warn(const Place& place, std::string_view key, std::string_view what,
                    std::string_view remedy) {
  std::string message = fmt::format("{}: {}: {}", text_of(place), key, what);
  if (!remedy.empty()) message += fmt::format("; {}", remedy);
  warnings_.push_back({place, std::move(message)});
}

std::vector<std::string> Problems::sorted(std::vector<Entry> entries) {
  // each source apart, in the order in which they came up: overrides, the scene, its lists
  std::unordered_map<std::string, std::size_t> rank;
  for (const Entry& entry : entries)
    if (entry.place.source) rank.try_emplace(*entry.place.source, rank.size());
  const auto order = [&](const Entry& entry) {
    return std::tuple(entry.place.source ? rank[*entry.place.source] : 0, entry.place.line,
                      entry.place.column);
  };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const Entry& a, const Entry& b) { return order(a) < order(b); });
  std::vector<std::string> lines;
  std::unordered_set<std::string> seen;
  for (Entry& entry : entries)
    if (seen.insert(entry.message).second) lines.push_back(std::move(entry.message));
  return lines;
}

void Problems::throw_if_any() const {
  if (any()) throw InputError(sorted(errors_));
}

std::vector<std::string> Problems::warnings() const { return sorted(warnings_); }

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  if (word.size() > 100) return {};
  std::string best;
  std::size_t least = std::max<std::size_t>(2, word.size() / 2);  // farther than this is another word
  for (const std::string& candidate : candidates) {
    // whoever writes the same beginning means the same word, whatever the end: "collide", "collision"
    const bool same_start =
        word.size() >= 4 && candidate.size() >= 4 && word.substr(0, 4) == candidate.substr(0, 4);
    const std::size_t distance =
        std::min<std::size_t>(edit_distance(word, candidate), same_start ? 2 : word.size() + 2);
    if (distance < least || (distance == least && best.empty() && distance < candidate.size())) {
      least = distance;
      best = candidate;
    }
  }
  return best;
}

std::string listed(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace interstice::scene
