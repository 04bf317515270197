// Errors and warnings of a file, collected so that a person sees all of them at once, in the order of the
// file.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace interstice::scene {

/// Where something stands: a line and a column (from 1) of a file, or an override of the command line (line
/// 0).
struct Place {
  std::shared_ptr<const std::string> source;
  int line = 0;
  int column = 0;
};

/// "scene.toml:12:3", or "--set a.b=1" where there is no line.
std::string text_of(const Place& place);

class Problems {
 public:
  /// Records "place: key: what; allowed; remedy"; empty parts are left out.
  void error(const Place& place, std::string_view key, std::string_view what, std::string_view allowed = {},
             std::string_view remedy = {});
  void warn(const Place& place, std::string_view key, std::string_view what, std::string_view remedy = {});

  bool any() const { return !errors_.empty(); }
  /// Throws one InputError with every error, sorted by place.
  void throw_if_any() const;
  /// The warnings, sorted by place.
  std::vector<std::string> warnings() const;

 private:
  struct Entry {
    Place place;
    std::string message;
  };
  static std::vector<std::string> sorted(std::vector<Entry> entries);

  std::vector<Entry> errors_, warnings_;
};

/// The candidate that takes the fewest edits from `word` (a swap of neighbours counts as one); empty when
/// none is near enough to be what was meant.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "a, b, c"
std::string listed(const std::vector<std::string>& words);

}  // namespace interstice::scene
