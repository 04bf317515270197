#include "coupling/scene/overrides.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "base/error.h"
#include "coupling/scene/units.h"

namespace interstice::scene {
namespace {

std::vector<std::string> split_path(std::string_view path) {
  std::vector<std::string> parts;
  for (;;) {
    const std::size_t end = path.find('.');
    parts.emplace_back(trim(path.substr(0, end)));
    if (end == std::string_view::npos) return parts;
    path.remove_prefix(end + 1);
  }
}

/// The name of an array's element: its `name`, or its two `materials` joined.
std::string own_name(const Value& element) {
  if (element.kind != Value::Kind::table) return {};
  if (const Value* name = element.find("name"); name && name->kind == Value::Kind::text) return name->text;
  const Value* pair = element.find("materials");
  if (!pair || pair->kind != Value::Kind::array || pair->items.size() != 2) return {};
  return fmt::format("{}-{}", pair->items[0].text, pair->items[1].text);
}

std::optional<std::size_t> index_of(const Value& array, std::string_view segment) {
  std::size_t index = 0;
  const auto result = std::from_chars(segment.data(), segment.data() + segment.size(), index);
  const bool whole = result.ec == std::errc{} && result.ptr == segment.data() + segment.size();
  for (std::size_t i = 0; i < array.items.size(); ++i)
    if (own_name(array.items[i]) == segment) return i;
  if (whole && index < array.items.size()) return index;
  for (std::size_t i = 0; i < array.items.size(); ++i) {  // a pair of materials in the other order
    const Value* pair =
        array.items[i].kind == Value::Kind::table ? array.items[i].find("materials") : nullptr;
    if (pair && pair->items.size() == 2 &&
        fmt::format("{}-{}", pair->items[1].text, pair->items[0].text) == segment)
      return i;
  }
  return std::nullopt;
}

std::string elements_of(const Value& array) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < array.items.size() && i < 20; ++i) names.push_back(element_name(array, i));
  return names.empty() ? "it is empty" : "its elements are " + listed(names);
}

/// The value that `path` leads to, made where tables lack it. Null, with an error recorded, when there is no
/// way.
Value* reach(Value& document, const std::vector<std::string>& path, const Place& place, Problems& problems) {
  Value* at = &document;
  std::string walked;
  for (const std::string& segment : path) {
    if (at->kind == Value::Kind::array) {
      const auto index = index_of(*at, segment);
      if (!index) {
        problems.error(place, walked, fmt::format("has no element \"{}\"", segment), elements_of(*at),
                       "use one of them, or its index from 0");
        return nullptr;
      }
      at = &at->items[*index];
    } else if (at->kind == Value::Kind::table) {
      Value* next = at->find(segment);
      if (!next) {
        Value made;
        made.place = place;
        at->members.push_back({segment, place, std::move(made)});
        next = &at->members.back().value;
      }
      at = next;
    } else {
      problems.error(place, walked,
                     fmt::format("is {} and has nothing named \"{}\" inside", noun(at->kind), segment),
                     "a path leads through tables and arrays",
                     fmt::format("set \"{}\" as a whole, for instance to a table {{ ... }}", walked));
      return nullptr;
    }
    walked += (walked.empty() ? "" : ".") + segment;
  }
  return at;
}

}  // namespace

std::string element_name(const Value& array, std::size_t index) {
  const std::string name = own_name(array.items[index]);
  std::size_t bearers = 0;
  for (const Value& item : array.items) bearers += own_name(item) == name;
  return name.empty() || bearers != 1 ? std::to_string(index) : name;
}

void apply_override(Value& document, const std::string& assignment, Problems& problems) {
  const Place place{std::make_shared<const std::string>("--set " + assignment), 0, 0};
  const std::size_t equals = assignment.find('=');
  const auto path = split_path(std::string_view(assignment).substr(0, equals));
  bool whole = equals != std::string::npos;
  for (const std::string& segment : path) whole = whole && !segment.empty();
  if (!whole) {
    problems.error(place, "", "is not an assignment", "path.to.key=value is due",
                   "write for instance --set particles.feed.count=1000");
    return;
  }
  try {
    Value value = parse_override_value(trim(std::string_view(assignment).substr(equals + 1)), place);
    if (Value* target = reach(document, path, place, problems)) *target = std::move(value);
  } catch (const InputError& error) {
    problems.error(place, "", std::string_view(error.messages().front()).substr(text_of(place).size() + 2));
  }
}

Place locate(const Value& document, std::string_view path) {
  const Value* at = &document;
  Place place = document.place;
  for (const std::string& segment : split_path(path)) {
    const Value* next = nullptr;
    if (at->kind == Value::Kind::array) {
      if (const auto index = index_of(*at, segment)) next = &at->items[*index];
    } else if (at->kind == Value::Kind::table) {
      next = at->find(segment);
    }
    if (!next) return place;
    at = next;
    place = at->place;
  }
  return place;
}

}  // namespace interstice::scene
