// Tangential spring with history and Coulomb limit (Mindlin 1949 no-slip stiffness; Cundall & Strack 1979 for
// the incremental form; Johnson, Contact Mechanics, 1985, eq. 7.43).
#pragma once

#include "base/vec3.h"
#include "dem/contact/numeric.h"

namespace interstice::dem {

template <class T>
struct TangentialForce {
  Vec3<T> force;         // [N]
  Vec3<T> displacement;  // the spring after this step [m]
};

/// `displacement` is the spring before this step. It is turned into the present tangent plane, lengthened by
/// `velocity * dt`, and shortened again where spring and dashpot together exceed `limit` = friction * |F_n|.
/// `stiffness` = 8 G* sqrt(R* overlap) [N/m].
template <class T>
INTERSTICE_HD inline TangentialForce<T> mindlin(const Vec3<T>& displacement, const Vec3<T>& normal,
                                                const Vec3<T>& velocity, const T& dt, const T& stiffness,
                                                const T& dashpot, const T& limit) {
  const Vec3<T> in_plane = displacement - dot(displacement, normal) * normal;
  const Vec3<T> spring = in_plane + dt * velocity;
  const Vec3<T> trial = -(stiffness * spring) - dashpot * velocity;
  const T magnitude = norm(trial);
  const auto slips = magnitude > limit;
  const T scale = limit / select(slips, magnitude, T(1));
  const Vec3<T> sliding = scale * trial;
  const Vec3<T> relaxed = (T(-1) / stiffness) * (sliding + dashpot * velocity);
  return {{select(slips, sliding.x, trial.x), select(slips, sliding.y, trial.y),
           select(slips, sliding.z, trial.z)},
          {select(slips, relaxed.x, spring.x), select(slips, relaxed.y, spring.y),
           select(slips, relaxed.z, spring.z)}};
}

}  // namespace interstice::dem
