#include "coupling/io/field_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "coupling/io/atomic_file.h"
#include "coupling/io/field_tables.h"
#include "coupling/io/vdb_file.h"
#include "coupling/io/vti_file.h"
#include "voxel/methods.h"

namespace interstice::io {
namespace {

using Json = nlohmann::ordered_json;

Json or_null(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

double relative_error(double value, double truth) {
  return truth != 0 ? std::abs(value - truth) / std::abs(truth) : std::abs(value);
}

Json box_of(const Box& b) { return Json::array({b.lo.x, b.hi.x, b.lo.y, b.hi.y, b.lo.z, b.hi.z}); }

// Void fraction along a line, clear of walls: the numbers one compares runs by.
Json line_summary(const std::string& name, const voxel::Samples& line) {
  Json json{{"name", name}};
  const auto add = [&](const char* key, std::vector<double> v) {
    std::erase_if(v, [](double value) { return std::isnan(value); });
    if (v.empty()) return;
    json[std::string(key) + "_min"] = *std::min_element(v.begin(), v.end());
    json[std::string(key) + "_max"] = *std::max_element(v.begin(), v.end());
    json[std::string(key) + "_mean"] =
        std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  add("void_fraction", voxel::clear_of_walls(line));
  add("void_fraction_averaged", voxel::outside_walls(line, line.void_fraction_averaged));
  return json;
}

void add_origin(Json& json, const voxel::Field& field, std::size_t spheres,
                const FieldFilesRequest& request) {
  const auto& lattice = field.lattice;
  const Box covered = lattice.box();
  json["source"] = request.source;
  json["kind"] = request.kind;
  json["frame"] = request.frame >= 0 ? Json(request.frame) : Json(nullptr);
  json["step"] = request.step >= 0 ? Json(request.step) : Json(nullptr);
  json["time_s"] = or_null(request.time);
  json["particles"] = field.sums.particles;
  json["particles_in_file"] = spheres;
  json["voxel_m"] = lattice.h.x;
  json["box_m"] = box_of(covered);
  json["box_asked_m"] = box_of(request.box);
  const Vec3d more = covered.hi - request.box.hi;
  const double slack = 1e-6 * lattice.h.x;
  json["box_extended"] = more.x > slack || more.y > slack || more.z > slack;
  json["shape"] = lattice.n;
  json["method"] = name_of(request.computed);
  json["overlap"] = request.computed.overlap == voxel::Overlap::united ? "union" : "sum";
  json["periodic"] = request.computed.periodic;
  json["walls"] = request.walls;
  json["average_m"] =
      request.computed.average_length > 0 ? Json(request.computed.average_length) : Json(nullptr);
  json["average_window"] =
      request.computed.average_length > 0 ? Json(name_of(request.computed.average_window)) : Json(nullptr);
}

void add_sums(Json& json, const voxel::Field& field, bool mass_known) {
  const auto& sums = field.sums;
  const double available = sums.available_volume;
  const double solid = available > 0 ? sums.solid_volume_field / available : 0;
  json["solid_volume_particles_m3"] = sums.solid_volume_particles;
  json["solid_volume_field_m3"] = sums.solid_volume_field;
  json["available_volume_m3"] = available;
  json["mass_kg"] = mass_known ? Json(sums.mass) : Json(nullptr);
  json["overlap_volume_m3"] = sums.overlap_volume;
  json["deleted_volume_m3"] = sums.deleted_volume;
  json["relative_conservation_error"] =
      relative_error(sums.solid_volume_field, sums.solid_volume_particles - sums.overlap_volume);
  json["written_conservation_error"] = relative_error(sums.written_solid_volume, sums.solid_volume_field);
  json["solid_fraction_mean"] = solid;
  json["void_fraction_mean"] = 1 - solid;
  json["void_fraction_min"] = sums.void_min;
  json["void_fraction_max"] = sums.void_max;
  json["negative_voxels"] = sums.negative_voxels;
}

// Means over the solid in the box; of what is per volume, over all that walls leave of it.
void add_quantities(Json& json, const voxel::Field& field) {
  for (const auto& q : field.quantities) {
    if (q.name != "bonded_mask") json[column_name(q.full_name() + "_mean", q.units)] = or_null(q.mean);
  }
}

void add_layers(Json& json, const FieldFilesRequest& request,
                const std::optional<voxel::LayerColumns>& columns) {
  if (!columns) {
    json["layer_mean"] = nullptr;
    json["layer_sd"] = nullptr;
    return;
  }
  const voxel::LayerSummary layer = voxel::layer_summary(*columns);
  json["layer_m"] = Json::array({request.layers->box.lo.z, request.layers->box.hi.z});
  json["layer_columns"] = columns->columns;
  json["layer_mean"] = layer.solid_fraction_gap;
  json["layer_sd"] = or_null(layer.solid_fraction_sd);
  json["solid_height_m"] = layer.solid_height;
  json["surface_height_m"] = layer.surface_height;
  json["solid_fraction_below_surface"] = layer.solid_fraction_below_surface;
}

Json scales_of(const voxel::ScaleReport& report) {
  return {{"window", name_of(report.window)},
          {"grain_volume_m3", report.grain_volume},
          {"median_diameter_m", report.median_diameter},
          {"random_length_m", or_null(report.random_length)},
          {"many_grains_length_m", or_null(report.many_grains_length)},
          {"lengths", report.rows.size()}};
}

// Sentences about what is not as it would be by default.
std::vector<std::string> remarks_of(const voxel::Field& field, const FieldFilesRequest& request,
                                    const FieldFilesResult& result) {
  std::vector<std::string> remarks;
  const auto& sums = field.sums;
  const double percent = sums.solid_volume_particles > 0 ? 100 / sums.solid_volume_particles : 0;
  if (request.computed.least_void > 0)
    remarks.push_back(fmt::format("the least void fraction of {} deleted {:.4g} m^3 of solid, {:.3g} % of it",
                                  request.computed.least_void, sums.deleted_volume,
                                  percent * sums.deleted_volume));
  if (request.computed.overlap == voxel::Overlap::united)
    remarks.push_back(
        fmt::format("places that spheres share count once: {:.4g} m^3, {:.3g} % of the solid, taken off",
                    sums.overlap_volume, percent * sums.overlap_volume));
  if (result.scales) remarks.push_back(sentence_of(*result.scales));
  return remarks;
}

Json summary_of(const voxel::Field& field, std::size_t spheres, const FieldFilesRequest& request,
                const FieldFilesResult& result) {
  Json json;
  add_origin(json, field, spheres, request);
  add_sums(json, field, field.mass_density != nullptr);
  add_quantities(json, field);
  add_layers(json, request, result.layers);
  json["lines"] = Json::array();
  for (std::size_t i = 0; i < request.lines.size(); ++i) {
    json["lines"].push_back(line_summary(name_of(request.lines[i]), result.lines[i]));
  }
  json["scales"] = result.scales ? scales_of(*result.scales) : Json(nullptr);
  json["messages"] = result.messages;
  json["seconds"] = request.seconds;
  json["version"] = request.version;
  return json;
}

// Slices, lines and layers in memory: what the request asks for and the field does not hold shows here.
void take_samples(const voxel::Field& field, const voxel::SpheresView& spheres, const voxel::Solids& solids,
                  const FieldFilesRequest& request, FieldFilesResult& result) {
  for (const auto& slice : request.slices)
    result.slices.push_back(voxel::sample_slice(field, slice.axis, slice.at));
  for (const auto& line : request.lines)
    result.lines.push_back(voxel::sample_line(field, line.axis, line.at));
  if (request.layers) result.layers = voxel::layer_columns(spheres, solids, *request.layers);
  if (request.scales)
    result.scales =
        voxel::void_scales(field, spheres, request.computed.periodic, request.computed.average_window);
}

void write_tables(const std::filesystem::path& folder, const FieldFilesRequest& request,
                  FieldFilesResult& result) {
  const auto write = [&](const std::filesystem::path& path, const std::string& text) {
    write_text_atomically(path, text);
    result.written.push_back(path);
  };
  const auto make = [](const std::filesystem::path& path) {
    std::error_code error;
    std::filesystem::create_directories(path, error);
    if (error) throw RunError(fmt::format("cannot make folder {}: {}", path.string(), error.message()));
    return path;
  };
  make(folder);
  for (std::size_t i = 0; i < request.slices.size(); ++i) {
    write(make(folder / "slices") / (name_of(request.slices[i]) + ".csv"), csv_of(result.slices[i]));
  }
  for (std::size_t i = 0; i < request.lines.size(); ++i) {
    write(make(folder / "lines") / (name_of(request.lines[i]) + ".csv"), csv_of(result.lines[i]));
  }
  if (result.layers) {
    write(folder / "layers.csv", csv_of(*result.layers));
    write(folder / "profile_x.csv", csv_of(voxel::layer_profile(*result.layers, 0), 0));
    write(folder / "profile_y.csv", csv_of(voxel::layer_profile(*result.layers, 1), 1));
  }
  if (result.scales) write(folder / "scales.csv", csv_of(*result.scales));
  write(folder / "summary.json", result.summary.dump(2) + "\n");
}

}  // namespace

std::string name_of(const voxel::FieldRequest& computed) { return voxel::method_name(computed); }

std::string name_of(const scene::Slice& slice) { return fmt::format("{}={}", "xyz"[slice.axis], slice.at); }

std::string name_of(const scene::Line& line) {
  const int a = line.axis == 0 ? 1 : 0, b = line.axis == 2 ? 1 : 2;
  return fmt::format("{}@{}={},{}={}", "xyz"[line.axis], "xyz"[a], line.at[a], "xyz"[b], line.at[b]);
}

FieldFilesResult write_field_files(const std::filesystem::path& folder, const voxel::Field& field,
                                   const voxel::SpheresView& spheres, const voxel::Solids& solids,
                                   const FieldFilesRequest& request) {
  FieldFilesResult result;
  take_samples(field, spheres, solids, request, result);
  const bool image = request.vti && field.lattice.cells() <= request.vti_most_cells;
  if (request.vti && !image) {
    result.messages.push_back(
        fmt::format("{}.vti left out: {} cells, more than {}; slices and {}.vdb hold the field", request.stem,
                    field.lattice.cells(), request.vti_most_cells, request.stem));
  }
  for (auto& remark : remarks_of(field, request, result)) result.messages.push_back(std::move(remark));
  result.summary = summary_of(field, spheres.count, request, result);

  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw RunError(fmt::format("cannot make folder {}: {}", folder.string(), error.message()));
  if (request.vdb) {
    result.written.push_back(folder / (request.stem + ".vdb"));
    write_vdb(result.written.back(), field, request);
  }
  if (image) {
    result.written.push_back(folder / (request.stem + ".vti"));
    write_vti(result.written.back(), field, request.time);
  }
  write_tables(folder / request.tables, request, result);  // the summary last: with it, the set is whole
  return result;
}

}  // namespace interstice::io
