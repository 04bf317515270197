#include "coupling/stream/field_memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "coupling/io/field_grains.h"

namespace interstice::stream {
namespace {

// Two grids of floats with their masks and nodes; lists of spheres by region and those that wait to be added;
// what threads and OpenVDB keep once. `bench_fields scaling` (docs/PERFORMANCE.md) measures less.
constexpr double kBytesPerCell = 12, kBytesPerSphere = 300, kBytesOnce = 8e6;
// Dense averages: solid and available in double, and two more grids.
constexpr double kBytesPerAveragedCell = 36;
// A quantity's grid of floats with its mask, and where averages are taken its parts and their average.
constexpr double kBytesPerQuantityCell = 5, kBytesPerAveragedQuantityCell = 20,
                 kBytesPerQuantityOfASphere = 8;
constexpr double kBytesPerCopiedGrain = 150;

/// How many classes a run's grains can be in.
std::size_t classes_of(const scene::Scene& scene, const scene::FieldClasses& classes) {
  using By = scene::FieldClasses::By;
  switch (classes.by) {
    case By::none:
      return 0;
    case By::size:
      return classes.edges.size() + 1;
    case By::material:
      return scene.materials.size();
    case By::layer:
      return scene.particles.size();
  }
  return 0;
}

io::FieldFilesRequest request_of(const scene::Scene& scene, const scene::Field& field) {
  io::FieldFilesRequest request;
  request.computed.lattice = voxel::cubic_lattice(field.box, field.voxel);
  request.computed.average_length = field.average;
  request.computed.average_window = field.average_window;
  io::GrainClasses classes;
  classes.names.resize(classes_of(scene, field.recipe.classes));
  io::apply(field.recipe, classes, request.computed);
  return request;
}

double cells_of(const voxel::Lattice& lattice) {
  return static_cast<double>(lattice.n[0]) * static_cast<double>(lattice.n[1]) *
         static_cast<double>(lattice.n[2]);
}

double grains_of(const scene::Scene& scene) {
  double grains = 0;
  for (const scene::Particles& p : scene.particles)
    grains += p.list ? static_cast<double>(p.list->grains.size()) : static_cast<double>(p.count);
  return grains;
}

double memory_of(const scene::Scene& scene, const scene::Field& field, double grains) {
  const io::FieldFilesRequest request = request_of(scene, field);
  return field_memory(request, cells_of(request.computed.lattice), grains);
}

}  // namespace

double cells_reached(const std::vector<double>& radius, const voxel::FieldRequest& request) {
  const double all = cells_of(request.lattice), h = request.lattice.h.x;
  const bool tiles = request.method == voxel::Method::exact && request.average_length == 0;
  double cells = 0;
  for (const double r : radius) {
    const double edge = 2 * std::max(r, request.kernel_length) / h + 9;  // of its box in leaves of 8
    // the inside of a large sphere is tiles; its surface passes fewer cells' leaves than 40 edge^2
    cells += tiles && edge > 40 ? 40 * edge * edge : edge * edge * edge;
    if (cells >= all) return all;
  }
  return cells;
}

double field_memory(const io::FieldFilesRequest& request, double cells, double spheres) {
  const double all = cells_of(request.computed.lattice);
  const bool averaged = request.computed.average_length > 0;
  double bytes = kBytesOnce + kBytesPerCell * cells + kBytesPerSphere * spheres;
  if (averaged) bytes += kBytesPerAveragedCell * all;
  if (averaged && request.computed.average_window == WindowShape::sphere) bytes += 8 * all;  // sums aside
  const auto quantities = static_cast<double>(request.computed.quantities.grids() + 1);  // and mass density
  bytes += quantities * (kBytesPerQuantityCell * cells + kBytesPerQuantityOfASphere * spheres);
  if (averaged) bytes += quantities * kBytesPerAveragedQuantityCell * all;
  if (request.vti && all <= static_cast<double>(request.vti_most_cells))
    bytes += (averaged ? 24 : 12) * (1 + quantities / 3) * all;
  return bytes;
}

double fields_memory(const scene::Scene& scene) {
  const double grains = grains_of(scene);
  double largest = 0;
  for (const scene::Field& field : scene.fields) largest = std::max(largest, memory_of(scene, field, grains));
  return largest + 2 * kBytesPerCopiedGrain * grains;
}

void check_fields_memory(const scene::Scene& scene, double available) {
  const double needed = fields_memory(scene);
  if (scene.fields.empty() || needed <= available) return;
  const double grains = grains_of(scene);
  const auto& worst =
      *std::max_element(scene.fields.begin(), scene.fields.end(), [&](const auto& a, const auto& b) {
        return memory_of(scene, a, grains) < memory_of(scene, b, grains);
      });
  const voxel::Lattice lattice = voxel::cubic_lattice(worst.box, worst.voxel);
  throw InputError(fmt::format(
      "fields: `{}` ({} x {} x {} voxels) would need up to {:.3g} GB; this machine has {:.3g} GB free; use a "
      "larger voxel or a smaller box",
      worst.name, lattice.n[0], lattice.n[1], lattice.n[2], 1e-9 * needed, 1e-9 * available));
}

}  // namespace interstice::stream
