// The loop over groups of pairs, for any laws and number type: a pair a lane. What may differ from pair to
// pair is a mask or a select, so that a pair's bits do not depend on its neighbours in the list.
#pragma once

#include "dem/flatten.h"
#include "dem/kernels/contact_group.h"
#include "dem/kernels/rows.h"

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

/// A pair's force and torques, to each of its ends.
template <class P>
void store_ends(const PairEnds* ends, const Vec3<P>& force, const Vec3<P>& torque_a, const Vec3<P>& torque_b,
                RealOf<P>* end_forces) {
  using Storer = simd::QuadStorer<RealOf<P>, kLanes>;
  const P zero(0);
  const Storer force_a({force.x, force.y, force.z, zero}), force_b({-force.x, -force.y, -force.z, zero}),
      turn_a({torque_a.x, torque_a.y, torque_a.z, zero}), turn_b({torque_b.x, torque_b.y, torque_b.z, zero});
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    RealOf<P>* const a = end_forces + kEndReals * ends[i].a;
    RealOf<P>* const b = end_forces + kEndReals * ends[i].b;
    force_a.template store<i>(a);
    turn_a.template store<i>(a + 4);
    force_b.template store<i>(b);
    turn_b.template store<i>(b + 4);
  });
}

/// How the surfaces of a group's grains move against each other.
template <class L, class P>
ContactKinematics<P> pair_kinematics(const L& laws, const PairGeometry<P>& g, const GrainRows<P>& a,
                                     const GrainRows<P>& b, const P& effective_radius, P& arm_a, P& arm_b) {
  ContactKinematics<P> kin;
  const bool beyond = laws.cohesion == CohesionLaw::jkr;
  kin.overlap = beyond ? g.overlap : max_of(g.overlap, P(0));
  kin.effective_radius = effective_radius;
  kin.effective_mass = a.mass * (b.mass * inverse_of(a.mass + b.mass));  // their product may underflow
  kin.normal = g.normal;
  if (laws.cohesion == CohesionLaw::sjkr) {
    kin.area = sphere_sphere_area(g.radius_a, g.radius_b, g.distance, kin.overlap);
  }
  arm_a = g.radius_a - P(0.5) * kin.overlap;
  arm_b = g.radius_b - P(0.5) * kin.overlap;
  kin.velocity = a.velocity - b.velocity;
  kin.relative_spin = a.spin - b.spin;
  if (laws.tangential != TangentialLaw::none) {
    // arm_a w_a + arm_b w_b, exactly 0 for equal grains that roll on each other
    const Vec3<P> surface =
        P(0.5) * ((arm_a + arm_b) * (a.spin + b.spin) + (arm_a - arm_b) * kin.relative_spin);
    kin.velocity = kin.velocity - cross(surface, g.normal);
  }
  return kin;
}

