#include "dem/contacts.h"

#include <algorithm>

#include "base/parallel.h"
#include "dem/grain_store.h"
#include "dem/springs.h"

namespace interstice::dem {
namespace {
constexpr std::size_t kSlotsPerBlock = 2048;
/// Lists and springs longer than this leave the caches from step to step.
constexpr std::size_t kBytesInCaches = std::size_t{8} << 20;
/// Where pairs reach over more rows than this, some have left the second cache before they are needed again:
/// rows, ends and all that passes by meanwhile take more than half a megabyte. (Found by trying beds, with
/// caches of 1 MB of which others use a part.)
constexpr std::size_t kRowsInSecondCache = 1700;
constexpr std::size_t kGroupsPerBlock = 256;

template <class Vector>
std::size_t bytes_of(const Vector& v) {
  return v.capacity() * sizeof(v[0]);
}

/// Resizes without the room to double that vectors keep: lists change by a few percent from one to the next.
template <class Vector>
void resize_tightly(Vector& v, std::size_t n) {
  if (n > v.capacity() || n < v.capacity() / 2) {
    v.clear();
    v.shrink_to_fit();
    v.reserve(n + n / 16);
  }
  v.resize(n);
}

constexpr std::size_t kNoPair = static_cast<std::size_t>(-1);

/// A list that is being replaced, by the slots of its time.
struct OldEnds {
  LargeVector<PairRef> pairs;
  std::vector<std::uint32_t> first, pair_of_end;

  std::size_t find(std::uint32_t a, std::uint32_t b) const {
    if (a + 1 >= first.size()) return kNoPair;
    for (std::uint32_t e = first[a]; e < first[a + 1]; ++e) {
      const PairRef& p = pairs[pair_of_end[e]];
      if (p.a == b || p.b == b) return pair_of_end[e];
    }
    return kNoPair;
  }
};

}  // namespace

PairContacts::PairContacts(const KeptMemories& kept, Precision precision, const Rates& rates)
    : precision_(precision),
      memories_(kept, precision),
      rates_(rates),
      ring_forces_(precision),
      kept_forces_(precision) {}

/// Empty places get a copy of a listed pair of their group, so that they can be worked on like any other.
void PairContacts::place_pairs(const std::vector<PairRef>& found, const PairOrder& order) {
  listed_ = found.size();
  sweep_ = order.sweep;
  resize_tightly(pairs_, order.places);
  memories_.reset(order.places);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::size_t k = order.place[i];
    pairs_[k] = found[i];
    memories_.list(k);
  }
  for (std::size_t g = 0; g < memories_.groups(); ++g) {
    const auto listed =
        static_cast<std::size_t>(std::countr_one(memories_.group(g).listed));  // empty places come last
    for (std::size_t lane = listed; lane < kLanes; ++lane) pairs_[g * kLanes + lane] = pairs_[g * kLanes];
  }
  const std::uint32_t stride = row_stride(precision_);
  resize_tightly(row_offsets_, order.places);
  for (std::size_t k = 0; k < order.places; ++k)
    row_offsets_[k] = {pairs_[k].a * stride, pairs_[k].b * stride};
}

void PairContacts::replace(const std::vector<PairRef>& found, const PairClasses& classes,
                           const std::vector<GrainSite>& sites, const std::vector<std::uint32_t>& old_slot,
                           const Parts& parts, std::size_t farthest,
                           const std::vector<std::uint32_t>& further_ends) {
  const ContactMemories old = std::move(memories_);
  const OldEnds old_ends{std::move(pairs_), std::move(first_end_), std::move(pair_of_end_)};
  pairs_ = {};
  place_pairs(found, order_pairs(found, classes, parts, farthest));
  for_each_block({memories_.groups(), kGroupsPerBlock}, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin * kLanes; k < end * kLanes; ++k) {
      const auto before = [&](std::uint32_t slot) { return old_slot.empty() ? slot : old_slot[slot]; };
      const std::uint32_t a = before(pairs_[k].a), b = before(pairs_[k].b);
      if (a == kNoSlot || b == kNoSlot || !memories_.is_listed(k)) continue;
      const std::size_t from = old_ends.find(a, b);
      if (from != kNoPair) memories_.inherit(k, old, from);
    }
  });
  ring_ = make_ring(sweep_, pairs_, first_end_, build_adjacency(sites), further_ends, precision_);
  ring_forces_.reset(ring_.places * kEndReals);
  kept_forces_.reset(ring_.kept * kEndReals);
}

