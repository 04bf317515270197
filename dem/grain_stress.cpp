#include "dem/grain_stress.h"

#include <cmath>

#include "base/parallel.h"
#include "dem/wall_distance.h"

namespace interstice::dem {
namespace {

/// What the contacts of one grain add up to.
struct Sum {
  double contacts = 0;
  std::array<double, 6> moment{};  // [N m]

  void add(const Vec3d& r, const Vec3d& f) {
    moment[0] += r.x * f.x, moment[1] += r.y * f.y, moment[2] += r.z * f.z;
    moment[3] += 0.5 * (r.x * f.y + r.y * f.x);
    moment[4] += 0.5 * (r.y * f.z + r.z * f.y);
    moment[5] += 0.5 * (r.x * f.z + r.z * f.x);
  }
};

Sum sum_of(const Simulation& sim, const SearchSpace& space, std::uint32_t slot) {
  const GrainSite grain = sim.site(slot);
  const PairContacts& pairs = sim.pair_contacts();
  Sum sum;
  for (const Adjacent& e : pairs.of(slot)) {
    if (pairs.memories().state(e.pair) == ContactState::apart) continue;
    const GrainSite other = sim.site(e.slot);
    const Vec3d across = separation(other.position(), grain.position(), space);
    const Vec3d force = (e.second ? -1.0 : 1.0) * pairs.memories().force(e.pair);
    sum.add((grain.radius / (grain.radius + other.radius)) * across, force);
    sum.contacts += pairs.touching(e.pair) ? 1 : 0;
  }
  for (const WallContact& c : sim.wall_contacts().of(slot)) {
    if (c.state == ContactState::apart) continue;
    const WallDistance surface = wall_distance(sim.walls()[c.wall], grain.position());
    sum.add(-surface.distance * surface.normal, c.force);
    sum.contacts += c.touching() ? 1 : 0;
  }
  return sum;
}

}  // namespace

GrainStresses grain_stresses(const Simulation& sim) {
  const std::vector<std::uint32_t> slots = sim.slots_by_id();
  const SearchSpace space = sim.search_space();
  GrainStresses all;
  all.contacts.resize(slots.size());
  for (auto& component : all.stress) component.resize(slots.size());
  for_each_block({slots.size(), 4096}, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Sum sum = sum_of(sim, space, slots[i]);
      const double r = sim.site(slots[i]).radius, volume = 4 * M_PI / 3 * (r * r * r);
      all.contacts[i] = sum.contacts;
      for (std::size_t c = 0; c < 6; ++c) all.stress[c][i] = sum.moment[c] / volume;
    }
  });
  return all;
}

}  // namespace interstice::dem
