// What groups of pairs and of wall contacts share: which contacts of a group do what, and what they lose.
#pragma once

#include "dem/kernels/geometry.h"
#include "dem/kernels/pair_geometry.h"
#include "dem/simd/transpose.h"

namespace interstice::dem {

/// Springs of a group, by number and lane.
template <class P>
TangentialSpring<P> load_spring(const RealOf<P>* at) {
  return {{P::load(at), P::load(at + kLanes), P::load(at + 2 * kLanes)}, P::load(at + 3 * kLanes)};
}
template <class P>
void store_spring(const TangentialSpring<P>& spring, const typename P::M& kept, RealOf<P>* at) {
  select(kept, spring.force.x, P(0)).store(at);
  select(kept, spring.force.y, P(0)).store(at + kLanes);
  select(kept, spring.force.z, P(0)).store(at + 2 * kLanes);
  select(kept, spring.stiffness, P(0)).store(at + 3 * kLanes);
}

template <class P>
void store_columns(const Vec3<P>& v, RealOf<P>* at) {
  v.x.store(at), v.y.store(at + kLanes), v.z.store(at + 2 * kLanes);
}

/// Which contacts of a group do what in this step, a bit a contact.
struct ContactStates {
  std::uint32_t before;      // touching after the last step
  std::uint32_t touching;    // now
  std::uint32_t torn;        // necks that tear now
  std::uint32_t attracting;  // across a gap
  std::uint32_t parted;      // had a memory that is lost now
};

template <class L, class P>
ContactStates contact_states(const L& laws, const GroupBits& bits, const P& overlap,
                             const PairConstants<P>& c, const P& effective_radius, P& attraction) {
  ContactStates s{};
  s.before = bits.touching;
  const std::uint32_t overlapping = (overlap > P(0)).bits() & bits.listed;
  s.touching = overlapping;
  if (laws.cohesion == CohesionLaw::jkr) {
    const std::uint32_t necks = bits.touching & ~overlapping;
    const std::uint32_t holding = necks != 0 ? neck_holds(c, effective_radius, overlap).bits() & necks : 0;
    s.touching |= holding;
    s.torn = necks & ~holding;
  } else if (laws.cohesion == CohesionLaw::van_der_waals) {
    attraction = van_der_waals_attraction(c.hamaker_constant, c.cutoff, c.range, effective_radius, overlap);
    s.attracting = (attraction > P(0)).bits() & bits.listed & ~overlapping;
  }
  s.parted = (s.before | bits.attracting) & ~s.touching;
  return s;
}

/// Are all contacts of a group apart, and were before? Then it has no force and keeps nothing. `overlap`, or
/// any number of its sign.
template <class L, class P>
bool stay_apart(const L& laws, const GroupBits& bits, const P& overlap) {
  return laws.cohesion != CohesionLaw::van_der_waals && bits.touching == 0 &&
         ((overlap > P(0)).bits() & bits.listed) == 0;
}

template <class P>
void store_heat(const ContactStates& s, const ContactForce<P>& f, const ContactMemory<P>& before,
                const P& torn, PairHeat* heat) {
  using M = typename P::M;
  const M touching = M::from_bits(s.touching), parted = M::from_bits(s.parted);
  const P lost_sliding = select(parted, spring_energy(before.sliding), P(0));
  const P lost_rolling = select(parted, spring_energy(before.rolling), P(0));
  const P adhesion = select(M::from_bits(s.torn), torn, P(0));
  RealOf<P> columns[4][kLanes];
  select(touching, f.heat.damping, P(0)).store(columns[0]);
  select(touching, f.heat.sliding, lost_sliding).store(columns[1]);
  select(touching, f.heat.rolling, lost_rolling).store(columns[2]);
  adhesion.store(columns[3]);
  for (std::size_t i = 0; i < kLanes; ++i) {
    heat[i] = {static_cast<double>(columns[0][i]), static_cast<double>(columns[1][i]),
               static_cast<double>(columns[2][i]), static_cast<double>(columns[3][i])};
  }
}

/// Do laws chosen at compile time keep no account of energies? (kernel_table.h looks none up for that.)
template <class L>
inline constexpr bool kCountsHeat = std::is_same_v<L, Laws>;

}  // namespace interstice::dem
