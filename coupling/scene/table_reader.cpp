#include "coupling/scene/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "coupling/scene/format_quantity.h"
#include "coupling/scene/overrides.h"

namespace interstice::scene {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

std::string example(const Key& key) {
  const DimensionInfo& dimension = info(key.dimension);
  const auto quote = [&](std::string_view number) {
    return dimension.si_unit.empty() ? std::string(number) : fmt::format("\"{}\"", number);
  };
  const std::string one = quote(dimension.example);
  switch (key.kind) {
    case Kind::vector:
      return fmt::format("{} = [{}, {}, {}]", key.name, one, one, one);
    case Kind::box:
      return fmt::format("{} = [[\"0 mm\", \"18 mm\"], [\"-1 mm\", \"1 mm\"], [\"0 mm\", \"2 mm\"]]",
                         key.name);
    case Kind::interval:
      return fmt::format("{} = [\"0 um\", \"70 um\"]", key.name);
    case Kind::list:
      return fmt::format("{} = [{}, {}]", key.name, one, one);
    case Kind::quantity:
      return fmt::format("{} = {}", key.name, one);
    case Kind::integer:
      return fmt::format("{} = 1000", key.name);
    case Kind::boolean:
      return fmt::format("{} = true", key.name);
    case Kind::choice:
      return fmt::format("{} = \"{}\"", key.name, split_words(key.words).front());
    case Kind::choices:
      return fmt::format("{} = [\"open\", \"open\", \"open\"]", key.name);
    case Kind::texts:
      return fmt::format("{} = [\"...\"]", key.name);
    case Kind::table:
      return fmt::format("{} = {{ ... }}", key.name);
    case Kind::tables:
      return fmt::format("[[{}]]", key.name);
    default:
      return fmt::format("{} = \"...\"", key.name);
  }
}

bool is_name(std::string_view text) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !text.empty() && text.size() <= 64 && text.front() != '-' &&
         std::all_of(text.begin(), text.end(), good);
}

}  // namespace

TableReader::TableReader(const Value* value, const Section& section, std::string path, const Place& around,
                         Problems& problems)
    : section_(&section), path_(std::move(path)), around_(around), problems_(&problems) {
  if (value && value->kind != Value::Kind::table) {
    problems.error(value->place, path_, fmt::format("is {}", noun(value->kind)),
                   fmt::format("a table with these keys is due: {}", listed(section.key_names())),
                   "write { key = value, ... } or a [section] of its own");
    return;
  }
  static const Value empty{};
  table_ = value ? value : &empty;
  if (value) around_ = value->place;
  for (const Member& member : table_->members) {
    if (section.find(member.key)) continue;
    const std::string near = nearest(member.key, section.key_names());
    problems.error(member.place, this->path(member.key), "unknown key",
                   fmt::format("allowed here: {}", listed(section.key_names())),
                   near.empty() ? "remove it" : fmt::format("did you mean \"{}\"?", near));
  }
  for (const Key& key : section.keys)
    if (key.required && !table_->find(key.name))
      problems.error(around_, this->path(key.name), "is missing", "it has no default",
                     fmt::format("add {}", example(key)));
}

std::string TableReader::path(std::string_view key) const {
  return path_.empty() ? std::string(key) : key.empty() ? path_ : fmt::format("{}.{}", path_, key);
}

Place TableReader::place(std::string_view key) const {
  const Value* value = key.empty() ? nullptr : raw(key);
  return value ? value->place : around_;
}

void TableReader::error(std::string_view key, std::string_view what, std::string_view allowed,
                        std::string_view remedy) const {
  problems_->error(place(key), path(key), what, allowed, remedy);
}

const Key& TableReader::spec(std::string_view key) const {
  if (const Key* found = section_->find(key)) return *found;
  throw std::logic_error(fmt::format("no key \"{}\" in section \"{}\" of a scene", key, section_->name));
}

const Value* TableReader::given(const Key& key) const { return raw(key.name); }

