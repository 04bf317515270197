// The sections that say what space and materials are like.
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

}  // namespace interstice::scene
