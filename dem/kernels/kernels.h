// The force loops of a step, chosen once per simulation: by the laws that the scene names and by the number
// type in which forces are computed.
#pragma once

#include "dem/contact/contact.h"
#include "dem/contacts.h"
#include "dem/grain_store.h"
#include "dem/model.h"
#include "dem/neighbours.h"
#include "dem/wall_contacts.h"

namespace interstice::dem {

/// What the force loops see: trivially copyable, owns nothing.
struct StepView {
  const void* rows;                              // PairRow of the kernels' number type
  const std::uint16_t* materials;                // of the grains
  Vec3d period;                                  // of the domain [m]; 0 along axes that are not periodic
  double dt;                                     // [s]
  double slider_velocity;                        // [m/s]
  const PairConstants<double>* constants;        // materials x materials
  const PairConstants<float>* constants_single;  // the same
  std::size_t material_count;
  std::int64_t only_material;  // of all grains; -1 where they differ

  PairView pairs;
  WallView near_walls;

  const Shape* walls;
  const Vec3d* wall_velocities;
  const Wall* wall_models;
};

/// Memory to bring near while groups of pairs are evaluated, because later ones touch it.
struct MemoryAhead {
  const char* begin = nullptr;
  const char* end = nullptr;

  /// What the groups [first, last) of `all` ask for.
  MemoryAhead share(std::size_t first, std::size_t last, std::size_t all) const {
    const auto at = [&](std::size_t group) {
      return begin + static_cast<std::size_t>(end - begin) * group / all;
    };
    return {at(first), at(last)};
  }
};

struct ForceKernels {
  /// Evaluates the groups of pairs [begin, end).
  void (*pairs)(const Laws&, const StepView&, std::size_t begin, std::size_t end, MemoryAhead ahead);
  /// Evaluates the groups of contacts with walls [begin, end).
  void (*walls)(const Laws&, const StepView&, std::size_t begin, std::size_t end);
  bool generic;  // laws chosen at run time
};

/// The kernels of a listed combination, or the generic ones.
ForceKernels find_kernels(const Laws& laws, Precision precision, bool energies);
/// Is the combination listed?
bool has_own_kernel(const Laws& laws);

}  // namespace interstice::dem
