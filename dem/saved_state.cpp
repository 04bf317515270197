// A simulation to named arrays and back, bit for bit.
#include <algorithm>

#include "base/error.h"
#include "dem/simulation.h"

namespace interstice::dem {
namespace {

constexpr std::size_t kRealsPerGrain = 17;
constexpr std::size_t kIntegersPerGrain = 3;
constexpr std::size_t kRealsPerWall = 6;
constexpr std::size_t kRealsPerSpring = 4, kRealsPerContact = 2 * kRealsPerSpring;  // sliding, rolling
constexpr std::size_t kRealsPerLedger = 10;

void append(std::vector<double>& out, const Vec3d& v) { out.insert(out.end(), {v.x, v.y, v.z}); }

Vec3d vec_at(const std::vector<double>& in, std::size_t at) { return {in[at], in[at + 1], in[at + 2]}; }

void append(std::vector<double>& out, const TangentialSpring<double>& s) {
  append(out, s.force);
  out.push_back(s.stiffness);
}

TangentialSpring<double> spring_from(const std::vector<double>& in, std::size_t at) {
  return {vec_at(in, at), in[at + 3]};
}

template <class Map>
const auto& array_of(const Map& map, const char* name) {
  const auto it = map.find(name);
  if (it == map.end())
    throw InputError(std::string("checkpoint: no array named ") + name + "; start the run anew");
  return it->second;
}

}  // namespace

SavedState Simulation::save() const {
  SavedState s;
  std::vector<double>& grains = s.real["grains"];
  std::vector<std::int64_t>& labels = s.integer["grain_labels"];
  std::vector<double>&pair_springs = s.real["pair_springs"], &wall_springs = s.real["wall_springs"];
  std::vector<std::int64_t>&pair_ids = s.integer["pair_ids"], &wall_ids = s.integer["wall_ids"];
  for (const std::uint32_t slot : slots_by_id()) {
    const GrainRow g = grains_.row(slot);
    const GrainAcceleration& a = grains_.accelerations()[slot];
    append(grains, g.position());
    append(grains, g.velocity());
    append(grains, g.spin());
    append(grains, a.linear);
    append(grains, a.angular);
    if (options_.rates.two()) {
      append(s.real["slow_accelerations"], grains_.slow_accelerations()[slot].linear);
      append(s.real["slow_accelerations"], grains_.slow_accelerations()[slot].angular);
    }
    grains.insert(grains.end(), {g.radius, g.mass});
    labels.insert(labels.end(), {g.id, g.material, g.layer});
    if (rest_) {
      append(s.real["rest_references"], grains_.rests()[slot].reference);
      s.real["rest_pushes"].push_back(grains_.rests()[slot].push);
      s.integer["rest_checks"].insert(s.integer["rest_checks"].end(),
                                      {grains_.rests()[slot].checks, grains_.rests()[slot].calm});
    }
    for (const Adjacent& e : pair_contacts_.of(slot)) {
      if (e.second || !pair_contacts_.touching(e.pair)) continue;
      pair_ids.insert(pair_ids.end(), {g.id, grains_.labels()[e.slot].id});
      append(pair_springs, pair_contacts_.memories().sliding(e.pair));
      append(pair_springs, pair_contacts_.memories().rolling(e.pair));
    }
    for (const WallContact& w : wall_contacts_.of(slot)) {
      if (!w.touching()) continue;
      wall_ids.insert(wall_ids.end(), {g.id, w.wall});
      append(wall_springs, w.sliding);
      append(wall_springs, w.rolling);
    }
  }
  std::vector<double>&walls = s.real["walls"], &ledger = s.real["energies"];  // there even where empty
  std::vector<std::int64_t>& since = s.integer["walls_since"];
  for (const WallMotion& m : motion_of_wall_) {
    append(walls, m.velocity);
    append(walls, m.offset);
    since.push_back(m.since);
  }
  for (const GrainEnergy& e : energies_) {
    ledger.insert(ledger.end(), {e.inserted, e.gravity, e.walls, e.wall_power, e.carried, e.heat.damping,
                                 e.heat.sliding, e.heat.rolling, e.heat.adhesion, e.stilled});
  }
  s.real["time_step"] = {dt_};
  s.integer["counters"] = {step_, next_id_, lost_, counted_ids_};
  return s;
}

void Simulation::restore(const SavedState& s) {
  const auto& grains = array_of(s.real, "grains");
  const auto& labels = array_of(s.integer, "grain_labels");
  const auto& counters = array_of(s.integer, "counters");
  const std::size_t n = labels.size() / kIntegersPerGrain;
  if (grains.size() != n * kRealsPerGrain || counters.size() != 4) {
    throw InputError("checkpoint: arrays of unequal length; start the run anew");
  }
  if (array_of(s.real, "time_step").at(0) != dt_) {
    throw InputError("checkpoint: made with another time step; start the run anew");
  }
  step_ = counters[0], next_id_ = counters[1], lost_ = counters[2], counted_ids_ = counters[3];
  grains_.clear();
  grains_.set_stepping(false);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t at = i * kRealsPerGrain;
    const Vec3d p = vec_at(grains, at), v = vec_at(grains, at + 3), w = vec_at(grains, at + 6);
    grains_.add({p.x, p.y, p.z, grains[at + 15], v.x, v.y, v.z, grains[at + 16], w.x, w.y, w.z, labels[3 * i],
                 static_cast<std::int32_t>(labels[3 * i + 2]), static_cast<std::uint16_t>(labels[3 * i + 1])},
                {vec_at(grains, at + 9), vec_at(grains, at + 12)});
  }
  if (rest_) restore_rests(s);
  if (options_.rates.two()) restore_slow_accelerations(s);
  const auto& walls = array_of(s.real, "walls");
  const auto& since = array_of(s.integer, "walls_since");
  if (since.size() != motion_of_wall_.size() || walls.size() != kRealsPerWall * since.size()) {
    throw InputError("checkpoint: made with other walls; start the run anew");
  }
  for (std::size_t w = 0; w < since.size(); ++w) {
    motion_of_wall_[w] = {vec_at(walls, kRealsPerWall * w), vec_at(walls, kRealsPerWall * w + 3), since[w]};
    wall_velocities_[w] = motion_of_wall_[w].velocity;
  }
  place_walls();
  begun_ = false;
  built_ids_.clear();
  rebuild();
  restore_springs(s);
  if (options_.energies) restore_energies(s);
}

