// Checks that concern more than one section of a scene. Everything here must bear values that could not be
// read: they are NaN or empty, are reported already, and pass every check.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "coupling/scene/format_quantity.h"
#include "coupling/scene/overrides.h"
#include "coupling/scene/readers.h"
#include "coupling/scene/sizes.h"

namespace interstice::scene {
namespace {

struct Checker {
  const Scene& scene;
  const Value& document;
  Problems& problems;

  /// The path of an element of a top-level array, as `--set` takes it.
  std::string path(std::string_view array, std::size_t i) const {
    return fmt::format("{}.{}", array, element_name(*document.find(array), i));
  }
  void error(const std::string& at, std::string_view what, std::string_view allowed,
             std::string_view remedy) const {
    problems.error(locate(document, at), at, what, allowed, remedy);
  }
  void warn(const std::string& at, std::string_view what, std::string_view remedy) const {
    problems.warn(locate(document, at), at, what, remedy);
  }
};

std::vector<std::string> material_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Material& material : scene.materials) names.push_back(material.name);
  return names;
}

std::vector<std::string> phase_names(const Scene& scene) {
  std::vector<std::string> names;
  for (const Phase& phase : scene.phases)
    if (!phase.name.empty()) names.push_back(phase.name);
  return names;
}

void check_reference(const Checker& check, const std::string& at, const std::string& name,
                     const std::vector<std::string>& known, std::string_view where) {
  if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string near = nearest(name, known);
  const std::string allowed = known.empty() ? std::string("there are none") : "allowed: " + listed(known);
  check.error(at, fmt::format("\"{}\" is not in {}", name, where), allowed,
              near.empty() ? fmt::format("name one of {}, or add it there", where)
                           : fmt::format("did you mean \"{}\"?", near));
}

void check_duplicates(const Checker& check, std::string_view array, const std::vector<std::string>& names) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto first = std::find(names.begin(), names.end(), names[i]);
    if (names[i].empty() || first == names.begin() + static_cast<std::ptrdiff_t>(i)) continue;
    check.error(fmt::format("{}.{}.name", array, i), fmt::format("\"{}\" is taken", names[i]),
                fmt::format("names within [[{}]] differ, because files and columns are named by them", array),
                "rename one of the two");
  }
}

template <class Items>
std::vector<std::string> names_of(const Items& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

void check_names(const Checker& check) {
  const Scene& scene = check.scene;
  check_duplicates(check, "particles", names_of(scene.particles));
  check_duplicates(check, "walls", names_of(scene.walls));
  check_duplicates(check, "phases", names_of(scene.phases));
  check_duplicates(check, "fields", names_of(scene.fields));
  if (check.document.find("phases") && scene.phases.empty())
    check.error("phases", "is empty", "a run has at least one phase",
                "add [[phases]] with a name and a duration");

  const auto materials = material_names(scene);
  const auto phases = phase_names(scene);
  for (std::size_t axis = 0; axis < 3; ++axis)
    check_reference(check, "domain.wall_material", scene.domain.wall_material[axis], materials,
                    "[materials]");
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    const Particles& group = scene.particles[i];
    check_reference(check, check.path("particles", i) + ".material", group.material, materials,
                    "[materials]");
    if (group.rain)
      check_reference(check, check.path("particles", i) + ".insert.phase", group.rain->phase, phases,
                      "[[phases]]");
  }
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Wall& wall = scene.walls[i];
    check_reference(check, check.path("walls", i) + ".material", wall.material, materials, "[materials]");
    std::set<std::string> moved;
    for (std::size_t j = 0; j < wall.motion.size(); ++j) {
      const std::string at = fmt::format("{}.motion.{}.phase", check.path("walls", i), j);
      const std::string& phase = wall.motion[j].phase;
      check_reference(check, at, phase, phases, "[[phases]]");
      if (!phase.empty() && !moved.insert(phase).second)
        check.error(at, fmt::format("\"{}\" is there twice", phase), "one motion per phase is allowed",
                    "merge or remove one");
    }
  }
}

using MaterialPair = std::pair<std::string, std::string>;
MaterialPair ordered(const std::string& a, const std::string& b) {
  return a < b ? MaterialPair(a, b) : MaterialPair(b, a);
}

