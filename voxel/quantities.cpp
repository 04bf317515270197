#include "voxel/quantities.h"

#include <cmath>
#include <span>

#include "base/error.h"

namespace interstice::voxel {

namespace {

[[noreturn]] void missing(const char* quantity, const char* columns) {
  std::string message = "the quantity ";
  message.append(quantity).append(" needs ").append(columns);
  message.append(", and the particles have none; leave the quantity out, or give particles that have them");
  throw InputError(message);
}

void check_finite(std::span<const double> column, const char* quantity) {
  for (std::size_t s = 0; s < column.size(); ++s) {
    if (std::isfinite(column[s])) continue;
    std::string message = "the ";
    message.append(quantity).append(" of sphere ").append(std::to_string(s));
    message.append(" is not finite; finite numbers only; correct it, or leave the quantity out");
    throw InputError(message);
  }
}

}  // namespace

void check_quantities(const SpheresView& spheres, const QuantityRequest& request) {
  if (spheres.count == 0) return;
  if (request.velocity || request.temperature) {
    if (!spheres.velocity[0])
      missing(request.temperature ? "temperature" : "velocity", "the columns vx, vy and vz");
    for (const double* v : spheres.velocity) check_finite({v, spheres.count}, "velocity");
  }
  if (request.coordination) {
    if (!spheres.coordination) missing("coordination", "the column coordination");
    check_finite({spheres.coordination, spheres.count}, "coordination");
  }
  if (request.stress) {
    if (!spheres.stress[0])
      missing("stress", "the columns stress_xx, stress_yy, stress_zz, stress_xy, stress_yz and stress_xz");
    for (const double* s : spheres.stress) check_finite({s, spheres.count}, "stress");
  }
  if (request.bonded && !spheres.bonded) missing("bonded", "the column bonded");
  if (request.groups.empty()) return;
  if (!spheres.group) missing("solid fraction by class", "a class for each sphere");
  const auto groups = static_cast<std::int32_t>(request.groups.size());
  for (std::size_t s = 0; s < spheres.count; ++s)
    if (spheres.group[s] >= groups)
      throw InputError("sphere " + std::to_string(s) + " is of class " + std::to_string(spheres.group[s]) +
                       ", and there are " + std::to_string(groups) + "; classes count from 0; correct it");
}

}  // namespace interstice::voxel
