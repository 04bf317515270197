#include "dem/site_order.h"

#include <algorithm>
#include <cmath>

namespace interstice::dem {
namespace {

/// Of n rows the first, the last, the second, the last but one, and so on, so that none is farther than two
/// from its neighbours, also where the last is the first one's.
std::uint64_t folded(std::uint64_t row, std::uint64_t n) { return std::min(2 * row, 2 * (n - 1 - row) + 1); }

/// A box of grains, cut into slabs a grain thick along its longest side and into columns across it.
struct Sections {
  Vec3d lo, size;
  double cell;           // [m]
  int along, across[2];  // axes: rows of a slab lie along across[0]
  double columns[2];     // how many
  bool ring;             // of rows: the last touch the first

  Sections(const std::vector<GrainSite>& sites, const std::array<bool, 3>& periodic)
      : lo(sites.front().position()), size(lo) {
    double radius_sum = 0;
    for (const GrainSite& g : sites) {
      lo = {std::min(lo.x, g.x), std::min(lo.y, g.y), std::min(lo.z, g.z)};
      size = {std::max(size.x, g.x), std::max(size.y, g.y), std::max(size.z, g.z)};
      radius_sum += g.radius;
    }
    size = size - lo;
    cell = 2 * radius_sum / static_cast<double>(sites.size());
    along = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    across[0] = (along + 1) % 3, across[1] = (along + 2) % 3;
    if (size[across[0]] > size[across[1]]) std::swap(across[0], across[1]);
    const double slabs = std::max(1.0, size[along] / cell);
    const double in_slab = static_cast<double>(sites.size()) / slabs,
                 wanted = in_slab > kMostInSlab ? in_slab / kGrainsInSlabOfColumn : 1;
    const double side = std::sqrt(size[across[0]] * size[across[1]] / wanted);  // of nearly square section
    for (int i = 0; i < 2; ++i)
      columns[i] = wanted > 1 ? std::clamp(std::round(size[across[i]] / side), 1.0, 64.0) : 1;
    if (wanted > 1 && columns[0] == 1) columns[1] = std::clamp(std::ceil(wanted), 1.0, 4095.0);
    ring = periodic[across[1]] && columns[1] == 1;
  }

  /// Of column, slab and place in the slab: 12, 20 and 32 bits.
  std::uint64_t key(const Vec3d& p) const {
    const auto index = [&](double from_lo, double most) {
      return static_cast<std::uint64_t>(std::clamp(from_lo / cell, 0.0, most));
    };
    const auto column = [&](int i) {
      const double share = size[across[i]] > 0 ? (p[across[i]] - lo[across[i]]) / size[across[i]] : 0;
      return static_cast<std::uint64_t>(std::min(share * columns[i], columns[i] - 1));
    };
    const std::uint64_t row = index(p[across[1]] - lo[across[1]], 65535),
                        rows = index(size[across[1]], 32767) + 1;
    const std::uint64_t in_slab = (ring ? folded(std::min(row, rows - 1), rows) : row) << 16 |
                                  index(p[across[0]] - lo[across[0]], 65535);
    return (column(1) * static_cast<std::uint64_t>(columns[0]) + column(0)) << 52 |
           index(p[along] - lo[along], 1048575) << 32 | in_slab;
  }
};

}  // namespace

std::vector<std::uint32_t> order_in_space(const std::vector<GrainSite>& sites,
                                          const std::array<bool, 3>& periodic) {
  if (sites.empty()) return {};
  const Sections sections(sites, periodic);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) keys[i] = {sections.key(sites[i].position()), i};
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].second;
  return order;
}

}  // namespace interstice::dem
