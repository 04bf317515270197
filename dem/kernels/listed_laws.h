// The combinations of laws that have a kernel of their own. Every other runs through one generic kernel, in
// which the laws are chosen at run time. A new combination is one line here.
#pragma once

#include <array>

#include "dem/contact/laws.h"

namespace interstice::dem {
namespace listed {

constexpr auto hooke = NormalLaw::hooke;
constexpr auto hertz = NormalLaw::hertz;
constexpr bool tension = false, clipped = true;
constexpr auto no_friction = TangentialLaw::none;
constexpr auto slider = TangentialLaw::slider;
constexpr auto mindlin = TangentialLaw::mindlin;
constexpr auto no_rolling = RollingLaw::none;
constexpr auto cdt = RollingLaw::cdt;
constexpr auto epsd2 = RollingLaw::epsd2;
constexpr auto no_cohesion = CohesionLaw::none;
constexpr auto sjkr = CohesionLaw::sjkr;
constexpr auto jkr = CohesionLaw::jkr;
constexpr auto dmt = CohesionLaw::dmt;
constexpr auto van_der_waals = CohesionLaw::van_der_waals;

}  // namespace listed

// clang-format off
inline constexpr auto kListedLaws = [] {
  using namespace listed;
  constexpr Laws list[] = {
    {hertz, tension, no_friction, no_rolling, no_cohesion},   // frictionless packings, granular gases
    {hertz, tension, mindlin,     no_rolling, no_cohesion},   // LAMMPS gran/hertz, Chung & Ooi
    {hertz, tension, mindlin,     cdt,        no_cohesion},   // LIGGGHTS hertz + cdt
    {hertz, tension, mindlin,     epsd2,      no_cohesion},   // LIGGGHTS hertz + epsd2
    {hertz, tension, mindlin,     cdt,        sjkr},          // compactors against static walls (paper 004)
    {hertz, tension, mindlin,     epsd2,      sjkr},
    {hertz, tension, mindlin,     no_rolling, sjkr},
    {hertz, tension, no_friction, no_rolling, jkr},
    {hertz, tension, mindlin,     no_rolling, jkr},           // LAMMPS granular jkr
    {hertz, tension, mindlin,     cdt,        jkr},           // EDEM Hertz-Mindlin with JKR (papers 002, 003)
    {hertz, tension, mindlin,     epsd2,      jkr},
    {hertz, tension, mindlin,     no_rolling, dmt},           // LAMMPS granular dmt
    {hertz, tension, mindlin,     cdt,        dmt},
    {hertz, tension, mindlin,     epsd2,      dmt},
    {hertz, tension, mindlin,     cdt,        van_der_waals},
    {hertz, tension, mindlin,     epsd2,      van_der_waals},
    {hertz, clipped, no_friction, no_rolling, no_cohesion},
    {hertz, clipped, mindlin,     no_rolling, no_cohesion},   // YADE Hertz-Mindlin
    {hertz, clipped, mindlin,     cdt,        no_cohesion},   // LIGGGHTS with limitForce
    {hertz, clipped, mindlin,     epsd2,      no_cohesion},
    {hooke, tension, no_friction, no_rolling, no_cohesion},
    {hooke, tension, slider,      no_rolling, no_cohesion},   // binder-jet model (paper 000)
    {hooke, tension, mindlin,     no_rolling, no_cohesion},   // foundry sand (paper 001), LAMMPS gran/hooke
    {hooke, tension, mindlin,     cdt,        no_cohesion},
  };
  return std::to_array(list);
}();
// clang-format on

}  // namespace interstice::dem
