#include "dem/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "dem/site_order.h"

namespace interstice::dem {
namespace {

constexpr std::int64_t kRebuildsPerSort = 32;
constexpr std::size_t kPartsPerThread = 4;

Vec3d offset_at(const Vec3d& offset, const Vec3d& velocity, std::int64_t steps, double dt) {
  return offset + (static_cast<double>(steps) * dt) * velocity;
}

}  // namespace

Simulation::Simulation(Model model, double time_step, const SimulationOptions& options)
    : model_(std::move(model)),
      dt_(time_step),
      options_(options),
      kernels_(find_kernels(model_.laws, options.precision, options.energies)),
      motion_of_wall_(model_.walls.size()),
      wall_velocities_(model_.walls.size()),
      grains_(options.precision),
      pair_contacts_({keeps_spring(model_.laws), keeps_rolling_spring(model_.laws), options.energies},
                     options.precision) {
  if (!(dt_ > 0) || !std::isfinite(dt_)) throw InputError("time step: must be positive and finite");
  for (std::size_t a = 0; a < model_.materials.size(); ++a) {
    for (std::size_t b = 0; b < model_.materials.size(); ++b) {
      constants_.push_back(model_.constants(a, b));
      constants_single_.push_back(constants_.back().as<float>());
    }
  }
  walls_.resize(model_.walls.size());
  place_walls();
}

/// The engine's own guard, whatever made the grain: nothing that is no number reaches a kernel.
void Simulation::check_grain(const NewGrain& g) const {
  const auto finite = [](const Vec3d& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
  };
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
    grains_.add(row, {model_.gravity, {0, 0, 0}});
    if (options_.energies) energies_.emplace_back().inserted = kinetic_energy(row);
  }
  list_valid_ = list_valid_ && grains.empty();
}

void Simulation::set_wall_velocity(std::size_t wall, const Vec3d& velocity) {
  WallMotion& m = motion_of_wall_[wall];
  m.offset = offset_at(m.offset, m.velocity, step_ - m.since, dt_);
  m.since = step_;
  m.velocity = velocity;
  wall_velocities_[wall] = velocity;
}

void Simulation::place_walls() {
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const WallMotion& m = motion_of_wall_[w];
    walls_[w] = translated(model_.walls[w].shape, offset_at(m.offset, m.velocity, step_ - m.since, dt_));
  }
}

void Simulation::advance(std::int64_t steps) {
  for (std::int64_t s = 0; s < steps; ++s) {
    if (!begun_) begin_step();
    ++step_;
    begun_ = false;
    place_walls();
    rebuild_if_needed();
    evaluate_and_move(s + 1 < steps);
  }
}

std::vector<GrainRow> Simulation::rows() const {
  std::vector<GrainRow> all;
  all.reserve(grains_.size());
  for (std::size_t s = 0; s < grains_.size(); ++s) all.push_back(grains_.row(s));
  return all;
}

void Simulation::take_report(const std::vector<PassReport>& reports) {
  Four squared(0);
  bool left = false;
  for (const PassReport& r : reports) {
    squared = max_of(squared, r.step_squared);
    left = left || r.left;
    if (r.broken >= 0) {
      throw UnstableError(
          "grain " + std::to_string(r.broken) + " crossed half its radius in one step (step " +
          std::to_string(step_ + 1) + ", t = " + std::to_string(time()) +
          " s): the time step is too large for these contacts or speeds; use a smaller [time] step");
    }
  }
  const Vec3d longest = three(squared);
  const double step = std::sqrt(longest.x + longest.y + longest.z);
  moved_ += step;
  moved_since_refresh_ += step;
  fastest_ = step / dt_;
  begun_ = true;
  grains_.set_stepping(true);
  if (left) remove_leavers();
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
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < grains_.size(); ++i) {
    if (inside(grains_.site(i).position())) {
      kept.push_back(i);
    } else if (options_.energies) {
      note_leaver(i);
    }
  }
  lost_ += static_cast<std::int64_t>(grains_.size() - kept.size());
  grains_.take(kept);
  list_valid_ = false;
}