/// Of grains by ascending id, before they are put in another order.
void Simulation::restore_slow_accelerations(const SavedState& s) {
  if (grains_.size() == 0) return;
  const auto& slow = array_of(s.real, "slow_accelerations");
  if (slow.size() != 6 * grains_.size()) {
    throw InputError("checkpoint: arrays of unequal length; start the run anew");
  }
  for (std::size_t i = 0; i < grains_.size(); ++i)
    grains_.slow_accelerations()[i] = {vec_at(slow, 6 * i), vec_at(slow, 6 * i + 3)};
}

/// The same.
void Simulation::restore_rests(const SavedState& s) {
  doubt_ = true;
  if (grains_.size() == 0) return;
  const auto& references = array_of(s.real, "rest_references");
  const auto& pushes = array_of(s.real, "rest_pushes");
  const auto& checks = array_of(s.integer, "rest_checks");
  if (checks.size() != 2 * grains_.size() || pushes.size() != grains_.size() ||
      references.size() != 3 * grains_.size()) {
    throw InputError("checkpoint: arrays of unequal length; start the run anew");
  }
  for (std::size_t i = 0; i < grains_.size(); ++i)
    grains_.rests()[i] = {vec_at(references, 3 * i), pushes[i], static_cast<std::int32_t>(checks[2 * i]),
                          checks[2 * i + 1] != 0};
}

void Simulation::restore_energies(const SavedState& s) {
  energies_.assign(static_cast<std::size_t>(next_id_), {});
  const auto& ledger = array_of(s.real, "energies");
  if (ledger.size() != kRealsPerLedger * energies_.size()) {
    throw InputError("checkpoint: arrays of unequal length; start the run anew");
  }
  for (std::size_t i = 0; i < energies_.size(); ++i) {
    const double* v = ledger.data() + kRealsPerLedger * i;
    energies_[i] = {v[0], v[1], v[2], v[3], {v[5], v[6], v[7], v[8]}, v[9], v[4]};
  }
}

void Simulation::restore_springs(const SavedState& s) {
  const auto& pair_ids = array_of(s.integer, "pair_ids");
  const auto& pair_springs = array_of(s.real, "pair_springs");
  const auto& wall_ids = array_of(s.integer, "wall_ids");
  const auto& wall_springs = array_of(s.real, "wall_springs");
  if (2 * pair_springs.size() != kRealsPerContact * pair_ids.size() ||
      2 * wall_springs.size() != kRealsPerContact * wall_ids.size()) {
    throw InputError("checkpoint: arrays of unequal length; start the run anew");
  }
  std::vector<std::uint32_t> slot_of_id(static_cast<std::size_t>(next_id_), PairContacts::kNoSlot);
  for (std::uint32_t slot = 0; slot < grains_.size(); ++slot) slot_of_id[id_of(slot)] = slot;
  for (std::size_t k = 0; 2 * k < pair_ids.size(); ++k) {
    for (const Adjacent& e : pair_contacts_.of(slot_of_id.at(static_cast<std::size_t>(pair_ids[2 * k])))) {
      if (grains_.labels()[e.slot].id != pair_ids[2 * k + 1]) continue;
      pair_contacts_.memories().set_touching(
          e.pair, spring_from(pair_springs, kRealsPerContact * k),
          spring_from(pair_springs, kRealsPerContact * k + kRealsPerSpring));
    }
  }
  for (std::size_t k = 0; 2 * k < wall_ids.size(); ++k) {
    const std::uint32_t slot = slot_of_id.at(static_cast<std::size_t>(wall_ids[2 * k]));
    for (const std::uint32_t place : wall_contacts_.places_of(slot)) {
      if (wall_contacts_.wall(place) != wall_ids[2 * k + 1]) continue;
      wall_contacts_.memories().set_touching(
          place, spring_from(wall_springs, kRealsPerContact * k),
          spring_from(wall_springs, kRealsPerContact * k + kRealsPerSpring));
    }
  }
}

}  // namespace interstice::dem
