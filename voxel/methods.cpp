#include "voxel/methods.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "voxel/text.h"

namespace interstice::voxel {

void centre_fractions(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& block,
                      double* fractions) {
  std::fill_n(fractions, block.cells(), 0.0);
  std::int64_t at = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t i = sphere.cell[axis] - block.lo[axis];
    if (i < 0 || i >= block.size(axis)) return;
    at = at * block.size(axis) + i;
  }
  const double r = sphere.radius;
  fractions[at] = 4 * std::numbers::pi / 3 * ((r / lattice.h.x) * (r / lattice.h.y) * (r / lattice.h.z));
}

void subsample_fractions(const Lattice& lattice, const PlacedSphere& sphere, const CellRange& block,
                         int points, double* fractions) {
  const double inverse = 1.0 / points, r = sphere.radius;
  // squared distance, in radii and along one axis, of point p of cell i
  const auto squared = [&](int axis, std::int64_t i, int p) {
    const double at = static_cast<double>(i - sphere.cell[axis]) + (p + 0.5) * inverse;
    const double d = (at * lattice.h[axis] - sphere.offset[axis]) / r;
    return d * d;
  };
  for (std::int64_t i = block.lo[0]; i < block.hi[0]; ++i)
    for (std::int64_t j = block.lo[1]; j < block.hi[1]; ++j)
      for (std::int64_t k = block.lo[2]; k < block.hi[2]; ++k) {
        std::int64_t inside = 0;
        if (touches(lattice, sphere, {{i, j, k}, {i + 1, j + 1, k + 1}}))
          for (int p = 0; p < points; ++p)
            for (int q = 0; q < points; ++q) {
              const double xy = squared(0, i, p) + squared(1, j, q);
              if (xy > 1) continue;
              for (int s = 0; s < points; ++s) inside += xy + squared(2, k, s) <= 1;
            }
        *fractions++ = static_cast<double>(inside) * (inverse * inverse * inverse);
      }
}

const std::array<Vec3d, kDividedPoints>& divided_points() {
  static const auto points = [] {
    // A ball of 1/29 of the volume around the centre, two shells of 14/29 each; a shell's points lie at the
    // mean distance of what is in it.
    const double inner = std::cbrt(1.0 / 29), outer = std::cbrt(15.0 / 29);
    const auto mean = [](double from, double to) {
      return 0.75 * (std::pow(to, 4) - std::pow(from, 4)) / (std::pow(to, 3) - std::pow(from, 3));
    };
    std::array<Vec3d, kDividedPoints> all;
    std::size_t n = 0;
    all[n++] = {0, 0, 0};
    for (const double r : {mean(inner, outer), mean(outer, 1)}) {
      // Not the corners of a cube: the published angles are multiples of 45 degrees from z and in the plane.
      for (const double x : {-0.5, 0.5})
        for (const double y : {-0.5, 0.5})
          for (const double z : {-std::numbers::sqrt2 / 2, std::numbers::sqrt2 / 2})
            all[n++] = {r * x, r * y, r * z};
      for (const double side : {-r, r}) {
        all[n++] = {side, 0, 0};
        all[n++] = {0, side, 0};
        all[n++] = {0, 0, side};
      }
    }
    return all;
  }();
  return points;
}

void divided_fractions(const Lattice& lattice, const PlacedSphere& sphere,
                       const std::array<bool, 3>& periodic, const CellRange& block, double* fractions) {
  std::fill_n(fractions, block.cells(), 0.0);
  const auto inside = [&](const std::array<std::int64_t, 3>& cell) {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (!periodic[axis] && (cell[axis] < 0 || cell[axis] >= lattice.n[axis])) return false;
    return true;
  };
  if (!inside(sphere.cell)) return;
  const double r = sphere.radius;
  const double part =
      4 * std::numbers::pi / 3 / kDividedPoints * ((r / lattice.h.x) * (r / lattice.h.y) * (r / lattice.h.z));
  for (const Vec3d& point : divided_points()) {
    std::array<std::int64_t, 3> cell;
    for (int axis = 0; axis < 3; ++axis)
      cell[static_cast<std::size_t>(axis)] =
          sphere.cell[axis] + floor_index((sphere.offset[axis] + r * point[axis]) / lattice.h[axis]);
    if (!inside(cell)) cell = sphere.cell;
    if (!block.contains(cell[0], cell[1], cell[2])) continue;
    fractions[((cell[0] - block.lo[0]) * block.size(1) + (cell[1] - block.lo[1])) * block.size(2) +
              (cell[2] - block.lo[2])] += part;
  }
}

void method_fractions(const FieldRequest& request, const PlacedSphere& sphere, const CellRange& block,
                      double* fractions) {
  switch (request.method) {
    case Method::exact:
    case Method::kernel:  // spheres that the kernel cannot place
      return exact_fractions(request.lattice, sphere, block, fractions);
    case Method::centre:
      return centre_fractions(request.lattice, sphere, block, fractions);
    case Method::subsample:
      return subsample_fractions(request.lattice, sphere, block, request.subsample, fractions);
    case Method::divided:
      return divided_fractions(request.lattice, sphere, request.periodic, block, fractions);
  }
}

std::string method_name(const FieldRequest& request) {
  std::string name;
  switch (request.method) {
    case Method::exact:
      name = request.precision == Precision::mixed ? "exact, single" : "exact";
      break;
    case Method::centre:
      name = "centre";
      break;
    case Method::subsample:
      name = "subsample:";
      name += std::to_string(request.subsample);
      break;
    case Method::divided:
      name = "divided";
      if (request.least_void > 0) name.append(":").append(shown(request.least_void));
      break;
    case Method::kernel:
      name = "kernel:";
      name.append(shown(request.kernel_length)).append("m");
      break;
  }
  return name;
}

void check_method(const FieldRequest& request) {
  if (request.method == Method::subsample && (request.subsample < 1 || request.subsample > 1000))
    throw InputError("subsample is " + std::to_string(request.subsample) +
                     " points per edge; 1 to 1000 are possible");
  if (!(request.least_void >= 0 && request.least_void < 1))
    throw InputError("the least void fraction is " + shown(request.least_void) +
                     "; from 0 (no limit) to below 1 is possible");
  if (request.least_void > 0 && request.method != Method::divided)
    throw InputError("a least void fraction goes with the method divided only; leave it out");
  if (request.method == Method::kernel) {
    const double length = request.kernel_length;
    if (!(std::isfinite(length) && length > 0))
      throw InputError("the kernel's length is " + shown(length) + " m; it must be finite and positive");
    for (int axis = 0; axis < 3; ++axis)
      if (length / request.lattice.h[axis] > 1000)
        throw InputError(
            "the kernel's length is more than 1000 voxels; choose a shorter kernel or larger voxels");
  }
  if (request.overlap == Overlap::united && request.method != Method::exact)
    throw InputError("the union of overlapping spheres needs the method exact; another one sums them");
}

}  // namespace interstice::voxel
