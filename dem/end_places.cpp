#include "dem/end_places.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace interstice::dem {
namespace {

/// Where ranks begin: registers hold two ends in single precision.
constexpr std::uint32_t kEndsTogether = 2;

struct Layout {
  std::vector<std::size_t> before{0};  // places of all groups before each, and one past the last
  std::size_t largest = 0;             // group
};

/// Puts the grains of a group in the order of their ends, most first; returns how many places it takes.
std::size_t rank_ends(EndRing& ring, std::size_t group) {
  std::uint32_t* const count = &ring.count[group * kLanes];
  std::array<std::uint32_t, kLanes> lanes{};
  std::iota(lanes.begin(), lanes.end(), 0u);
  std::stable_sort(lanes.begin(), lanes.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return count[a] > count[b]; });
  EndRows& rows = ring.rows[group];
  std::array<std::uint32_t, kLanes> most_first{};
  for (std::uint32_t place = 0; place < kLanes; ++place) {
    rows.column_of[lanes[place]] = static_cast<std::uint8_t>(column_of_place(place));
    most_first[place] = count[lanes[place]];
  }
  std::copy(most_first.begin(), most_first.end(), count);
  rows.ranks = static_cast<std::uint32_t>(ring.rank_begin.size());
  std::uint32_t at = 0, grains = kLanes;
  for (std::uint32_t rank = 0; rank < count[0]; ++rank) {
    while (count[grains - 1] <= rank) --grains;
    ring.rank_begin.push_back(at);
    at += (grains + kEndsTogether - 1) / kEndsTogether * kEndsTogether;
  }
  return at;
}

Layout lay_out(EndRing& ring) {
  const std::size_t groups = ring.count.size() / kLanes;
  ring.rows.resize(groups);
  Layout layout;
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t places = rank_ends(ring, g);
    layout.before.push_back(layout.before.back() + places);
    layout.largest = std::max(layout.largest, places);
  }
  return layout;
}

/// The most places that are in use at a time in one part: from the grains of a block to the last partner of
/// any pair that must be done before they move.
std::size_t widest_window(const Sweep& sweep, std::size_t part, const LargeVector<PairRef>& pairs,
                          const Layout& layout) {
  std::size_t widest = 0, last_row = 0, pair = sweep.first_group[part] * kLanes;
  for (std::size_t b = sweep.parts.first_block[part]; b < sweep.parts.first_block[part + 1]; ++b) {
    for (; pair < sweep.done_before[b] * kLanes; ++pair)
      last_row = std::max<std::size_t>(last_row, std::max(pairs[pair].a, pairs[pair].b));
    last_row = std::max(last_row, sweep.parts.end_row(b) - 1);
    widest = std::max(
        widest, layout.before[last_row / kLanes + 1] - layout.before[sweep.parts.begin_row(b) / kLanes]);
  }
  return widest;
}

/// Places in rings, one a part.
void place_groups(EndRing& ring, const Sweep& sweep, const LargeVector<PairRef>& pairs,
                  const Layout& layout) {
  const Parts& parts = sweep.parts;
  ring.nobodys.resize(parts.blocks());
  for (std::size_t p = 0; p < parts.count(); ++p) {
    const std::size_t begin = parts.begin_row(parts.first_block[p]) / kLanes,
                      end = std::min(ring.rows.size(), parts.begin_row(parts.first_block[p + 1]) / kLanes);
    const std::size_t size = widest_window(sweep, p, pairs, layout) + 2 * layout.largest;
    std::size_t at = 0;
    for (std::size_t g = begin; g < end; ++g) {
      const std::size_t places = layout.before[g + 1] - layout.before[g];
      if (at + places > size) at = 0;  // a group's ends lie side by side
      ring.rows[g].first = static_cast<std::uint32_t>(ring.places + at);
      at += places;
    }
    ring.places += size;
    for (std::size_t b = parts.first_block[p]; b < parts.first_block[p + 1]; ++b)
      ring.nobodys[b] = static_cast<std::uint32_t>(ring.places);
    ring.places += kEndsTogether;
  }
  ring.places += kLanes;  // a rank's last registers may be loaded, though not used, beyond its end
}

std::vector<std::uint32_t> ends_of_slots(const std::vector<std::uint32_t>& first_end,
                                         const std::vector<std::uint32_t>& further) {
  std::vector<std::uint32_t> count(groups_for(further.size()) * kLanes, 0);
  for (std::size_t s = 0; s < further.size(); ++s) count[s] = first_end[s + 1] - first_end[s] + further[s];
  return count;
}

}  // namespace

EndRing make_ring(const Sweep& sweep, const LargeVector<PairRef>& pairs,
                  const std::vector<std::uint32_t>& first_end, const std::vector<PairEnds>& ends,
                  const std::vector<std::uint32_t>& further, Precision precision) {
  const Parts& parts = sweep.parts;
  const std::uint32_t stride = end_stride(precision);
  EndRing ring;
  ring.count = ends_of_slots(first_end, further);
  place_groups(ring, sweep, pairs, lay_out(ring));
  ring.kept = 2 * sweep.shared_groups * kLanes + 1;

  ring.of_pair.resize(pairs.size());
  std::vector<std::vector<SharedEnd>> by_block(parts.blocks());
  const auto place = [&](std::uint32_t slot, std::uint32_t end) {
    return ring.place_of(slot, end - first_end[slot]);
  };
  std::size_t part = 0;
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const bool shared = k < sweep.shared_groups * kLanes;
    if (ends[k].a == ends[k].b) {
      while (!shared && part + 1 < parts.count() && k >= sweep.first_group[part + 1] * kLanes) ++part;
      const auto nobody =
          shared ? static_cast<std::uint32_t>(ring.kept - 1) : ring.nobodys[parts.first_block[part]];
      ring.of_pair[k] = {nobody * stride, nobody * stride};
      continue;
    }
    const PairEnds in_ring{place(pairs[k].a, ends[k].a), place(pairs[k].b, ends[k].b)};
    if (!shared) {
      ring.of_pair[k] = {in_ring.a * stride, in_ring.b * stride};
      continue;
    }
    const auto kept = static_cast<std::uint32_t>(2 * k);
    ring.of_pair[k] = {kept * stride, (kept + 1) * stride};
    by_block[pairs[k].a / kRowsPerBlock].push_back({in_ring.a, kept});
    by_block[pairs[k].b / kRowsPerBlock].push_back({in_ring.b, kept + 1});
  }
  ring.of_block.push_back(0);
  for (const auto& block : by_block) {
    ring.shared.insert(ring.shared.end(), block.begin(), block.end());
    ring.of_block.push_back(static_cast<std::uint32_t>(ring.shared.size()));
  }
  return ring;
}

}  // namespace interstice::dem
