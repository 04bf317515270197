#include "coupling/io/field_grains.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"

namespace interstice::io {
namespace {

constexpr std::size_t kMostClasses = 64;

const double* column(const std::vector<double>& values) { return values.empty() ? nullptr : values.data(); }

/// "20um": a part of names of grids, columns and files.
std::string micrometres(double length) { return fmt::format("{:.6g}um", 1e6 * length); }

GrainClasses by_size(const ParticleFrame& frame, const std::vector<double>& edges) {
  GrainClasses classes;
  classes.names.push_back("size_below_" + micrometres(edges.front()));
  for (std::size_t e = 1; e < edges.size(); ++e)
    classes.names.push_back(fmt::format("size_{}_to_{}", micrometres(edges[e - 1]), micrometres(edges[e])));
  classes.names.push_back("size_from_" + micrometres(edges.back()));
  for (const double radius : frame.radius) {
    const auto above = std::upper_bound(edges.begin(), edges.end(), 2 * radius);
    classes.of.push_back(static_cast<std::int32_t>(above - edges.begin()));
  }
  return classes;
}

GrainClasses by_number(const std::vector<std::int32_t>& numbers, const std::string& kind,
                       const std::vector<std::string>& known) {
  std::vector<std::int32_t> found = numbers;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  if (found.size() > kMostClasses)
    throw InputError(fmt::format("--classes {}: {} different ones; at most {}; leave the classes out", kind,
                                 found.size(), kMostClasses));
  GrainClasses classes;
  for (const std::int32_t number : found) {
    const auto n = static_cast<std::size_t>(number);
    classes.names.push_back(
        fmt::format("{}_{}", kind, number >= 0 && n < known.size() ? known[n] : fmt::format("{}", number)));
  }
  for (const std::int32_t number : numbers)
    classes.of.push_back(
        static_cast<std::int32_t>(std::lower_bound(found.begin(), found.end(), number) - found.begin()));
  return classes;
}

}  // namespace

voxel::SpheresView view_of(const ParticleFrame& frame) {
  voxel::SpheresView view{frame.size(),   frame.x.data(),      frame.y.data(),
                          frame.z.data(), frame.radius.data(), column(frame.density)};
  if (!frame.vx.empty() && !frame.vy.empty() && !frame.vz.empty())
    view.velocity = {frame.vx.data(), frame.vy.data(), frame.vz.data()};
  view.coordination = column(frame.coordination);
  const bool stress = std::none_of(frame.stress.begin(), frame.stress.end(),
                                   [](const std::vector<double>& component) { return component.empty(); });
  for (std::size_t c = 0; c < 6 && stress; ++c) view.stress[c] = frame.stress[c].data();
  view.bonded = frame.bonded.empty() ? nullptr : frame.bonded.data();
  return view;
}

GrainClasses classify(const ParticleFrame& frame, const scene::FieldClasses& classes,
                      const std::vector<std::string>& materials) {
  using By = scene::FieldClasses::By;
  if (classes.by == By::size) return by_size(frame, classes.edges);
  if (classes.by == By::none || frame.size() == 0) return {};
  const bool layer = classes.by == By::layer;
  const auto& numbers = layer ? frame.layer : frame.material;
  const std::string kind = layer ? "layer" : "material";
  if (numbers.empty())
    throw InputError(
        fmt::format("--classes {0}: the particles have no column {0}; one is needed; name it with --columns "
                    "{0}=NAME, or leave the classes out",
                    kind));
  return by_number(numbers, kind, layer ? std::vector<std::string>{} : materials);
}

void apply(const scene::FieldRecipe& recipe, const GrainClasses& classes, voxel::FieldRequest& request) {
  switch (recipe.method) {
    case scene::FieldMethod::exact:
      request.method = voxel::Method::exact;
      break;
    case scene::FieldMethod::centre:
      request.method = voxel::Method::centre;
      break;
    case scene::FieldMethod::subsample:
      request.method = voxel::Method::subsample;
      break;
    case scene::FieldMethod::divided:
      request.method = voxel::Method::divided;
      break;
    case scene::FieldMethod::kernel:
      request.method = voxel::Method::kernel;
      break;
  }
  request.subsample = recipe.subsample;
  request.least_void = recipe.least_void;
  request.kernel_length = recipe.kernel_length;
  request.overlap = recipe.united ? voxel::Overlap::united : voxel::Overlap::sum;
  const scene::FieldQuantities& q = recipe.quantities;
  request.quantities = {q.velocity, q.temperature, q.diameter,   q.coordination,
                        q.stress,   q.bonded,      classes.names};
}

}  // namespace interstice::io
