// How a grain moves: x, y, z and what lies beside them in its row as one vector of four.
//
// Synchronous Verlet: positions and velocities that the forces see all belong to the step's end. With
// half-step velocities a part of the approach leaks into the slip of large-small contacts (Vyas et al.,
// Comput. Phys. Commun. 310, 109524, 2025); v + a dt is as accurate as the positions and has no such lag.
// Between two steps the half-step velocity is kept, from which both follow:
//   v(t) = u + a(t) dt/2,   u' = v(t) + a(t) dt/2,   x' = x + u' dt,   predicted v' = u' + a(t) dt/2.
#pragma once

#include "dem/grain_store.h"
#include "dem/simd/pack.h"

namespace interstice::dem {

using Four = simd::Pack<double, 4>;

inline auto three_lanes() { return Four::M::from_bits(7); }
/// The first three lanes; the fourth, which belongs to something else, is 0.
inline Four first_three(const Four& v) { return select(three_lanes(), v, Four(0)); }
inline Four four(const Vec3d& v) {
  const double lanes[4] = {v.x, v.y, v.z, 0};
  return Four::load(lanes);
}
inline Vec3d three(const Four& v) {
  double lanes[4];
  v.store(lanes);
  return {lanes[0], lanes[1], lanes[2]};
}

/// Puts three numbers into the row, in its number type; the fourth stays.
template <class Real>
void put_three(const Four& v, Real* at) {
  using Row = simd::Pack<Real, 4>;
  select(Row::M::from_bits(7), simd::converted<Real>(v), Row::load(at)).store(at);
}

/// Velocities half a step on.
inline Four half_step(const Four& velocity, const Four& acceleration, double half_dt) {
  return velocity + Four(half_dt) * acceleration;
}

/// Moves a grain on from the present velocities and accelerations (fourth lanes 0) and predicts its
/// velocities; returns how far it went along each axis.
template <class Real>
Four begin_motion(PairRow<Real>& row, GrainMotion& m, const Four& velocity, const Four& spin,
                  const Four& acceleration, const Four& angular, double dt) {
  const Four u = half_step(velocity, acceleration, 0.5 * dt), w = half_step(spin, angular, 0.5 * dt);
  put_three(u, &m.velocity.x);
  put_three(w, &m.spin.x);
  const Four step = Four(dt) * u;
  (Four::load(&row.x) + step).store(&row.x);  // the radius stays: the step's fourth lane is 0
  put_three(half_step(u, acceleration, 0.5 * dt), &row.vx);
  put_three(half_step(w, angular, 0.5 * dt), &row.wx);
  return step;
}

}  // namespace interstice::dem
