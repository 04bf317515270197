// The loop over groups of pairs, for any laws and number type: a pair a lane. What may differ from pair to
// pair is a mask or a select, so that a pair's bits do not depend on its neighbours in the list.
#pragma once

#include "dem/flatten.h"
#include "dem/kernels/ask_ahead.h"
#include "dem/kernels/contact_group.h"
#include "dem/kernels/rows.h"

namespace interstice::dem {

/// The forces of a group of pairs from their first ends: out of the way of the steps that keep none.
template <class Real>
[[gnu::noinline]] void keep_forces(const PairView& pairs, std::size_t group) {
  for (std::size_t k = group * kLanes; k < (group + 1) * kLanes; ++k) {
    const Real* const force = simd::row_at<Real>(pairs.end_forces, pairs.ends[k].a);
    for (int axis = 0; axis < 3; ++axis) static_cast<Real*>(pairs.forces)[axis_index(k, axis)] = force[axis];
  }
}

/// A pair's force and torques, to each of its ends.
template <class P>
void store_ends(const StepView& v, std::size_t group, const Vec3<P>& force, const Vec3<P>& torque_a,
                const Vec3<P>& torque_b) {
  using Real = RealOf<P>;
  using Quads = simd::Quads<Real, kLanes>;
  const PairEnds* const ends = v.pairs.ends + group * kLanes;
  const P zero(0);
  const Quads across(force.x, force.y, force.z, zero);
  const simd::OctStorer<Real, kLanes> to_a(across, Quads(torque_a.x, torque_a.y, torque_a.z, zero)),
      to_b(-across, Quads(torque_b.x, torque_b.y, torque_b.z, zero));
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    to_a.template store<i>(simd::row_at<Real>(v.pairs.end_forces, ends[i].a));
    to_b.template store<i>(simd::row_at<Real>(v.pairs.end_forces, ends[i].b));
  });
  if (v.pairs.forces) [[unlikely]]
    keep_forces<Real>(v.pairs, group);
}

/// How the surfaces of a group's grains move against each other.
template <class L, class P>
ContactKinematics<P> pair_kinematics(const L& laws, const PairGeometry<P>& g, const GrainRows<P>& a,
                                     const GrainRows<P>& b, const P& effective_radius, P& arm_a, P& arm_b) {
  ContactKinematics<P> kin;
  const bool beyond = laws.cohesion == CohesionLaw::jkr;
  kin.overlap = beyond ? g.overlap : max_of(g.overlap, P(0));
  kin.effective_radius = effective_radius;
  kin.effective_mass = inverse_of(a.inverse_mass + b.inverse_mass);
  kin.normal = g.normal;
  if (laws.cohesion == CohesionLaw::sjkr) {
    kin.area = sphere_sphere_area(a.radius, b.radius, g.distance, g.inverse_distance, kin.overlap);
  }
  arm_a = a.radius - P(0.5) * kin.overlap;
  arm_b = b.radius - P(0.5) * kin.overlap;
  kin.velocity = a.velocity - b.velocity;
  kin.relative_spin = a.spin - b.spin;
  if (laws.tangential != TangentialLaw::none) {
    // arm_a w_a + arm_b w_b, exactly 0 for equal grains that roll on each other
    const Vec3<P> surface = multiply_add(P(0.5) * (arm_a + arm_b), a.spin + b.spin,
                                         (P(0.5) * (arm_a - arm_b)) * kin.relative_spin);
    kin.velocity = kin.velocity - cross(surface, g.normal);
  }
  return kin;
}

/// What pairs have in common.
template <class P>
struct CommonInputs {
  StepConstants<P> step;
  Periods periods;
  PairConstants<P> constants;  // where there is only one material
};

/// No force in a group of pairs.
template <class P>
void leave_apart(const StepView& v, std::size_t group) {
  const Vec3<P> none{P(0), P(0), P(0)};
  store_ends(v, group, none, none, none);
  if (v.pairs.heat) std::fill_n(v.pairs.heat + group * kLanes, kLanes, PairHeat{});
}

