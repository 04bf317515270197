// The account of energies that a step keeps where it is asked to (energy.h).
#include "dem/simulation.h"
#include "dem/wall_distance.h"

namespace interstice::dem {

/// The work of gravity on a group that moved.
void Simulation::add_lifting(std::size_t first, const Vec3<Each>& step) {
  double steps[3][kLanes];
  store(step, steps[0], steps[1], steps[2]);
  for (std::size_t i = first; i < std::min(grains_.size(), first + kLanes); ++i) {
    const Vec3d moved{steps[0][i - first], steps[1][i - first], steps[2][i - first]};
    energies_[id_of(i)].gravity += grains_.labels()[i].mass * dot(model_.gravity, moved);
  }
}

void Simulation::add_heat(std::size_t group) {
  const std::size_t first = group * kLanes;
  for (std::size_t i = first; i < std::min(grains_.size(), first + kLanes); ++i) add_heat_of(i);
}

/// Half of each pair's heat to each of its grains; the work of walls by the trapezoidal rule.
void Simulation::add_heat_of(std::size_t i) {
  GrainEnergy& e = energies_[id_of(i)];
  for (const Adjacent& partner : pair_contacts_.of(i)) {
    if (rest_ && (sleepers_.frozen(partner.pair / kLanes) >> partner.pair % kLanes & 1) != 0) continue;
    const PairHeat& heat = pair_contacts_.memories().heat(partner.pair);
    e.heat += {0.5 * heat.damping, 0.5 * heat.sliding, 0.5 * heat.rolling, 0.5 * heat.adhesion};
  }
  double power = 0;
  for (const WallContact& w : wall_contacts_.of(i)) {
    if (!is_frozen(w.slot, w.wall)) e.heat += w.heat;
    power += w.power;
  }
  e.walls += 0.5 * dt_ * (e.wall_power + power);
  e.wall_power = power;
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
  for (std::size_t i = 0; i < grains_.size(); ++i) {
    if (grains_.labels()[i].id >= counted_ids_) {
      for (WallContact w : wall_contacts_.of(i)) {
        w.state = ContactState::touching;  // walls are evaluated later in the step
        energies_[id_of(i)].inserted += inserted_on_wall(grains_.row(i), w);
      }
    }
    for (const Adjacent& e : pair_contacts_.of(i)) {
      const bool fresh =
          grains_.labels()[i].id >= counted_ids_ || grains_.labels()[e.slot].id >= counted_ids_;
      if (fresh && !e.second) {
        energies_[id_of(i)].inserted += stored_in_pair(*this, e.pair).normal;
      }
    }
  }
  counted_ids_ = next_id_;
}

/// What a grain takes along: its motion and all that is stored in its contacts.
void Simulation::note_leaver(std::size_t i) {
  double carried = kinetic_energy(grains_.row(i));
  for (const Adjacent& e : pair_contacts_.of(i)) {
    if (e.second && !inside(grains_.site(e.slot).position()))
      continue;  // its partner leaves with it, and has counted the pair
    carried += stored_in_pair(*this, e.pair).sum();
  }
  for (const WallContact& w : wall_contacts_.of(i))
    carried += stored_in_wall_contact(*this, grains_.row(i), w).sum();
  energies_[id_of(i)].carried += carried;
}

}  // namespace interstice::dem
