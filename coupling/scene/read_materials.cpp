// The sections that say what space, materials and contacts are like.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/scene/readers.h"

namespace interstice::scene {
namespace {

/// `wall_material`: one name for every wall, or one per axis.
void read_wall_material(const TableReader& table, Domain& domain) {
  const Value* value = table.raw("wall_material");
  bool any_wall = false;
  for (const Boundary boundary : domain.boundary) any_wall = any_wall || boundary == Boundary::wall;
  if (!value) {
    if (any_wall)
      table.error("boundary", "has a wall, and wall_material is missing", "a wall needs a material",
                  "add wall_material = \"NAME\"");
    return;
  }
  const bool list = value->kind == Value::Kind::array && value->items.size() == 3;
  if (!list && value->kind != Value::Kind::text) {
    table.error("wall_material", "is neither a name nor three",
                "the name of a material, or one per axis, is due",
                "write for instance wall_material = \"steel\"");
    return;
  }
  if (!list && !any_wall)
    table.error("wall_material", "is given, but no boundary is a wall",
                "it is allowed with boundary \"wall\"", "drop it or make a boundary a wall");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool wall = domain.boundary[axis] == Boundary::wall;
    const Value& name = list ? value->items[axis] : *value;
    const bool given = name.kind == Value::Kind::text && !name.text.empty();
    if (wall && !given)
      table.error("wall_material", fmt::format("names no material for the walls along {}", "xyz"[axis]),
                  "a wall needs a material", "name one of [materials]");
    if (list && !wall && (given || name.kind != Value::Kind::text))
      table.error("wall_material", fmt::format("names a material along {}, where no wall is", "xyz"[axis]),
                  "\"\" is due there", "write \"\" or make that boundary a wall");
    if (wall) domain.wall_material[axis] = name.text;
  }
}

/// The words of the three optional laws; empty where the word was wrong, so that nothing follows from it.
struct LawWords {
  std::string tangential, rolling, cohesion;
};

/// A pair's parameter that only one law uses: due with that law, refused without any.
double read_law_parameter(const TableReader& table, std::string_view key, std::string_view law,
                          const std::string& word) {
  const bool none = word == "none";
  const auto words = split_words(section("contact").find(law)->words);
  if (none && table.has(key)) {
    table.error(key, fmt::format("is given although contact.{} is \"none\"", law),
                fmt::format("it is allowed with contact.{} = \"{}\"", law, words.back()),
                "name that law or drop this key");
    return 0;
  }
  if (!none && !word.empty() && !table.has(key))
    table.error(key, "is missing", fmt::format("contact.{} needs it for every pair", law),
                fmt::format("add {} = ..., or set contact.{} = \"none\"", key, law));
  return table.has(key) ? table.quantity(key) : 0;
}

ContactPair read_pair(const TableReader& table, const LawWords& laws) {
  ContactPair pair;
  const auto names = table.texts("materials");
  if (names.size() == 2)
    pair.materials = {names[0], names[1]};
  else if (table.has("materials"))
    table.error("materials", fmt::format("has {} names", names.size()), "two materials meet in a contact",
                "write for instance materials = [\"powder\", \"steel\"]");
  pair.restitution = table.quantity("restitution");
  pair.friction = read_law_parameter(table, "friction", "tangential", laws.tangential);
  pair.rolling_friction = read_law_parameter(table, "rolling_friction", "rolling", laws.rolling);
  pair.cohesion_energy_density =
      read_law_parameter(table, "cohesion_energy_density", "cohesion", laws.cohesion);
  return pair;
}

}  // namespace

Domain read_domain(const Value* value, const Place& around, Problems& problems) {
  const TableReader table(value, section("domain"), "domain", around, problems);
  Domain domain;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  domain.box = table.box("box").value_or(Box{{nan, nan, nan}, {nan, nan, nan}});
  const auto words = table.choices("boundary");
  for (std::size_t axis = 0; axis < 3; ++axis)
    domain.boundary[axis] = words[axis] == "wall"       ? Boundary::wall
                            : words[axis] == "periodic" ? Boundary::periodic
                                                        : Boundary::open;
  read_wall_material(table, domain);
  domain.gravity = table.vector("gravity");
  return domain;
}

std::vector<Material> read_materials(const Value* value, Problems& problems) {
  std::vector<Material> materials;
  if (!value) return materials;
  if (value->kind != Value::Kind::table) {
    problems.error(value->place, "materials", fmt::format("is {}", noun(value->kind)),
                   "one table a material is due", "write [materials.NAME]");
    return materials;
  }
  const auto good = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_';
  };
  for (const Member& member : value->members) {
    const std::string path = fmt::format("materials.{}", member.key);
    if (member.key.empty() || !std::all_of(member.key.begin(), member.key.end(), good))
      problems.error(member.place, path, "is not a name", "letters, digits, '-' and '_' are allowed",
                     "rename it");
    const TableReader table(&member.value, section("materials.NAME"), path, member.place, problems);
    if (!table) continue;
    materials.push_back({member.key, table.quantity("density"), table.quantity("youngs_modulus"),
                         table.quantity("poisson_ratio")});
  }
  return materials;
}

Contact read_contact(const Value* value, const Place& around, Problems& problems) {
  const TableReader table(value, section("contact"), "contact", around, problems);
  Contact contact;
  if (!table) return contact;
  table.choice("normal");
  contact.damping = table.choice("damping") == "clipped" ? Damping::clipped : Damping::tension;
  const LawWords laws{table.choice("tangential"), table.choice("rolling"), table.choice("cohesion")};
  contact.tangential = laws.tangential == "mindlin" ? TangentialLaw::mindlin : TangentialLaw::none;
  contact.rolling = laws.rolling == "cdt" ? RollingLaw::cdt : RollingLaw::none;
  contact.cohesion = laws.cohesion == "sjkr" ? CohesionLaw::sjkr : CohesionLaw::none;
  const auto pairs = table.tables("pair");
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const TableReader pair(pairs[i], section("contact.pair"), table.element_path("pair", i), table.place(),
                           problems);
    contact.pairs.push_back(pair ? read_pair(pair, laws) : ContactPair{});
  }
  return contact;
}

}  // namespace interstice::scene