/// How far any grain is from where the list was built [m].
double Simulation::farthest_moved() const {
  const Blocks blocks{grains_.size(), 4096};
  std::vector<double> farthest(blocks.count(), 0);
  for_each_block(blocks, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3d moved = grains_.site(i).position() - grains_.labels()[i].built;
      farthest[b] = std::max(farthest[b], dot(moved, moved));
    }
  });
  return std::sqrt(farthest.empty() ? 0 : *std::max_element(farthest.begin(), farthest.end()));
}

double Simulation::wall_travel() const {
  double farthest = 0;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const auto corner = [](const Shape& s) {
      return std::holds_alternative<Plane>(s) ? std::get<Plane>(s).point : std::get<Box>(s).lo;
    };
    farthest = std::max(farthest, norm(corner(walls_[w]) - corner(refreshed_walls_[w])));
  }
  return farthest;
}

/// `moved_` adds up the longest steps; where grains go to and fro it grows beyond how far they are, and is
/// measured anew before anything is done about it.
void Simulation::rebuild_if_needed() {
  if (list_valid_ && 2 * moved_ >= skin_) {
    moved_ = std::min(moved_, farthest_moved());
    list_valid_ = 2 * moved_ < 0.75 * skin_;  // else it would be measured again in a few steps
  }
  if (!list_valid_) {
    rebuild();
  } else if (moved_since_refresh_ + std::max(moved_since_refresh_, wall_travel()) >= near_gap_) {
    refresh({}, grains_.sites());
  }
}

/// Lists that last: the near pairs some 30 steps at the present speed, the candidates four times as long.
/// Bits do not depend on it, only speed does.
void Simulation::choose_gaps(const std::vector<GrainSite>& sites) {
  double radius_sum = 0, fastest = fastest_;
  for (const GrainSite& g : sites) radius_sum += g.radius;
  for (const WallMotion& m : motion_of_wall_) fastest = std::max(fastest, norm(m.velocity));
  const double diameter = sites.empty() ? 0 : 2 * radius_sum / static_cast<double>(sites.size());
  near_gap_ = std::clamp(60 * fastest * dt_, 0.002 * diameter, 0.1 * diameter);
  skin_ = std::max(4 * near_gap_, 0.04 * diameter);
  if (options_.skin > 0) {
    skin_ = options_.skin;
    near_gap_ = 0.25 * skin_;
  }
}

SearchSpace Simulation::search_space() const {
  SearchSpace space{model_.domain, {}, skin_};
  for (int axis = 0; axis < 3; ++axis) space.periodic[axis] = model_.boundary[axis] == AxisBoundary::periodic;
  return space;
}

/// How far bodies act on each other beyond contact [m], at most.
double Simulation::attraction_reach(double largest) const {
  double reach = 0;
  for (const PairConstants<double>& c : constants_) {
    if (model_.laws.cohesion == CohesionLaw::jkr)  // grows with R*, which is at most the radius (at a wall)
      reach = std::max(reach, jkr_reach(c.effective_modulus, c.work_of_adhesion, largest));
    if (model_.laws.cohesion == CohesionLaw::van_der_waals) reach = std::max(reach, c.range);
  }
  return reach;
}

void Simulation::check_periodic_lengths(double largest) const {
  for (int axis = 0; axis < 3; ++axis) {
    const double length = model_.domain.hi[axis] - model_.domain.lo[axis];
    if (model_.boundary[axis] != AxisBoundary::periodic || length > 2 * (2 * largest + skin_ + attraction_))
      continue;
    throw InputError(
        "domain.box: the periodic axis " + std::string(1, "xyz"[axis]) +
        " is shorter than two of the largest grains; make it longer, or the boundary open or a wall");
  }
}

