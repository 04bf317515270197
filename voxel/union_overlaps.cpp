#include "voxel/union_overlaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "base/parallel.h"
#include "voxel/sum.h"
#include "voxel/union_share.h"

namespace interstice::voxel {

namespace {

constexpr double kPairTolerance = 1e-8;   // of a cell, per lens and cell
constexpr double kCrowdTolerance = 1e-6;  // of a cell
constexpr std::size_t kCrowd = 16;        // more spheres than this in one cell: by lines
constexpr int kLines = 96;

/// A sphere or one of its periodic images.
struct Node {
  std::uint32_t sphere = 0;
  std::array<std::int32_t, 3> image{0, 0, 0};

  auto operator<=>(const Node&) const = default;
};

struct Pair {
  std::uint32_t a = 0, b = 0;  // nodes, a < b

  auto operator<=>(const Pair&) const = default;
};

struct Graph {
  const Lattice& lattice;
  std::vector<Node> nodes;           // ascending
  std::vector<PlacedSphere> placed;  // of the nodes
  std::vector<Pair> pairs;           // ascending; of spheres that are not hidden
  std::vector<std::size_t> first;    // neighbours[first[n]] to neighbours[first[n + 1] - 1] overlap node n
  std::vector<std::uint32_t> neighbours;  // ascending per node
};

/// A node as seen from a cell, in cells.
CellBall seen_from(const Lattice& lattice, const PlacedSphere& sphere,
                   const std::array<std::int64_t, 3>& cell) {
  CellBall ball;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    ball.center[axis] = static_cast<double>(sphere.cell[a] - cell[a]) + sphere.offset[axis] / lattice.h[axis];
  }
  ball.radius = sphere.radius / lattice.h.x;
  return ball;
}

std::vector<Node> nodes_of(const Bins& bins) {
  std::vector<Node> nodes;
  nodes.reserve(bins.entries.size());
  for (const BinEntry& entry : bins.entries) nodes.push_back({entry.sphere, entry.image});
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Calls visit(a, b) for all pairs of nodes in a region whose extents along x overlap.
template <class Visit>
void for_each_candidate(const Graph& graph, std::vector<std::uint32_t>& members, const Visit& visit) {
  const std::array<std::int64_t, 3>& origin = graph.placed[members[0]].cell;
  struct Extent {
    double lo, hi;
    std::uint32_t node;
  };
  std::vector<Extent> extents;
  for (const std::uint32_t node : members) {
    const CellBall ball = seen_from(graph.lattice, graph.placed[node], origin);
    extents.push_back({ball.center.x - ball.radius, ball.center.x + ball.radius, node});
  }
  std::sort(extents.begin(), extents.end(),
            [](const Extent& a, const Extent& b) { return std::tie(a.lo, a.node) < std::tie(b.lo, b.node); });
  for (std::size_t i = 0; i < extents.size(); ++i)
    for (std::size_t j = i + 1; j < extents.size() && extents[j].lo < extents[i].hi; ++j)
      visit(std::min(extents[i].node, extents[j].node), std::max(extents[i].node, extents[j].node));
}

/// Pairs that meet, and spheres that are hidden, region by region. Ascending, each pair once.
std::vector<Pair> find_pairs(const Graph& graph, const Bins& bins, std::vector<std::uint8_t>& hidden) {
  std::vector<std::vector<Pair>> lenses(bins.keys.size()), nested(bins.keys.size());
  for_each_block({bins.keys.size(), 1}, [&](std::size_t r, std::size_t, std::size_t) {
    std::vector<std::uint32_t> members;
    for (std::size_t e = bins.first[r]; e < bins.first[r + 1]; ++e) {
      const Node node{bins.entries[e].sphere, bins.entries[e].image};
      const auto at = std::lower_bound(graph.nodes.begin(), graph.nodes.end(), node);
      members.push_back(static_cast<std::uint32_t>(at - graph.nodes.begin()));
    }
    for_each_candidate(graph, members, [&](std::uint32_t a, std::uint32_t b) {
      const auto& origin = graph.placed[a].cell;
      const Meeting how = meeting(seen_from(graph.lattice, graph.placed[a], origin),
                                  seen_from(graph.lattice, graph.placed[b], origin));
      if (how == Meeting::lens) lenses[r].push_back({a, b});
      // Of two equal spheres in one place both are inside the other: the later goes.
      const bool equal = graph.placed[a].radius == graph.placed[b].radius;
      if (how == Meeting::second_inside || (how == Meeting::first_inside && equal))
        nested[r].push_back({b, a});
      if (how == Meeting::first_inside && !equal) nested[r].push_back({a, b});
    });
  });
  std::vector<Pair> pairs;
  for (const auto& inner : nested)
    for (const Pair& pair : inner) hidden[graph.nodes[pair.a].sphere] = 1;
  for (const auto& region : lenses)
    for (const Pair& pair : region)
      if (!hidden[graph.nodes[pair.a].sphere] && !hidden[graph.nodes[pair.b].sphere]) pairs.push_back(pair);
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

void find_neighbours(Graph& graph) {
  graph.first.assign(graph.nodes.size() + 1, 0);
  for (const Pair& pair : graph.pairs) ++graph.first[pair.a + 1], ++graph.first[pair.b + 1];
  for (std::size_t n = 0; n < graph.nodes.size(); ++n) graph.first[n + 1] += graph.first[n];
  graph.neighbours.resize(2 * graph.pairs.size());
  std::vector<std::size_t> at(graph.first.begin(), graph.first.end() - 1);
  for (const Pair& pair : graph.pairs) {  // ascending pairs give ascending neighbours in two goes
    graph.neighbours[at[pair.b]++] = pair.a;
  }
  for (const Pair& pair : graph.pairs) graph.neighbours[at[pair.a]++] = pair.b;
}

/// Does a third sphere reach into the lens (or nearly)?
bool is_crowded(const Graph& graph, const Pair& pair, const Lens& lens,
                const std::array<std::int64_t, 3>& origin) {
  auto a = graph.first[pair.a], b = graph.first[pair.b];
  while (a < graph.first[pair.a + 1] && b < graph.first[pair.b + 1]) {
    const std::uint32_t x = graph.neighbours[a], y = graph.neighbours[b];
    if (x == y) {
      const CellBall third = seen_from(graph.lattice, graph.placed[x], origin);
      if (norm(third.center - lens.rim_center) < third.radius + lens.outer_radius) return true;
    }
    a += x <= y, b += y <= x;
  }
  return false;
}

/// One pair in one cell.
struct Part {
  std::array<std::int64_t, 3> cell;
  Pair pair;
  double share;  // negative: a third sphere reaches in, all are to be looked at together

  bool crowded() const { return share < 0; }
};

CellRange cells_of(const Lens& lens, const std::array<std::int64_t, 3>& origin) {
  CellRange cells;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    cells.lo[a] = origin[a] + floor_index(lens.lo[axis]);
    cells.hi[a] = origin[a] + std::max(floor_index(lens.lo[axis]) + 1,
                                       floor_index(std::nextafter(lens.hi[axis], -INFINITY)) + 1);
  }
  return cells;
}

double part_of(const Graph& graph, const Pair& pair, const Lens& lens,
               const std::array<std::int64_t, 3>& origin, const std::array<std::int64_t, 3>& cell) {
  double first = 0, second = 0;
  const CellRange range{cell, {cell[0] + 1, cell[1] + 1, cell[2] + 1}};
  exact_fractions(graph.lattice, graph.placed[pair.a], range, &first);
  exact_fractions(graph.lattice, graph.placed[pair.b], range, &second);
  if (first == 1 || second == 1) return std::min(first, second);
  const std::vector<CellBall> balls{seen_from(graph.lattice, graph.placed[pair.a], cell),
                                    seen_from(graph.lattice, graph.placed[pair.b], cell)};
  const auto up = static_cast<double>(origin[2] - cell[2]);
  const double shared = shared_volume(balls, lens.lo.z + up, lens.hi.z + up, kPairTolerance);
  return std::clamp(shared, 0.0, std::min(first, second));
}

/// What is missing to the whole lens goes to its largest part.
void complete(std::vector<Part>& parts, std::size_t from, double volume) {
  std::size_t largest = from;
  double sum = 0;
  for (std::size_t p = from; p < parts.size(); ++p) {
    sum += parts[p].share;
    if (parts[p].share > parts[largest].share) largest = p;
  }
  if (parts.size() > from) parts[largest].share += volume - sum;
}

/// The cells that a pair's lens lies in, and how much of it.
void divide(const Graph& graph, const Pair& pair, std::vector<Part>& parts) {
  const PlacedSphere &a = graph.placed[pair.a], &b = graph.placed[pair.b];
  const std::array<std::int64_t, 3>& origin = a.cell;
  const Lens lens = lens_of(seen_from(graph.lattice, a, origin), seen_from(graph.lattice, b, origin));
  const CellRange all = cells_of(lens, origin);
  const CellRange cells = intersection(all, all_cells(graph.lattice));
  if (cells.empty()) return;
  const bool crowded = is_crowded(graph, pair, lens, origin), whole = cells.cells() == all.cells();
  if (all.cells() == 1 && !crowded) {
    parts.push_back({all.lo, pair, lens.volume});
    return;
  }
  const std::size_t from = parts.size();
  for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i)
    for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j)
      for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k) {
        const CellRange cell{{i, j, k}, {i + 1, j + 1, k + 1}};
        if (!touches(graph.lattice, a, cell) || !touches(graph.lattice, b, cell)) continue;
        const double share = crowded ? -1 : part_of(graph, pair, lens, origin, cell.lo);
        if (share != 0) parts.push_back({cell.lo, pair, share});
      }
  if (!crowded && whole) complete(parts, from, lens.volume);
}

