// The loop over groups of contacts with walls, for any laws and number type: a contact a lane. A wall is flat
// and heavy: R* = R, m* = m.
#pragma once

#include "dem/flatten.h"
#include "dem/kernels/contact_group.h"
#include "dem/kernels/rows.h"
#include "dem/wall_distance.h"

namespace interstice::dem {

/// How the grains of a group stand to their walls, and how these move.
template <class P>
struct WallGeometry {
  simd::Pack<double, kLanes> distance;  // [m]
  Vec3<P> normal, velocity;
};

template <class P>
WallGeometry<P> wall_geometry(const StepView& v, const WallContact* contacts, std::size_t count,
                              const Vec3<simd::Pack<double, kLanes>>& position) {
  using D = simd::Pack<double, kLanes>;
  double at[3][kLanes], distance[kLanes], normal[3][kLanes], velocity[3][kLanes];
  position.x.store(at[0]), position.y.store(at[1]), position.z.store(at[2]);
  for (std::size_t i = 0; i < kLanes; ++i) {
    const std::uint32_t wall = contacts[std::min(i, count - 1)].wall;
    const WallDistance surface = wall_distance(v.walls[wall], {at[0][i], at[1][i], at[2][i]});
    distance[i] = surface.distance;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      normal[axis][i] = surface.normal[static_cast<int>(axis)];
      velocity[axis][i] = v.wall_velocities[wall][static_cast<int>(axis)];
    }
  }
  const auto vector = [](const double(&columns)[3][kLanes]) {
    return simd::converted<RealOf<P>>(Vec3<D>{D::load(columns[0]), D::load(columns[1]), D::load(columns[2])});
  };
  return {D::load(distance), vector(normal), vector(velocity)};
}

template <class At>
GroupBits bits_of(const At& contact_at) {
  GroupBits bits;
  bits.listed = static_cast<std::uint16_t>(-1);
  for (int i = 0; i < static_cast<int>(kLanes); ++i) {
    const auto bit = static_cast<std::uint16_t>(1u << i);
    if (contact_at(i).state == ContactState::touching) bits.touching |= bit;
    if (contact_at(i).state == ContactState::attracting) bits.attracting |= bit;
  }
  return bits;
}

/// A spring that a contact keeps in double.
template <TangentialSpring<double> WallContact::*spring, class P, class At>
TangentialSpring<P> load_wall_spring(const At& contact_at) {
  simd::QuadLoader<kLanes> loader;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    loader.template load<i>(&(contact_at(i).*spring).force.x);
  });
  const auto c = loader.columns();
  const auto real = [](const auto& column) { return simd::converted<RealOf<P>>(column); };
  return {{real(c[0]), real(c[1]), real(c[2])}, real(c[3])};
}
template <TangentialSpring<double> WallContact::*spring, class P, class At>
void store_wall_spring(const TangentialSpring<P>& s, const typename P::M& kept, const At& contact_at) {
  const auto d = [&](const P& number) { return simd::converted<double>(select(kept, number, P(0))); };
  const simd::Quads<double, kLanes> storer(d(s.force.x), d(s.force.y), d(s.force.z), d(s.stiffness));
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    storer.template store<i>(&(contact_at(i).*spring).force.x);
  });
}

template <class P, class To>
void store_vectors(const Vec3<P>& v, const To& to) {
  const auto d = simd::converted<double>(v);
  const simd::Quads<double, kLanes> storer(d.x, d.y, d.z, simd::Pack<double, kLanes>(0));
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    storer.template store_three<i>(&to(i).x);
  });
}

inline void set_states(const ContactStates& s, WallContact* contacts, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    contacts[i].state = s.touching >> i & 1     ? ContactState::touching
                        : s.attracting >> i & 1 ? ContactState::attracting
                                                : ContactState::apart;
  }
}

