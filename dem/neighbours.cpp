#include "dem/neighbours.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.h"

namespace interstice::dem {

namespace {

constexpr std::size_t kRowsPerBlock = 1024;
constexpr int kMaxLevels = 16;

PairRef ordered(const std::vector<GrainSite>& sites, std::uint32_t i, std::uint32_t j) {
  return sites[i].id < sites[j].id ? PairRef{i, j} : PairRef{j, i};
}

/// A grain as the search passes over it.
struct Member {
  double x, y, z, radius;
  std::uint32_t slot;
};

/// The grains of one size class in the cells of a dense grid over their own bounding box.
struct Level {
  double largest = 0;  // radius [m]
  Vec3d lo;
  std::array<double, 3> cell{1, 1, 1};
  std::array<std::int64_t, 3> n{1, 1, 1};
  std::vector<std::uint32_t> start;  // first member of each cell, and one past the last
  std::vector<Member> members;       // cell by cell

  std::int64_t coordinate(double p, int axis) const {
    return static_cast<std::int64_t>(std::floor((p - lo[axis]) / cell[axis]));
  }
  std::int64_t index(std::int64_t i, std::int64_t j, std::int64_t k) const {
    return (k * n[1] + j) * n[0] + i;
  }
};

Box bounds_of(const std::vector<GrainSite>& sites, const std::vector<std::uint32_t>& members) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Box b{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (const std::uint32_t m : members) {
    const Vec3d p = sites[m].position();
    for (int axis = 0; axis < 3; ++axis) {
      b.lo[axis] = std::min(b.lo[axis], p[axis]);
      b.hi[axis] = std::max(b.hi[axis], p[axis]);
    }
  }
  return b;
}

/// Sets the cells: about as large as the class's pairs reach, larger where that would make far more cells
/// than grains (a few fine grains in a long domain), so that memory stays proportional to the number of
/// grains.
void size_cells(Level& level, const Box& box, double edge, std::size_t grains, const SearchSpace& space) {
  const double budget = 16.0 * static_cast<double>(grains) + 4096;
  for (;; edge *= 1.26) {  // about 2^(1/3): half as many cells
    double cells = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const bool wraps = space.periodic[axis];
      level.lo[axis] = wraps ? space.domain.lo[axis] : box.lo[axis];
      const double length = (wraps ? space.domain.hi[axis] : box.hi[axis]) - level.lo[axis];
      const double count = std::max(1.0, std::floor(length / edge + (wraps ? 0 : 1)));
      level.n[axis] = count > 2e9 ? 2000000000 : static_cast<std::int64_t>(count);
      level.cell[axis] = wraps ? length / static_cast<double>(level.n[axis]) : edge;
      cells *= count;
    }
    if (cells <= budget) return;
  }
}

/// `place`: of each slot among the members of its level.
void sort_into_cells(Level& level, const std::vector<GrainSite>& sites,
                     const std::vector<std::uint32_t>& slots, std::vector<std::uint32_t>& place) {
  level.start.assign(static_cast<std::size_t>(level.n[0] * level.n[1] * level.n[2]) + 1, 0);
  std::vector<std::uint32_t> cell_of(slots.size());
  for (std::size_t s = 0; s < slots.size(); ++s) {
    const Vec3d p = sites[slots[s]].position();
    std::array<std::int64_t, 3> c{};
    for (int axis = 0; axis < 3; ++axis) {
      c[axis] = std::clamp<std::int64_t>(level.coordinate(p[axis], axis), 0, level.n[axis] - 1);
    }
    cell_of[s] = static_cast<std::uint32_t>(level.index(c[0], c[1], c[2]));
    ++level.start[cell_of[s] + 1];
  }
  for (std::size_t c = 1; c < level.start.size(); ++c) level.start[c] += level.start[c - 1];
  level.members.resize(slots.size());
  std::vector<std::uint32_t> next(level.start.begin(), level.start.end() - 1);
  for (std::size_t s = 0; s < slots.size(); ++s) {
    const GrainSite& site = sites[slots[s]];
    place[slots[s]] = next[cell_of[s]]++;
    level.members[place[slots[s]]] = {site.x, site.y, site.z, site.radius, slots[s]};
  }
}

/// Classes by halves of the largest radius; empty ones are left out.
std::vector<Level> build_levels(const std::vector<GrainSite>& sites, const SearchSpace& space,
                                std::vector<std::uint8_t>& level_of, std::vector<std::uint32_t>& place) {
  double largest = 0;
  for (const GrainSite& r : sites) largest = std::max(largest, r.radius);
  std::array<std::vector<std::uint32_t>, kMaxLevels> classes;
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    const int c = std::clamp(static_cast<int>(std::log2(largest / sites[i].radius)), 0, kMaxLevels - 1);
    classes[c].push_back(i);
  }
  std::vector<Level> levels;
  level_of.resize(sites.size());
  place.resize(sites.size());
  for (const auto& slots : classes) {
    if (slots.empty()) continue;
    Level level;
    for (const std::uint32_t s : slots) {
      level.largest = std::max(level.largest, sites[s].radius);
      level_of[s] = static_cast<std::uint8_t>(levels.size());
    }
    size_cells(level, bounds_of(sites, slots), 2 * level.largest + space.skin, slots.size(), space);
    sort_into_cells(level, sites, slots, place);
    levels.push_back(std::move(level));
  }
  return levels;
}

