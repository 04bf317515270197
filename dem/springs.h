// The springs of contacts in memory: by group of kLanes contacts, number and lane, in the kernels' number
// type.
#pragma once

#include "dem/contact/mindlin.h"
#include "dem/lanes.h"
#include "dem/reals.h"

namespace interstice::dem {

/// Numbers of one spring: force [N] and stiffness [N/m].
inline constexpr std::size_t kSpringReals = 4;
/// Where number `n` of a contact's spring lies.
constexpr std::size_t spring_index(std::size_t contact, std::size_t n) {
  return (contact / kLanes * kSpringReals + n) * kLanes + contact % kLanes;
}
/// The same of a vector of each contact.
constexpr std::size_t axis_index(std::size_t contact, std::size_t axis) {
  return (contact / kLanes * 3 + axis) * kLanes + contact % kLanes;
}

/// Zero where none are kept.
inline TangentialSpring<double> spring_at(const Reals& springs, std::size_t contact) {
  if (springs.empty()) return {};
  const auto number = [&](std::size_t n) { return springs[spring_index(contact, n)]; };
  return {{number(0), number(1), number(2)}, number(3)};
}

inline void set_spring(Reals& springs, std::size_t contact, const TangentialSpring<double>& spring) {
  for (int axis = 0; axis < 3; ++axis)
    springs.set(spring_index(contact, static_cast<std::size_t>(axis)), spring.force[axis]);
  springs.set(spring_index(contact, 3), spring.stiffness);
}

inline void copy_spring(const Reals& from, std::size_t old_contact, Reals& to, std::size_t contact) {
  for (std::size_t n = 0; n < kSpringReals; ++n)
    to.set(spring_index(contact, n), from[spring_index(old_contact, n)]);
}

inline Vec3d vector_at(const Reals& vectors, std::size_t contact) {
  if (vectors.empty()) return {0, 0, 0};
  const auto number = [&](std::size_t n) { return vectors[axis_index(contact, n)]; };
  return {number(0), number(1), number(2)};
}

}  // namespace interstice::dem
