// Grains moved by contact forces, step by step. Results depend on the model, the grains and the time step
// alone: not on the number of threads, the order in which grains lie in memory, or when neighbour lists were
// rebuilt.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "dem/columns.h"
#include "dem/contacts.h"
#include "dem/energy.h"
#include "dem/grains.h"
#include "dem/kernels/kernels.h"
#include "dem/model.h"
#include "dem/neighbours.h"

namespace interstice::dem {

struct SimulationOptions {
  bool reference = false;  // serial loops, neighbours by trying every pair
  double skin = 0;         // [m]; 0: chosen at every rebuild from how fast the grains are
  Precision precision = Precision::real64;
  bool energies = false;  // keep account of every grain's energy (energy.h)
};

/// Everything that a run must keep to go on with the same bits: named arrays.
struct SavedState {
  std::map<std::string, std::vector<double>> real;
  std::map<std::string, std::vector<std::int64_t>> integer;
};

class Simulation {
 public:
  /// Throws InputError when the model cannot be simulated (a periodic axis shorter than two grains is found
  /// later, when the grains are known).
  Simulation(Model model, double time_step, const SimulationOptions& options = {});

  /// Throws InputError for a grain whose numbers are not finite or whose radius is not positive.
  void add_grains(std::span<const NewGrain> grains);
  /// From the present time on [m/s].
  void set_wall_velocity(std::size_t wall, const Vec3d& velocity);

  /// Advances by whole steps; afterwards positions, velocities and contacts all belong to the present time.
  /// Throws UnstableError naming the grain when a position is no longer finite or a grain crosses half its
  /// radius in one step.
  void advance(std::int64_t steps);

  std::int64_t step() const { return step_; }
  double time() const { return static_cast<double>(step_) * dt_; }
  double time_step() const { return dt_; }
  std::size_t grains() const { return rows_.size(); }
  std::int64_t grains_added() const { return next_id_; }
  std::int64_t grains_lost() const { return lost_; }
  const Model& model() const { return model_; }
  const std::vector<Shape>& walls() const { return walls_; }
  Vec3d wall_velocity(std::size_t wall) const { return motion_of_wall_[wall].velocity; }

  void copy_columns(GrainColumns& out) const;
  SavedState save() const;
  void restore(const SavedState& state);

  /// Read access for statistics and insertion, by ascending id (see statistics.h, rain.h).
  std::span<const GrainRow> rows() const { return rows_; }
  const PairContacts& pair_contacts() const { return pair_contacts_; }
  const WallContacts& wall_contacts() const { return wall_contacts_; }
  std::vector<std::uint32_t> slots_by_id() const;
  const PairConstants<double>& constants(std::size_t material_a, std::size_t material_b) const {
    return constants_[material_a * model_.materials.size() + material_b];
  }
  /// By id; empty unless energies are kept.
  std::span<const GrainEnergy> grain_energies() const { return energies_; }
  /// Are the laws chosen at run time, for want of a kernel of their own?
  bool generic_kernel() const { return kernels_.generic; }
  SearchSpace search_space() const;
  std::int64_t rebuilds() const { return rebuilds_; }
  /// Bytes held for grains, lists and contacts.
  std::size_t bytes() const;

 private:
  struct WallMotion {
    Vec3d velocity{0, 0, 0};
    Vec3d offset{0, 0, 0};   // of the shape at `since` from the shape at time 0
    std::int64_t since = 0;  // step
  };
  /// What one block of grains reports of a pass.
  struct PassReport {
    double moved_squared = 0;  // farthest from where the list was built [m^2]
    double speed_squared = 0;
    bool left = false;         // a grain crossed an open face
    std::int64_t broken = -1;  // id of a grain whose motion is no longer sane
  };

  void check_grain(const NewGrain& grain) const;
  void place_walls();
  double wall_travel() const;
  void begin_step();
  PassReport begin_rows(std::size_t begin, std::size_t end);
  void finish_and_begin(bool begin_next);
  void take_report(const std::vector<PassReport>& reports);
  bool inside(const GrainRow& grain) const;
  void remove_leavers();
  void rebuild_if_needed();
  void rebuild();
  double choose_skin() const;
  void check_periodic_lengths() const;
  void restore_springs(const SavedState& state);
  void restore_energies(const SavedState& state);
  double attraction_reach() const;
  StepView step_view();
  void evaluate_pairs();
  void finish_row(const StepView& view, std::size_t i);
  void count_inserted_contacts();
  double inserted_on_wall(const GrainRow& grain, const WallContact& contact) const;
  void add_heat(std::size_t i, const WallTotals& walls);
  void note_leaver(std::size_t i);
  template <class Body>
  void for_rows(const Body& body) const;

  Model model_;
  double dt_;
  SimulationOptions options_;
  ForceKernels kernels_;
  std::vector<PairConstants<double>> constants_;        // materials x materials
  std::vector<PairConstants<float>> constants_single_;  // the same
  std::vector<Shape> walls_;                            // as they stand now
  std::vector<WallMotion> motion_of_wall_;
  std::vector<Vec3d> wall_velocities_;

  std::vector<GrainRow> rows_;
  std::vector<GrainMotion> motions_;
  PairContacts pair_contacts_;
  WallContacts wall_contacts_;

  std::int64_t step_ = 0;
  std::int64_t next_id_ = 0;
  std::int64_t lost_ = 0;
  std::vector<GrainEnergy> energies_;  // by id; empty unless kept
  std::int64_t counted_ids_ = 0;       // grains below have had their first step

  bool list_valid_ = false;
  bool begun_ = false;  // the step after step_ has been begun
  double skin_ = 0;
  double moved_ = 0, fastest_ = 0;
  std::vector<Shape> built_walls_;       // as they stood when the list was built
  std::vector<std::int64_t> built_ids_;  // ids by slot when the list was built
  std::int64_t rebuilds_ = 0, sorted_at_ = -1;
};

}  // namespace interstice::dem
