// Tangential spring with history and Coulomb limit: stiffness of Mindlin (J. Appl. Mech. 16, 1949, no slip;
// Johnson, Contact Mechanics, 1985, eq. 7.43), incremental force of Cundall & Strack (1979), lessened with
// the contact when it unloads so that no energy is made (Thornton, Cummins & Cleary, Powder Technol. 233,
// 2013).
#pragma once

#include "base/vec3.h"
#include "dem/contact/numeric.h"

namespace interstice::dem {

/// What a tangential contact remembers.
template <class T>
struct TangentialSpring {
  Vec3<T> force;    // of the spring on the first body [N]
  T stiffness = 0;  // with which that was stored [N/m]; 0 before the first step of a contact
};

template <class T>
struct TangentialForce {
  Vec3<T> force;               // on the first body [N]
  TangentialSpring<T> spring;  // after this step
  T slip_heat;                 // lost to slip and to the changing contact in this step [J]
  T damping_heat;              // lost in the dashpot in this step [J]
};

/// The spring's force is turned into the present tangent plane, lessened in proportion when the stiffness has
/// fallen, and changed by `-stiffness * velocity * dt`. Where it and the dashpot together exceed `limit`
/// = friction * |F_n|, the contact slides: the force is `limit`, the spring holds just that, and the dashpot
/// rests. `stiffness` = 8 G* a [N/m], a the contact radius.
template <class T>
INTERSTICE_HD inline TangentialForce<T> mindlin_force(const TangentialSpring<T>& old, const Vec3<T>& normal,
                                                      const Vec3<T>& velocity, const T& dt,
                                                      const T& stiffness, const T& dashpot, const T& limit) {
  const auto unloads = stiffness < old.stiffness;
  const T lessened = select(unloads, stiffness * inverse_of(select(unloads, old.stiffness, T(1))), T(1));
  const Vec3<T> kept = lessened * subtract_product(dot(old.force, normal), normal, old.force);
  const Vec3<T> spring = subtract_product(stiffness * dt, velocity, kept);
  const Vec3<T> trial = subtract_product(dashpot, velocity, spring);
  const T held = limit * inverse_length_of(trial);  // what share of it friction can hold
  const auto slides = held < T(1);
  TangentialForce<T> out;
  out.force = select(slides, held * trial, trial);
  out.spring = {select(slides, out.force, spring), stiffness};

  const T compliance = T(1) / max_of(stiffness, T(1e-30));  // a contact of zero overlap has no stiffness
  const Vec3<T> slip = compliance * (out.spring.force - spring);
  const auto remembers = old.stiffness > T(0);
  const T stored = dot(old.force, old.force) / select(remembers, old.stiffness, T(1));
  const T relaxed = select(remembers, stored, T(0)) - compliance * dot(kept, kept);
  out.slip_heat = T(0.5) * (relaxed - dot(kept + out.spring.force, slip));
  out.damping_heat = select(slides, T(0), dashpot * dt * dot(velocity, velocity));
  return out;
}

/// Energy in the spring [J].
template <class T>
INTERSTICE_HD inline T spring_energy(const TangentialSpring<T>& spring) {
  const auto remembers = spring.stiffness > T(0);
  return select(remembers,
                T(0.5) * dot(spring.force, spring.force) / select(remembers, spring.stiffness, T(1)), T(0));
}

}  // namespace interstice::dem
