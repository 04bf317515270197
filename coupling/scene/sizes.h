// Sizes of grains drawn from a distribution, truncated to its [min, max], by number or by mass.
#pragma once

#include <cstdint>
#include <vector>

#include "coupling/scene/scene.h"

namespace interstice::scene {

/// The distribution by number of a group's diameters, tabulated finely enough that the error of a quantile is
/// far below a nanometre. A distribution by mass m(d) is one by number with density m(d) / d^3.
class SizeDistribution {
 public:
  explicit SizeDistribution(const Diameters& diameters);

  /// The diameter [m] that the share p (by number, 0 to 1) of grains do not exceed.
  double quantile(double p) const;
  /// The mean over grains of d^power: 1 the mean diameter [m], 3 what the solid volume needs [m^3].
  double moment(int power) const;
  double min() const { return min_; }
  double max() const { return max_; }

 private:
  /// Within a cell the density is a straight line that has the cell's share and first moment.
  struct Cell {
    double lo, width;  // [m]
    double below;      // share of all grains below `lo`
    double share;      // ... and within the cell
    double slope;      // density at the ends of the cell: (1 -+ slope) * share / width
  };
  std::vector<Cell> cells_;  // none: all grains are of size min
  double min_, max_;
};

/// `count` independent diameters [m]: a pure function of its arguments (base/random.h).
std::vector<double> sample_diameters(const Diameters& diameters, std::int64_t count, std::uint64_t seed,
                                     std::uint64_t stream);

/// The diameter [m] that the share p (by number) of grains do not exceed; for one call, else see
/// SizeDistribution.
double quantile(const Diameters& diameters, double p);

/// Of a group's grains, rained or listed [m]; an empty list has infinity and 0.
double smallest_diameter(const Particles& group);
double largest_diameter(const Particles& group);

}  // namespace interstice::scene
