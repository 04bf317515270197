#include "dem/simulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "dem/row_order.h"

namespace interstice::dem {
namespace {

constexpr std::size_t kRowsPerBlock = 512;
constexpr std::int64_t kRebuildsPerSort = 32;

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
      pair_contacts_({keeps_spring(model_.laws), keeps_rolling_spring(model_.laws), options.energies}) {
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

template <class Body>
void Simulation::for_rows(const Body& body) const {
  const Blocks blocks{rows_.size(), kRowsPerBlock};
  if (options_.reference) {
    for (std::size_t b = 0; b < blocks.count(); ++b) body(b, blocks.begin(b), blocks.end(b));
  } else {
    for_each_block(blocks, body);
  }
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
    GrainRow row{};
    row.x = g.position.x, row.y = g.position.y, row.z = g.position.z;
    row.vx = g.velocity.x, row.vy = g.velocity.y, row.vz = g.velocity.z;
    row.wx = g.spin.x, row.wy = g.spin.y, row.wz = g.spin.z;
    row.radius = g.radius;
    row.mass = 4.0 / 3.0 * M_PI * g.radius * g.radius * g.radius * model_.materials[g.material].density;
    row.id = next_id_++;
    row.material = g.material;
    row.layer = g.layer;
    rows_.push_back(row);
    // The first step's acceleration is gravity alone: exact for a grain in flight, first order for one in
    // contact.
    motions_.push_back({model_.gravity, 1 / row.mass, {0, 0, 0}, 1 / (0.4 * row.mass * g.radius * g.radius)});
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
    evaluate_pairs();
    if (options_.energies) count_inserted_contacts();
    finish_and_begin(s + 1 < steps);
  }
}

void Simulation::begin_step() {
  std::vector<PassReport> reports(Blocks{rows_.size(), kRowsPerBlock}.count());
  for_rows([&](std::size_t b, std::size_t begin, std::size_t end) { reports[b] = begin_rows(begin, end); });
  take_report(reports);
}

/// Collects the forces, completes the velocities, and (to spare a pass over memory) begins the next step.
void Simulation::finish_and_begin(bool begin_next) {
  std::vector<PassReport> reports(Blocks{rows_.size(), kRowsPerBlock}.count());
  const StepView view = step_view();
  for_rows([&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) finish_row(view, i);
    if (begin_next) reports[b] = begin_rows(begin, end);
  });
  if (begin_next) take_report(reports);
}

/// Synchronous Verlet: positions and velocities that the forces see all belong to the step's end. With
/// half-step velocities a part of the approach leaks into the slip of large-small contacts (Vyas et al.,
/// Comput. Phys. Commun. 310, 109524, 2025); v + a dt is as accurate as the positions and has no such lag.
Simulation::PassReport Simulation::begin_rows(std::size_t begin, std::size_t end) {
  PassReport report;
  for (std::size_t i = begin; i < end; ++i) {
    GrainRow& g = rows_[i];
    const GrainMotion& m = motions_[i];
    const Vec3d v = g.velocity();
    const Vec3d step = dt_ * v + (0.5 * dt_ * dt_) * m.acceleration;
    g.x += step.x, g.y += step.y, g.z += step.z;
    g.vx += dt_ * m.acceleration.x, g.vy += dt_ * m.acceleration.y, g.vz += dt_ * m.acceleration.z;
    g.wx += dt_ * m.angular.x, g.wy += dt_ * m.angular.y, g.wz += dt_ * m.angular.z;
    if (options_.energies) {
      energies_[static_cast<std::size_t>(g.id)].gravity += g.mass * dot(model_.gravity, step);
    }
    const double stepped = dot(step, step);
    if (!(stepped <= 0.25 * g.radius * g.radius) && report.broken < 0) report.broken = g.id;
    for (int axis = 0; axis < 3; ++axis) {
      double& p = axis == 0 ? g.x : axis == 1 ? g.y : g.z;
      const double lo = model_.domain.lo[axis], hi = model_.domain.hi[axis];
      if (p >= lo && p < hi) continue;
      if (model_.boundary[axis] == AxisBoundary::open) {
        report.left = true;
      } else {
        double& built = axis == 0 ? g.built_x : axis == 1 ? g.built_y : g.built_z;
        const double shift = p < lo ? hi - lo : lo - hi;
        p += shift;
        built += shift;
      }
    }
    const Vec3d moved = g.position() - Vec3d{g.built_x, g.built_y, g.built_z};
    report.moved_squared = std::max(report.moved_squared, dot(moved, moved));
    report.speed_squared = std::max(report.speed_squared, dot(v, v));
  }
  return report;
}

void Simulation::take_report(const std::vector<PassReport>& reports) {
  double moved = 0, speed = 0;
  bool left = false;
  for (const PassReport& r : reports) {
    moved = std::max(moved, r.moved_squared);
    speed = std::max(speed, r.speed_squared);
    left = left || r.left;
    if (r.broken >= 0) {
      throw UnstableError(
          "grain " + std::to_string(r.broken) + " crossed half its radius in one step (step " +
          std::to_string(step_ + 1) + ", t = " + std::to_string(time()) +
          " s): the time step is too large for these contacts or speeds; use a smaller [time] step");
    }
  }
  moved_ = std::sqrt(moved);
  fastest_ = std::sqrt(speed);
  begun_ = true;
  if (left) remove_leavers();
}

bool Simulation::inside(const GrainRow& g) const {
  for (int axis = 0; axis < 3; ++axis) {
    if (model_.boundary[axis] != AxisBoundary::open) continue;
    const double p = g.position()[axis];
    if (!(p >= model_.domain.lo[axis] && p < model_.domain.hi[axis])) return false;
  }
  return true;
}

void Simulation::remove_leavers() {
  for (std::size_t i = 0; options_.energies && i < rows_.size(); ++i) {
    if (!inside(rows_[i])) note_leaver(i);
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (!inside(rows_[i])) continue;
    rows_[kept] = rows_[i];
    motions_[kept] = motions_[i];
    ++kept;
  }
  lost_ += static_cast<std::int64_t>(rows_.size() - kept);
  rows_.resize(kept);
  motions_.resize(kept);
  list_valid_ = false;
}

double Simulation::wall_travel() const {
  double farthest = 0;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const auto corner = [](const Shape& s) {
      return std::holds_alternative<Plane>(s) ? std::get<Plane>(s).point : std::get<Box>(s).lo;
    };
    farthest = std::max(farthest, norm(corner(walls_[w]) - corner(built_walls_[w])));
  }
  return farthest;
}

