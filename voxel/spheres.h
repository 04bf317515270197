// Particles as this library sees them: how many, where, how large. It knows nothing of who moves them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace interstice::voxel {

/// A view of spheres in columns [m]; owns nothing. All columns behind the radius may be null; those of
/// velocity and of stress are there together or not at all.
struct SpheresView {
  std::size_t count = 0;
  const double* x = nullptr;
  const double* y = nullptr;
  const double* z = nullptr;
  const double* radius = nullptr;
  const double* density = nullptr;          // [kg/m^3]
  std::array<const double*, 3> velocity{};  // [m/s]
  const double* coordination = nullptr;     // contacts
  std::array<const double*, 6> stress{};    // xx yy zz xy yz xz, means over the sphere, tension positive [Pa]
  const std::int32_t* bonded = nullptr;     // 0: not
  const std::int32_t* group = nullptr;      // class, from 0 on; below 0: none
};

}  // namespace interstice::voxel