/// What many spheres share of a cell.
double shared_by_all(const Graph& graph, const std::vector<std::uint32_t>& nodes,
                     const std::array<std::int64_t, 3>& cell) {
  const CellRange range{cell, {cell[0] + 1, cell[1] + 1, cell[2] + 1}};
  std::vector<CellBall> balls;
  double sum = 0;
  bool covered = false;
  for (const std::uint32_t node : nodes) {
    double share = 0;
    exact_fractions(graph.lattice, graph.placed[node], range, &share);
    sum += share;
    covered = covered || share == 1;
    balls.push_back(seen_from(graph.lattice, graph.placed[node], cell));
  }
  if (covered) return sum - 1;  // one sphere fills the cell: the others are all too much
  const double shared = balls.size() > kCrowd ? shared_volume_by_lines(balls, kLines)
                                              : shared_volume(balls, 0, 1, kCrowdTolerance);
  return std::clamp(shared, std::max(0.0, sum - 1), sum);
}

/// All parts of one cell made one number.
CellOverlap merge(const Graph& graph, const Part* first, const Part* last) {
  CellOverlap overlap;
  overlap.cell = first->cell;
  std::vector<std::uint32_t> crowd;
  for (const Part* part = first; part != last; ++part)
    if (part->crowded()) crowd.insert(crowd.end(), {part->pair.a, part->pair.b});
  std::sort(crowd.begin(), crowd.end());
  crowd.erase(std::unique(crowd.begin(), crowd.end()), crowd.end());
  if (!crowd.empty()) overlap.share = shared_by_all(graph, crowd, first->cell);
  const auto within = [&](std::uint32_t node) {
    return std::binary_search(crowd.begin(), crowd.end(), node);
  };
  for (const Part* part = first; part != last; ++part) {
    const auto [a, b] = part->pair;
    if (part->crowded() || (within(a) && within(b))) continue;  // counted with the crowd
    overlap.share += part->share;
  }
  return overlap;
}

