// Which laws a scene names. The same names as in the scene file; each is one header of this folder.
#pragma once

namespace interstice::dem {

enum class NormalLaw { hooke, hertz };
enum class TangentialLaw { none, slider, mindlin };
enum class RollingLaw { none, cdt, epsd2 };
enum class CohesionLaw { none, sjkr, jkr, dmt, van_der_waals };

/// A choice of laws, known at run time.
struct Laws {
  NormalLaw normal = NormalLaw::hertz;
  bool clip = false;  // spring and dashpot together never attract
  TangentialLaw tangential = TangentialLaw::none;
  RollingLaw rolling = RollingLaw::none;
  CohesionLaw cohesion = CohesionLaw::none;

  bool operator==(const Laws&) const = default;
};

/// The same choice, known at compile time: what it does not name is compiled out.
template <Laws L>
struct FixedLaws {
  static constexpr NormalLaw normal = L.normal;
  static constexpr bool clip = L.clip;
  static constexpr TangentialLaw tangential = L.tangential;
  static constexpr RollingLaw rolling = L.rolling;
  static constexpr CohesionLaw cohesion = L.cohesion;
};

/// Do all forces of a contact vanish with its overlap?
constexpr bool fades_out(const auto& laws) {
  return laws.normal == NormalLaw::hertz &&
         (laws.cohesion == CohesionLaw::none || laws.cohesion == CohesionLaw::sjkr);
}

/// Does the tangential spring (or the rolling spring) need a memory?
constexpr bool keeps_spring(const Laws& laws) { return laws.tangential == TangentialLaw::mindlin; }
constexpr bool keeps_rolling_spring(const Laws& laws) { return laws.rolling == RollingLaw::epsd2; }

}  // namespace interstice::dem