PairView PairContacts::view() {
  const MemoryView m = memories_.view();
  const std::size_t bytes =
      pairs_.size() * (sizeof(PairOffsets) + sizeof(PairEnds) + kSpringReals * real_bytes(precision_));
  return {memories_.groups(),
          bytes > kBytesInCaches,
          sweep_.widest > kRowsInSecondCache,
          pairs_.data(),
          row_offsets_.data(),
          ring_.of_pair.data(),
          m.bits,
          m.sliding,
          m.rolling,
          ring_forces_.data(),
          m.forces,
          m.heat};
}

PairView PairContacts::shared_view() {
  PairView v = view();
  v.scattered = true;
  v.end_forces = kept_forces_.data();
  return v;
}

void PairContacts::fetch_shared(std::size_t block) {
  const std::uint32_t next = ring_.of_block[std::min(block + 2, ring_.of_block.size() - 1)];
  for (std::uint32_t i = ring_.of_block[block + 1]; i < next; ++i)
    kept_forces_.ask(ring_.shared[i].kept * kEndReals);
  for (std::uint32_t i = ring_.of_block[block]; i < ring_.of_block[block + 1]; ++i) {
    const SharedEnd& end = ring_.shared[i];
    ring_forces_.copy(end.place * kEndReals, kept_forces_, end.kept * kEndReals, kEndReals);
  }
}

std::size_t PairContacts::bytes() const {
  return memories_.bytes() + bytes_of(pairs_) + bytes_of(row_offsets_) + bytes_of(ring_.rows) +
         bytes_of(ring_.count) + bytes_of(ring_.rank_begin) + bytes_of(ring_.of_pair) +
         bytes_of(ring_.nobodys) + bytes_of(ring_.shared) + ring_forces_.bytes() + kept_forces_.bytes() +
         bytes_of(first_end_) + bytes_of(pair_of_end_);
}

std::vector<PairEnds> PairContacts::build_adjacency(const std::vector<GrainSite>& sites) {
  std::vector<std::uint32_t>& first = first_end_;
  first.assign(sites.size() + 1, 0);
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    if (!memories_.is_listed(k)) continue;
    ++first[pairs_[k].a + 1];
    ++first[pairs_[k].b + 1];
  }
  for (std::size_t s = 1; s < first.size(); ++s) first[s] += first[s - 1];
  // The partner's id above the pair, so that numbers sort as they should.
  std::vector<std::uint64_t> ends(2 * listed_);
  const auto end_of = [&](std::uint32_t partner, std::uint32_t pair) {
    return static_cast<std::uint64_t>(sites[partner].id) << 32 | pair;
  };
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t k = 0; k < pairs_.size(); ++k) {
    if (!memories_.is_listed(k)) continue;
    ends[next[pairs_[k].a]++] = end_of(pairs_[k].b, k);
    ends[next[pairs_[k].b]++] = end_of(pairs_[k].a, k);
  }
  resize_tightly(pair_of_end_, ends.size());
  std::vector<PairEnds> ends_of_pair(pairs_.size(), {0, 0});
  for_each_block({sites.size(), kSlotsPerBlock}, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      const auto own = ends.begin() + first[s], own_end = ends.begin() + first[s + 1];
      std::sort(own, own_end);
      if (rates_.two() && !rates_.is_quick(sites[s].radius))
        std::stable_partition(own, own_end, [&](std::uint64_t e) {
          const PairRef& p = pairs_[static_cast<std::uint32_t>(e)];
          return rates_.is_quick(sites[p.a == s ? p.b : p.a].radius);
        });
      for (std::uint32_t e = first[s]; e < first[s + 1]; ++e) {
        const std::uint32_t k = pair_of_end_[e] = static_cast<std::uint32_t>(ends[e]);
        (pairs_[k].a == s ? ends_of_pair[k].a : ends_of_pair[k].b) = e;
      }
    }
  });
  return ends_of_pair;
}

}  // namespace interstice::dem
