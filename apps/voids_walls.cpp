#include "apps/voids_walls.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/error.h"
#include "coupling/io/stl_reader.h"
#include "coupling/scene/format_quantity.h"
#include "coupling/scene/selectors.h"
#include "coupling/scene/units.h"

namespace interstice::apps {
namespace {

constexpr const char* kSolids =
    "box:x0,x1,y0,y1,z0,z1, ball:x,y,z,RADIUS, cylinder:x0,y0,z0,x1,y1,z1,RADIUS or plane:x,y,z,nx,ny,nz";
constexpr double kSeldom = 100;  // times larger or smaller than the field's box

[[noreturn]] void wrong(const std::string& text, const std::string& what) {
  throw InputError(fmt::format(
      "--solid: {}: {}; {}; write for example cylinder:1mm,0mm,2mm,1mm,5mm,2mm,0.5mm", text, what, kSolids));
}

std::vector<std::string> parts_of(const std::string& text, const std::string& list, std::size_t due) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t to = std::min(list.find(',', at), list.size());
    parts.emplace_back(scene::trim(std::string_view(list).substr(at, to - at)));
    at = to + 1;
  }
  if (parts.size() != due) wrong(text, fmt::format("{} values where {} are due", parts.size(), due));
  return parts;
}

double length(const std::string& part) { return scene::parse_length(part, "--solid"); }

Vec3d point(const std::vector<std::string>& parts, std::size_t first) {
  return {length(parts[first]), length(parts[first + 1]), length(parts[first + 2])};
}

double radius(const std::string& text, const std::string& part) {
  const double value = length(part);
  if (!(value > 0)) wrong(text, "the radius is not positive");
  return value;
}

Plane plane(const std::string& text, const std::vector<std::string>& parts) {
  Plane plane{point(parts, 0), {}};
  for (int axis = 0; axis < 3; ++axis) {
    const std::string& part = parts[static_cast<std::size_t>(3 + axis)];
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), plane.normal[axis]);
    if (error != std::errc() || end != part.data() + part.size() || !std::isfinite(plane.normal[axis]))
      wrong(text, fmt::format("'{}' is no plain number for the normal", part));
  }
  const double size = norm(plane.normal);
  if (!(size > 0)) wrong(text, "the normal has no direction");
  plane.normal = (1 / size) * plane.normal;
  return plane;
}

double largest(const Vec3d& size) { return std::max({size.x, size.y, size.z}); }

}  // namespace

void read_mesh(const std::string& text, WallOptions& options) {
  const auto at = text.rfind('@');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw InputError("--walls: " + text +
                     ": an STL file says no unit of length; FILE.stl@UNIT; write for example blade.stl@mm");
  const std::string file = text.substr(0, at);
  const double unit = scene::parse_length_unit(text.substr(at + 1), "--walls");
  options.solids.meshes.push_back(
      {std::make_shared<const voxel::TriangleMesh>(io::read_stl(file, unit)), {0, 0, 0}});
  options.meshes.push_back(file);
  options.words.push_back(text);
}

void read_solid(const std::string& text, WallOptions& options) {
  const auto colon = text.find(':');
  const std::string kind = text.substr(0, colon);
  const std::string list = colon == std::string::npos ? "" : text.substr(colon + 1);
  if (kind == "box") {
    options.solids.shapes.emplace_back(scene::parse_box(list, "--solid box"));
  } else if (kind == "ball") {
    const auto parts = parts_of(text, list, 4);
    options.solids.balls.push_back({point(parts, 0), radius(text, parts[3])});
  } else if (kind == "cylinder") {
    const auto parts = parts_of(text, list, 7);
    const voxel::Cylinder cylinder{point(parts, 0), point(parts, 3), radius(text, parts[6])};
    if (cylinder.from == cylinder.to) wrong(text, "both ends are at the same place");
    options.solids.cylinders.push_back(cylinder);
  } else if (kind == "plane") {
    options.solids.shapes.emplace_back(plane(text, parts_of(text, list, 6)));
  } else {
    wrong(text, "no such solid");
  }
  options.words.push_back(text);
}

std::vector<std::string> warnings_of_walls(const WallOptions& options, const Box& box) {
  std::vector<std::string> warnings;
  for (std::size_t m = 0; m < options.meshes.size(); ++m) {
    const Box mesh = options.solids.meshes[m].bounds();
    const double size = largest(mesh.size()), around = largest(box.size());
    bool apart = false;
    for (int axis = 0; axis < 3; ++axis)
      apart = apart || mesh.hi[axis] <= box.lo[axis] || mesh.lo[axis] >= box.hi[axis];
    const bool unlikely = size > kSeldom * around || size < around / kSeldom;
    if (!apart && !unlikely) continue;
    std::string line = fmt::format("{}: ", options.meshes[m]);
    if (unlikely)
      line += fmt::format("measures {}, the field's box {}", scene::format_length(size),
                          scene::format_length(around));
    if (apart)
      line += unlikely ? ", and lies outside it" : "lies outside the field's box, so it takes no room there";
    warnings.push_back(line + "; check its unit (@mm, @um, @m) and place");
  }
  return warnings;
}

}  // namespace interstice::apps
