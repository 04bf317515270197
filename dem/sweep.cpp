#include "dem/sweep.h"

#include <algorithm>

namespace interstice::dem {

Parts::Parts(std::size_t rows_, std::size_t count) : rows(rows_) {
  const std::size_t blocks = (rows + kRowsPerBlock - 1) / kRowsPerBlock;
  count = std::clamp<std::size_t>(count, 1, std::max<std::size_t>(blocks, 1));
  first_block.clear();
  for (std::size_t p = 0; p <= count; ++p) first_block.push_back(blocks * p / count);
}

namespace {

/// `key`: of pairs inside a part, the earlier row after the number of rows.
std::vector<std::size_t> find_front(const std::vector<PairRef>& pairs, const std::vector<std::uint32_t>& key,
                                    const Parts& parts) {
  std::vector<std::size_t> front(parts.blocks());
  for (std::size_t b = 0; b < front.size(); ++b) front[b] = parts.end_row(b);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (key[k] < parts.rows) continue;
    std::size_t& last = front[(key[k] - parts.rows) / kRowsPerBlock];
    last = std::max<std::size_t>(last, std::max(pairs[k].a, pairs[k].b) + 1);
  }
  for (std::size_t p = 0; p < parts.count(); ++p)
    for (std::size_t b = parts.first_block[p] + 1; b < parts.first_block[p + 1]; ++b)
      front[b] = std::max(front[b], front[b - 1]);
  return front;
}

}  // namespace

PairOrder order_pairs(const std::vector<PairRef>& pairs, const Parts& parts, bool all_shared) {
  const std::size_t rows = parts.rows;
  std::vector<std::uint16_t> part_of_block(parts.blocks());
  for (std::size_t p = 0; p < parts.count(); ++p)
    for (std::size_t b = parts.first_block[p]; b < parts.first_block[p + 1]; ++b)
      part_of_block[b] = static_cast<std::uint16_t>(p);

  // Pairs of rows far from each other, as across a periodic face, would keep everything between in use.
  const std::size_t farthest = std::max<std::size_t>(4096, rows / 16);
  // A counting sort by the earlier row; keys of pairs inside a part come after those of all shared pairs.
  std::vector<std::uint32_t> key(pairs.size()), start(2 * rows, 0);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    const auto [first, last] = std::minmax(pairs[k].a, pairs[k].b);
    const bool shared = all_shared || last - first > farthest ||
                        part_of_block[first / kRowsPerBlock] != part_of_block[last / kRowsPerBlock];
    key[k] = first + static_cast<std::uint32_t>(shared ? 0 : rows);
    ++start[key[k]];
  }
  PairOrder order;
  Sweep& sweep = order.sweep;
  sweep.parts = parts;
  std::size_t at = 0;
  const auto place_rows = [&](std::size_t first_key, std::size_t last_key) {
    for (std::size_t i = first_key; i < last_key; ++i) {
      const std::uint32_t count = start[i];
      start[i] = static_cast<std::uint32_t>(at);
      at += count;
    }
  };
  const auto next_group = [&] { return (at + kLanes - 1) / kLanes; };
  place_rows(0, rows);
  sweep.shared_groups = next_group();
  at = sweep.shared_groups * kLanes;
  for (std::size_t p = 0; p < parts.count(); ++p) {
    sweep.first_group.push_back(next_group());
    for (std::size_t b = parts.first_block[p]; b < parts.first_block[p + 1]; ++b) {
      place_rows(rows + parts.begin_row(b), rows + parts.end_row(b));
      sweep.done_before.push_back(next_group());
    }
    at = next_group() * kLanes;
  }
  order.places = at;
  order.place.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) order.place[k] = start[key[k]]++;
  sweep.front = find_front(pairs, key, parts);
  return order;
}

}  // namespace interstice::dem