/// The cells of one axis within reach of a grain, as at most two runs of neighbours.
struct Span {
  std::array<std::pair<std::int64_t, std::int64_t>, 2> run;
  int count = 0;
};

Span cells_in_reach(const Level& level, double p, double reach, int axis, bool periodic) {
  std::int64_t first = level.coordinate(p - reach, axis), last = level.coordinate(p + reach, axis);
  const std::int64_t n = level.n[axis];
  Span span;
  if (!periodic) {
    first = std::max<std::int64_t>(first, 0);
    last = std::min(last, n - 1);
    if (first <= last) span.run[span.count++] = {first, last};
  } else if (last - first + 1 >= n) {
    span.run[span.count++] = {0, n - 1};
  } else {
    const std::int64_t from = ((first % n) + n) % n, to = ((last % n) + n) % n;
    if (from <= to) {
      span.run[span.count++] = {from, to};
    } else {
      span.run[span.count++] = {0, to};
      span.run[span.count++] = {from, n - 1};
    }
  }
  return span;
}

/// Of the grains of its own class those that a grain is paired with follow it.
struct SearchedLevel {
  const Level& level;
  std::size_t first_member;
};

void search_level(const std::vector<GrainSite>& sites, const SearchSpace& space, const SearchedLevel& in,
                  std::uint32_t i, std::vector<PairRef>& found) {
  const GrainSite& grain = sites[i];
  const Level& level = in.level;
  const NearTest near(space);
  const double reach = grain.radius + level.largest + space.skin;
  std::array<Span, 3> spans;
  for (int axis = 0; axis < 3; ++axis) {
    spans[axis] = cells_in_reach(level, grain.position()[axis], reach, axis, space.periodic[axis]);
  }
  const auto visit_row = [&](std::int64_t j, std::int64_t k) {
    for (int r = 0; r < spans[0].count; ++r) {
      const std::size_t begin = level.start[level.index(spans[0].run[r].first, j, k)];
      const std::size_t end = level.start[level.index(spans[0].run[r].second, j, k) + 1];
      for (std::size_t m = std::max(begin, in.first_member); m < end; ++m)
        if (near(grain, level.members[m])) found.push_back(ordered(sites, i, level.members[m].slot));
    }
  };
  for (int rk = 0; rk < spans[2].count; ++rk) {
    for (std::int64_t k = spans[2].run[rk].first; k <= spans[2].run[rk].second; ++k) {
      for (int rj = 0; rj < spans[1].count; ++rj) {
        for (std::int64_t j = spans[1].run[rj].first; j <= spans[1].run[rj].second; ++j) visit_row(j, k);
      }
    }
  }
}

}  // namespace

std::vector<PairRef> find_pairs(const std::vector<GrainSite>& sites, const SearchSpace& space) {
  if (sites.empty()) return {};
  std::vector<std::uint8_t> level_of;
  std::vector<std::uint32_t> place;
  const std::vector<Level> levels = build_levels(sites, space, level_of, place);

  const Blocks blocks{sites.size(), kRowsPerBlock};
  std::vector<std::vector<PairRef>> found(blocks.count());
  for_each_block(blocks, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t l = 0; l <= level_of[i]; ++l) {  // its own class and the coarser ones
        const SearchedLevel in{levels[l], l == level_of[i] ? place[i] + std::size_t{1} : 0};
        search_level(sites, space, in, static_cast<std::uint32_t>(i), found[b]);
      }
    }
  });
  std::size_t total = 0;
  for (const auto& f : found) total += f.size();
  std::vector<PairRef> pairs;
  pairs.reserve(total);
  for (const auto& f : found) pairs.insert(pairs.end(), f.begin(), f.end());
  return pairs;
}

std::vector<PairRef> find_pairs_brute_force(const std::vector<GrainSite>& sites, const SearchSpace& space) {
  const NearTest near(space);
  std::vector<PairRef> pairs;
  for (std::uint32_t i = 0; i < sites.size(); ++i) {
    for (std::uint32_t j = i + 1; j < sites.size(); ++j) {
      if (near(sites[i], sites[j])) pairs.push_back(ordered(sites, i, j));
    }
  }
  return pairs;
}

}  // namespace interstice::dem
