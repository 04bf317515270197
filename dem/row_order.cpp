#include "dem/row_order.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace interstice::dem {
namespace {

std::uint64_t spread_bits(std::uint64_t v) {  // 21 bits, two zeros after each
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffull;
  v = (v | v << 16) & 0x1f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  return (v | v << 2) & 0x1249249249249249ull;
}

}  // namespace

void sort_rows_in_space(std::vector<GrainRow>& rows, std::vector<GrainMotion>& motions) {
  if (rows.empty()) return;
  Vec3d lo = rows.front().position();
  double radius_sum = 0;
  for (const GrainRow& g : rows) {
    lo = {std::min(lo.x, g.x), std::min(lo.y, g.y), std::min(lo.z, g.z)};
    radius_sum += g.radius;
  }
  const double cell = 4 * radius_sum / static_cast<double>(rows.size());
  const auto cell_index = [cell](double p) {
    return static_cast<std::uint64_t>(std::clamp(p / cell, 0.0, 2097151.0));
  };
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(rows.size());
  for (std::uint32_t i = 0; i < rows.size(); ++i) {
    const Vec3d p = rows[i].position() - lo;
    keys[i] = {
        spread_bits(cell_index(p.x)) | spread_bits(cell_index(p.y)) << 1 | spread_bits(cell_index(p.z)) << 2,
        i};
  }
  std::sort(keys.begin(), keys.end());
  std::vector<GrainRow> sorted_rows(rows.size());
  std::vector<GrainMotion> sorted_motions(rows.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    sorted_rows[i] = rows[keys[i].second];
    sorted_motions[i] = motions[keys[i].second];
  }
  rows = std::move(sorted_rows);
  motions = std::move(sorted_motions);
}

}  // namespace interstice::dem
