#include "voxel/bins.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "base/parallel.h"
#include "voxel/text.h"

namespace interstice::voxel {

namespace {

/// The smallest range that holds both.
CellRange united(const CellRange& a, const CellRange& b) {
  if (a.empty()) return b;
  CellRange all;
  for (int axis = 0; axis < 3; ++axis) {
    all.lo[axis] = std::min(a.lo[axis], b.lo[axis]);
    all.hi[axis] = std::max(a.hi[axis], b.hi[axis]);
  }
  return all;
}

constexpr double kMaxPeriods = 64;  // a sphere that overlaps its own images this often is a mistake in units

// Calls visit(key, image) for every block that an image of the sphere touches, in ascending order of images.
template <class Visit>
void for_each_block_touched(const Lattice& lattice, const BlockGrid& grid, std::int64_t edge,
                            const PlacedSphere& sphere, const std::array<bool, 3>& periodic,
                            CellRange& reached, const Visit& visit) {
  const ImageRange images = images_of(lattice, sphere, periodic);
  std::array<std::int32_t, 3> m;
  for (m[0] = images.lo[0]; m[0] <= images.hi[0]; ++m[0])
    for (m[1] = images.lo[1]; m[1] <= images.hi[1]; ++m[1])
      for (m[2] = images.lo[2]; m[2] <= images.hi[2]; ++m[2]) {
        const PlacedSphere image = moved(sphere, lattice, m);
        const CellRange bounding = bounding_cells(lattice, image);
        const CellRange cells = intersection(bounding, all_cells(lattice));
        if (cells.empty()) continue;
        reached = united(reached, cells);
        std::array<std::int64_t, 3> b, last;
        bool whole = true;  // one block holds all of the sphere
        for (int axis = 0; axis < 3; ++axis) {
          b[axis] = cells.lo[axis] / edge, last[axis] = (cells.hi[axis] - 1) / edge;
          whole = whole && b[axis] == last[axis] && cells.size(axis) == bounding.size(axis);
        }
        if (whole) {
          visit(grid.key(b), m);
          continue;
        }
        const std::array<std::int64_t, 3> first = b;
        for (b[0] = first[0]; b[0] <= last[0]; ++b[0])
          for (b[1] = first[1]; b[1] <= last[1]; ++b[1])
            for (b[2] = first[2]; b[2] <= last[2]; ++b[2])
              if (touches(lattice, image, block_cells(lattice, b, edge))) visit(grid.key(b), m);
      }
}

struct KeyedEntry {
  std::uint64_t key;
  BinEntry entry;
};

// Counting sort where a counter per block is affordable, else a comparison sort; both keep the order of
// spheres.
void group_by_key(std::vector<KeyedEntry>& keyed, std::int64_t blocks, Bins& bins) {
  const std::size_t count = keyed.size();
  bins.entries.resize(count);
  if (static_cast<std::uint64_t>(blocks) <= std::max<std::uint64_t>(1u << 22, 4 * count)) {
    std::vector<std::size_t> begin(static_cast<std::size_t>(blocks) + 1, 0);
    for (const KeyedEntry& e : keyed) ++begin[e.key + 1];
    for (std::size_t key = 0; key < static_cast<std::size_t>(blocks); ++key) {
      if (begin[key + 1] > 0) {
        bins.keys.push_back(key);
        bins.first.push_back(begin[key]);
      }
      begin[key + 1] += begin[key];
    }
    for (const KeyedEntry& e : keyed) bins.entries[begin[e.key]++] = e.entry;
  } else {
    std::stable_sort(keyed.begin(), keyed.end(),
                     [](const KeyedEntry& a, const KeyedEntry& b) { return a.key < b.key; });
    for (std::size_t e = 0; e < count; ++e) {
      if (e == 0 || keyed[e].key != keyed[e - 1].key) {
        bins.keys.push_back(keyed[e].key);
        bins.first.push_back(e);
      }
      bins.entries[e] = keyed[e].entry;
    }
  }
  bins.first.push_back(count);
}

}  // namespace

ImageRange images_of(const Lattice& lattice, const PlacedSphere& sphere,
                     const std::array<bool, 3>& periodic) {
  ImageRange images;
  if (!periodic[0] && !periodic[1] && !periodic[2]) return images;
  const CellRange cells = bounding_cells(lattice, sphere);
  for (int axis = 0; axis < 3; ++axis) {
    if (!periodic[axis]) continue;
    // all m with cells.hi + m n > 0 and cells.lo + m n < n
    const std::int64_t n = lattice.n[axis];
    const auto floor_div = [n](std::int64_t a) { return a >= 0 ? a / n : -((-a + n - 1) / n); };
    images.lo[axis] = static_cast<std::int32_t>(floor_div(-cells.hi[axis]) + 1);
    images.hi[axis] = static_cast<std::int32_t>(floor_div(n - cells.lo[axis] - 1));
  }
  return images;
}

Bins bin_spheres(const SpheresView& spheres, const Lattice& lattice, const std::array<bool, 3>& periodic,
                 std::int64_t edge) {
  const BlockGrid grid(lattice, edge);
  const Blocks parts{spheres.count, 8192};
  struct Part {
    std::vector<KeyedEntry> keyed;
    CellRange reached;
  };
  std::vector<Part> found(parts.count());
  for_each_block(parts, [&](std::size_t p, std::size_t begin, std::size_t end) {
    Part& part = found[p];
    part.keyed.reserve(2 * (end - begin));
    for (std::size_t s = begin; s < end; ++s)
      for_each_block_touched(lattice, grid, edge, place(lattice, spheres, s), periodic, part.reached,
                             [&](std::uint64_t key, const std::array<std::int32_t, 3>& image) {
                               part.keyed.push_back({key, {static_cast<std::uint32_t>(s), image}});
                             });
  });
  Bins bins;
  std::vector<KeyedEntry> keyed;
  for (Part& part : found) {
    keyed.insert(keyed.end(), part.keyed.begin(), part.keyed.end());
    std::vector<KeyedEntry>().swap(part.keyed);
    bins.reached = united(bins.reached, part.reached);
  }
  group_by_key(keyed, grid.blocks(), bins);
  return bins;
}

void check_spheres(const SpheresView& spheres, const Lattice& lattice, const std::array<bool, 3>& periodic) {
  constexpr std::size_t kReported = 10;
  if (spheres.count > std::numeric_limits<std::uint32_t>::max())
    throw InputError("more than 2^32 - 1 spheres in one field; split them");
  std::vector<std::string> errors;
  const auto report = [&](std::size_t s, const std::string& what) {
    errors.push_back("sphere " + std::to_string(s) + ": " + what);
  };
  double shortest_period = std::numeric_limits<double>::infinity();
  double reach = 0x1p30;  // images farther away than this many periods would overflow their counter
  for (int axis = 0; axis < 3; ++axis)
    if (periodic[axis])
      shortest_period = std::min(shortest_period, static_cast<double>(lattice.n[axis]) * lattice.h[axis]);
  for (std::size_t s = 0; s < spheres.count && errors.size() < kReported; ++s) {
    const Vec3d c{spheres.x[s], spheres.y[s], spheres.z[s]};
    const double r = spheres.radius[s];
    if (!(std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z)))
      report(s, "its position is not finite");
    else if (!(std::isfinite(r) && r > 0))
      report(s, "its radius is " + shown(r) + " m; it must be finite and positive");
    else if (2 * r > kMaxPeriods * shortest_period)
      report(s, "its diameter is more than 64 periods of the box");
    else if (norm(c - lattice.lo) > reach * shortest_period)
      report(s, "it lies more than 2^30 periods away from the box");
    if (spheres.density && !(std::isfinite(spheres.density[s]) && spheres.density[s] > 0))
      report(s, "its density is " + shown(spheres.density[s]) + " kg/m^3; it must be finite and positive");
  }
  if (!errors.empty()) throw InputError(errors);
}

}  // namespace interstice::voxel
