// How grains move, kLanes at a time.
//
// Synchronous Verlet: positions and velocities that the forces see all belong to the step's end. With
// half-step velocities a part of the approach leaks into the slip of large-small contacts (Vyas et al.,
// Comput. Phys. Commun. 310, 109524, 2025); v + a dt is as accurate as the positions and has no such lag.
// Between two steps the half-step velocity is kept, from which both follow:
//   v(t) = u + a(t) dt/2,   u' = v(t) + a(t) dt/2,   x' = x + u' dt,   predicted v' = u' + a(t) dt/2.
#pragma once

#include "dem/grain_store.h"
#include "dem/simd/transpose.h"

namespace interstice::dem {

/// A number of each grain of a group.
using Each = simd::Pack<double, kLanes>;

inline Vec3<Each> all_of(const Vec3d& v) { return {Each(v.x), Each(v.y), Each(v.z)}; }
inline Vec3<Each> load(const double* x, const double* y, const double* z) {
  return {Each::load(x), Each::load(y), Each::load(z)};
}
inline void store(const Vec3<Each>& v, double* x, double* y, double* z) {
  v.x.store(x), v.y.store(y), v.z.store(z);
}

/// Velocities half a step on.
inline Vec3<Each> half_step(const Vec3<Each>& velocity, const Vec3<Each>& acceleration, double half_dt) {
  return multiply_add(Each(half_dt), acceleration, velocity);
}

/// Present velocities and accelerations of a group.
struct GroupState {
  Vec3<Each> velocity, spin, acceleration, angular;
};

/// Forces on a group of grains, or accelerations: translation and rotation.
struct Pull {
  Vec3<Each> linear, angular;
};

/// Where a group's grains are now, and how far they went in the step.
struct GroupStep {
  Vec3<Each> position, step;
  Each radius;
};

/// Three numbers of each grain and a fourth, in the number type of the rows.
template <class Real>
simd::Quads<Real, kLanes> quads(const Vec3<Each>& v, const Each& fourth) {
  const auto w = simd::converted<Real>(v);
  return {w.x, w.y, w.z, simd::converted<Real>(fourth)};
}

/// Where a group's grains are; step 0.
template <class Real>
GroupStep load_sites(const PairRow<Real>* rows) {
  simd::QuadLoader<kLanes> sites;
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    sites.template load<i>(&rows[i].x);
  });
  const auto site = sites.columns();
  return {{site[0], site[1], site[2]}, {Each(0), Each(0), Each(0)}, site[3]};
}

struct AllLanes {
  constexpr bool has(int) const { return true; }
};
struct SomeLanes {
  std::uint32_t lanes;
  bool has(int lane) const { return (lanes >> lane & 1) != 0; }
};

/// Writes rows of some lanes.
template <class Real, class Lanes>
void store_rows(const GroupStep& at, const Vec3<Each>& velocity, const Vec3<Each>& spin,
                const Each& inverse_mass, PairRow<Real>* rows, const Lanes& lanes) {
  const auto places = quads<double>(at.position, at.radius);
  const simd::OctStorer<Real, kLanes> motion(quads<Real>(velocity, inverse_mass),
                                             quads<Real>(spin, at.radius));
  simd::unrolled<kLanes>([&](auto lane) {
    constexpr int i = decltype(lane)::value;
    if (!lanes.has(i)) return;
    places.template store<i>(&rows[i].x);
    motion.template store<i>(&rows[i].vx);
  });
}

/// Moves a group on, and predicts its velocities.
template <class Real>
GroupStep begin_motion(PairRow<Real>* rows, GroupMotion& m, const GroupState& now, double dt) {
  const Vec3<Each> u = half_step(now.velocity, now.acceleration, 0.5 * dt);
  const Vec3<Each> w = half_step(now.spin, now.angular, 0.5 * dt);
  store(u, m.vx, m.vy, m.vz);
  store(w, m.wx, m.wy, m.wz);
  GroupStep moved = load_sites(rows);
  moved.step = Each(dt) * u;
  moved.position = moved.position + moved.step;
  store_rows(moved, half_step(u, now.acceleration, 0.5 * dt), half_step(w, now.angular, 0.5 * dt),
             Each::load(m.inverse_mass), rows, AllLanes());
  return moved;
}

}  // namespace interstice::dem
