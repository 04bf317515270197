// A folder as `interstice run` leaves it, with numbers simple enough to know every answer by heart.
//
// Two phases: spread (0 to 10 ms) and compact (10 to 20 ms), a sample each millisecond. With strength s:
//   mean inter-particle force 1 uN * s in spread, 0.5 uN * s in compact
//   floor: normal force 6 uN * s on 3 contacts of 2 grains, 2e-9 m^2 contact circles, 5e-9 m^2 footprint;
//   shear half, its
//   magnitudes three quarters
// One field, `layer`, 4 x 3 x 2 voxels of 20 um, with a frame at the end of each phase and a line along y.
#pragma once

#include <fmt/format.h>
#include <openvdb/openvdb.h>

#include <filesystem>
#include <string>

#include "tests/coupling/figures/temporary_folder.h"
#include "voxel/metre_grid.h"

namespace interstice::fixtures {

struct SyntheticRun {
  double strength = 1;
  bool compacts = true;  // false: ends after `spread`
  double solid = 0.5;    // solid fraction of the filled half of the box (z < 20 um), at the end
  double voxel = 20e-6;  // [m]
  int shift = 0;         // of the lattice along x, in voxels
  int lost = 3;
};

inline std::string series_of(const SyntheticRun& run) {
  std::string csv =
      "time_s,particles,particles_lost,kinetic_energy_J,contacts,coordination_mean,contact_force_mean_N,"
      "contact_force_max_N,contact_normal_force_mean_N,floor_normal_force_N,floor_shear_force_N,floor_shear_"
      "force_sum_N,floor_"
      "contacts,"
      "floor_particles,floor_contact_area_m2,floor_footprint_area_m2\n";
  for (int ms = 0; ms <= (run.compacts ? 20 : 10); ++ms) {
    const double s = run.strength, force = ms <= 10 ? 1e-6 * s : 0.5e-6 * s;
    csv += fmt::format("{},100,{},1e-12,{},{},{},{},{},{},{},{},3,2,2e-9,5e-9\n", ms * 1e-3, run.lost, 200, 4,
                       force, force * 10 + ms * 1e-9, force * 0.75, 6e-6 * s, 3e-6 * s, 4.5e-6 * s);
  }
  return csv;
}

inline void write_vdb(const std::filesystem::path& path, const SyntheticRun& run, double solid) {
  openvdb::initialize();
  openvdb::GridPtrVec grids;
  for (const char* name : {"solid_fraction", "void_fraction"}) {
    const bool is_solid = name[0] == 's';
    const openvdb::FloatGrid::Ptr grid = std::make_shared<voxel::MetreGrid>(is_solid ? 0.0F : 1.0F);
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 3; ++j) {
        grid->tree().setValue({i, j, 0}, static_cast<float>(is_solid ? solid : 1 - solid));
      }
    }
    grid->setName(name);
    const double x = run.shift * run.voxel;
    voxel::Lattice lattice;
    lattice.lo = {x, 0, 0};
    lattice.h = {run.voxel, run.voxel, run.voxel};
    lattice.n = {4, 3, 2};
    grid->setTransform(voxel::cell_transform(lattice));
    grid->insertMeta("box", openvdb::StringMetadata(fmt::format("{},{},0,{},0,{}", x, x + 4 * run.voxel,
                                                                3 * run.voxel, 2 * run.voxel)));
    grids.push_back(grid);
  }
  openvdb::io::File file(path.string());
  file.write(grids);
  file.close();
}

inline std::string voxel_row(double x, double y, double z, double empty) {
  return fmt::format("{},{},{},{},{},nan\n", x, y, z, empty, 1 - empty);
}

inline void write_moment(const std::filesystem::path& fields, const std::string& stem,
                         const SyntheticRun& run, double solid) {
  const auto folder = fields / stem;
  const double h = run.voxel;
  const std::string head = "x_m,y_m,z_m,void_fraction,solid_fraction,mass_density_kg_m3\n";
  std::string slice = head, line = head;
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 2; ++k)
      slice += voxel_row(5e-5, (j + 0.5) * h, (k + 0.5) * h, k == 0 ? 1 - solid : 1);
    // on the line: solid, solid, empty
    line += voxel_row(5e-5, (j + 0.5) * h, 0.5 * h, j < 2 ? 1 - solid : 1);
  }
  write(folder / "slices" / "x=5e-05.csv", slice);
  write(folder / "lines" / "y@x=5e-05,z=1e-05.csv", line);
  for (const char* axis : {"x", "y"}) {
    write(folder / fmt::format("profile_{}.csv", axis),
          fmt::format("{1}_m,solid_fraction,solid_height_m,surface_height_m,solid_fraction_below_surface\n"
                      "1e-5,{0},1e-5,2e-5,0.5\n3e-5,{0},1e-5,2e-5,0.5\n",
                      solid, axis));
  }
  write(folder / "summary.json", R"({"voxel_m": 2e-5, "method": "exact", "average_m": null})");
  write_vdb(fields / (stem + ".vdb"), run, solid);
}

inline void write_run(const std::filesystem::path& folder, const SyntheticRun& run) {
  std::string phases = R"({"name": "spread", "start_s": 0, "end_s": 0.01})";
  if (run.compacts) phases += R"(, {"name": "compact", "start_s": 0.01, "end_s": 0.02})";
  write(folder / "run.json",
        fmt::format(R"({{"title": "made up", "exit_reason": "done", "grains_inserted": 100,
    "grains_lost": {}, "phases": [{}]}})",
                    run.lost, phases));
  write(folder / "series.csv", series_of(run));
  const auto row = [](int frame, double time, const char* phase, double solid) {
    return fmt::format("{},{},{},{},{},{},{},0.0625,{},3e-05,{}\n", frame, time, phase, solid / 2,
                       1 - solid / 2, 1 - solid, solid, 40e-6 * solid, solid / 1.5);
  };
  std::string table =
      "frame,time_s,phase,solid_fraction_mean,void_fraction_mean,void_fraction_min,solid_fraction_gap,"
      "solid_fraction_sd,solid_height_m,surface_height_m,solid_fraction_below_surface\n";
  table += row(7, 0.01, "spread", 0.25);
  write_moment(folder / "fields", "layer_000007", run, 0.25);
  if (run.compacts) {
    table += row(12, 0.02, "compact", run.solid);
    write_moment(folder / "fields", "layer_000012", run, run.solid);
  }
  write(folder / "fields" / "layer.csv", table);
}

}  // namespace interstice::fixtures
