// Reads one table of a document by its section of the schema: every getter checks kind, unit and range,
// records what is wrong, and returns a harmless value (NaN, "", nothing) so that reading goes on to the next
// error.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/shapes.h"
#include "coupling/scene/document.h"
#include "coupling/scene/schema.h"

namespace interstice::scene {

class TableReader {
 public:
  /// `value` may be null or no table: then everything required is missing, or the kind is wrong, and says so
  /// once.
  TableReader(const Value* value, const Section& section, std::string path, const Place& around,
              Problems& problems);

  /// Whether there is a table to read at all.
  explicit operator bool() const { return table_ != nullptr; }

  double quantity(std::string_view key) const;
  std::optional<double> optional_quantity(std::string_view key) const;
  Vec3d vector(std::string_view key) const;
  std::optional<Box> box(std::string_view key) const;
  std::optional<std::array<double, 2>> interval(std::string_view key) const;
  std::vector<double> list(std::string_view key) const;
  std::string text(std::string_view key) const;
  std::string choice(std::string_view key) const;
  std::vector<std::string> choices(std::string_view key) const;
  std::vector<std::string> texts(std::string_view key) const;
  bool boolean(std::string_view key) const;
  std::optional<std::int64_t> integer(std::string_view key) const;
  /// The tables of an array of tables; none when it is not given.
  std::vector<const Value*> tables(std::string_view key) const;
  /// The path of element `index` of an array of tables, as `--set` takes it.
  std::string element_path(std::string_view key, std::size_t index) const;

  /// The value as it stands, or null.
  const Value* raw(std::string_view key) const { return table_ ? table_->find(key) : nullptr; }
  bool has(std::string_view key) const { return raw(key) != nullptr; }
  std::string path(std::string_view key) const;
  /// The place of a key's value, or of the table when it is not there.
  Place place(std::string_view key = {}) const;
  Problems& problems() const { return *problems_; }
  void error(std::string_view key, std::string_view what, std::string_view allowed,
             std::string_view remedy) const;

  /// One number with its unit, by the schema's `key`; `path` names it in messages.
  double number(const Value& value, const Key& key, const std::string& path) const;

 private:
  const Key& spec(std::string_view key) const;
  const Value* given(const Key& key) const;
  double fallback(const Key& key) const;
  bool expect(const Value& value, Value::Kind kind, const Key& key, std::string_view remedy) const;
  std::string checked_choice(const Value& value, const Key& key, const std::string& at) const;
  double checked(double number, const Value& value, const Key& key, const std::string& path) const;

  const Value* table_ = nullptr;
  const Section* section_;
  std::string path_;
  Place around_;
  Problems* problems_;
};

}  // namespace interstice::scene
