#include "coupling/scene/sizes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/random.h"

namespace interstice::scene {
namespace {

double bell(double d, double mean, double sd) {
  const double z = (d - mean) / sd;
  return std::exp(-0.5 * z * z) / sd;
}

/// The density as given (by number or by mass), up to a factor.
double given_density(const Diameters& law, double d) {
  switch (law.law) {
    case SizeLaw::normal:
      return bell(d, law.mean, law.sd);
    case SizeLaw::lognormal:
      return bell(std::log(d / law.mean), 0, law.sd) / d;
    case SizeLaw::bimodal:
      return (1 - law.share2) * bell(d, law.mean, law.sd) + law.share2 * bell(d, law.mean2, law.sd2);
    case SizeLaw::table: {
      const auto& edge = law.table_diameter;
      const auto above = std::upper_bound(edge.begin(), edge.end(), d);
      const auto k = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(
          above - edge.begin() - 1, 0, static_cast<std::ptrdiff_t>(law.table_share.size()) - 1));
      return law.table_share[k] / (edge[k + 1] - edge[k]);
    }
    default:
      return 1;
  }
}

/// The density by number, up to a factor.
double number_density(const Diameters& law, double d) {
  const double density = given_density(law, d);
  if (law.weight == SizeWeight::number) return density;
  const double relative = d / law.min;  // keeps d^3 near one
  return density / (relative * relative * relative);
}

/// Nodes that resolve the cut, the steep end of d^-3, the modes however narrow, and the classes of a table.
std::vector<double> nodes(const Diameters& law) {
  constexpr int n = 2000;
  std::vector<double> nodes{law.min, law.max};
  for (int i = 1; i < n; ++i) {
    const double t = static_cast<double>(i) / n;
    nodes.push_back(law.min + t * (law.max - law.min));
    nodes.push_back(law.min * std::pow(law.max / law.min, t));
  }
  const auto around = [&](double mean, double sd, bool logarithmic) {
    for (int i = -n; i <= n; ++i) {
      const double z = 8.0 * i / n;
      nodes.push_back(logarithmic ? mean * std::exp(z * sd) : mean + z * sd);
    }
  };
  if (law.law == SizeLaw::normal || law.law == SizeLaw::bimodal) around(law.mean, law.sd, false);
  if (law.law == SizeLaw::lognormal) around(law.mean, law.sd, true);
  if (law.law == SizeLaw::bimodal) around(law.mean2, law.sd2, false);
  nodes.insert(nodes.end(), law.table_diameter.begin(), law.table_diameter.end());
  std::erase_if(nodes, [&](double d) { return !(d >= law.min && d <= law.max); });
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

// Gauss-Legendre with five points on [-1, 1]: exact for polynomials up to degree nine.
constexpr std::array<double, 5> kPoints{-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                        0.9061798459386640};
constexpr std::array<double, 5> kWeights{0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                         0.4786286704993665, 0.2369268850561891};

}  // namespace

SizeDistribution::SizeDistribution(const Diameters& law) : min_(law.min), max_(law.max) {
  if (law.law == SizeLaw::single || !(law.min < law.max)) return;
  const auto edges = nodes(law);
  double total = 0;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double half = 0.5 * (edges[i + 1] - edges[i]), middle = edges[i] + half;
    double integral = 0, first = 0;
    for (std::size_t k = 0; k < kPoints.size(); ++k) {
      const double part = half * kWeights[k] * number_density(law, middle + half * kPoints[k]);
      integral += part;
      first += part * kPoints[k];
    }
    if (!(integral > 0)) continue;  // an empty class, or a tail that underflows
    // a line (1 + slope t) / 2 on [-1, 1] has the first moment slope / 3; it must not turn negative
    cells_.push_back(
        {edges[i], edges[i + 1] - edges[i], total, integral, std::clamp(3 * first / integral, -1.0, 1.0)});
    total += integral;
  }
  for (Cell& cell : cells_) {
    cell.below /= total;
    cell.share /= total;
  }
}

double SizeDistribution::quantile(double p) const {
  if (cells_.empty()) return min_;
  if (p <= 0) return min_;
  if (p >= 1) return max_;
  const auto above = std::upper_bound(cells_.begin(), cells_.end(), p,
                                      [](double value, const Cell& cell) { return value < cell.below; });
  const Cell& cell = above == cells_.begin() ? cells_.front() : *(above - 1);
  const double u = std::clamp((p - cell.below) / cell.share, 0.0, 1.0);
  // the share up to s in [0, 1] of the cell is s (1 - a) + a s^2; solved without cancellation
  const double a = cell.slope, b = 1 - a;
  const double root = b + std::sqrt(std::max(0.0, b * b + 4 * a * u));
  const double s = root > 0 ? std::min(1.0, 2 * u / root) : 0.0;
  return std::clamp(cell.lo + s * cell.width, min_, max_);
}

double SizeDistribution::moment(int power) const {
  if (cells_.empty()) return std::pow(min_, power);
  double sum = 0;
  for (const Cell& cell : cells_)
    for (std::size_t k = 0; k < kPoints.size(); ++k)
      sum += cell.share * 0.5 * kWeights[k] * (1 + cell.slope * kPoints[k]) *
             std::pow(cell.lo + 0.5 * (1 + kPoints[k]) * cell.width, power);
  return sum;
}

std::vector<double> sample_diameters(const Diameters& diameters, std::int64_t count, std::uint64_t seed,
                                     std::uint64_t stream) {
  const SizeDistribution distribution(diameters);
  Random random(seed, stream);
  std::vector<double> sizes;
  sizes.reserve(static_cast<std::size_t>(std::max<std::int64_t>(count, 0)));
  for (std::int64_t i = 0; i < count; ++i) sizes.push_back(distribution.quantile(random.uniform()));
  return sizes;
}

double quantile(const Diameters& diameters, double p) { return SizeDistribution(diameters).quantile(p); }

double smallest_diameter(const Particles& group) {
  double smallest = group.rain ? group.diameter.min : std::numeric_limits<double>::infinity();
  if (group.list)
    for (const PlacedGrain& grain : group.list->grains) smallest = std::min(smallest, grain.diameter);
  return smallest;
}

double largest_diameter(const Particles& group) {
  double largest = group.rain ? group.diameter.max : 0;
  if (group.list)
    for (const PlacedGrain& grain : group.list->grains) largest = std::max(largest, grain.diameter);
  return largest;
}

}  // namespace interstice::scene
