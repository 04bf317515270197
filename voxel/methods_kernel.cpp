#include "voxel/methods_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/parallel.h"
#include "voxel/sum.h"

namespace interstice::voxel {

namespace {

/// The bump's integral from -1 to u.
double bump_below(double u) {
  const double v = std::clamp(u, -1.0, 1.0), square = v * v;
  return 0.5 + v * (15 - square * (10 - 3 * square)) / 16;
}

/// The bump's integral over the cells of a range along one axis.
void axis_weights(const Lattice& lattice, const PlacedSphere& sphere, double length, int axis,
                  const CellRange& cells, std::vector<double>& weights) {
  const auto below = [&](std::int64_t face) {
    return bump_below(
        (static_cast<double>(face - sphere.cell[axis]) * lattice.h[axis] - sphere.offset[axis]) / length);
  };
  weights.clear();
  double last = below(cells.lo[axis]);
  for (std::int64_t i = cells.lo[axis]; i < cells.hi[axis]; ++i) {
    const double next = below(i + 1);
    weights.push_back(next - last);
    last = next;
  }
}

struct Weights {
  std::vector<double> x, y, z;

  void fill(const Lattice& lattice, const PlacedSphere& sphere, double length, const CellRange& cells) {
    axis_weights(lattice, sphere, length, 0, cells, x);
    axis_weights(lattice, sphere, length, 1, cells, y);
    axis_weights(lattice, sphere, length, 2, cells, z);
  }
};

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

/// The sum of a sphere's weights over the cells of `cells` as far as they are free.
double free_weight(const Weights& w, const CellRange& cells, const WallShares& walls) {
  if (walls.none()) return sum_of(w.x) * sum_of(w.y) * sum_of(w.z);
  CompensatedSum sum;
  for (std::size_t i = 0; i < w.x.size(); ++i)
    for (std::size_t j = 0; j < w.y.size(); ++j)
      for (std::size_t k = 0; k < w.z.size(); ++k)
        sum.add(w.x[i] * w.y[j] * w.z[k] *
                walls.available(cells.lo[0] + static_cast<std::int64_t>(i),
                                cells.lo[1] + static_cast<std::int64_t>(j),
                                cells.lo[2] + static_cast<std::int64_t>(k)));
  return sum.value();
}

}  // namespace

WallShares::WallShares(const Solids& local, const Lattice& lattice, const std::vector<WallBlock>& blocks)
    : grid_(lattice) {
  std::vector<std::uint64_t> partial;
  for (const WallBlock& block : blocks) {
    found_[block.key] = block.full ? kFull : partial.size() * kBlockCells;
    if (!block.full) partial.push_back(block.key);
  }
  shares_.assign(partial.size() * kBlockCells, 0.0);
  for_each_block({partial.size(), 16}, [&](std::size_t, std::size_t begin, std::size_t end) {
    double fractions[kBlockCells];
    for (std::size_t b = begin; b < end; ++b) {
      const CellRange cells = block_cells(lattice, grid_.block(partial[b]));
      wall_fractions(local, lattice, cells, fractions);
      const double* next = fractions;
      double* to = shares_.data() + b * kBlockCells;
      for (std::int64_t i = 0; i < cells.size(0); ++i)
        for (std::int64_t j = 0; j < cells.size(1); ++j)
          for (std::int64_t k = 0; k < cells.size(2); ++k) to[(i * kBlock + j) * kBlock + k] = *next++;
    }
  });
}

double WallShares::available(std::int64_t i, std::int64_t j, std::int64_t k) const {
  const auto block = found_.find(grid_.key({i / kBlock, j / kBlock, k / kBlock}));
  if (block == found_.end()) return 1;
  if (block->second == kFull) return 0;
  return 1 - shares_[block->second +
                     static_cast<std::size_t>((i % kBlock * kBlock + j % kBlock) * kBlock + k % kBlock)];
}

KernelSpread kernel_spread(const SpheresView& spheres, const std::vector<double>& inside,
                           const FieldRequest& request, const Solids& local,
                           const std::vector<WallBlock>& walls) {
  const Lattice& lattice = request.lattice;
  KernelSpread spread{request.kernel_length, WallShares(local, lattice, walls), {}, {}};
  spread.reach.resize(spheres.count);
  spread.scale.assign(spheres.count, 0.0);
  const double corner = std::sqrt(3.0) * spread.length * (1 + 1e-12);  // of the cube that the kernel fills
  for_each_block({spheres.count, 1024}, [&](std::size_t, std::size_t begin, std::size_t end) {
    Weights weights;
    for (std::size_t s = begin; s < end; ++s) {
      spread.reach[s] = std::max(corner, spheres.radius[s]);
      if (!(inside[s] > 0)) {
        spread.reach[s] = spheres.radius[s];
        continue;
      }
      PlacedSphere ball = place(lattice, spheres, s);
      ball.radius = spread.reach[s];
      const ImageRange images = images_of(lattice, ball, request.periodic);
      double weight = 0;
      std::array<std::int32_t, 3> m;
      for (m[0] = images.lo[0]; m[0] <= images.hi[0]; ++m[0])
        for (m[1] = images.lo[1]; m[1] <= images.hi[1]; ++m[1])
          for (m[2] = images.lo[2]; m[2] <= images.hi[2]; ++m[2]) {
            const PlacedSphere image = moved(ball, lattice, m);
            const CellRange cells =
                intersection(kernel_cells(lattice, image, spread.length), all_cells(lattice));
            if (cells.empty()) continue;
            weights.fill(lattice, image, spread.length, cells);
            weight += free_weight(weights, cells, spread.walls);
          }
      // what rounding leaves of nothing is nothing: else a sphere would be piled onto one sliver
      if (weight > 1e-9) spread.scale[s] = inside[s] / lattice.cell_volume() / weight;
    }
  });
  return spread;
}

CellRange kernel_cells(const Lattice& lattice, const PlacedSphere& sphere, double length) {
  PlacedSphere cube = sphere;
  cube.radius = length;
  return bounding_cells(lattice, cube);
}

void kernel_fractions(const Lattice& lattice, const PlacedSphere& sphere, const KernelSpread& spread,
                      double scale, const CellRange& block, double* fractions) {
  thread_local Weights w;
  w.fill(lattice, sphere, spread.length, block);
  for (std::size_t i = 0; i < w.x.size(); ++i)
    for (std::size_t j = 0; j < w.y.size(); ++j) {
      const double xy = scale * (w.x[i] * w.y[j]);
      for (const double z : w.z) *fractions++ = xy * z;
    }
  if (spread.walls.none()) return;
  fractions -= block.cells();
  for (std::int64_t i = block.lo[0]; i < block.hi[0]; ++i)
    for (std::int64_t j = block.lo[1]; j < block.hi[1]; ++j)
      for (std::int64_t k = block.lo[2]; k < block.hi[2]; ++k)
        *fractions++ *= spread.walls.available(i, j, k);
}

}  // namespace interstice::voxel