template <class L, class Real>
void evaluate_group(const L& laws, const StepView& v, const PairConstants<simd::Pack<Real, kLanes>>* only,
                    std::size_t group) {
  using P = simd::Pack<Real, kLanes>;
  using M = typename P::M;
  const std::size_t first = group * kLanes;
  GroupBits& bits = v.pairs.bits[group];
  const PairRef* pairs = v.pairs.pairs + first;
  const GrainRows<P> a = load_rows<P>(v, [&](int lane) { return pairs[lane].a; }),
                     b = load_rows<P>(v, [&](int lane) { return pairs[lane].b; });
  const PairGeometry<P> g = pair_geometry<P>(a.position, a.radius, b.position, b.radius, v.period);
  if (stay_apart(laws, bits, g.overlap)) {
    const Vec3<P> none{P(0), P(0), P(0)};
    store_ends(v.pairs.ends + first, none, none, none, static_cast<Real*>(v.pairs.end_forces));
    if (v.pairs.forces) std::fill_n(static_cast<Real*>(v.pairs.forces) + 3 * first, 3 * kLanes, Real(0));
    if (v.pairs.heat) std::fill_n(v.pairs.heat + first, kLanes, PairHeat{});
    return;  // still apart
  }
  const PairConstants<P> c = only ? *only : load_constants<Real>([&](int lane) -> const PairConstants<Real>& {
    const auto* rows = static_cast<const PairRow<Real>*>(v.rows);
    return constants_of<Real>(v, rows[pairs[lane].a].material, rows[pairs[lane].b].material);
  });
  const P effective_radius = g.radius_a * g.radius_b * g.inverse_reach;
  P attraction(0);
  const ContactStates s = contact_states(laws, bits, g.overlap, c, effective_radius, attraction);
  const M touching = M::from_bits(s.touching);

  P arm_a, arm_b;
  const ContactKinematics<P> kin = pair_kinematics(laws, g, a, b, effective_radius, arm_a, arm_b);
  const auto spring = [&](void* springs) { return static_cast<Real*>(springs) + kSpringReals * first; };
  ContactMemory<P> memory{};
  if (laws.tangential == TangentialLaw::mindlin) memory.sliding = load_spring<P>(spring(v.pairs.sliding));
  if (laws.rolling == RollingLaw::epsd2) memory.rolling = load_spring<P>(spring(v.pairs.rolling));
  const auto step = step_constants<P>(v.dt, v.slider_velocity);
  const ContactForce<P> f = evaluate_contact(laws, kin, c, memory, step);

  if (laws.tangential == TangentialLaw::mindlin)
    store_spring(f.memory.sliding, touching, spring(v.pairs.sliding));
  if (laws.rolling == RollingLaw::epsd2) store_spring(f.memory.rolling, touching, spring(v.pairs.rolling));
  const Vec3<P> none{P(0), P(0), P(0)};
  Vec3<P> across = none;
  if (laws.cohesion == CohesionLaw::van_der_waals)
    across = select(M::from_bits(s.attracting), -attraction * g.normal, none);
  Vec3<P> torque_a = none, torque_b = none;
  if (laws.tangential != TangentialLaw::none || laws.rolling != RollingLaw::none) {
    const Vec3<P> turning = cross(g.normal, f.tangential);
    torque_a = select(touching, f.rolling_torque - arm_a * turning, none);
    torque_b = select(touching, -f.rolling_torque - arm_b * turning, none);
  }
  const Vec3<P> force = select(touching, f.force, across);
  store_ends(v.pairs.ends + first, force, torque_a, torque_b, static_cast<Real*>(v.pairs.end_forces));
  if (v.pairs.forces) {
    Real* const forces = static_cast<Real*>(v.pairs.forces) + 3 * first;
    force.x.store(forces), force.y.store(forces + kLanes), force.z.store(forces + 2 * kLanes);
  }
  if constexpr (kCountsHeat<L>) {
    const P torn = s.torn != 0 ? tear_heat(c, effective_radius) : P(0);
    if (v.pairs.heat) store_heat(s, f, memory, torn, v.pairs.heat + first);
  }
  bits.touching = static_cast<std::uint16_t>(s.touching);
  bits.attracting = static_cast<std::uint16_t>(s.attracting);
}

template <class L, class Real>
INTERSTICE_FLATTEN void evaluate_groups(const L& laws, const StepView& v, std::size_t begin,
                                        std::size_t end) {
  using P = simd::Pack<Real, kLanes>;
  const simd::FlushTinyNumbers flush;
  if (v.only_material >= 0) {
    const auto m = static_cast<std::size_t>(v.only_material);
    const PairConstants<P> only = constants_of<Real>(v, m, m).template as<P>();
    for (std::size_t g = begin; g < end; ++g) evaluate_group<L, Real>(laws, v, &only, g);
  } else {
    for (std::size_t g = begin; g < end; ++g) evaluate_group<L, Real>(laws, v, nullptr, g);
  }
}

}  // namespace interstice::dem
