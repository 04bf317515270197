#include "dem/packing.h"

#include <algorithm>
#include <cmath>

#include "base/random.h"
#include "dem/neighbours.h"

namespace interstice::dem {
namespace {

constexpr int kRounds = 1500, kRoundsPerSearch = 10;

/// One round: every overlapping pair is pushed apart, the lighter sphere farther.
void push_apart(std::vector<GrainSite>& sites, const std::vector<PairRef>& pairs, const SearchSpace& space,
                std::vector<Vec3d>& push) {
  std::fill(push.begin(), push.end(), Vec3d{0, 0, 0});
  for (const PairRef& p : pairs) {
    const GrainSite &a = sites[p.a], &b = sites[p.b];
    const Vec3d apart = separation(a.position(), b.position(), space);
    const double reach = a.radius + b.radius, d2 = dot(apart, apart);
    if (d2 >= reach * reach || d2 == 0) continue;
    const double d = std::sqrt(d2), mass_a = a.radius * a.radius * a.radius,
                 mass_b = b.radius * b.radius * b.radius, share = mass_b / (mass_a + mass_b);
    const Vec3d along = ((reach - d) / d) * apart;
    push[p.a] += share * along;
    push[p.b] -= (1 - share) * along;
  }
}

double wrapped(double p, double length) { return p - length * std::floor(p / length); }

void move(std::vector<GrainSite>& sites, const std::vector<Vec3d>& push, const SearchSpace& space) {
  for (std::size_t i = 0; i < sites.size(); ++i) {
    GrainSite& g = sites[i];
    g.x = wrapped(g.x + 0.6 * push[i].x, space.domain.hi.x);
    g.y = wrapped(g.y + 0.6 * push[i].y, space.domain.hi.y);
    g.z = std::clamp(g.z + 0.6 * push[i].z, g.radius, space.domain.hi.z - g.radius);
  }
}

}  // namespace

std::vector<NewGrain> pack_in_cell(const std::vector<double>& radii, double length_x, double length_y,
                                   double solid_fraction, std::uint64_t seed) {
  double volume = 0, largest = 0;
  for (const double r : radii) {
    volume += 4.0 / 3 * M_PI * r * r * r;
    largest = std::max(largest, r);
  }
  const double height = volume / (solid_fraction * length_x * length_y);
  const SearchSpace space{{{0, 0, 0}, {length_x, length_y, height}}, {true, true, false}, 0.3 * largest};
  Random random(seed, 0);
  std::vector<GrainSite> sites(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    sites[i].id = static_cast<std::int64_t>(i);
    sites[i].radius = radii[i];
    sites[i].x = random.uniform(0, length_x);
    sites[i].y = random.uniform(0, length_y);
    sites[i].z = random.uniform(radii[i], height - radii[i]);
  }
  std::vector<Vec3d> push(sites.size());
  std::vector<PairRef> pairs;
  for (int round = 0; round < kRounds; ++round) {
    if (round % kRoundsPerSearch == 0) pairs = find_pairs(sites, space);
    push_apart(sites, pairs, space, push);
    move(sites, push, space);
  }
  std::vector<NewGrain> grains;
  for (const GrainSite& g : sites) grains.push_back({g.position(), g.radius, {}, {}, 0, 0});
  return grains;
}

}  // namespace interstice::dem
