// Groups of grains: how many, of what, how large, and how they come in.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "base/error.h"
#include "coupling/scene/format_quantity.h"
#include "coupling/scene/readers.h"

namespace interstice::scene {
namespace {

RainInsertion read_rain(const TableReader& table) {
  RainInsertion rain;
  rain.phase = table.text("phase");
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  rain.box = table.box("box").value_or(Box{{nan, nan, nan}, {nan, nan, nan}});
  rain.velocity = table.vector("velocity");
  rain.interval = table.quantity("interval");
  return rain;
}

ListInsertion read_list(const TableReader& table, const std::string& scene_file) {
  ListInsertion list;
  Problems& problems = table.problems();
  if (table.has("file") == table.has("csv")) {
    table.error("", table.has("file") ? "has both file and csv" : "has neither file nor csv",
                "a list is one or the other", "write for instance file = \"grains.csv\"");
    return list;
  }
  if (table.has("csv")) {
    const std::string text = table.text("csv");
    if (!text.empty()) list.grains = read_grain_list(text, table.place("csv"), table.path("csv"), problems);
    return list;
  }
  list.file = table.text("file");
  if (list.file.empty()) return list;
  // a list lies beside its scene, wherever the command was called
  const Place place = table.place("file");
  const auto folder = std::filesystem::path(scene_file).parent_path();
  const std::string path = (folder / list.file).string();
  try {
    const Place start{std::make_shared<const std::string>(path), 1, 1};
    list.grains = read_grain_list(read_text_file(path), start, "", problems);
  } catch (const InputError& error) {
    problems.error(place, table.path("file"), error.what());
  }
  return list;
}

void require(const TableReader& table, std::string_view key, std::string_view method, std::string_view how) {
  if (!table.has(key))
    table.error(key, "is missing", fmt::format("insert.method = \"{}\" needs it", method), how);
}
void forbid(const TableReader& table, std::string_view key) {
  if (table.has(key))
    table.error(key, "is given although the grains come from a list", "the list says it for every grain",
                "drop this key");
}

Particles read_group(const TableReader& table, const std::string& scene_file) {
  Particles group;
  group.name = table.text("name");
  group.material = table.text("material");
  const Value* insert = table.raw("insert");
  const Value* method = insert ? insert->find("method") : nullptr;
  const bool list = method ? method->text == "list" : insert && (insert->find("file") || insert->find("csv"));
  const TableReader how(insert, section(list ? "particles.insert (list)" : "particles.insert (rain)"),
                        table.path("insert"), table.place(), table.problems());
  if (!insert || !how) return group;
  const bool known = !how.choice("method").empty();
  if (list) {
    forbid(table, "count");
    forbid(table, "diameter");
    group.list = read_list(how, scene_file);
    group.count = static_cast<std::int64_t>(group.list->grains.size());
    return group;
  }
  group.rain = read_rain(how);
  if (known) {
    require(table, "count", "rain", "add count = 1000");
    require(table, "diameter", "rain", "add diameter = \"40 um\" or a distribution");
  }
  group.count = table.integer("count").value_or(0);
  if (const Value* diameter = table.raw("diameter"))
    group.diameter = read_diameters(*diameter, table.path("diameter"), table.problems());
  return group;
}

}  // namespace

std::vector<Particles> read_particles(const TableReader& root, const std::string& scene_file) {
  std::vector<Particles> groups;
  const auto tables = root.tables("particles");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const TableReader table(tables[i], section("particles"), root.element_path("particles", i), root.place(),
                            root.problems());
    groups.push_back(table ? read_group(table, scene_file) : Particles{});
  }
  return groups;
}

}  // namespace interstice::scene
