// How often each void fraction occurs among the voxels of a field.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "voxel/field.h"
#include "voxel/layer.h"

namespace interstice::studies {

/// Counts of voxels in equal bins of void fraction over [0, 1], 1 itself in the last. Voxels that walls fill
/// are left out.
struct VoidHistogram {
  static constexpr int bins = 50;

  struct Counts {
    std::int64_t negative = 0;  // where grains overlap so far that a voxel holds more than its volume
    std::vector<std::int64_t> in_bin;
  };
  Counts voxels;
  std::optional<Counts> averaged;
  std::int64_t cells = 0;                      // voxels counted
  std::optional<std::array<double, 2>> layer;  // [m] heights between which voxels were counted

  static double bin_edge(int bin) { return static_cast<double>(bin) / bins; }
};

/// Over the whole box, or over the voxels whose centre is in the layer where one is given.
VoidHistogram void_histogram(const voxel::Field& field, const std::optional<voxel::LayerRequest>& layer);

/// void_fraction_from, void_fraction_to, voxels[, voxels_averaged]; the first row holds the negative ones.
std::string csv_of(const VoidHistogram& histogram);

}  // namespace interstice::studies
