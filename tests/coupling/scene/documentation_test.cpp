// docs/SCENES.md holds the very tables that validate scenes, so it cannot fall behind them.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>

#include "coupling/scene/schema.h"

namespace interstice::scene {
namespace {

std::string kind_of(const Key& key) {
  const DimensionInfo& dimension = info(key.dimension);
  const std::string_view noun = dimension.noun.substr(dimension.noun.find(' ') + 1);
  const bool plain = dimension.si_unit.empty();
  const std::string quantity = plain ? "number" : fmt::format("{} ({})", noun, dimension.si_unit);
  const std::string each =
      plain ? "each a number" : fmt::format("each {} ({})", dimension.noun, dimension.si_unit);
  switch (key.kind) {
    case Kind::quantity:
      return quantity;
    case Kind::vector:
      return fmt::format("[x, y, z], {}", each);
    case Kind::interval:
      return fmt::format("[lo, hi], {}", each);
    case Kind::box:
      return "[[x0, x1], [y0, y1], [z0, z1]], lengths (m)";
    case Kind::list:
      return fmt::format("[...], {}", each);
    case Kind::choice:
      return "one word";
    case Kind::choices:
      return "[x, y, z], each one word";
    case Kind::texts:
      return "[...] texts";
    case Kind::tables:
      return "array of tables";
    case Kind::special:
      return "see right";
    case Kind::text:
      return "text";
    case Kind::name:
      return "name";
    case Kind::boolean:
      return "true, false";
    case Kind::integer:
      return "integer";
    case Kind::table:
      return "table";
  }
  return {};
}

std::string allowed_of(const Key& key) {
  if (!key.words.empty()) return fmt::format("`{}`", fmt::join(split_words(key.words), "`, `"));
  if (std::isfinite(key.range.lo) || std::isfinite(key.range.hi)) return text_of(key.range, key.dimension);
  return "";
}

std::string table_of(const Section& section) {
  std::string text = "| key | kind (SI unit) | default | allowed | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : section.keys)
    text += fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, kind_of(key),
                        key.required ? "required" : std::string(key.fallback), allowed_of(key), key.about);
  return text;
}

TEST(Documentation, HoldsTheTableOfEverySection) {
  std::ifstream file(INTERSTICE_SOURCE_DIR "/docs/SCENES.md");
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  ASSERT_FALSE(text.empty());
  for (const Section& section : all_sections()) {
    const std::string heading =
        section.name.empty() ? "### The file itself" : fmt::format("### {}", section.name);
    EXPECT_NE(text.find(heading + "\n"), std::string::npos) << heading;
    EXPECT_NE(text.find(table_of(section)), std::string::npos)
        << "docs/SCENES.md should hold, under " << heading << ":\n\n"
        << section.about << ".\n\n"
        << table_of(section);
  }
}

}  // namespace
}  // namespace interstice::scene
