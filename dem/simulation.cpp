#include "dem/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"

namespace interstice::dem {
namespace {

/// Ids and slots are kept in 32 bits, of which one number means none.
constexpr std::int64_t kMostGrains = PairContacts::kNoSlot;

/// Grains that crossed an open face are taken away every so many steps: each time the lists of the others are
/// made anew.
constexpr std::int64_t kStepsPerFarewell = 64;

Vec3d offset_at(const Vec3d& offset, const Vec3d& velocity, double steps, double dt) {
  return offset + (steps * dt) * velocity;
}

void check_rates(const SimulationOptions& options) {
  const Rates& r = options.rates;
  if (r.beats < 1 || !(r.quick_below >= 0))
    throw InputError("two rates: there must be at least one beat a step, and the limit a radius in metres");
  if (r.two() && options.energies)
    throw InputError("two rates of steps: energies cannot be kept; give all grains the same step");
  if (r.two() && options.sleep_tolerance > 0)
    throw InputError("two rates of steps: grains cannot sleep; choose one of the two");
}

/// None, where all grains take the same step.
Rates used_rates(const SimulationOptions& options) { return options.rates.two() ? options.rates : Rates{}; }

KeptMemories kept_memories(const Laws& laws, const SimulationOptions& options) {
  return {keeps_spring(laws), keeps_rolling_spring(laws), options.energies};
}

}  // namespace

Simulation::Simulation(Model model, double time_step, const SimulationOptions& options)
    : model_(std::move(model)),
      dt_(time_step),
      options_(options),
      beat_(time_step / std::max(1, options.rates.beats)),
      kernels_(find_kernels(model_.laws, options.precision, options.energies)),
      motion_of_wall_(model_.walls.size()),
      wall_velocities_(model_.walls.size()),
      grains_(options.precision, options.sleep_tolerance > 0, options.rates.two()),
      pair_contacts_(kept_memories(model_.laws, options), options.precision, used_rates(options)),
      wall_contacts_(kept_memories(model_.laws, options), options.precision, used_rates(options)) {
  check_rates(options_);
  if (!(dt_ > 0) || !std::isfinite(dt_)) throw InputError("time step: must be positive and finite");
  for (std::size_t a = 0; a < model_.materials.size(); ++a) {
    for (std::size_t b = 0; b < model_.materials.size(); ++b) {
      constants_.push_back(model_.constants(a, b));
      constants_single_.push_back(constants_.back().as<float>());
    }
  }
  walls_.resize(model_.walls.size());
  place_walls();
  if (options_.sleep_tolerance != 0) rest_ = rest_rule();
}

RestRule Simulation::rest_rule() const {
  const double gravity = norm(model_.gravity), tolerance = options_.sleep_tolerance;
  if (!(tolerance > 0 && tolerance <= RestRule::kLargestTolerance))
    throw InputError("sleep tolerance: " + std::to_string(tolerance) +
                     " is not a small share of a grain's weight; allowed: above 0, at most 0.1");
  if (!(gravity > 0))
    throw InputError(
        "sleeping grains: without gravity there is no weight to judge rest by; give gravity, or let no grain "
        "sleep");
  return {tolerance, gravity, dt_};
}

/// The engine's own guard, whatever made the grain: nothing that is no number reaches a kernel.
void Simulation::check_grain(const NewGrain& g) const {
  const auto finite = [](const Vec3d& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
  if (next_id_ >= kMostGrains)
    throw InputError(
        "more than 4,294,967,295 grains, those that left included; start from the grains that are left");
  const std::string who = "grain " + std::to_string(next_id_) + ": ";
  if (!finite(g.position) || !finite(g.velocity) || !finite(g.spin))
    throw InputError(who + "its place or motion is not finite; give finite numbers");
  if (!(std::isfinite(g.radius) && g.radius > 0))
    throw InputError(who + "its radius is not finite and positive; give a radius in metres");
  if (g.material >= model_.materials.size() || !(model_.materials[g.material].density > 0))
    throw InputError(who + "its material is unknown or has no density; give one of the model's materials");
}

void Simulation::add_grains(std::span<const NewGrain> grains) {
  for (const NewGrain& g : grains) {
    check_grain(g);
    const double mass =
        4.0 / 3.0 * M_PI * g.radius * g.radius * g.radius * model_.materials[g.material].density;
    const GrainRow row{g.position.x, g.position.y, g.position.z, g.radius,  g.velocity.x,
                       g.velocity.y, g.velocity.z, mass,         g.spin.x,  g.spin.y,
                       g.spin.z,     next_id_++,   g.layer,      g.material};
    // The first step's acceleration is gravity alone: exact for a grain in flight, first order for one in
    // contact.
    const Vec3d none{0, 0, 0};
    if (options_.rates.two() && !options_.rates.is_quick(g.radius)) {
      grains_.add(row, {none, none}, {model_.gravity, none});
    } else {
      grains_.add(row, {model_.gravity, none});
    }
    if (options_.energies) energies_.emplace_back().inserted = kinetic_energy(row);
  }
  list_valid_ = list_valid_ && grains.empty();
}

void Simulation::set_wall_velocity(std::size_t wall, const Vec3d& velocity) {
  WallMotion& m = motion_of_wall_[wall];
  m.offset = offset_at(m.offset, m.velocity, static_cast<double>(step_ - m.since), dt_);
  m.since = step_;
  if (!(m.velocity == velocity)) wake_all();
  m.velocity = velocity;
  wall_velocities_[wall] = velocity;
}

/// Where they are at the present step, or so many beats after it.
void Simulation::place_walls(int beat) {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const WallMotion& m = motion_of_wall_[w];
    const double steps =
        static_cast<double>(step_ - m.since) + static_cast<double>(beat) / options_.rates.beats;
    walls_[w] = translated(model_.walls[w].shape, offset_at(m.offset, m.velocity, steps, dt_));
  }
}

void Simulation::advance(std::int64_t steps) {
  for (std::int64_t s = 0; s < steps; ++s) {
    const bool two_rates = options_.rates.two();
    if (!begun_) begin_step();
    if (two_rates) finish_beats();
    ++step_;
    begun_ = false;
    place_walls();
    update_lists();
    if (rest_) tend_sleepers();
    if (two_rates) {
      evaluate_and_move_rated(s + 1 < steps);
    } else {
      evaluate_and_move(s + 1 < steps);
    }
  }
}

std::vector<GrainRow> Simulation::rows() const {
  std::vector<GrainRow> all;
  all.reserve(grains_.size());
  for (std::size_t s = 0; s < grains_.size(); ++s) all.push_back(grains_.row(s));
  return all;
}

void Simulation::take_report(const std::vector<PassReport>& reports) {
  bool left = false;
  for (const PassReport& r : reports) {
    strayed_ = strayed_ || r.strayed;
    left = left || r.left;
    if (r.broken >= 0) {
      throw UnstableError(
          "grain " + std::to_string(r.broken) + " crossed half its radius in one step (step " +
          std::to_string(step_ + 1) + ", t = " + std::to_string(time()) +
          " s): the time step is too large for these contacts or speeds; use a smaller [time] step");
    }
  }
  begun_ = true;
  grains_.set_stepping(true);
  left_ = left_ || left;
  if (!options_.rates.two()) remove_leavers();
}

bool Simulation::inside(const Vec3d& position) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (model_.boundary[axis] != AxisBoundary::open) continue;
    const double p = position[axis];
    if (!(p >= model_.domain.lo[axis] && p < model_.domain.hi[axis])) return false;
  }
  return true;
}