void Simulation::rebuild_if_needed() {
  if (list_valid_ && moved_ + std::max(moved_, wall_travel()) < skin_) return;
  rebuild();
}

/// A skin that lasts some 60 steps at the present speed. Bits do not depend on it, only speed does.
double Simulation::choose_skin() const {
  if (options_.skin > 0) return options_.skin;
  double radius_sum = 0, fastest = fastest_;
  for (const GrainRow& g : rows_) radius_sum += g.radius;
  for (const WallMotion& m : motion_of_wall_) fastest = std::max(fastest, norm(m.velocity));
  const double diameter = rows_.empty() ? 0 : 2 * radius_sum / static_cast<double>(rows_.size());
  return std::clamp(120 * fastest * dt_, 0.03 * diameter, 0.3 * diameter);
}

SearchSpace Simulation::search_space() const {
  SearchSpace space{model_.domain, {}, skin_};
  for (int axis = 0; axis < 3; ++axis) space.periodic[axis] = model_.boundary[axis] == AxisBoundary::periodic;
  return space;
}

/// How far bodies act on each other beyond contact [m], at most.
double Simulation::attraction_reach() const {
  double reach = 0, largest = 0;
  for (const GrainRow& g : rows_) largest = std::max(largest, g.radius);
  for (const PairConstants<double>& c : constants_) {
    if (model_.laws.cohesion == CohesionLaw::jkr)  // grows with R*, which is at most the radius (at a wall)
      reach = std::max(reach, jkr_reach(c.effective_modulus, c.work_of_adhesion, largest));
    if (model_.laws.cohesion == CohesionLaw::van_der_waals) reach = std::max(reach, c.range);
  }
  return reach;
}

void Simulation::check_periodic_lengths() const {
  double largest = 0;
  for (const GrainRow& g : rows_) largest = std::max(largest, g.radius);
  for (int axis = 0; axis < 3; ++axis) {
    const double length = model_.domain.hi[axis] - model_.domain.lo[axis];
    if (model_.boundary[axis] != AxisBoundary::periodic ||
        length > 2 * (2 * largest + skin_ + attraction_reach()))
      continue;
    throw InputError(
        "domain.box: the periodic axis " + std::string(1, "xyz"[axis]) +
        " is shorter than two of the largest grains; make it longer, or the boundary open or a wall");
  }
}

void Simulation::rebuild() {
  skin_ = choose_skin();
  check_periodic_lengths();
  std::vector<std::uint32_t> slot_of_id(static_cast<std::size_t>(next_id_), PairContacts::kNoSlot);
  for (std::uint32_t s = 0; s < built_ids_.size(); ++s)
    slot_of_id[static_cast<std::size_t>(built_ids_[s])] = s;
  if (sorted_at_ < 0 || rows_.size() != built_ids_.size() || rebuilds_ - sorted_at_ >= kRebuildsPerSort) {
    sort_rows_in_space(rows_, motions_);
    sorted_at_ = rebuilds_;
  }
  std::vector<std::uint32_t> old_slot(rows_.size());
  for (std::size_t s = 0; s < rows_.size(); ++s)
    old_slot[s] = slot_of_id[static_cast<std::size_t>(rows_[s].id)];

  SearchSpace space = search_space();
  space.skin += attraction_reach();
  pair_contacts_.replace(options_.reference ? find_pairs_brute_force(rows_, space) : find_pairs(rows_, space),
                         rows_, old_slot);
  wall_contacts_.replace(rows_, walls_, space.skin, old_slot);
  built_ids_.resize(rows_.size());
  for (std::size_t s = 0; s < rows_.size(); ++s) {
    GrainRow& g = rows_[s];
    built_ids_[s] = g.id;
    g.built_x = g.x, g.built_y = g.y, g.built_z = g.z;
  }
  built_walls_ = walls_;
  moved_ = 0;
  list_valid_ = true;
  ++rebuilds_;
}

std::size_t Simulation::bytes() const {
  return rows_.capacity() * sizeof(GrainRow) + motions_.capacity() * sizeof(GrainMotion) +
         pair_contacts_.bytes() + wall_contacts_.bytes() + built_ids_.capacity() * sizeof(std::int64_t) +
         energies_.capacity() * sizeof(GrainEnergy);
}

std::vector<std::uint32_t> Simulation::slots_by_id() const {
  std::vector<std::uint32_t> slots(rows_.size());
  for (std::uint32_t s = 0; s < slots.size(); ++s) slots[s] = s;
  std::sort(slots.begin(), slots.end(),
            [&](std::uint32_t l, std::uint32_t r) { return rows_[l].id < rows_[r].id; });
  return slots;
}

void Simulation::copy_columns(GrainColumns& out) const {
  const std::vector<std::uint32_t> slots = slots_by_id();
  const auto fill = [&](auto& column, auto value) {
    column.resize(slots.size());
    for (std::size_t i = 0; i < slots.size(); ++i) column[i] = value(rows_[slots[i]]);
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