template <bool one_material, class L, class P>
void evaluate_group(const L& laws, const StepView& v, const CommonInputs<P>& common,
                    const PairSites<P>& sites, std::size_t group, const MemoryAhead& piece) {
  using Real = RealOf<P>;
  using M = typename P::M;
  const std::size_t first = group * kLanes;
  GroupBits& bits = v.pairs.bits[group];
  const PairRef* pairs = v.pairs.pairs + first;
  const PairRows<P> rows = load_pair_rows<P>(v, group);
  const GrainRows<P>&a = rows.a, &b = rows.b;
  const PairGeometry<P> g = pair_geometry(sites, a.radius + b.radius);
  const PairConstants<P> c =
      one_material ? common.constants : load_constants<P>([&](int lane) -> const PairConstants<Real>& {
        return constants_of<Real>(v, v.materials[pairs[lane].a], v.materials[pairs[lane].b]);
      });
  const P effective_radius = a.radius * b.radius * g.inverse_reach;
  P attraction(0);
  const ContactStates s = contact_states(laws, bits, g.overlap, c, effective_radius, attraction);
  const M touching = M::from_bits(s.touching);

  P arm_a, arm_b;
  const ContactKinematics<P> kin = pair_kinematics(laws, g, a, b, effective_radius, arm_a, arm_b);
  const auto spring = [&](void* springs) { return static_cast<Real*>(springs) + spring_index(first, 0); };
  ContactMemory<P> memory{};
  if (laws.tangential == TangentialLaw::mindlin) memory.sliding = load_spring<P>(spring(v.pairs.sliding));
  if (laws.rolling == RollingLaw::epsd2) memory.rolling = load_spring<P>(spring(v.pairs.rolling));
  const ContactForce<P> f = evaluate_contact(laws, kin, c, memory, common.step);

  if (laws.tangential == TangentialLaw::mindlin)
    store_spring(f.memory.sliding, touching, spring(v.pairs.sliding));
  if (laws.rolling == RollingLaw::epsd2) store_spring(f.memory.rolling, touching, spring(v.pairs.rolling));
  // Here, not before the rows are loaded: what is asked for would hold up what they miss.
  ask_ahead<Real>(laws, v, group, piece);
  const Vec3<P> none{P(0), P(0), P(0)};
  Vec3<P> across = none;
  if (laws.cohesion == CohesionLaw::van_der_waals)
    across = select(M::from_bits(s.attracting), -attraction * g.normal, none);
  Vec3<P> torque_a = none, torque_b = none;
  if (laws.tangential != TangentialLaw::none || laws.rolling != RollingLaw::none) {
    const Vec3<P> turning = cross(g.normal, f.tangential);
    torque_a = subtract_product(arm_a, turning, f.rolling_torque);
    torque_b = subtract_product(arm_b, turning, -f.rolling_torque);
  }
  Vec3<P> force = f.force;
  if (!fades_out(laws)) {
    force = select(touching, force, across);
    torque_a = select(touching, torque_a, none), torque_b = select(touching, torque_b, none);
  }
  store_ends(v, group, force, torque_a, torque_b);
  if constexpr (kCountsHeat<L>) {
    const P torn = s.torn != 0 ? tear_heat(c, effective_radius) : P(0);
    if (v.pairs.heat) store_heat(s, f, memory, torn, v.pairs.heat + first);
  }
  bits.touching = static_cast<std::uint16_t>(s.touching);
  bits.attracting = static_cast<std::uint16_t>(s.attracting);
}

template <bool one_material, class L, class P>
void evaluate_range(const L& laws, const StepView& v, const CommonInputs<P>& common, std::size_t begin,
                    std::size_t end, const MemoryAhead& ahead) {
  using Real = RealOf<P>;
  Pieces pieces(ahead, end - begin);
  for (std::size_t group = begin; group < end; ++group) {
    const MemoryAhead piece = pieces.next();
    const PairSites<P> sites = load_pair_sites<P>(v, common.periods, group);
    if (stay_apart(laws, v.pairs.bits[group], sites.excess)) {
      ask_ahead<Real>(laws, v, group, piece);
      leave_apart<P>(v, group);
    } else {
      evaluate_group<one_material>(laws, v, common, sites, group, piece);
    }
  }
}

/// Evaluates the groups [begin, end).
template <class L, class Real>
INTERSTICE_FLATTEN void evaluate_groups(const L& laws, const StepView& view, std::size_t begin,
                                        std::size_t end, const MemoryAhead& ahead) {
  if (begin == end) return;
  using P = simd::Pack<Real, kLanes>;
  const simd::FlushTinyNumbers flush;
  const StepView v = view;  // of which the compiler knows that nothing stored changes it
  CommonInputs<P> common{step_constants<P>(v.dt, v.slider_velocity), Periods(v.period), {}};
  if (v.only_material >= 0) {
    const auto m = static_cast<std::size_t>(v.only_material);
    common.constants = constants_of<Real>(v, m, m).template as<P>();
    evaluate_range<true>(laws, v, common, begin, end, ahead);
  } else {
    evaluate_range<false>(laws, v, common, begin, end, ahead);
  }
}

}  // namespace interstice::dem