/// Grains meet grains and walls; walls do not meet each other. A grain that is alone meets no other of its
/// kind.
std::set<MaterialPair> pairs_that_meet(const Scene& scene) {
  std::vector<std::pair<std::string, std::int64_t>> grains;  // material, how many
  for (const Particles& group : scene.particles) {
    const auto same =
        std::find_if(grains.begin(), grains.end(), [&](const auto& g) { return g.first == group.material; });
    if (same == grains.end())
      grains.emplace_back(group.material, group.count);
    else
      same->second += group.count;
  }
  std::vector<std::string> solids;
  for (const Wall& wall : scene.walls) solids.push_back(wall.material);
  for (const std::string& material : scene.domain.wall_material) solids.push_back(material);
  std::set<MaterialPair> pairs;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    if (grains[i].second > 1) pairs.insert(ordered(grains[i].first, grains[i].first));
    for (std::size_t j = 0; j < i; ++j) pairs.insert(ordered(grains[i].first, grains[j].first));
    for (const std::string& solid : solids) pairs.insert(ordered(grains[i].first, solid));
  }
  return pairs;
}

void check_pairs(const Checker& check) {
  const auto materials = material_names(check.scene);
  std::set<MaterialPair> given;
  const Value* contact = check.document.find("contact");
  const Value* list = contact ? contact->find("pair") : nullptr;
  for (std::size_t i = 0; i < check.scene.contact.pairs.size(); ++i) {
    const auto& names = check.scene.contact.pairs[i].materials;
    const std::string at = fmt::format("contact.pair.{}.materials", element_name(*list, i));
    for (const std::string& name : names) check_reference(check, at, name, materials, "[materials]");
    if (!names[0].empty() && !given.insert(ordered(names[0], names[1])).second)
      check.error(at, fmt::format("{} and {} are given twice", names[0], names[1]),
                  "each pair once, in either order", "remove one of the two");
  }
  const std::set<std::string> known(materials.begin(), materials.end());
  for (const auto& [a, b] : pairs_that_meet(check.scene)) {
    if (!known.count(a) || !known.count(b) || given.count({a, b})) continue;
    check.error("contact.pair", fmt::format("{} and {} can meet, and the pair is not given", a, b),
                "every pair that can meet is due",
                fmt::format("add [[contact.pair]] with materials = [\"{}\", \"{}\"]", a, b));
  }
}

/// The first axis along which `inner` reaches outside `outer`; -1 if none.
int axis_outside(const Box& inner, const Box& outer) {
  for (int axis = 0; axis < 3; ++axis)
    if (inner.lo[axis] < outer.lo[axis] || inner.hi[axis] > outer.hi[axis]) return axis;
  return -1;
}

void check_inside(const Checker& check, const std::string& at, const Box& inner, std::string_view remedy) {
  const Box& outer = check.scene.domain.box;
  const int axis = axis_outside(inner, outer);
  if (axis < 0) return;
  check.error(at,
              fmt::format("{} to {} reaches outside the domain along {}", format_length(inner.lo[axis]),
                          format_length(inner.hi[axis]), "xyz"[axis]),
              fmt::format("{} to {} is allowed (domain.box)", format_length(outer.lo[axis]),
                          format_length(outer.hi[axis])),
              remedy);
}

void check_rain(const Checker& check, const std::string& path, const Particles& group) {
  check_inside(check, path + ".insert.box", group.rain->box, "make it smaller, or the domain larger");
  const Vec3d size = group.rain->box.size();
  for (int axis = 0; axis < 3; ++axis)
    if (size[axis] < group.diameter.max)
      check.error(path + ".insert.box",
                  fmt::format("is {} along {}, and the largest grain {}", format_length(size[axis]),
                              "xyz"[axis], format_length(group.diameter.max)),
                  "grains appear wholly inside it", "make the box larger, or cut the sizes at a smaller max");
}

void check_list(const Checker& check, const std::string& path, const Particles& group) {
  const Box& box = check.scene.domain.box;
  int outside = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < group.list->grains.size(); ++i) {
    const Vec3d& p = group.list->grains[i].position;
    for (int axis = 0; axis < 3; ++axis)
      if (p[axis] < box.lo[axis] || p[axis] >= box.hi[axis]) {
        if (outside++ == 0) first = i;
        break;
      }
  }
  if (outside > 0)
    check.error(path + ".insert",
                fmt::format("{} of {} grains start outside the domain, the first is number {}", outside,
                            group.list->grains.size(), first + 1),
                "every grain starts inside domain.box",
                "move them, check the list's units, or make the domain larger");
}

