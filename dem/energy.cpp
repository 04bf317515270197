#include "dem/energy.h"

#include "dem/simulation.h"
#include "dem/wall_distance.h"

namespace interstice::dem {
namespace {

/// The potential of the normal force, zero for bodies that just touch (van der Waals: that are out of range).
double normal_potential(const Laws& laws, const PairConstants<double>& c, double effective_radius,
                        double overlap, double area_integral) {
  double energy = 0;
  if (laws.cohesion == CohesionLaw::jkr) {
    const double a = jkr_contact_radius(c.effective_modulus, c.work_of_adhesion, effective_radius, overlap);
    return jkr_energy(c.effective_modulus, c.work_of_adhesion, effective_radius, a);
  }
  if (overlap > 0) {
    const double hertz =
        hertz_force(hertz_stiffness(c.effective_modulus, std::sqrt(effective_radius * overlap)), overlap);
    energy =
        laws.normal == NormalLaw::hertz ? hertz_energy(hertz, overlap) : hooke_energy(c.stiffness, overlap);
  }
  if (laws.cohesion == CohesionLaw::sjkr) energy -= c.cohesion_energy_density * area_integral;
  if (laws.cohesion == CohesionLaw::dmt)
    energy -= dmt_attraction(c.work_of_adhesion, effective_radius) * overlap;
  if (laws.cohesion == CohesionLaw::van_der_waals)
    energy -= van_der_waals_work(c.hamaker_constant, c.cutoff, c.range, effective_radius, overlap);
  return energy;
}

}  // namespace

double kinetic_energy(const GrainRow& g) {
  return 0.5 * g.mass *
         (dot(g.velocity(), g.velocity()) + 0.4 * g.radius * g.radius * dot(g.spin(), g.spin()));
}

StoredEnergy stored_in_pair(const Simulation& sim, std::size_t k) {
  const PairContacts& list = sim.pair_contacts();
  if (list.memories().state(k) == ContactState::apart) return {};
  const GrainRow a = sim.row(list.pair(k).a);
  const GrainRow b = sim.row(list.pair(k).b);
  const double d = norm(separation(a.position(), b.position(), sim.search_space()));
  const double overlap = a.radius + b.radius - d;
  StoredEnergy stored;
  stored.normal = normal_potential(sim.model().laws, sim.constants(a.material, b.material),
                                   a.radius * b.radius / (a.radius + b.radius), overlap,
                                   d > 0 ? sphere_sphere_area_integral(a.radius, b.radius, d, overlap) : 0);
  stored.tangential = spring_energy(list.memories().sliding(k));
  stored.rolling = spring_energy(list.memories().rolling(k));
  return stored;
}

StoredEnergy stored_in_wall_contact(const Simulation& sim, const GrainRow& g, const WallContact& contact) {
  if (contact.state == ContactState::apart) return {};
  const double overlap = g.radius - wall_distance(sim.walls()[contact.wall], g.position()).distance;
  StoredEnergy stored;
  stored.normal =
      normal_potential(sim.model().laws, sim.constants(g.material, sim.model().walls[contact.wall].material),
                       g.radius, overlap, sphere_plane_area_integral(g.radius, overlap));
  stored.tangential = spring_energy(contact.sliding);
  stored.rolling = spring_energy(contact.rolling);
  return stored;
}

EnergyBalance energy_balance(const Simulation& sim) {
  EnergyBalance sum;
  const auto add = [&](const StoredEnergy& s) {
    sum.elastic_normal += s.normal;
    sum.elastic_tangential += s.tangential;
    sum.elastic_rolling += s.rolling;
  };
  for (const std::uint32_t slot : sim.slots_by_id()) {
    sum.kinetic += kinetic_energy(sim.row(slot));
    for (const Adjacent& e : sim.pair_contacts().of(slot)) {
      if (!e.second) add(stored_in_pair(sim, e.pair));
    }
    for (const WallContact& contact : sim.wall_contacts().of(slot)) {
      add(stored_in_wall_contact(sim, sim.row(slot), contact));
    }
  }
  for (const GrainEnergy& g : sim.grain_energies()) {
    sum.inserted += g.inserted;
    sum.gravity += g.gravity;
    sum.walls += g.walls;
    sum.heat += g.heat;
    sum.stilled += g.stilled;
    sum.carried += g.carried;
  }
  return sum;
}

}  // namespace interstice::dem