std::vector<Part> all_parts(const Graph& graph) {
  const Blocks blocks{graph.pairs.size(), 64};
  std::vector<std::vector<Part>> found(blocks.count());
  for_each_block(blocks, [&](std::size_t block, std::size_t begin, std::size_t end) {
    for (std::size_t p = begin; p < end; ++p) divide(graph, graph.pairs[p], found[block]);
  });
  std::vector<Part> parts;
  for (const auto& block : found) parts.insert(parts.end(), block.begin(), block.end());
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.cell < b.cell; });
  return parts;
}

/// From parts in the order of cells to one entry a cell.
void fill(const Graph& graph, std::int64_t edge, const std::vector<Part>& parts, Overlaps& overlaps) {
  std::vector<std::size_t> first;
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (p == 0 || parts[p].cell != parts[p - 1].cell) first.push_back(p);
  overlaps.cells.resize(first.size());
  first.push_back(parts.size());
  const BlockGrid regions(graph.lattice, edge);
  for_each_block({overlaps.cells.size(), 16}, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      CellOverlap& cell = overlaps.cells[c];
      cell = merge(graph, parts.data() + first[c], parts.data() + first[c + 1]);
      cell.region = regions.key({cell.cell[0] / edge, cell.cell[1] / edge, cell.cell[2] / edge});
    }
  });
  CompensatedSum sum;
  for (std::size_t c = 0; c < overlaps.cells.size(); ++c) {
    sum.add(overlaps.cells[c].share);
    overlaps.shared_by_many += std::any_of(parts.begin() + static_cast<std::ptrdiff_t>(first[c]),
                                           parts.begin() + static_cast<std::ptrdiff_t>(first[c + 1]),
                                           [](const Part& part) { return part.crowded(); });
  }
  overlaps.volume = sum.value() * graph.lattice.cell_volume();
  std::stable_sort(overlaps.cells.begin(), overlaps.cells.end(),
                   [](const CellOverlap& a, const CellOverlap& b) { return a.region < b.region; });
}

}  // namespace

