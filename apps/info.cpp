// interstice info FILE: what is in a file.
#include <fmt/format.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "base/error.h"
#include "coupling/io/edem_hdf5_reader.h"
#include "coupling/io/particle_reader.h"
#include "coupling/io/state_file.h"
#include "coupling/scene/read_scene.h"

namespace interstice::apps {
namespace {

using Json = nlohmann::ordered_json;

Json vdb_info(const std::string& path) {
  openvdb::initialize();
  Json j;
  j["kind"] = "OpenVDB";
  try {
    openvdb::io::File file(path);
    file.open();
    for (auto it = file.beginName(); it != file.endName(); ++it) {
      const auto grid = file.readGrid(it.gridName());
      Json g;
      g["name"] = it.gridName();
      g["type"] = grid->type();
      g["active_voxels"] = grid->activeVoxelCount();
      g["voxel_m"] = grid->voxelSize().x();
      for (auto m = grid->beginMeta(); m != grid->endMeta(); ++m) g["metadata"][m->first] = m->second->str();
      j["grids"].push_back(g);
    }
  } catch (const openvdb::Exception& e) {
    throw InputError(path + ": not a readable OpenVDB file (" + e.what() + "); give a whole .vdb file");
  }
  return j;
}

Json particles_info(const std::string& path) {
  const auto reader = io::open_particles(path, {});
  Json j;
  j["kind"] = reader->kind();
  std::int64_t frames = 0;
  io::ParticleFrame frame, last;
  double first_time = NAN;
  while (reader->next(frame)) {
    if (frames++ == 0) first_time = frame.time;
    std::swap(frame, last);
  }
  j["frames"] = frames;
  if (frames == 0) return j;
  if (std::isfinite(last.time)) j["time_s"] = {first_time, last.time};
  j["particles_last_frame"] = last.size();
  if (last.size() > 0) {
    const auto [lo, hi] = std::minmax_element(last.radius.begin(), last.radius.end());
    j["diameter_m"] = {2 * *lo, 2 * *hi};
    for (const auto& [name, column] : {std::pair{"x_m", &last.x}, {"y_m", &last.y}, {"z_m", &last.z}}) {
      const auto [least, most] = std::minmax_element(column->begin(), column->end());
      j[name] = {*least, *most};
    }
  }
  for (const auto& w : last.walls) j["walls"].push_back(w.name);
  return j;
}

Json scene_info(const std::string& path) {
  const scene::Scene s = scene::read_scene(path);
  Json j;
  j["kind"] = "scene";
  j["title"] = s.title;
  for (const auto& p : s.particles) j["particles"].push_back(p.name);
  for (const auto& w : s.walls) j["walls"].push_back(w.name);
  for (const auto& p : s.phases) j["phases"].push_back(p.name);
  for (const auto& f : s.fields) j["fields"].push_back(f.name);
  return j;
}

Json checkpoint_info(const std::string& path) {
  const io::State s = io::read_state(path);
  Json j;
  j["kind"] = "checkpoint";
  for (const auto& [name, values] : s.real) j["real"][name] = values.size();
  for (const auto& [name, values] : s.integer) j["integer"][name] = values.size();
  return j;
}

void info(const std::string& path, bool json) {
  if (!std::filesystem::exists(path)) throw InputError(path + ": no such file; check the name");
  const std::string extension = std::filesystem::path(path).extension().string();
  const Json j = extension == ".vdb"                                     ? vdb_info(path)
                 : extension == ".toml"                                  ? scene_info(path)
                 : extension == ".h5" && !io::looks_like_edem_hdf5(path) ? checkpoint_info(path)
                                                                         : particles_info(path);
  if (json) {
    fmt::print("{}\n", j.dump(2));
    return;
  }
  for (const auto& [key, value] : j.items()) {
    fmt::print("{:<22} {}\n", key, value.is_string() ? value.get<std::string>() : value.dump());
  }
}

}  // namespace

void add_info(CLI::App& root) {
  struct Arguments {
    std::string file;
    bool json = false;
  };
  auto a = std::make_shared<Arguments>();
  CLI::App* c =
      root.add_subcommand("info", "what is in a file (particles, trajectory, .vdb, scene, checkpoint)");
  c->add_option("file", a->file, "the file")->required();
  c->add_flag("--json", a->json, "print one JSON object");
  c->callback([a] { info(a->file, a->json); });
}

}  // namespace interstice::apps