bool TableReader::expect(const Value& value, Value::Kind kind, const Key& key,
                         std::string_view remedy) const {
  if (value.kind == kind) return true;
  problems_->error(value.place, path(key.name), fmt::format("is {}", noun(value.kind)),
                   fmt::format("{} is due", noun(kind)),
                   remedy.empty() ? fmt::format("write for instance {}", example(key)) : std::string(remedy));
  return false;
}

double TableReader::checked(double number, const Value& value, const Key& key, const std::string& at) const {
  const std::string written = format_quantity(number, key.dimension, 10);
  if (!std::isfinite(number)) {
    problems_->error(value.place, at, "is not a finite number",
                     fmt::format("{} is due", info(key.dimension).noun),
                     fmt::format("write for instance {}", example(key)));
    return kNaN;
  }
  if (!key.range.holds(number)) {
    const std::string reason = key.range.reason.empty() ? "" : fmt::format(": {}", key.range.reason);
    problems_->error(
        value.place, at, fmt::format("{} cannot be{}", written, reason),
        fmt::format("allowed: {}", text_of(key.range, key.dimension)),
        fmt::format("correct the number{}", info(key.dimension).si_unit.empty() ? "" : " or its unit"));
    return kNaN;
  }
  if (number < key.plausible.lo || number > key.plausible.hi)
    problems_->warn(value.place, at,
                    fmt::format("{} is far from what one would expect ({} to {})", written,
                                format_quantity(key.plausible.lo, key.dimension),
                                format_quantity(key.plausible.hi, key.dimension)),
                    "check the number and its unit");
  return number;
}

double TableReader::number(const Value& value, const Key& key, const std::string& at) const {
  const DimensionInfo& dimension = info(key.dimension);
  const bool plain = value.kind == Value::Kind::integer || value.kind == Value::Kind::real;
  if (plain && dimension.si_unit.empty()) return checked(value.real, value, key, at);
  if (plain) {
    const std::string written =
        value.kind == Value::Kind::integer ? fmt::format("{}", value.integer) : fmt::format("{}", value.real);
    problems_->error(value.place, at, fmt::format("{} has no unit", written),
                     fmt::format("{} is due (SI: {})", dimension.noun, dimension.si_unit),
                     fmt::format("write \"{} {}\" if it is in SI, or for instance \"{}\"", written,
                                 dimension.si_unit, dimension.example));
    return kNaN;
  }
  if (value.kind != Value::Kind::text) {
    problems_->error(value.place, at, fmt::format("is {}", noun(value.kind)),
                     dimension.si_unit.empty()
                         ? "a plain number is due"
                         : fmt::format("{} in quotes is due (SI: {})", dimension.noun, dimension.si_unit),
                     fmt::format("write for instance {}", example(key)));
    return kNaN;
  }
  QuantityProblem problem;
  const auto parsed = try_parse_quantity(value.text, key.dimension, problem);
  if (parsed) return checked(*parsed, value, key, at);
  problems_->error(value.place, at, problem.what, problem.allowed, problem.remedy);
  return kNaN;
}

double TableReader::fallback(const Key& key) const {
  QuantityProblem problem;
  return key.fallback.empty() ? kNaN
                              : try_parse_quantity(key.fallback, key.dimension, problem).value_or(kNaN);
}

double TableReader::quantity(std::string_view name) const {
  const Key& key = spec(name);
  const Value* value = given(key);
  return value ? number(*value, key, path(name)) : fallback(key);
}

std::optional<double> TableReader::optional_quantity(std::string_view name) const {
  return has(name) ? std::optional(quantity(name)) : std::nullopt;
}

