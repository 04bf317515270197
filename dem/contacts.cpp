#include "dem/contacts.h"

#include <algorithm>

#include "base/parallel.h"
#include "dem/wall_distance.h"

namespace interstice::dem {
namespace {
constexpr std::size_t kRowsPerBlock = 2048;
constexpr std::size_t kPairsPerBlock = 4096;

template <class T>
std::size_t bytes_of(const std::vector<T>& v) {
  return v.capacity() * sizeof(T);
}

/// Resizes without the room to double that vectors keep: lists change by a few percent from one to the next.
template <class T>
void resize_tightly(std::vector<T>& v, std::size_t n) {
  if (n > v.capacity() || n < v.capacity() / 2) {
    v.clear();
    v.shrink_to_fit();
    v.reserve(n + n / 16);
  }
  v.resize(n);
}

}  // namespace

void PairContacts::replace(std::vector<PairRef> new_pairs, const std::vector<GrainRow>& rows,
                           const std::vector<std::uint32_t>& old_slot) {
  std::vector<ContactState> new_state(new_pairs.size(), ContactState::apart);
  std::vector<TangentialSpring<double>> new_sliding(kept_.sliding ? new_pairs.size() : 0);
  std::vector<TangentialSpring<double>> new_rolling(kept_.rolling ? new_pairs.size() : 0);
  for_each_block({new_pairs.size(), kPairsPerBlock}, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t slot = old_slot[new_pairs[k].a];
      if (slot == kNoSlot) continue;
      const std::int64_t partner = rows[new_pairs[k].b].id;
      const auto first = partner_id_.begin() + first_[slot], last = partner_id_.begin() + first_[slot + 1];
      const auto at = std::lower_bound(first, last, partner);
      if (at == last || *at != partner) continue;
      const std::uint32_t old_pair = adjacent_[static_cast<std::size_t>(at - partner_id_.begin())].pair;
      new_state[k] = state[old_pair];
      if (kept_.sliding) new_sliding[k] = sliding[old_pair];
      if (kept_.rolling) new_rolling[k] = rolling[old_pair];
    }
  });
  pairs = std::move(new_pairs);
  state = std::move(new_state);
  sliding = std::move(new_sliding);
  rolling = std::move(new_rolling);
  resize_tightly(results, pairs.size());
  if (kept_.heat) heat.assign(pairs.size(), {});
  build_adjacency(rows);
}

std::size_t PairContacts::bytes() const {
  return bytes_of(pairs) + bytes_of(state) + bytes_of(sliding) + bytes_of(rolling) + bytes_of(results) +
         bytes_of(heat) + bytes_of(first_) + bytes_of(adjacent_) + bytes_of(partner_id_);
}

std::size_t WallContacts::bytes() const { return bytes_of(entries) + bytes_of(first_); }

void PairContacts::build_adjacency(const std::vector<GrainRow>& rows) {
  first_.assign(rows.size() + 1, 0);
  for (const PairRef& p : pairs) {
    ++first_[p.a + 1];
    ++first_[p.b + 1];
  }
  for (std::size_t s = 1; s < first_.size(); ++s) first_[s] += first_[s - 1];
  resize_tightly(adjacent_, 2 * pairs.size());
  resize_tightly(partner_id_, 2 * pairs.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t k = 0; k < pairs.size(); ++k) {
    adjacent_[next[pairs[k].a]++] = {k, pairs[k].b, 0};
    adjacent_[next[pairs[k].b]++] = {k, pairs[k].a, 1};
  }
  for_each_block({rows.size(), kRowsPerBlock}, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      std::sort(adjacent_.begin() + first_[s], adjacent_.begin() + first_[s + 1],
                [&](const Adjacent& l, const Adjacent& r) { return rows[l.slot].id < rows[r.slot].id; });
      for (std::uint32_t e = first_[s]; e < first_[s + 1]; ++e) partner_id_[e] = rows[adjacent_[e].slot].id;
    }
  });
}

void WallContacts::replace(const std::vector<GrainRow>& rows, const std::vector<Shape>& walls, double reach,
                           const std::vector<std::uint32_t>& old_slot) {
  const Blocks blocks{rows.size(), kRowsPerBlock};
  std::vector<std::vector<WallContact>> found(blocks.count());
  std::vector<std::uint32_t> count(rows.size() + 1, 0);
  for_each_block(blocks, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t s = begin; s < end; ++s) {
      for (std::uint32_t w = 0; w < walls.size(); ++w) {
        if (wall_distance(walls[w], rows[s].position()).distance >= rows[s].radius + reach) continue;
        WallContact contact;
        contact.wall = w;
        if (old_slot[s] != PairContacts::kNoSlot) {
          for (const WallContact& old : of(old_slot[s])) {
            if (old.wall == w) contact = old;
          }
        }
        found[b].push_back(contact);
        ++count[s + 1];
      }
    }
  });
  entries.clear();
  for (const auto& f : found) entries.insert(entries.end(), f.begin(), f.end());
  for (std::size_t s = 1; s < count.size(); ++s) count[s] += count[s - 1];
  first_ = std::move(count);
}

}  // namespace interstice::dem
