// What a step does with forces: pairs are evaluated by the kernels, then every grain collects what its
// contacts did and completes its velocities.
#include "base/parallel.h"
#include "dem/simulation.h"
#include "dem/wall_distance.h"

namespace interstice::dem {
namespace {
constexpr std::size_t kPairsPerBlock = 1024;
}  // namespace

StepView Simulation::step_view() {
  PairContacts& p = pair_contacts_;
  return {rows_.data(),
          search_space().period(),
          dt_,
          model_.slider_velocity,
          constants_.data(),
          constants_single_.data(),
          model_.materials.size(),
          p.pairs.data(),
          p.state.data(),
          p.sliding.empty() ? nullptr : p.sliding.data(),
          p.rolling.empty() ? nullptr : p.rolling.data(),
          p.results.data(),
          p.heat.empty() ? nullptr : p.heat.data(),
          walls_.data(),
          wall_velocities_.data(),
          model_.walls.data()};
}

void Simulation::evaluate_pairs() {
  const StepView view = step_view();
  const std::size_t n = pair_contacts_.pairs.size();
  if (options_.reference) {
    kernels_.pairs(model_.laws, view, 0, n);
    return;
  }
  for_each_block({n, kPairsPerBlock}, [&](std::size_t, std::size_t begin, std::size_t end) {
    kernels_.pairs(model_.laws, view, begin, end);
  });
}

void Simulation::finish_row(const StepView& view, std::size_t i) {
  Vec3d force{0, 0, 0}, torque{0, 0, 0};
  for (const Adjacent& partner : pair_contacts_.of(i)) {
    if (pair_contacts_.state[partner.pair] == ContactState::apart) continue;
    const PairResult& result = pair_contacts_.results[partner.pair];
    if (partner.second) {
      force -= result.force;
      torque += result.torque_b;
    } else {
      force += result.force;
      torque += result.torque_a;
    }
  }
  const std::span<WallContact> walls = wall_contacts_.of(i);
  if (!walls.empty() || options_.energies) {
    WallTotals totals;
    kernels_.walls(model_.laws, view, rows_[i], walls, totals);
    force += totals.force;
    torque += totals.torque;
    if (options_.energies) add_heat(i, totals);
  }
  GrainRow& g = rows_[i];
  GrainMotion& m = motions_[i];
  const Vec3d acceleration = model_.gravity + m.inverse_mass * force;
  const Vec3d angular = m.inverse_inertia * torque;
  const Vec3d dv = (0.5 * dt_) * (acceleration - m.acceleration), dw = (0.5 * dt_) * (angular - m.angular);
  g.vx += dv.x, g.vy += dv.y, g.vz += dv.z;
  g.wx += dw.x, g.wy += dw.y, g.wz += dw.z;
  m.acceleration = acceleration;
  m.angular = angular;
}

/// Half of each pair's heat to each of its grains; the work of walls by the trapezoidal rule.
void Simulation::add_heat(std::size_t i, const WallTotals& walls) {
  GrainEnergy& e = energies_[static_cast<std::size_t>(rows_[i].id)];
  for (const Adjacent& partner : pair_contacts_.of(i)) {
    const PairHeat& heat = pair_contacts_.heat[partner.pair];
    e.heat += {0.5 * heat.damping, 0.5 * heat.sliding, 0.5 * heat.rolling, 0.5 * heat.adhesion};
  }
  e.heat += walls.heat;
  e.walls += 0.5 * dt_ * (e.wall_power + walls.power);
  e.wall_power = walls.power;
}

/// The elastic energy of a grain that overlaps a wall when it is inserted [J].
double Simulation::inserted_on_wall(const GrainRow& g, const WallContact& contact) const {
  const bool overlap = wall_distance(walls_[contact.wall], g.position()).distance < g.radius;
  return overlap ? stored_in_wall_contact(*this, g, contact).normal : 0;
}

/// A grain that is put into contact brings elastic energy along. Counted in its first step, when contacts are
/// known.
void Simulation::count_inserted_contacts() {
  if (counted_ids_ == next_id_) return;
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    if (rows_[i].id >= counted_ids_) {
      for (WallContact w : wall_contacts_.of(i)) {
        w.state = ContactState::touching;  // walls are evaluated later in the step
        energies_[static_cast<std::size_t>(rows_[i].id)].inserted += inserted_on_wall(rows_[i], w);
      }
    }
    for (const Adjacent& e : pair_contacts_.of(i)) {
      const bool fresh = rows_[i].id >= counted_ids_ || rows_[e.slot].id >= counted_ids_;
      if (fresh && !e.second) {
        energies_[static_cast<std::size_t>(rows_[i].id)].inserted += stored_in_pair(*this, e.pair).normal;
      }
    }
  }
  counted_ids_ = next_id_;
}

/// What a grain takes along: its motion and all that is stored in its contacts.
void Simulation::note_leaver(std::size_t i) {
  double carried = kinetic_energy(rows_[i]);
  for (const Adjacent& e : pair_contacts_.of(i)) {
    if (e.second && !inside(rows_[e.slot])) continue;  // its partner leaves with it, and has counted the pair
    carried += stored_in_pair(*this, e.pair).sum();
  }
  for (const WallContact& w : wall_contacts_.of(i))
    carried += stored_in_wall_contact(*this, rows_[i], w).sum();
  energies_[static_cast<std::size_t>(rows_[i].id)].carried += carried;
}

}  // namespace interstice::dem