/// Lanes beyond `count` <= kLanes repeat the last contact in everything: what they store is what that stores.
template <class L, class Real>
void evaluate_wall_group(const L& laws, const StepView& v, WallContact* contacts, std::size_t count,
                         WallEffect* effects) {
  using P = simd::Pack<Real, kLanes>;
  using M = typename P::M;
  const auto contact_at = [&](int lane) -> WallContact& {
    return contacts[std::min(static_cast<std::size_t>(lane), count - 1)];
  };
  const auto effect_at = [&](int lane) -> WallEffect& {
    return effects[std::min(static_cast<std::size_t>(lane), count - 1)];
  };
  simd::QuadLoader<kLanes> sites;
  RowLoader<P> rows;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    const auto& row = static_cast<const PairRow<Real>*>(v.rows)[contact_at(i).slot];
    sites.template load<i>(&row.x);
    rows.template load<i>(&row.vx);
  });
  const auto site = sites.columns();
  const GrainRows<P> grain = grain_rows<P>(rows);
  const WallGeometry<P> wall = wall_geometry<P>(v, contacts, count, {site[0], site[1], site[2]});
  const P overlap = simd::converted<Real>(site[3] - wall.distance);
  const GroupBits bits = bits_of(contact_at);
  if (stay_apart(laws, bits, overlap)) {
    std::fill_n(effects, count, WallEffect{});
    return;
  }
  const PairConstants<P> c = load_constants<P>([&](int lane) -> const PairConstants<Real>& {
    const WallContact& contact = contact_at(lane);
    return constants_of<Real>(v, v.materials[contact.slot], v.wall_models[contact.wall].material);
  });
  P attraction(0);
  const ContactStates s = contact_states(laws, bits, overlap, c, grain.radius, attraction);
  const M touching = M::from_bits(s.touching);

  ContactKinematics<P> kin{};
  kin.overlap = laws.cohesion == CohesionLaw::jkr ? overlap : max_of(overlap, P(0));
  kin.effective_radius = grain.radius;
  kin.effective_mass = inverse_of(grain.inverse_mass);
  kin.normal = wall.normal;
  if (laws.cohesion == CohesionLaw::sjkr) kin.area = sphere_plane_area(grain.radius, kin.overlap);
  const P arm = grain.radius - kin.overlap;
  kin.velocity = grain.velocity - wall.velocity;
  kin.relative_spin = grain.spin;
  if (laws.tangential != TangentialLaw::none)
    kin.velocity = kin.velocity - cross(arm * grain.spin, wall.normal);

  ContactMemory<P> memory{};
  if (laws.tangential == TangentialLaw::mindlin)
    memory.sliding = load_wall_spring<&WallContact::sliding, P>(contact_at);
  if (laws.rolling == RollingLaw::epsd2)
    memory.rolling = load_wall_spring<&WallContact::rolling, P>(contact_at);
  const ContactForce<P> f =
      evaluate_contact(laws, kin, c, memory, step_constants<P>(v.dt, v.slider_velocity));
  if (laws.tangential == TangentialLaw::mindlin)
    store_wall_spring<&WallContact::sliding>(f.memory.sliding, touching, contact_at);
  if (laws.rolling == RollingLaw::epsd2)
    store_wall_spring<&WallContact::rolling>(f.memory.rolling, touching, contact_at);

  const Vec3<P> none{P(0), P(0), P(0)};
  Vec3<P> across = none, torque = none;
  if (laws.cohesion == CohesionLaw::van_der_waals)
    across = select(M::from_bits(s.attracting), -attraction * wall.normal, none);
  if (laws.tangential != TangentialLaw::none || laws.rolling != RollingLaw::none)
    torque = select(touching, multiply_add(-arm, cross(wall.normal, f.tangential), f.rolling_torque), none);
  const Vec3<P> force = select(touching, f.force, across);
  store_vectors(force, [&](int lane) -> Vec3d& { return contact_at(lane).force; });
  store_vectors(torque, [&](int lane) -> Vec3d& { return effect_at(lane).torque; });
  set_states(s, contacts, count);
  if constexpr (kCountsHeat<L>) {
    PairHeat heat[kLanes];
    const P torn = s.torn != 0 ? tear_heat(c, grain.radius) : P(0);
    store_heat(s, f, memory, torn, heat);
    for (std::size_t i = 0; i < count; ++i) {
      effects[i].heat = heat[i];
      effects[i].power = dot(contacts[i].force, v.wall_velocities[contacts[i].wall]);
    }
  }
}

template <class L, class Real>
INTERSTICE_FLATTEN void evaluate_walls(const L& laws, const StepView& v, std::span<WallContact> contacts,
                                       WallEffect* effects) {
  const simd::FlushTinyNumbers flush;
  for (std::size_t first = 0; first < contacts.size(); first += kLanes) {
    evaluate_wall_group<L, Real>(laws, v, contacts.data() + first, std::min(kLanes, contacts.size() - first),
                                 effects + first);
  }
}

}  // namespace interstice::dem
