// Walls and tools, the phases they move in, and the time step.
#include <fmt/format.h>

#include <cmath>

#include "coupling/scene/readers.h"

namespace interstice::scene {
namespace {

Plane read_plane(const TableReader& table) {
  Plane plane{table.vector("point"), table.vector("normal")};
  const double largest =
      std::max({std::abs(plane.normal.x), std::abs(plane.normal.y), std::abs(plane.normal.z)});
  if (largest == 0)
    table.error("normal", "is zero", "a direction of any length is due",
                "write for instance normal = [0, 0, 1]");
  if (!(largest > 0)) return plane;
  // what is a unit vector to rounding stays as it is, so that a resolved scene reads back bit for bit
  if (std::abs(dot(plane.normal, plane.normal) - 1) < 4e-15) return plane;
  plane.normal = (1 / largest) * plane.normal;  // first, so that squares neither overflow nor vanish
  plane.normal = (1 / norm(plane.normal)) * plane.normal;
  return plane;
}

Box read_solid_box(const TableReader& table) {
  const bool centered = table.has("center") || table.has("size");
  const bool cornered = table.has("lo") || table.has("hi");
  const bool whole = centered ? table.has("center") && table.has("size") : table.has("lo") && table.has("hi");
  if (centered == cornered || !whole) {
    table.error("", "is not one box", "center and size, or lo and hi, are due",
                "write for instance box = { lo = [\"0 mm\", \"-1 mm\", \"-1 mm\"], hi = [\"18 mm\", \"1 "
                "mm\", \"0 mm\"] }");
    return {};
  }
  if (centered) {
    const Vec3d center = table.vector("center"), half = 0.5 * table.vector("size");
    return {center - half, center + half};
  }
  const Box box{table.vector("lo"), table.vector("hi")};
  for (int axis = 0; axis < 3; ++axis)
    if (box.lo[axis] >= box.hi[axis])
      table.error("hi", fmt::format("is not above lo along {}", "xyz"[axis]), "lo < hi on every axis is due",
                  "swap the two or make the box larger");
  return box;
}

Shape read_shape(const TableReader& table) {
  if (table.has("plane") == table.has("box")) {
    table.error(
        "", table.has("plane") ? "is both plane and box" : "is neither plane nor box",
        "it is one or the other",
        "write for instance shape = { plane = { point = [\"0 m\", \"0 m\", \"0 m\"], normal = [0, 0, 1] } }");
    return Box{};
  }
  const std::string_view key = table.has("plane") ? "plane" : "box";
  const TableReader inner(table.raw(key), section(fmt::format("walls.shape.{}", key)), table.path(key),
                          table.place(), table.problems());
  if (!inner) return Box{};
  return key == "plane" ? Shape(read_plane(inner)) : Shape(read_solid_box(inner));
}

Wall read_wall(const TableReader& table) {
  Wall wall;
  wall.name = table.text("name");
  wall.material = table.text("material");
  wall.watch = table.boolean("watch");
  if (table.has("shape")) {
    const TableReader shape(table.raw("shape"), section("walls.shape"), table.path("shape"),
                            table.place("shape"), table.problems());
    if (shape) wall.shape = read_shape(shape);
  }
  const auto motions = table.tables("motion");
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const TableReader motion(motions[i], section("walls.motion"), table.element_path("motion", i),
                             table.place("motion"), table.problems());
    wall.motion.push_back(motion ? Motion{motion.text("phase"), motion.vector("velocity")} : Motion{});
  }
  return wall;
}

void read_until(const TableReader& until, Phase& phase) {
  phase.until_inserted = until.boolean("inserted");
  phase.until_settled = until.boolean("settled");
  phase.at_most = until.quantity("at_most");
  phase.settled_energy = until.quantity("settled_energy");
  phase.settled_time = until.quantity("settled_time");
  if (!phase.until_inserted && !phase.until_settled)
    until.error("", "waits for nothing", "inserted = true or settled = true (or both) is due",
                "add one of them, or give the phase a duration");
}

Phase read_phase(const TableReader& table) {
  Phase phase;
  phase.name = table.text("name");
  phase.duration = table.optional_quantity("duration");
  if (table.has("duration") == table.has("until"))
    table.error("", table.has("until") ? "has both duration and until" : "has neither duration nor until",
                "a phase ends by one or the other", "write for instance duration = \"50 ms\"");
  if (!table.has("until")) return phase;
  const TableReader until(table.raw("until"), section("phases.until"), table.path("until"),
                          table.place("until"), table.problems());
  if (until) read_until(until, phase);
  return phase;
}

}  // namespace

std::vector<Wall> read_walls(const TableReader& root) {
  std::vector<Wall> walls;
  const auto tables = root.tables("walls");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const TableReader table(tables[i], section("walls"), root.element_path("walls", i), root.place(),
                            root.problems());
    walls.push_back(table ? read_wall(table) : Wall{});
  }
  return walls;
}

std::vector<Phase> read_phases(const TableReader& root) {
  std::vector<Phase> phases;
  const auto tables = root.tables("phases");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const TableReader table(tables[i], section("phases"), root.element_path("phases", i), root.place(),
                            root.problems());
    phases.push_back(table ? read_phase(table) : Phase{});
  }
  return phases;
}

TimeStep read_time_step(const TableReader& time) {
  TimeStep step;
  step.allow_unstable = time.boolean("allow_unstable");
  step.sleeping = time.boolean("sleeping");
  step.sleep_tolerance = time.quantity("sleep_tolerance");
  step.short_below = time.optional_quantity("short_steps_below");
  const Value* value = time.raw("step");
  if (value && value->kind != Value::Kind::table) {
    const Key key{.name = "step",
                  .dimension = Dimension::time,
                  .range = {.lo = 0, .lo_open = true, .reason = "time goes forward"},
                  .plausible = {1e-12, 1e-2}};
    step.fixed = time.number(*value, key, time.path("step"));
    return step;
  }
  const TableReader table(value, section("time.step"), time.path("step"), time.place(), time.problems());
  step.rayleigh = table.quantity("rayleigh");
  step.collision = table.quantity("collision");
  if (step.collision > 0.2 && !step.allow_unstable)
    table.error("collision",
                fmt::format("{} of the collision time cannot be: impacts would gain energy", step.collision),
                "allowed: at most 0.2, and 0.05 is wise", "lower it, or set time.allow_unstable = true");
  return step;
}

}  // namespace interstice::scene
