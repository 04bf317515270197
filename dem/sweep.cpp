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

/// The order of pairs: shared ones first, class by class; then block after block of their earlier rows, in
/// each block class by class: pairs that are only near, or sleep, fill groups of their own that are soon
/// done.
class PairKeys {
 public:
  PairKeys(const std::vector<PairRef>& pairs, const PairClasses& classes, const Parts& parts,
           std::size_t farthest)
      : shared_(parts.blocks() * kRowsPerBlock / kLanes), of_pair_(pairs.size()) {
    std::vector<std::uint16_t> part_of_block(parts.blocks());
    for (std::size_t p = 0; p < parts.count(); ++p)
      for (std::size_t b = parts.first_block[p]; b < parts.first_block[p + 1]; ++b)
        part_of_block[b] = static_cast<std::uint16_t>(p);
    for (std::size_t k = 0; k < pairs.size(); ++k) {
      const auto [first, last] = std::minmax(pairs[k].a, pairs[k].b);
      const bool shared = last - first > farthest ||
                          part_of_block[first / kRowsPerBlock] != part_of_block[last / kRowsPerBlock];
      const std::size_t block = first / kRowsPerBlock;
      of_pair_[k] = static_cast<std::uint32_t>(
          shared ? classes.of(k) * shared_ + first / kLanes
                 : begin_of(block) + turn_of(classes.of(k), block) * kRowsPerBlock + first % kRowsPerBlock);
    }
  }

  std::uint32_t of_pair(std::size_t k) const { return of_pair_[k]; }
  bool is_shared(std::size_t k) const { return of_pair_[k] < begin_of(0); }
  /// The first key of quick shared pairs.
  std::size_t shared_quick() const { return PairClasses::kQuick * shared_; }
  /// Keys of unshared pairs of a block.
  std::size_t begin_of(std::size_t block) const {
    return PairClasses::kCount * (shared_ + kRowsPerBlock * block);
  }
  /// Of these the first of quick pairs.
  std::size_t quick_of(std::size_t block) const {
    return begin_of(block) + PairClasses::kQuick * kRowsPerBlock;
  }
  std::size_t count(std::size_t blocks) const { return begin_of(blocks); }

 private:
  /// Every other block begins with the class that the one before ends with: fewer groups hold both pairs that
  /// touch and such that do not.
  static std::size_t turn_of(std::size_t pair_class, std::size_t block) {
    constexpr std::size_t last = PairClasses::kQuick - 1;
    return block % 2 == 1 && pair_class <= last ? last - pair_class : pair_class;
  }

  std::size_t shared_;  // keys of a class of shared pairs
  std::vector<std::uint32_t> of_pair_;
};

std::vector<std::size_t> find_front(const std::vector<PairRef>& pairs, const PairKeys& keys,
                                    const Parts& parts) {
  std::vector<std::size_t> front(parts.blocks());
  for (std::size_t b = 0; b < front.size(); ++b) front[b] = parts.end_row(b);
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    if (keys.is_shared(k)) continue;
    const auto [first, last] = std::minmax(pairs[k].a, pairs[k].b);
    std::size_t& end = front[first / kRowsPerBlock];
    end = std::max<std::size_t>(end, last + 1);
  }
  for (std::size_t p = 0; p < parts.count(); ++p)
    for (std::size_t b = parts.first_block[p] + 1; b < parts.first_block[p + 1]; ++b)
      front[b] = std::max(front[b], front[b - 1]);
  return front;
}

}  // namespace

PairOrder order_pairs(const std::vector<PairRef>& pairs, const PairClasses& classes, const Parts& parts,
                      std::size_t farthest) {
  const PairKeys keys(pairs, classes, parts, farthest);
  std::vector<std::uint32_t> start(keys.count(parts.blocks()), 0);  // a counting sort
  for (std::size_t k = 0; k < pairs.size(); ++k) ++start[keys.of_pair(k)];
  PairOrder order;
  Sweep& sweep = order.sweep;
  sweep.parts = parts;
  std::size_t at = 0;
  const auto place_keys = [&](std::size_t begin, std::size_t end) {
    for (std::size_t key = begin; key < end; ++key) {
      const std::uint32_t count = start[key];
      start[key] = static_cast<std::uint32_t>(at);
      at += count;
    }
  };
  const auto next_group = [&] { return groups_for(at); };
  const bool two_rates = pairs.size() > classes.end[PairClasses::kAsleep];
  const auto begin_group = [&] { return (at = next_group() * kLanes) / kLanes; };
  place_keys(0, keys.shared_quick());
  sweep.shared_quick = begin_group();
  place_keys(keys.shared_quick(), keys.begin_of(0));
  sweep.shared_groups = next_group();
  at = sweep.shared_groups * kLanes;
  for (std::size_t p = 0; p < parts.count(); ++p) {
    sweep.first_group.push_back(next_group());
    for (std::size_t b = parts.first_block[p]; b < parts.first_block[p + 1]; ++b) {
      place_keys(keys.begin_of(b), keys.quick_of(b));
      sweep.quick.push_back(two_rates ? begin_group() : next_group());
      place_keys(keys.quick_of(b), keys.begin_of(b + 1));
      sweep.done_before.push_back(two_rates ? begin_group() : next_group());
    }
    at = next_group() * kLanes;
  }
  order.places = at;
  order.place.resize(pairs.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) order.place[k] = start[keys.of_pair(k)]++;
  sweep.front = find_front(pairs, keys, parts);
  for (std::size_t b = 0; b < parts.blocks(); ++b)
    sweep.widest = std::max(sweep.widest, sweep.front[b] - parts.begin_row(b));
  return order;
}

}  // namespace interstice::dem