void Simulation::remove_leavers() {
  if (!left_ || step_ % kStepsPerFarewell != 0) return;
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < grains_.size(); ++i) {
    if (inside(grains_.site(i).position())) {
      kept.push_back(i);
    } else if (options_.energies) {
      note_leaver(i);
    }
  }
  left_ = false;
  if (kept.size() == grains_.size()) return;  // they came back
  lost_ += static_cast<std::int64_t>(grains_.size() - kept.size());
  grains_.take(kept);
  if (list_valid_ && !kept.empty()) {
    drop_from_lists(kept);
  } else {
    list_valid_ = false;
  }
  doubt_ = true;
}

SearchSpace Simulation::search_space() const {
  SearchSpace space{model_.domain, {}, 0};
  for (int axis = 0; axis < 3; ++axis) space.periodic[axis] = model_.boundary[axis] == AxisBoundary::periodic;
  return space;
}

std::size_t Simulation::bytes() const {
  return grains_.bytes() + pair_contacts_.bytes() + wall_contacts_.bytes() +
         candidates_.capacity() * sizeof(PairRef) + reach_.capacity() * sizeof(float) +
         path_left_.capacity() * sizeof(float) + built_ids_.capacity() * sizeof(std::uint32_t) +
         sleepers_.bytes() + quick_.bytes() + slow_.capacity() * sizeof(GroupPull) +
         energies_.capacity() * sizeof(GrainEnergy);
}

std::vector<std::uint32_t> Simulation::slots_by_id() const {
  std::vector<std::uint32_t> slots(static_cast<std::size_t>(next_id_), PairContacts::kNoSlot);
  for (std::uint32_t s = 0; s < grains_.size(); ++s) slots[id_of(s)] = s;
  std::erase(slots, PairContacts::kNoSlot);  // grains that left
  return slots;
}

void Simulation::copy_columns(GrainColumns& out) const {
  const std::vector<std::uint32_t> slots = slots_by_id();
  const auto fill = [&](auto& column, auto value) {
    column.resize(slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) column[i] = value(grains_.row(slots[i]));
  };
  fill(out.id, [](const GrainRow& g) { return g.id; });
  fill(out.x, [](const GrainRow& g) { return g.x; });
  fill(out.y, [](const GrainRow& g) { return g.y; });
  fill(out.z, [](const GrainRow& g) { return g.z; });
  fill(out.radius, [](const GrainRow& g) { return g.radius; });
  fill(out.mass, [](const GrainRow& g) { return g.mass; });
  fill(out.vx, [](const GrainRow& g) { return g.vx; });
  fill(out.vy, [](const GrainRow& g) { return g.vy; });
  fill(out.vz, [](const GrainRow& g) { return g.vz; });
  fill(out.wx, [](const GrainRow& g) { return g.wx; });
  fill(out.wy, [](const GrainRow& g) { return g.wy; });
  fill(out.wz, [](const GrainRow& g) { return g.wz; });
  fill(out.material, [](const GrainRow& g) { return static_cast<std::int32_t>(g.material); });
  fill(out.layer, [](const GrainRow& g) { return g.layer; });
}

}  // namespace interstice::dem
