// The loop over groups of contacts with walls, for any laws and number type: a contact a lane. A wall is flat
// and heavy: R* = R, m* = m.
#pragma once

#include "dem/flatten.h"
#include "dem/kernels/contact_group.h"
#include "dem/kernels/rows.h"
#include "dem/wall_distance.h"

namespace interstice::dem {

/// How the grains of a group stand to their walls, and how these move.
struct WallSites {
  Doubles distance;  // [m]
  Vec3<Doubles> normal, velocity;
};

inline WallSites sites_at(const StepView& v, std::uint32_t wall, const Vec3<Doubles>& position) {
  const auto surface = wall_distance(v.walls[wall], position);
  return {surface.distance, surface.normal, in_every_lane<Doubles>(v.wall_velocities[wall])};
}

/// `walls`: of each lane, in ascending order.
inline WallSites wall_sites(const StepView& v, const std::uint32_t* walls, const Vec3<Doubles>& position) {
  WallSites sites = sites_at(v, walls[0], position);
  if (walls[0] == walls[kLanes - 1]) return sites;
  for (std::size_t lane = 1; lane < kLanes; ++lane) {
    if (walls[lane] == walls[lane - 1]) continue;
    const auto from_here = Doubles::M::from_bits(0xffffu & ~0u << lane);
    const WallSites next = sites_at(v, walls[lane], position);
    sites = {select(from_here, next.distance, sites.distance), select(from_here, next.normal, sites.normal),
             select(from_here, next.velocity, sites.velocity)};
  }
  return sites;
}

template <class P>
PairConstants<P> wall_constants(const StepView& v, const std::uint32_t* slots, const std::uint32_t* walls) {
  using Real = RealOf<P>;
  const auto of = [&](std::size_t material, std::uint32_t wall) -> const PairConstants<Real>& {
    return constants_of<Real>(v, material, v.wall_models[wall].material);
  };
  if (v.only_material >= 0 && walls[0] == walls[kLanes - 1])
    return of(static_cast<std::size_t>(v.only_material), walls[0]).template as<P>();
  return load_constants<P>(
      [&](int lane) -> const PairConstants<Real>& { return of(v.materials[slots[lane]], walls[lane]); });
}

/// Force and torque on each grain.
template <class P>
void store_wall_ends(const std::uint32_t* ends, const Vec3<P>& force, const Vec3<P>& torque,
                     void* end_forces) {
  using Real = RealOf<P>;
  using Quads = simd::Quads<Real, kLanes>;
  const simd::OctStorer<Real, kLanes> to(Quads(force.x, force.y, force.z, P(0)),
                                         Quads(torque.x, torque.y, torque.z, P(0)));
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    to.template store<i>(simd::row_at<Real>(end_forces, ends[i]));
  });
}

/// No force from the walls of a group.
template <class P>
void leave_walls_apart(const StepView& v, std::size_t group) {
  const std::size_t first = group * kLanes;
  const WallView& w = v.near_walls;
  const Vec3<P> none{P(0), P(0), P(0)};
  store_wall_ends(w.ends + first, none, none, v.pairs.end_forces);
  if (w.forces) store_columns(none, static_cast<RealOf<P>*>(w.forces) + axis_index(first, 0));
  if (w.heat) std::fill_n(w.heat + first, kLanes, PairHeat{}), std::fill_n(w.power + first, kLanes, 0.0);
}

template <class P>
ContactKinematics<P> wall_kinematics(const auto& laws, const GrainRows<P>& grain, const WallSites& wall,
                                     const P& overlap, P& arm) {
  using Real = RealOf<P>;
  ContactKinematics<P> kin{};
  kin.overlap = laws.cohesion == CohesionLaw::jkr ? overlap : max_of(overlap, P(0));
  kin.effective_radius = grain.radius;
  kin.effective_mass = inverse_of(grain.inverse_mass);
  kin.normal = simd::converted<Real>(wall.normal);
  if (laws.cohesion == CohesionLaw::sjkr) kin.area = sphere_plane_area(grain.radius, kin.overlap);
  arm = grain.radius - kin.overlap;
  kin.velocity = grain.velocity - simd::converted<Real>(wall.velocity);
  kin.relative_spin = grain.spin;
  if (laws.tangential != TangentialLaw::none)
    kin.velocity = kin.velocity - cross(arm * grain.spin, kin.normal);
  return kin;
}

