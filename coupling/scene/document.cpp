#include "coupling/scene/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace interstice::scene {
/// What an assertion within toml++ turns into, see below.
struct ParserAssertion {};
[[noreturn]] inline void parser_asserts() { throw ParserAssertion(); }
}  // namespace interstice::scene

// Header only, and in this file alone: what links this library then needs no library of toml++. Version 3.3
// asserts where it should report (a header such as "[,]"), and in release builds assumes that it cannot
// happen; a file that a person wrote must do neither, so in this file assertions are always on and throw.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(condition) ((condition) ? void() : interstice::scene::parser_asserts())
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include "base/error.h"

namespace interstice::scene {
namespace {

Place place_of(const toml::source_region& region, const std::shared_ptr<const std::string>& source) {
  return {source, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

Value convert(const toml::node& node, const std::shared_ptr<const std::string>& source) {
  Value value;
  value.place = place_of(node.source(), source);
  if (const auto* table = node.as_table()) {
    value.kind = Value::Kind::table;
    for (const auto& [key, child] : *table)
      value.members.push_back(
          {std::string(key.str()), place_of(key.source(), source), convert(child, source)});
    std::stable_sort(value.members.begin(), value.members.end(), [](const Member& a, const Member& b) {
      return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
    });
  } else if (const auto* array = node.as_array()) {
    value.kind = Value::Kind::array;
    for (const auto& child : *array) value.items.push_back(convert(child, source));
  } else if (const auto* text = node.as_string()) {
    value.kind = Value::Kind::text;
    value.text = text->get();
  } else if (const auto* integer = node.as_integer()) {
    value.kind = Value::Kind::integer;
    value.integer = integer->get();
    value.real = static_cast<double>(integer->get());
  } else if (const auto* real = node.as_floating_point()) {
    value.kind = Value::Kind::real;
    value.real = real->get();
  } else if (const auto* boolean = node.as_boolean()) {
    value.kind = Value::Kind::boolean;
    value.boolean = boolean->get();
  } else {
    value.kind = Value::Kind::date;
  }
  return value;
}

/// A parser's message as one line.
std::string one_line(std::string_view text) {
  std::string line(text);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

bool asserts(std::string_view text) {
  try {
    static_cast<void>(toml::parse(text));
  } catch (const ParserAssertion&) {
    return true;
  } catch (const toml::parse_error&) {
  }
  return false;
}

/// The line on which the parser asserts: no shorter beginning of the text makes it do so, so halving finds
/// it.
int asserting_line(std::string_view text) {
  std::vector<std::size_t> ends;  // of the lines
  for (std::size_t i = 0; i < text.size(); ++i)
    if (text[i] == '\n') ends.push_back(i + 1);
  ends.push_back(text.size());
  const auto line = std::partition_point(ends.begin(), ends.end(),
                                         [&](std::size_t end) { return !asserts(text.substr(0, end)); });
  return static_cast<int>(line - ends.begin()) + 1;
}

void replace_places(Value& value, const Place& place) {
  value.place = place;
  for (Value& item : value.items) replace_places(item, place);
  for (Member& member : value.members) {
    member.place = place;
    replace_places(member.value, place);
  }
}

}  // namespace

const Value* Value::find(std::string_view key) const {
  for (const Member& member : members)
    if (member.key == key) return &member.value;
  return nullptr;
}
Value* Value::find(std::string_view key) {
  return const_cast<Value*>(static_cast<const Value*>(this)->find(key));
}

std::string_view noun(Value::Kind kind) {
  switch (kind) {
    case Value::Kind::text:
      return "a text";
    case Value::Kind::integer:
      return "an integer";
    case Value::Kind::real:
      return "a number";
    case Value::Kind::boolean:
      return "true or false";
    case Value::Kind::array:
      return "an array";
    case Value::Kind::table:
      return "a table";
    case Value::Kind::date:
      return "a date or time of day";
  }
  return "a value";
}

Value parse_document(std::string_view text, const std::string& source) {
  const auto name = std::make_shared<const std::string>(source);
  try {
    return convert(toml::parse(text), name);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("{}: not valid TOML: {}; see https://toml.io; correct this place",
                                 text_of(place_of(error.source(), name)), one_line(error.description())));
  } catch (const ParserAssertion&) {
    throw InputError(
        fmt::format("{}: not valid TOML: a name is due after '['; see https://toml.io; correct this place",
                    text_of(Place{name, asserting_line(text), 1})));
  }
}

Value parse_override_value(std::string_view text, const Place& place) {
  Value value;
  try {
    Value document = parse_document(fmt::format("value = {}", text), *place.source);
    // a text with a line break could smuggle in further keys: then it is no single value
    if (document.members.size() == 1) value = std::move(document.members[0].value);
  } catch (const InputError&) {
    if (!text.empty() && std::string_view("[{\"'").find(text.front()) != std::string_view::npos)
      throw InputError(
          fmt::format("{}: the value is not valid TOML; an array, a table or a quoted text must be closed; "
                      "check brackets and quotes",
                      text_of(place)));
    const auto printable = [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; };
    if (!std::all_of(text.begin(), text.end(), printable))
      throw InputError(
          fmt::format("{}: the value has control characters in it; a number, a quantity or a text is due; "
                      "remove them",
                      text_of(place)));
    value.kind = Value::Kind::text;
    value.text = text;
  }
  replace_places(value, place);
  return value;
}

std::string read_text_file(const std::string& path) {
  const auto fail = [&](std::string_view why) {
    throw InputError(fmt::format("{}: cannot be read: {}; a text file is due; check the path", path, why));
  };
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) fail("it is a folder");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(errno != 0 ? std::strerror(errno) : "it cannot be opened");
  std::ostringstream text;
  text << file.rdbuf();
  if (file.bad()) fail("reading it failed");
  return std::move(text).str();
}

}  // namespace interstice::scene