Vec3d TableReader::vector(std::string_view name) const {
  const Key& key = spec(name);
  Vec3d vector{kNaN, kNaN, kNaN};
  const Value* value = given(key);
  if (!value) {
    std::string_view rest = key.fallback;
    for (int axis = 0; axis < 3 && !rest.empty(); ++axis) {
      QuantityProblem problem;
      const std::size_t end = std::min(rest.find(','), rest.size());
      vector[axis] = try_parse_quantity(rest.substr(0, end), key.dimension, problem).value_or(kNaN);
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return vector;
  }
  if (value->kind != Value::Kind::array || value->items.size() != 3) {
    problems_->error(value->place, path(name), "is not a list of three", "x, y and z in brackets are due",
                     fmt::format("write for instance {}", example(key)));
    return vector;
  }
  for (int axis = 0; axis < 3; ++axis)
    vector[axis] =
        number(value->items[static_cast<std::size_t>(axis)], key, fmt::format("{}.{}", path(name), axis));
  return vector;
}

std::optional<std::array<double, 2>> TableReader::interval(std::string_view name) const {
  const Key& key = spec(name);
  const Value* value = given(key);
  if (!value) return std::nullopt;
  if (value->kind != Value::Kind::array || value->items.size() != 2) {
    problems_->error(value->place, path(name), "is not a pair", "[lo, hi] is due",
                     fmt::format("write for instance {}", example(key)));
    return std::nullopt;
  }
  const double lo = number(value->items[0], key, path(name) + ".0");
  const double hi = number(value->items[1], key, path(name) + ".1");
  if (lo < hi) return std::array{lo, hi};
  if (lo >= hi)
    problems_->error(value->place, path(name),
                     fmt::format("{} to {} is empty", format_quantity(lo, key.dimension),
                                 format_quantity(hi, key.dimension)),
                     "the smaller comes first", "swap the two or make it larger");
  return std::nullopt;
}

std::optional<Box> TableReader::box(std::string_view name) const {
  const Key& key = spec(name);
  const Value* value = given(key);
  if (!value) return std::nullopt;
  bool good = value->kind == Value::Kind::array && value->items.size() == 3;
  if (good)
    for (const Value& axis : value->items)
      good = good && axis.kind == Value::Kind::array && axis.items.size() == 2;
  if (!good) {
    problems_->error(value->place, path(name), "is not a box", "[[x0, x1], [y0, y1], [z0, z1]] is due",
                     fmt::format("write for instance {}", example(key)));
    return std::nullopt;
  }
  Box box;
  for (int axis = 0; axis < 3; ++axis) {
    const Value& ends = value->items[static_cast<std::size_t>(axis)];
    const std::string at = fmt::format("{}.{}", path(name), axis);
    const double lo = box.lo[axis] = number(ends.items[0], key, at + ".0");
    const double hi = box.hi[axis] = number(ends.items[1], key, at + ".1");
    if (lo >= hi)
      problems_->error(ends.place, at,
                       fmt::format("{} to {} is empty along {}", format_quantity(lo, key.dimension),
                                   format_quantity(hi, key.dimension), "xyz"[axis]),
                       "the smaller comes first", "swap the two or make the box larger");
    good = good && lo < hi;
  }
  return good ? std::optional(box) : std::nullopt;
}

std::vector<double> TableReader::list(std::string_view name) const {
  const Key& key = spec(name);
  std::vector<double> numbers;
  const Value* value = given(key);
  if (!value || !expect(*value, Value::Kind::array, key, {})) return numbers;
  for (std::size_t i = 0; i < value->items.size(); ++i)
    numbers.push_back(number(value->items[i], key, fmt::format("{}.{}", path(name), i)));
  return numbers;
}

std::string TableReader::text(std::string_view name) const {
  const Key& key = spec(name);
  const Value* value = given(key);
  if (!value || !expect(*value, Value::Kind::text, key, {})) return {};
  if (key.kind == Kind::name && !is_name(value->text)) {
    problems_->error(
        value->place, path(name), fmt::format("\"{}\" is not a name", value->text),
        "letters, digits, '-' and '_' are allowed, at most 64, because files and columns are named by it",
        "rename it, for instance \"blade-1\"");
    return {};
  }
  return value->text;
}

std::string TableReader::checked_choice(const Value& value, const Key& key, const std::string& at) const {
  const auto words = split_words(key.words);
  const std::string allowed = fmt::format("allowed: {}", listed(words));
  if (value.kind != Value::Kind::text) {
    problems_->error(value.place, at, fmt::format("is {}", noun(value.kind)), allowed,
                     fmt::format("write for instance \"{}\"", words.front()));
    return {};
  }
  if (std::find(words.begin(), words.end(), value.text) != words.end()) return value.text;
  const std::string near = nearest(value.text, words);
  problems_->error(value.place, at, fmt::format("\"{}\" is unknown", value.text), allowed,
                   near.empty() ? "choose one of them" : fmt::format("did you mean \"{}\"?", near));
  return {};
}

std::string TableReader::choice(std::string_view name) const {
  const Key& key = spec(name);
  const Value* value = given(key);
  return value ? checked_choice(*value, key, path(name)) : std::string(key.fallback);
}

std::vector<std::string> TableReader::choices(std::string_view name) const {
  const Key& key = spec(name);
  const Value* value = given(key);
  if (!value) return std::vector<std::string>(3, std::string(key.fallback));
  if (value->kind != Value::Kind::array || value->items.size() != 3) {
    problems_->error(value->place, path(name), "is not a list of three",
                     fmt::format("one word per axis is due, allowed: {}", listed(split_words(key.words))),
                     fmt::format("write for instance {}", example(key)));
    return std::vector<std::string>(3);
  }
  std::vector<std::string> words;
  for (std::size_t axis = 0; axis < 3; ++axis)
    words.push_back(checked_choice(value->items[axis], key, fmt::format("{}.{}", path(name), axis)));
  return words;
}

std::vector<std::string> TableReader::texts(std::string_view name) const {
  const Key& key = spec(name);
  std::vector<std::string> texts;
  const Value* value = given(key);
  if (!value || !expect(*value, Value::Kind::array, key, {})) return texts;
  for (std::size_t i = 0; i < value->items.size(); ++i) {
    const Value& item = value->items[i];
    if (item.kind != Value::Kind::text)
      problems_->error(item.place, fmt::format("{}.{}", path(name), i), fmt::format("is {}", noun(item.kind)),
                       "a text in quotes is due", fmt::format("write for instance {}", example(key)));
    texts.push_back(item.text);
  }
  return texts;
}

bool TableReader::boolean(std::string_view name) const {
  const Key& key = spec(name);
  const Value* value = given(key);
  if (!value || !expect(*value, Value::Kind::boolean, key, {})) return key.fallback == "true";
  return value->boolean;
}

std::optional<std::int64_t> TableReader::integer(std::string_view name) const {
  const Key& key = spec(name);
  const Value* value = given(key);
  if (!value) {
    if (key.fallback.empty()) return std::nullopt;
    return static_cast<std::int64_t>(fallback(key));
  }
  const bool whole = value->kind == Value::Kind::integer ||
                     (value->kind == Value::Kind::real && std::abs(value->real) < 1e15 &&
                      value->real == std::floor(value->real));  // 35e3 is a whole number too
  if (!whole) {
    expect(*value, Value::Kind::integer, key, {});
    return std::nullopt;
  }
  if (std::isnan(checked(value->real, *value, key, path(name)))) return std::nullopt;
  return value->kind == Value::Kind::integer ? value->integer : static_cast<std::int64_t>(value->real);
}

std::vector<const Value*> TableReader::tables(std::string_view name) const {
  const Key& key = spec(name);
  std::vector<const Value*> tables;
  const Value* value = given(key);
  if (!value) return tables;
  if (value->kind != Value::Kind::array) {
    problems_->error(value->place, path(name), fmt::format("is {}", noun(value->kind)),
                     "an array of tables is due", fmt::format("write [[{}]] with two brackets", path(name)));
    return tables;
  }
  for (const Value& item : value->items) tables.push_back(&item);
  return tables;
}

std::string TableReader::element_path(std::string_view key, std::size_t index) const {
  return fmt::format("{}.{}", path(key), element_name(*raw(key), index));
}

}  // namespace interstice::scene
