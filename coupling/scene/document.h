// A scene file as a tree of values that know where they stand, before anything is made of them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "coupling/scene/problems.h"

namespace interstice::scene {

struct Member;

struct Value {
  enum class Kind { text, integer, real, boolean, array, table, date };

  Kind kind = Kind::table;
  Place place;
  std::string text;             // text
  std::int64_t integer = 0;     // integer
  double real = 0;              // real; integer too
  bool boolean = false;         // boolean
  std::vector<Value> items;     // array
  std::vector<Member> members;  // table, in the order of the file

  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
};

struct Member {
  std::string key;
  Place place;  // of the key
  Value value;
};

/// What one calls a kind in a sentence: "a table".
std::string_view noun(Value::Kind kind);

/// The tree of a TOML text; `source` names it in messages. Throws InputError when the syntax is wrong.
Value parse_document(std::string_view text, const std::string& source);

/// The value that an override gives: TOML where it is TOML (numbers, booleans, arrays, quoted text), else
/// plain text, so that `--set time.step=8ns` needs no quotes within quotes. Throws InputError for broken
/// arrays, tables and quoted texts.
Value parse_override_value(std::string_view text, const Place& place);

/// The whole of a file. Throws InputError when it is missing or cannot be read.
std::string read_text_file(const std::string& path);

}  // namespace interstice::scene
