#include "dem/site_order.h"

#include <algorithm>

namespace interstice::dem {
namespace {

std::uint64_t spread_bits(std::uint64_t v) {  // 20 bits, a zero after each
  v &= 0xfffff;
  v = (v | v << 16) & 0x0000ffff0000ffffull;
  v = (v | v << 8) & 0x00ff00ff00ff00ffull;
  v = (v | v << 4) & 0x0f0f0f0f0f0f0f0full;
  v = (v | v << 2) & 0x3333333333333333ull;
  return (v | v << 1) & 0x5555555555555555ull;
}

}  // namespace

std::vector<std::uint32_t> order_in_space(const std::vector<GrainSite>& sites) {
  if (sites.empty()) return {};
  Vec3d lo = sites.front().position(), hi = lo;
  double radius_sum = 0;
  for (const GrainSite& g : sites) {
    lo = {std::min(lo.x, g.x), std::min(lo.y, g.y), std::min(lo.z, g.z)};
    hi = {std::max(hi.x, g.x), std::max(hi.y, g.y), std::max(hi.z, g.z)};
    radius_sum += g.radius;
  }
  const double cell = 2 * radius_sum / static_cast<double>(sites.size());
  const Vec3d size = hi - lo;
  const int along = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  const auto index = [&](const GrainSite& g, int axis) {
    return static_cast<std::uint64_t>(std::clamp((g.position()[axis] - lo[axis]) / cell, 0.0, 1048575.0));
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(sites.size());
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    const GrainSite& g = sites[i];
    const std::uint64_t across =
        spread_bits(index(g, (along + 1) % 3)) | spread_bits(index(g, (along + 2) % 3)) << 1;
    keys[i] = {index(g, along) << 40 | across, i};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].second;
  return order;
}

}  // namespace interstice::dem
