// Particles as this library sees them: how many, where, how large. It knows nothing of who moves them.
#pragma once

#include <cstddef>

namespace interstice::voxel {

/// A view of spheres in columns [m]; owns nothing. `density` [kg/m^3] may be null.
struct SpheresView {
  std::size_t count = 0;
  const double* x = nullptr;
  const double* y = nullptr;
  const double* z = nullptr;
  const double* radius = nullptr;
  const double* density = nullptr;
};

}  // namespace interstice::voxel
