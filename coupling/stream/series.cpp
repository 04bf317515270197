#include "coupling/stream/series.h"

#include <fmt/format.h>

#include "dem/statistics.h"

namespace interstice::stream {
namespace {

std::vector<std::size_t> watched_walls(const scene::Scene& scene) {
  std::vector<std::size_t> watched;
  for (std::size_t w = 0; w < scene.walls.size(); ++w) {
    if (scene.walls[w].watch) watched.push_back(w);
  }
  return watched;
}

std::string header_of(const scene::Scene& scene) {
  std::string line =
      "time_s,particles,particles_lost,kinetic_energy_J,contacts,coordination_mean,contact_force_mean_"
      "N,"
      "contact_force_max_N,contact_normal_force_mean_N";
  for (const std::size_t w : watched_walls(scene)) {
    for (const char* column : {"normal_force_N", "shear_force_N", "shear_force_sum_N", "contacts",
                               "particles", "contact_area_m2", "footprint_area_m2"}) {
      line += "," + scene.walls[w].name + "_" + column;
    }
  }
  if (scene.step.sleeping) line += ",particles_asleep";
  if (scene.output.energy) {
    if (scene.step.sleeping) line += ",energy_stilled_J";
    line +=
        ",energy_kinetic_J,energy_elastic_normal_J,energy_elastic_tangential_J,energy_elastic_rolling_J,"
        "heat_damping_J,heat_sliding_J,heat_rolling_J,heat_adhesion_J,energy_inserted_J,work_gravity_J,"
        "work_walls_J,energy_carried_away_J,energy_residual_J";
  }
  return line;
}

std::string energy_cells(const dem::EnergyBalance& e) {
  return fmt::format(",{},{},{},{},{},{},{},{},{},{},{},{},{}", e.kinetic, e.elastic_normal,
                     e.elastic_tangential, e.elastic_rolling, e.heat.damping, e.heat.sliding, e.heat.rolling,
                     e.heat.adhesion, e.inserted, e.gravity, e.walls, e.carried, e.residual());
}

}  // namespace

Series::Series(const std::filesystem::path& path, const scene::Scene& scene, std::optional<double> keep_until)
    : watched_(watched_walls(scene)),
      energies_(scene.output.energy),
      sleeping_(scene.step.sleeping),
      table_(path, header_of(scene), keep_until) {}

void Series::sample(const dem::Simulation& sim) {
  const dem::ContactStatistics c = dem::contact_statistics(sim);
  const dem::MotionStatistics m = dem::motion_statistics(sim);
  const double coordination =
      sim.grains() == 0 ? 0 : 2 * static_cast<double>(c.contacts) / static_cast<double>(sim.grains());
  std::string line =
      fmt::format("{},{},{},{},{},{},{},{},{}", sim.time(), sim.grains(), sim.grains_lost(), m.kinetic_energy,
                  c.contacts, coordination, c.force_mean, c.force_max, c.normal_force_mean);
  for (const std::size_t w : watched_) {
    const dem::WallStatistics s = dem::wall_statistics(sim, w);
    line += fmt::format(",{},{},{},{},{},{},{}", s.normal_force, s.shear_force, s.shear_force_sum, s.contacts,
                        s.particles, s.contact_area, s.footprint_area);
  }
  if (sleeping_) line += fmt::format(",{}", sim.grains_asleep());
  if (energies_) {
    const dem::EnergyBalance e = dem::energy_balance(sim);
    if (sleeping_) line += fmt::format(",{}", e.stilled);
    line += energy_cells(e);
  }
  table_.append(line);
}

}  // namespace interstice::stream
