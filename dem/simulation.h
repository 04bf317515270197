// Grains moved by contact forces, step by step. Results depend on the model, the grains and the time step
// alone: not on the number of threads, the order in which grains lie in memory, or when neighbour lists were
// rebuilt.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/parallel.h"
#include "dem/columns.h"
#include "dem/contacts.h"
#include "dem/energy.h"
#include "dem/grain_motion.h"
#include "dem/grain_store.h"
#include "dem/kernels/kernels.h"
#include "dem/model.h"
#include "dem/neighbours.h"
#include "dem/rates.h"
#include "dem/reals.h"
#include "dem/sleepers.h"
#include "dem/wall_contacts.h"

namespace interstice::dem {

struct SimulationOptions {
  bool reference = false;  // serial loops, neighbours by trying every pair
  double skin = 0;         // [m]; 0: chosen for each grain from how fast it is
  Precision precision = Precision::real64;
  bool energies = false;  // keep account of every grain's energy (energy.h)
  /// Grains at rest sleep (sleepers.h), and wake when forces on them are out of balance by this share of
  /// their weight; 0: none sleeps.
  double sleep_tolerance = 0;
  /// Small grains take shorter steps (rates.h).
  Rates rates{};
};

/// Everything that a run must keep to go on with the same bits: named arrays.
struct SavedState {
  std::map<std::string, std::vector<double>> real;
  std::map<std::string, std::vector<std::int64_t>> integer;
};

class Simulation {
 public:
  /// Throws InputError when the model cannot be simulated (a periodic axis shorter than two grains is found
  /// later, when the grains are known), grains cannot sleep in it, or options exclude each other.
  Simulation(Model model, double time_step, const SimulationOptions& options = {});

  /// Throws InputError for a grain whose numbers are not finite or whose radius is not positive.
  void add_grains(std::span<const NewGrain> grains);
  /// From the present time on [m/s]. A change wakes all grains.
  void set_wall_velocity(std::size_t wall, const Vec3d& velocity);

  /// Advances by whole steps; afterwards positions, velocities and contacts all belong to the present time.
  /// Throws UnstableError naming the grain when a position is no longer finite or a grain crosses half its
  /// radius in one step.
  void advance(std::int64_t steps);

  std::int64_t step() const { return step_; }
  double time() const { return static_cast<double>(step_) * dt_; }
  double time_step() const { return dt_; }
  /// The step that a grain of this radius takes [s].
  double step_of(double radius) const {
    return options_.rates.two() && options_.rates.is_quick(radius) ? beat_ : dt_;
  }
  std::size_t grains() const { return grains_.size(); }
  std::size_t grains_asleep() const;
  std::int64_t grains_added() const { return next_id_; }
  std::int64_t grains_lost() const { return lost_; }
  const Model& model() const { return model_; }
  const std::vector<Shape>& walls() const { return walls_; }
  Vec3d wall_velocity(std::size_t wall) const { return motion_of_wall_[wall].velocity; }

  void copy_columns(GrainColumns& out) const;
  SavedState save() const;
  void restore(const SavedState& state);

  /// Read access for statistics and insertion (see statistics.h, rain.h).
  GrainRow row(std::size_t slot) const { return grains_.row(slot); }
  GrainSite site(std::size_t slot) const { return grains_.site(slot); }
  std::vector<GrainRow> rows() const;
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
  /// Accelerations of a group by what acts in whole steps.
  struct alignas(64) GroupPull {
    double linear[3][kLanes], angular[3][kLanes];
  };
  /// A group's present motion, and accelerations by what acts in beats and in whole steps.
  struct RatedState {
    Vec3<Each> velocity, spin, quick, quick_angular, slow, slow_angular;
  };
  /// What one block of grains reports of a pass.
  struct PassReport {
    bool strayed = false;      // a grain used up its short reach
    bool left = false;         // a grain crossed an open face
    std::int64_t broken = -1;  // id of a grain whose motion is no longer sane
  };

