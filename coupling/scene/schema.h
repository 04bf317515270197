// What a scene file may say: one table of keys per section, with kind, dimension, range and default. The
// reader, the messages and the documentation go by it.
#pragma once

#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "coupling/scene/units.h"

namespace interstice::scene {

enum class Kind {
  text,      // any text
  name,      // letters, digits, '-' and '_': it becomes part of file and column names
  boolean,   // true | false
  integer,   //
  quantity,  // a number with the unit of `dimension` (a plain number if dimensionless)
  vector,    // [x, y, z] quantities
  interval,  // [lo, hi] quantities
  box,       // [[x0, x1], [y0, y1], [z0, z1]] quantities
  list,      // [...] quantities, any number of them
  choice,    // one word of `words`
  choices,   // [x, y, z], each one word of `words`
  texts,     // [...] texts
  table,     // a table: another section
  tables,    // an array of tables: another section
  special,   // more than one form; read by hand
};

/// A number's range, and the reason why nothing beyond it can be.
struct Range {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
  bool lo_open = false, hi_open = false;  // is the end itself excluded?
  std::string_view reason{};

  bool holds(double value) const {
    return (lo_open ? value > lo : value >= lo) && (hi_open ? value < hi : value <= hi);
  }
};

/// Beyond these a value is possible but most likely a slip of units: a warning.
struct Plausible {
  double lo = -std::numeric_limits<double>::infinity();
  double hi = std::numeric_limits<double>::infinity();
};

struct Key {
  std::string_view name;
  Kind kind = Kind::quantity;
  Dimension dimension = Dimension::dimensionless;
  bool required = false;
  std::string_view fallback{};  // what holds when it is not given, as one writes it; empty: nothing
  Range range{};
  Plausible plausible{};
  std::string_view words{};  // choice: "none mindlin"; where an enum holds them, in its order
  std::string_view law{};    // "cohesion jkr dmt": belongs to these words of this key of [contact] alone ...
  bool due = false;          // ... and has to be given with them
  std::string_view about{};  // one line for the documentation
};

struct Section {
  std::string_view name;   // "materials.NAME"
  std::string_view about;  // one line for the documentation
  std::span<const Key> keys;

  const Key* find(std::string_view key) const;
  std::vector<std::string> key_names() const;
};

/// Every section, in the order of the documentation.
std::span<const Section> all_sections();
/// A section by its name; it must exist.
const Section& section(std::string_view name);

/// "0 to 1", "greater than 0 kg/m^3"
std::string text_of(const Range& range, Dimension dimension);

std::vector<std::string> split_words(std::string_view words);

}  // namespace interstice::scene