template <class L, class Real>
void evaluate_wall_group(const L& laws, const StepView& v, std::size_t group) {
  using P = simd::Pack<Real, kLanes>;
  using M = typename P::M;
  const WallView& w = v.near_walls;
  const std::size_t first = group * kLanes;
  GroupBits& bits = w.bits[group];
  simd::QuadLoader<kLanes> places;
  RowLoader<P> rows;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    const auto& row = *simd::row_at<PairRow<Real>>(v.rows, w.rows[first + i]);
    places.template load<i>(&row.x);
    rows.template load<i>(&row.vx);
  });
  const auto place = places.columns();
  const WallSites wall = wall_sites(v, w.walls + first, {place[0], place[1], place[2]});
  const P overlap = simd::converted<Real>(place[3] - wall.distance);
  if (stay_apart(laws, bits, overlap)) return leave_walls_apart<P>(v, group);

  const GrainRows<P> grain = grain_rows<P>(rows);
  const PairConstants<P> c = wall_constants<P>(v, w.slots + first, w.walls + first);
  P attraction(0), arm;
  const ContactStates s = contact_states(laws, bits, overlap, c, grain.radius, attraction);
  const M touching = M::from_bits(s.touching);
  const ContactKinematics<P> kin = wall_kinematics<P>(laws, grain, wall, overlap, arm);
  const auto spring = [&](void* springs) { return static_cast<Real*>(springs) + spring_index(first, 0); };
  ContactMemory<P> memory{};
  if (laws.tangential == TangentialLaw::mindlin) memory.sliding = load_spring<P>(spring(w.sliding));
  if (laws.rolling == RollingLaw::epsd2) memory.rolling = load_spring<P>(spring(w.rolling));
  const ContactForce<P> f =
      evaluate_contact(laws, kin, c, memory, step_constants<P>(v.dt, v.slider_velocity));
  if (laws.tangential == TangentialLaw::mindlin) store_spring(f.memory.sliding, touching, spring(w.sliding));
  if (laws.rolling == RollingLaw::epsd2) store_spring(f.memory.rolling, touching, spring(w.rolling));

  const Vec3<P> none{P(0), P(0), P(0)};
  Vec3<P> across = none, torque = none;
  if (laws.cohesion == CohesionLaw::van_der_waals)
    across = select(M::from_bits(s.attracting), -attraction * kin.normal, none);
  if (laws.tangential != TangentialLaw::none || laws.rolling != RollingLaw::none)
    torque = select(touching, subtract_product(arm, cross(kin.normal, f.tangential), f.rolling_torque), none);
  const Vec3<P> force = select(touching, f.force, across);
  store_wall_ends(w.ends + first, force, torque, v.pairs.end_forces);
  if (w.forces) store_columns(force, static_cast<Real*>(w.forces) + axis_index(first, 0));
  if constexpr (kCountsHeat<L>) {
    const P torn = s.torn != 0 ? tear_heat(c, grain.radius) : P(0);
    if (w.heat) {
      store_heat(s, f, memory, torn, w.heat + first);
      dot(simd::converted<double>(force), wall.velocity).store(w.power + first);
    }
  }
  bits.touching = static_cast<std::uint16_t>(s.touching);
  bits.attracting = static_cast<std::uint16_t>(s.attracting);
}

/// Evaluates the groups of contacts with walls [begin, end).
template <class L, class Real>
INTERSTICE_FLATTEN void evaluate_walls(const L& laws, const StepView& view, std::size_t begin,
                                       std::size_t end) {
  if (begin == end) return;
  const simd::FlushTinyNumbers flush;
  const StepView v = view;  // of which the compiler knows that nothing stored changes it
  for (std::size_t group = begin; group < end; ++group) evaluate_wall_group<L, Real>(laws, v, group);
}

}  // namespace interstice::dem