void check_particles(const Checker& check) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < check.scene.particles.size(); ++i) {
    const Particles& group = check.scene.particles[i];
    const std::string path = check.path("particles", i);
    if (group.rain) check_rain(check, path, group);
    if (group.list) check_list(check, path, group);
    count += group.count;
    for (int axis = 0; axis < 3; ++axis)
      if (check.scene.domain.boundary[static_cast<std::size_t>(axis)] == Boundary::periodic &&
          check.scene.domain.box.size()[axis] < 2 * largest_diameter(group))
        check.error("domain.box",
                    fmt::format("is {} along {}, which is periodic, and the largest grain of {} is {}",
                                format_length(check.scene.domain.box.size()[axis]), "xyz"[axis], group.name,
                                format_length(largest_diameter(group))),
                    "at least two of the largest diameters are due, or grains would meet their own images",
                    "make the box larger, or the axis open");
  }
  if (count > 2147483647)
    check.error("particles", fmt::format("{} grains in all", count), "at most 2147483647 are allowed",
                "take fewer grains");
}

void check_periodic_walls(const Checker& check) {
  const Domain& domain = check.scene.domain;
  for (std::size_t i = 0; i < check.scene.walls.size(); ++i) {
    const std::string at = check.path("walls", i) + ".shape";
    for (int axis = 0; axis < 3; ++axis) {
      if (domain.boundary[static_cast<std::size_t>(axis)] != Boundary::periodic) continue;
      if (const auto* plane = std::get_if<Plane>(&check.scene.walls[i].shape)) {
        if (std::abs(plane->normal[axis]) > 0)
          check.error(
              at, fmt::format("the plane's normal has a part along {}, which is periodic", "xyz"[axis]),
              "a plane must run on across periodic ends", "turn the plane, or make that axis open or wall");
      } else {
        const Box& box = std::get<Box>(check.scene.walls[i].shape);
        const bool below = box.lo[axis] < domain.box.lo[axis] && box.hi[axis] > domain.box.lo[axis];
        const bool above = box.hi[axis] > domain.box.hi[axis] && box.lo[axis] < domain.box.hi[axis];
        if (below != above && !(box.lo[axis] <= domain.box.lo[axis] && box.hi[axis] >= domain.box.hi[axis]))
          check.warn(
              at,
              fmt::format("the box reaches through one end of the domain along {}, which is periodic, and "
                          "does not come back in at the other",
                          "xyz"[axis]),
              "let it span the whole domain, or end inside");
      }
    }
  }
}

/// Rayleigh time of a grain, t_R = pi r sqrt(rho / G) / (0.1631 nu + 0.8766).
double rayleigh_time(const Material& material, double diameter) {
  const double shear_modulus = material.youngs_modulus / (2 * (1 + material.poisson_ratio));
  return std::numbers::pi * 0.5 * diameter * std::sqrt(material.density / shear_modulus) /
         (0.1631 * material.poisson_ratio + 0.8766);
}

void check_time_step(const Checker& check) {
  if (!check.scene.step.fixed) return;
  double shortest = std::numeric_limits<double>::infinity();
  for (const Particles& group : check.scene.particles)
    for (const Material& material : check.scene.materials)
      if (material.name == group.material)
        shortest = std::min(shortest, rayleigh_time(material, smallest_diameter(group)));
  const double share = *check.scene.step.fixed / shortest;
  if (share > 0.4)
    check.warn("time.step",
               fmt::format("{} is {:.3g} of the Rayleigh time of the smallest grain, {}",
                           format_time(*check.scene.step.fixed), share, format_time(shortest)),
               "0.1 to 0.3 is usual: shorten it, or give fractions instead");
}

void check_sleeping(const Checker& check) {
  const Vec3d& g = check.scene.domain.gravity;
  if (check.scene.step.sleeping && g.x == 0 && g.y == 0 && g.z == 0)
    check.error("time.sleeping", "is true, and there is no gravity to tell a grain at rest by its weight",
                "it is allowed with a gravity above 0 m/s^2", "give domain.gravity, or drop this key");
}

void check_short_steps(const Checker& check) {
  const TimeStep& step = check.scene.step;
  if (!step.short_below) return;
  const auto excluded = [&](const char* what) {
    check.error("time.short_steps_below", fmt::format("does not go with {}", what),
                "grains all take the same step there", "drop one of the two");
  };
  if (step.sleeping) excluded("time.sleeping");
  if (check.scene.output.energy) excluded("output.energy");
}

}  // namespace

void check_scene(const Scene& scene, const Value& document, Problems& problems) {
  const Checker check{scene, document, problems};
  check_names(check);
  check_pairs(check);
  check_particles(check);
  check_periodic_walls(check);
  check_time_step(check);
  check_sleeping(check);
  check_short_steps(check);
  for (std::size_t i = 0; i < scene.fields.size(); ++i)
    check_inside(check, check.path("fields", i) + ".box", scene.fields[i].box,
                 "make it smaller, or the domain larger");
}

}  // namespace interstice::scene
