#include "coupling/stream/field_output.h"

#include <fmt/format.h>

#include <chrono>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "coupling/figures/figures.h"
#include "coupling/io/field_files.h"
#include "coupling/io/field_grains.h"
#include "coupling/stream/run_figures.h"

namespace interstice::stream {
namespace {

constexpr const char* kTableHeader =
    "frame,time_s,phase,solid_fraction_mean,void_fraction_mean,void_fraction_min,solid_fraction_gap,solid_"
    "fraction_sd,"
    "solid_height_m,surface_height_m,solid_fraction_below_surface";
constexpr int kTimeColumn = 1;

std::vector<std::string> material_names(const scene::Scene& scene) {
  std::vector<std::string> names;
  for (const scene::Material& material : scene.materials) names.push_back(material.name);
  return names;
}

std::string table_row(const Snapshot& s, std::int64_t number, const nlohmann::ordered_json& summary,
                      const voxel::LayerSummary& layer) {
  const auto value = [&](const char* key) { return summary.at(key).get<double>(); };
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{}", number, s.frame.time, s.phase,
                     value("solid_fraction_mean"), value("void_fraction_mean"), value("void_fraction_min"),
                     layer.solid_fraction_gap, layer.solid_fraction_sd, layer.solid_height,
                     layer.surface_height, layer.solid_fraction_below_surface);
}

}  // namespace

FieldOutput::FieldOutput(const scene::Scene& scene, std::filesystem::path folder, bool figures,
                         std::optional<double> keep_until)
    : scene_(scene), folder_(std::move(folder)), figures_(figures && figures::plotting_available()) {
  std::filesystem::create_directories(folder_ / "fields");
  if (figures_) std::filesystem::create_directories(folder_ / "figures");
  for (const scene::Field& f : scene.fields) {
    tables_.emplace_back(folder_ / "fields" / (f.name + ".csv"), kTableHeader, keep_until, kTimeColumn);
  }
}

void FieldOutput::write(const Snapshot& snapshot) {
  for (const Snapshot::Due& due : snapshot.due) write_field(snapshot, due);
  if (snapshot.phase_end && figures_)
    draw_grains(scene_, folder_ / "figures", snapshot.frame, snapshot.phase);
}

void FieldOutput::write_field(const Snapshot& snapshot, const Snapshot::Due& due) {
  const scene::Field& f = scene_.fields[due.field];
  const auto start = std::chrono::steady_clock::now();
  const io::GrainClasses classes = io::classify(snapshot.frame, f.recipe.classes, material_names(scene_));
  voxel::SpheresView spheres = io::view_of(snapshot.frame);
  if (!classes.of.empty()) spheres.group = classes.of.data();
  voxel::Solids solids;
  for (const io::WallPose& w : snapshot.frame.walls) solids.shapes.push_back(w.shape);

  io::FieldFilesRequest request;
  request.computed.lattice = voxel::cubic_lattice(f.box, f.voxel);
  if (f.periodic_from_domain) request.computed.periodic = snapshot.frame.periodic;
  request.computed.average_length = f.average;
  request.computed.average_window = f.average_window;
  io::apply(f.recipe, classes, request.computed);
  const voxel::Field field = voxel::compute_field(spheres, solids, request.computed);
  for (const io::WallPose& w : snapshot.frame.walls) request.walls.push_back(w.name);
  request.box = f.box;
  request.source = scene_.file;
  request.frame = due.number;
  request.step = snapshot.frame.step;
  request.time = snapshot.frame.time;
  request.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  request.version = kVersion;
  request.stem = fmt::format("{}_{:06d}", f.name, due.number);
  request.tables = request.stem;
  request.slices = f.slices;
  request.lines = f.lines;
  request.scales = f.scales;
  voxel::LayerRequest layers;
  layers.box = f.box;
  layers.box.lo.z = f.layers.z_lo, layers.box.hi.z = f.layers.z_hi;
  layers.columns = {f.layers.columns[0], f.layers.columns[1]};
  layers.periodic = request.computed.periodic;
  request.layers = layers;
  const io::FieldFilesResult files =
      io::write_field_files(folder_ / "fields", field, spheres, solids, request);
  tables_[due.field].append(
      table_row(snapshot, due.number, files.summary, voxel::layer_summary(files.layers.value())));
  if (snapshot.phase_end && figures_) {
    draw_field(f, folder_ / "figures", files, snapshot.frame, snapshot.phase);
  }
}

void FieldOutput::finish(const std::vector<PhaseSpan>& phases) {
  if (figures_) draw_series(scene_, folder_, phases);
}

}  // namespace interstice::stream