/// Now and then, or when grains came or went: neighbours in space beside each other in memory.
void Simulation::sort_grains(std::vector<GrainSite>& sites) {
  if (sorted_at_ >= 0 && sites.size() == built_ids_.size() && rebuilds_ - sorted_at_ < kRebuildsPerSort)
    return;
  const std::vector<std::uint32_t> order = order_in_space(sites);
  grains_.take(order);
  sites = grains_.sites();
  sorted_at_ = rebuilds_;
}

void Simulation::rebuild() {
  std::vector<GrainSite> sites = grains_.sites();
  double largest = 0;
  for (const GrainSite& g : sites) largest = std::max(largest, g.radius);
  choose_gaps(sites);
  attraction_ = attraction_reach(largest);
  check_periodic_lengths(largest);
  std::vector<std::uint32_t> slot_of_id(static_cast<std::size_t>(next_id_), PairContacts::kNoSlot);
  for (std::uint32_t s = 0; s < built_ids_.size(); ++s)
    slot_of_id[static_cast<std::size_t>(built_ids_[s])] = s;
  sort_grains(sites);
  std::vector<std::uint32_t> old_slot(sites.size());
  for (std::size_t s = 0; s < sites.size(); ++s)
    old_slot[s] = slot_of_id[static_cast<std::size_t>(sites[s].id)];

  SearchSpace space = search_space();
  space.skin += attraction_;
  candidates_ = options_.reference ? find_pairs_brute_force(sites, space) : find_pairs(sites, space);
  refresh(old_slot, sites);
  built_ids_.resize(sites.size());
  const auto material = [&](std::size_t s) {
    return grains_.with_rows([&](const auto& rows) { return static_cast<std::int64_t>(rows[s].material); });
  };
  only_material_ = sites.empty() ? 0 : material(0);
  for (std::size_t s = 0; s < sites.size(); ++s) {
    built_ids_[s] = sites[s].id;
    grains_.labels()[s].built = sites[s].position();
    if (material(s) != only_material_) only_material_ = -1;
  }
  moved_ = 0;
  list_valid_ = true;
  ++rebuilds_;
}

/// Of the candidates, those that may touch before grains have moved by half the gap; and the walls near
/// grains.
void Simulation::refresh(const std::vector<std::uint32_t>& old_slot, const std::vector<GrainSite>& sites) {
  SearchSpace space = search_space();
  space.skin = near_gap_ + attraction_;
  const Blocks blocks{candidates_.size(), 4096};
  std::vector<std::vector<PairRef>> near(blocks.count());
  for_each_block(blocks, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (are_near(sites[candidates_[k].a], sites[candidates_[k].b], space))
        near[b].push_back(candidates_[k]);
  });
  std::vector<PairRef> pairs;
  pairs.reserve(candidates_.size());
  for (const auto& n : near) pairs.insert(pairs.end(), n.begin(), n.end());
  pair_contacts_.replace(pairs, sites, old_slot, parts());
  wall_contacts_.replace(sites, walls_, space.skin, old_slot);
  refreshed_walls_ = walls_;
  moved_since_refresh_ = 0;
}

/// One part for one thread; several a thread else, so that the fastest does not wait for the slowest.
Parts Simulation::parts() const {
  return {grains_.size(), options_.reference || threads() == 1 ? 1 : kPartsPerThread * threads()};
}

std::size_t Simulation::bytes() const {
  return grains_.bytes() + pair_contacts_.bytes() + wall_contacts_.bytes() +
         candidates_.capacity() * sizeof(PairRef) + built_ids_.capacity() * sizeof(std::int64_t) +
         energies_.capacity() * sizeof(GrainEnergy);
}

std::vector<std::uint32_t> Simulation::slots_by_id() const {
  std::vector<std::uint32_t> slots(grains_.size());
  for (std::uint32_t s = 0; s < slots.size(); ++s) slots[s] = s;
  std::sort(slots.begin(), slots.end(), [&](std::uint32_t l, std::uint32_t r) {
    return grains_.labels()[l].id < grains_.labels()[r].id;
  });
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