  void check_grain(const NewGrain& grain) const;
  RestRule rest_rule() const;
  void place_walls(int beat = 0);
  double wall_travel() const;
  void begin_step();
  template <class Body>
  void for_blocks(const Blocks& blocks, const Body& body) const;
  template <class Work>
  void for_parts(const Work& work) const;
  void look_at_moved(const GroupStep& moved, std::size_t group, std::uint32_t lanes, PassReport& report);
  template <class Real>
  void look_for_leavers(PairRow<Real>* rows, const GroupStep& moved, std::size_t group, std::uint32_t lanes,
                        PassReport& report);
  template <class Real>
  void begin_group(PairRow<Real>* rows, std::size_t group, const GroupState& now, PassReport& report);
  void end_group(std::size_t group, const Vec3<Each>& velocity, const Vec3<Each>& spin,
                 const Pull& acceleration);
  template <bool kSleep, bool kBeginNext, class Real>
  PassReport move_rows(PairRow<Real>* rows, const StepView& view, std::size_t begin, std::size_t end);
  void evaluate_and_move(bool begin_next);
  template <bool kSleep, class Real>
  void evaluate_and_move(PairRow<Real>* rows, bool begin_next);
  template <class Real>
  bool wrap_or_leave(PairRow<Real>& row, GrainLabel& label) const;
  void evaluate_and_move_rated(bool begin_next);
  template <class Real>
  void evaluate_and_move_rated(PairRow<Real>* rows, bool begin_next);
  template <bool kBeginNext, class Real>
  PassReport move_rows_rated(PairRow<Real>* rows, const StepView& view, std::size_t begin, std::size_t end);
  template <class Real>
  void begin_group_rated(PairRow<Real>* rows, std::size_t group, const RatedState& now, PassReport& report);
  void finish_beats();
  template <class Real>
  void work_on_beat(PairRow<Real>* rows, bool last);
  template <class Real>
  void beat_group(PairRow<Real>* rows, const StepView& view, std::size_t group, bool last,
                  PassReport& report);
  StepView beat_view(const PairView& pairs);
  void note_quick_slots(const std::vector<GrainSite>& sites);
  void put_beating_first(std::vector<std::uint32_t>& order) const;
  double reserve() const;
  void take_report(const std::vector<PassReport>& reports);
  bool inside(const Vec3d& position) const;
  void remove_leavers();
  void drop_from_lists(const std::vector<std::uint32_t>& kept);
  double near_reach(double speed, bool pushed) const;
  double speed_of(std::size_t slot) const;
  double candidate_reach_left(std::size_t slot) const;
  double candidate_reach_of(std::size_t slot, bool pushed) const;
  double fastest_wall() const;
  double near_reach_of_walls() const;
  bool candidates_last() const;
  void update_lists();
  void rebuild();
  void note_ids();
  void note_materials();
  double longest_reach(double largest) const;
  void find_candidates(const std::vector<GrainSite>& sites, double longest);
  void sort_grains(std::vector<GrainSite>& sites);
  void refresh(const std::vector<std::uint32_t>& old_slot, const std::vector<GrainSite>& sites);
  Parts parts() const;
  std::size_t farthest_in_part() const;
  void restore_springs(const SavedState& state);
  void restore_energies(const SavedState& state);
  void restore_rests(const SavedState& state);
  void restore_slow_accelerations(const SavedState& state);
  double attraction_reach(double largest) const;
  StepView step_view(const PairView& pairs);
  void count_inserted_contacts();
  double inserted_on_wall(const GrainRow& grain, const WallContact& contact) const;
  template <class Real>
  MemoryAhead rows_ahead(const PairRow<Real>* rows, std::size_t block, bool last) const;
  void add_lifting(std::size_t first, const Vec3<Each>& step);
  void add_heat(std::size_t group);
  void add_heat_of(std::size_t slot);
  std::size_t id_of(std::size_t slot) const { return static_cast<std::size_t>(grains_.labels()[slot].id); }
  void note_leaver(std::size_t i);
  void wake_all();
  void put_awake_first(std::vector<std::uint32_t>& order) const;
  std::vector<bool> moving_walls() const;
  void tend_sleepers();
  void fall_asleep();
  bool is_frozen(std::size_t slot, std::size_t wall) const;
  bool spares(std::size_t begin, std::size_t end) const;
  bool is_needed(std::size_t group) const { return watch_all_ || sleepers_.needed(group, looks_); }
  template <class Real>
  void evaluate_frozen(const StepView& view, std::size_t group);
  bool is_left_out(std::size_t slot) const;
  template <class Real>
  void evaluate_needed(const StepView& view, std::size_t begin, std::size_t end, const MemoryAhead& ahead);
  template <class Real>
  void evaluate_needed_walls(const StepView& view, std::size_t begin, std::size_t end);
  template <class Real>
  void wake_disturbed(const PairRow<Real>* rows, std::size_t group, std::uint32_t watched,
                      const Vec3<Each>& torque, const GroupState& now);
  template <class Real>
  void count_rest(const PairRow<Real>* rows, std::size_t group, const GroupState& now);
  template <class Real>
  void judge_rest(const PairRow<Real>* rows, std::size_t group, const Vec3<Each>& torque, GroupState& now);

