#include "dem/site_order.h"

#include <algorithm>
#include <cmath>

namespace interstice::dem {
namespace {

std::uint64_t spread_bits(std::uint64_t v) {  // 16 bits, a zero after each
  v &= 0xffff;
  v = (v | v << 8) & 0x00ff00ffull;
  v = (v | v << 4) & 0x0f0f0f0full;
  v = (v | v << 2) & 0x33333333ull;
  return (v | v << 1) & 0x55555555ull;
}

/// A box of grains, cut into slabs a grain thick along its longest side and into columns across it.
struct Sections {
  Vec3d lo, size;
  double cell;  // [m]
  int along, across[2];
  double columns[2];  // how many

  explicit Sections(const std::vector<GrainSite>& sites) : lo(sites.front().position()), size(lo) {
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
    const double slabs = std::max(1.0, size[along] / cell);
    const double in_slab = static_cast<double>(sites.size()) / slabs,
                 wanted = in_slab > kMostInSlab ? in_slab / kGrainsInSlabOfColumn : 1;
    const double side = std::sqrt(size[across[0]] * size[across[1]] / wanted);  // of nearly square section
    for (int i = 0; i < 2; ++i)
      columns[i] = wanted > 1 ? std::clamp(std::round(size[across[i]] / side), 1.0, 64.0) : 1;
    const int longer = size[across[0]] >= size[across[1]] ? 0 : 1;
    if (wanted > 1 && columns[1 - longer] == 1) columns[longer] = std::clamp(std::ceil(wanted), 1.0, 4095.0);
  }

  /// Of column, slab and place in the slab: 12, 20 and 32 bits.
  std::uint64_t key(const Vec3d& p) const {
    const auto index = [&](int axis, double most) {
      return static_cast<std::uint64_t>(std::clamp((p[axis] - lo[axis]) / cell, 0.0, most));
    };
    const auto column = [&](int i) {
      const double share = size[across[i]] > 0 ? (p[across[i]] - lo[across[i]]) / size[across[i]] : 0;
      return static_cast<std::uint64_t>(std::min(share * columns[i], columns[i] - 1));
    };
    const std::uint64_t in_slab = spread_bits(index(across[0], 65535)) | spread_bits(index(across[1], 65535))
                                                                             << 1;
    return (column(1) * static_cast<std::uint64_t>(columns[0]) + column(0)) << 52 |
           index(along, 1048575) << 32 | in_slab;
  }
};

}  // namespace

std::vector<std::uint32_t> order_in_space(const std::vector<GrainSite>& sites) {
  if (sites.empty()) return {};
  const Sections sections(sites);
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) keys[i] = {sections.key(sites[i].position()), i};
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].second;
  return order;
}

}  // namespace interstice::dem
