#include "dem/end_places.h"

#include <algorithm>

namespace interstice::dem {
namespace {

/// The most ends that are in use at a time in one part: from the grains of a block to the last partner of any
/// pair that must be done before they move.
std::size_t widest_window(const Sweep& sweep, std::size_t part, const LargeVector<PairRef>& pairs,
                          const std::vector<std::uint32_t>& first) {
  std::size_t widest = 0, last_row = 0, pair = sweep.first_group[part] * kLanes;
  for (std::size_t b = sweep.parts.first_block[part]; b < sweep.parts.first_block[part + 1]; ++b) {
    for (; pair < sweep.done_before[b] * kLanes; ++pair)
      last_row = std::max<std::size_t>(last_row, std::max(pairs[pair].a, pairs[pair].b));
    last_row = std::max(last_row, sweep.parts.end_row(b) - 1);
    widest = std::max<std::size_t>(widest, first[last_row + 1] - first[sweep.parts.begin_row(b)]);
  }
  return widest;
}

}  // namespace

EndRing make_ring(const Sweep& sweep, const LargeVector<PairRef>& pairs,
                  const std::vector<std::uint32_t>& first_end, const std::vector<PairEnds>& ends) {
  const Parts& parts = sweep.parts;
  const auto ends_of = [&](std::size_t slot) { return first_end[slot + 1] - first_end[slot]; };
  EndRing ring;
  ring.first.resize(parts.rows);
  std::size_t base = 0;
  for (std::size_t p = 0; p < parts.count(); ++p) {
    const std::size_t begin = parts.begin_row(parts.first_block[p]),
                      end = std::min(parts.rows, parts.begin_row(parts.first_block[p + 1]));
    std::size_t most = 0;  // ends of one grain
    for (std::size_t s = begin; s < end; ++s) most = std::max<std::size_t>(most, ends_of(s));
    const std::size_t size = widest_window(sweep, p, pairs, first_end) + 2 * most;
    std::size_t at = 0;
    for (std::size_t s = begin; s < end; ++s) {
      if (at + ends_of(s) > size) at = 0;  // a grain's ends lie side by side
      ring.first[s] = static_cast<std::uint32_t>(base + at);
      at += ends_of(s);
    }
    base += size;
  }
  ring.places = base + 1;
  ring.kept = 2 * sweep.shared_groups * kLanes + 1;

  ring.of_pair.resize(pairs.size());
  std::vector<std::vector<SharedEnd>> by_block(parts.blocks());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const bool shared = k < sweep.shared_groups * kLanes;
    if (ends[k].a == ends[k].b) {
      const auto nobody = static_cast<std::uint32_t>(shared ? ring.kept - 1 : base);
      ring.of_pair[k] = {nobody, nobody};
      continue;
    }
    const auto place = [&](std::uint32_t slot, std::uint32_t end) {
      return ring.first[slot] + (end - first_end[slot]);
    };
    const PairEnds in_ring{place(pairs[k].a, ends[k].a), place(pairs[k].b, ends[k].b)};
    if (!shared) {
      ring.of_pair[k] = in_ring;
      continue;
    }
    const auto kept = static_cast<std::uint32_t>(2 * k);
    ring.of_pair[k] = {kept, kept + 1};
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