  Model model_;
  double dt_;
  SimulationOptions options_;
  double beat_;  // the step of quick grains [s]
  ForceKernels kernels_;
  std::vector<PairConstants<double>> constants_;        // materials x materials
  std::vector<PairConstants<float>> constants_single_;  // the same
  std::vector<Shape> walls_;                            // as they stand now
  std::vector<WallMotion> motion_of_wall_;
  std::vector<Vec3d> wall_velocities_;

  GrainStore grains_;
  std::int64_t only_material_ = -1;  // of all grains when the list was built; -1 where they differ
  PairContacts pair_contacts_;
  WallContacts wall_contacts_;

  std::int64_t step_ = 0;
  std::int64_t next_id_ = 0;
  std::int64_t lost_ = 0;
  std::vector<GrainEnergy> energies_;  // by id; empty unless kept
  std::int64_t counted_ids_ = 0;       // grains below have had their first step

  std::optional<RestRule> rest_;  // where grains may sleep
  Sleepers sleepers_;
  bool survey_due_ = true;  // who sleeps or the lists have changed
  bool doubt_ = true;       // sleepers may have lost a contact: the next step looks at all
  std::size_t turned_ = 0;  // how many fell asleep or woke since grains were last put in order
  bool looks_ = false;      // this step looks at those watched
  bool watch_all_ = false;  // this step works on all

  QuickSlots quick_;             // with two rates
  std::vector<GroupPull> slow_;  // by group of slots: what moves grains by whole steps
  bool left_ = false;            // a grain has left, and is still there

  bool list_valid_ = false;
  bool begun_ = false;                  // the step after step_ has been begun
  double mean_diameter_ = 0;            // when the list was built [m]
  double attraction_ = 0;               // how far bodies attract each other [m]
  std::vector<PairRef> candidates_;     // whose long reaches meet
  std::vector<float> reach_;            // by slot: how far from where the list was built candidates last [m]
  LargeVector<float> path_left_;        // by slot, up to whole groups: what is left of the short reaches [m]
  bool strayed_ = false;                // a grain has used up its short reach
  double reach_of_walls_ = 0;           // the same for walls [m]
  std::vector<Shape> refreshed_walls_;  // as they stood when walls near grains were listed
  std::vector<std::uint32_t> built_ids_;  // by slot when the list was built; slots may have changed since
  std::vector<std::uint32_t> stood_at_;   // by slot, where grains left: the slot in the list of pairs
  std::int64_t rebuilds_ = 0, sorted_at_ = -1;
};

}  // namespace interstice::dem
