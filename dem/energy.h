// Where the energy of a simulation is and where it went. Kept only when SimulationOptions::energies says so;
// the sums run in the order of ids, so that they are the same bits whatever the threads and lists.
#pragma once

#include <vector>

#include "dem/contacts.h"
#include "dem/grains.h"
#include "dem/wall_contacts.h"

namespace interstice::dem {

class Simulation;

/// What has happened to one grain since it was inserted [J]. Of a contact's heat, each grain has half.
struct GrainEnergy {
  double inserted = 0;    // kinetic, and elastic where it was put into contact
  double gravity = 0;     // work of gravity on it
  double walls = 0;       // work of moving walls on it
  double wall_power = 0;  // of the walls at the last step [W]
  PairHeat heat;
  double stilled = 0;  // motion that it lost by falling asleep
  double carried = 0;  // what it took along when it left the domain
};

/// Energies of the whole at the present time [J].
struct EnergyBalance {
  double kinetic = 0;
  double elastic_normal = 0;      // in overlaps, less the work of attraction (0 for bodies just touching)
  double elastic_tangential = 0;  // in sliding springs
  double elastic_rolling = 0;     // in rolling springs
  PairHeat heat;                  // lost since the start, by mechanism
  double stilled = 0;             // motion of grains that fell asleep
  double inserted = 0, gravity = 0, walls = 0;  // brought in since the start
  double carried = 0;                           // gone with grains that left

  /// Everything that is there or was lost, less everything that was brought in: zero but for the error of the
  /// time step.
  double residual() const {
    return kinetic + elastic_normal + elastic_tangential + elastic_rolling + heat.damping + heat.sliding +
           heat.rolling + heat.adhesion + stilled + carried - inserted - gravity - walls;
  }
};

/// Valid after Simulation::advance(); zeros but for `kinetic` and the elastic parts where no energies are
/// kept.
EnergyBalance energy_balance(const Simulation& simulation);

/// Energy stored in one pair: in its overlap (with attraction), and in its springs [J].
struct StoredEnergy {
  double normal = 0, tangential = 0, rolling = 0;

  double sum() const { return normal + tangential + rolling; }
};
StoredEnergy stored_in_pair(const Simulation& simulation, std::size_t pair);
StoredEnergy stored_in_wall_contact(const Simulation& simulation, const GrainRow& grain,
                                    const WallContact& contact);

double kinetic_energy(const GrainRow& grain);

}  // namespace interstice::dem
