// How quantities are summed: a cell has channels, and each sphere adds its share of the cell, times a number
// of its own, to those that are asked for. Shares are found once for all channels.
//
//   channel 0             the share itself
//   the next `linear`     share times a weight
//   the next `groups`     the share, in the channel of the sphere's class
//   the last 3, or 4      the running mean of the velocity, and the second moment about it
//
// The mean moves with each sphere by its part of what is summed so far, and the second moment grows by what
// that leaves (D. H. D. West, Commun. ACM 22, 1979, 532). So neither a velocity common to all spheres nor one
// that differs from place to place costs digits: the moment of one sphere alone is 0, not a difference.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "base/vec3.h"
#include "voxel/quantities.h"

namespace interstice::voxel {

/// How a number of a voxel follows from its channels.
enum class Reading { sum, mean_velocity, second_moment, pressure, mask };

struct Output {
  QuantityGrid quantity;  // its grids are still null
  Reading reading = Reading::sum;
  int channel = 0;    // that is read; pressure: the first of the three that it is the mean of
  double factor = 1;  // of Reading::sum

  bool is_mass() const { return quantity.name == "mass_density"; }
  bool averageable() const { return reading != Reading::mask && !is_mass(); }
};

struct Channels {
  std::vector<Output> outputs;
  int linear = 0, groups = 0;
  bool velocity = false, moment = false;
  std::vector<double> weights;  // of channels 1 to linear, sphere after sphere
  const std::int32_t* group = nullptr;
  std::array<const double*, 3> v{};
  Vec3d reference;  // mean velocity of all spheres [m/s]: averages are formed relative to it

  int count() const { return 1 + linear + groups + (velocity ? 3 : 0) + (moment ? 1 : 0); }
  int first_velocity() const { return 1 + linear + groups; }
  bool none() const { return outputs.empty(); }
  bool only_shares() const { return count() == 1; }
  const double* weights_of(std::size_t sphere) const {
    return weights.data() + sphere * static_cast<std::size_t>(linear);
  }
};

/// For what is asked for, and for the mass density where spheres carry a density or `density` [kg/m^3] is
/// not 0. The spheres must outlive it.
Channels channels_for(const SpheresView& spheres, const QuantityRequest& request, double density);

/// What sums and conservation are about: the quantity's part of the cell. The quantity is this itself, or
/// this over the solid. Calls visit(part), where part(at) is a cell's, `at` its channel 0, channels `plane`
/// apart: how a quantity is read is found once, not in each cell.
template <class Visit>
auto with_part_of(const Output& output, std::int64_t plane, const Visit& visit) {
  const std::int64_t channel = output.channel * plane;
  switch (output.reading) {
    case Reading::pressure:
      return visit([=](const double* at) {
        return -(at[channel] + at[channel + plane] + at[channel + 2 * plane]) / 3;
      });
    case Reading::mean_velocity:
      return visit([=](const double* at) { return at[0] * at[channel]; });
    case Reading::second_moment:
      return visit([=](const double* at) { return at[channel] / 3; });
    case Reading::mask:
      return visit([=](const double* at) { return at[channel] > 0 ? at[0] : 0.0; });
    case Reading::sum:
      break;
  }
  return visit([=, factor = output.factor](const double* at) { return factor * at[channel]; });
}

/// The same for sums over an averaging window: velocities are relative to the reference, and the second
/// moment is about it.
double windowed_part_of(const Output& output, const Channels& channels, const double* at, std::int64_t plane);

}  // namespace interstice::voxel