Overlaps find_overlaps(const SpheresView& spheres, const Lattice& lattice, const Bins& bins,
                       std::int64_t edge) {
  Overlaps overlaps;
  overlaps.hidden.assign(spheres.count, 0);
  Graph graph{lattice, nodes_of(bins), {}, {}, {}, {}};
  for (const Node& node : graph.nodes)
    graph.placed.push_back(moved(place(lattice, spheres, node.sphere), lattice, node.image));
  graph.pairs = find_pairs(graph, bins, overlaps.hidden);
  find_neighbours(graph);
  overlaps.pairs = static_cast<std::int64_t>(graph.pairs.size());
  fill(graph, edge, all_parts(graph), overlaps);
  return overlaps;
}

OverlapRange overlaps_in(const Overlaps& overlaps, std::uint64_t region) {
  const auto [first, last] =
      std::equal_range(overlaps.cells.begin(), overlaps.cells.end(), CellOverlap{region, {}, 0},
                       [](const CellOverlap& a, const CellOverlap& b) { return a.region < b.region; });
  const CellOverlap* data = overlaps.cells.data();
  return {data + (first - overlaps.cells.begin()), data + (last - overlaps.cells.begin())};
}

void drop_hidden(const Overlaps& overlaps, Bins& bins) {
  std::size_t to = 0;
  for (std::size_t b = 0; b < bins.keys.size(); ++b) {
    const std::size_t begin = bins.first[b], end = bins.first[b + 1];
    bins.first[b] = to;
    for (std::size_t e = begin; e < end; ++e)
      if (!overlaps.hidden[bins.entries[e].sphere]) bins.entries[to++] = bins.entries[e];
  }
  if (bins.keys.empty()) return;
  bins.first[bins.keys.size()] = to;
  bins.entries.resize(to);
}

}  // namespace interstice::voxel
