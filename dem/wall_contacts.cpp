#include "dem/wall_contacts.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "dem/ask_for.h"
#include "dem/contacts.h"
#include "dem/grain_store.h"
#include "dem/wall_distance.h"

namespace interstice::dem {

WallContacts::WallContacts(const KeptMemories& kept, Precision precision, const Rates& rates)
    : precision_(precision), memories_(kept, precision), rates_(rates) {}

void WallContacts::replace(const std::vector<GrainSite>& sites, const std::vector<GrainSite>& reaching,
                           const std::vector<Shape>& walls, double reach,
                           const std::vector<std::uint32_t>& old_slot) {
  const Blocks blocks{sites.size(), kRowsPerBlock};
  FoundByBlock found(blocks.count());
  for_each_block(blocks, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::uint32_t w = 0; w < walls.size(); ++w)
      for (std::size_t s = begin; s < end; ++s)
        if (wall_distance(walls[w], sites[s].position()).distance < reaching[s].radius + reach)
          (rates_.is_quick(sites[s].radius) ? found[b].quick : found[b].slow)
              .push_back({static_cast<std::uint32_t>(s), w});
  });

  const WallContacts old = std::move(*this);  // lists, bits and springs are made anew below
  place(found, sites.size());
  memories_.reset(places());
  if (memories_.kept().heat) power_.assign(places(), 0);
  for (std::size_t s = 0; s < sites.size(); ++s) {
    const std::size_t before = old_slot.empty() ? s : old_slot[s];
    for (const std::uint32_t k : places_of(s)) {
      memories_.list(k);
      if (before == PairContacts::kNoSlot) continue;
      for (const std::uint32_t from : old.places_of(before))
        if (old.walls_[from] == walls_[k]) memories_.inherit(k, old.memories_, from);
    }
  }
}

/// Block after block in whole groups; empty places get a copy of the contact before them.
void WallContacts::place(const FoundByBlock& found, std::size_t slots) {
  first_.assign(slots + 1, 0);
  first_group_.assign(1, 0);
  first_quick_.clear();
  std::size_t contacts = 0;
  for (const FoundInBlock& block : found) {
    for (const auto* list : {&block.slow, &block.quick})
      for (const Found& f : *list) ++first_[f.slot + 1];
    contacts += block.slow.size() + block.quick.size();
    first_quick_.push_back(first_group_.back() + static_cast<std::uint32_t>(groups_for(block.slow.size())));
    first_group_.push_back(first_quick_.back() + static_cast<std::uint32_t>(groups_for(block.quick.size())));
  }
  for (std::size_t s = 0; s < slots; ++s) first_[s + 1] += first_[s];
  place_.resize(contacts);
  slots_.resize(first_group_.back() * kLanes);
  walls_.resize(slots_.size());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  const auto place_list = [&](const std::vector<Found>& list, std::size_t k, std::size_t end) {
    for (const Found& f : list) {
      slots_[k] = f.slot, walls_[k] = f.wall;
      place_[next[f.slot]++] = static_cast<std::uint32_t>(k++);
    }
    for (; k < end; ++k) slots_[k] = slots_[k - 1], walls_[k] = walls_[k - 1];
  };
  for (std::size_t b = 0; b < found.size(); ++b) {
    place_list(found[b].slow, first_group_[b] * kLanes, first_quick_[b] * kLanes);
    place_list(found[b].quick, first_quick_[b] * kLanes, first_group_[b + 1] * kLanes);
  }
  row_offsets_.resize(slots_.size());
  for (std::size_t k = 0; k < slots_.size(); ++k) row_offsets_[k] = slots_[k] * row_stride(precision_);
}

void WallContacts::place_ends(const PairContacts& pairs) {
  ends_.resize(places());
  for (std::size_t b = 0; b + 1 < first_group_.size(); ++b)
    std::fill(ends_.begin() + first_group_[b] * kLanes, ends_.begin() + first_group_[b + 1] * kLanes,
              pairs.nobodys_end(b));
  for (std::size_t s = 0; s + 1 < first_.size(); ++s) {
    std::uint32_t rank = 0;
    for (const std::uint32_t k : places_of(s)) ends_[k] = pairs.further_end(s, rank++);
  }
}

WallContact WallContacts::at(std::size_t k) const {
  WallContact contact;
  contact.slot = slots_[k], contact.wall = walls_[k];
  contact.state = memories_.state(k);
  contact.sliding = memories_.sliding(k);
  contact.rolling = memories_.rolling(k);
  contact.force = memories_.force(k);
  if (memories_.kept().heat) contact.heat = memories_.heat(k), contact.power = power_[k];
  return contact;
}

WallView WallContacts::view() {
  const MemoryView m = memories_.view();
  return {slots_.data(), row_offsets_.data(),
          walls_.data(), ends_.data(),
          m.bits,        m.sliding,
          m.rolling,     m.forces,
          m.heat,        power_.empty() ? nullptr : power_.data()};
}

void WallContacts::ask(std::size_t block) const {
  if (block + 1 >= first_group_.size()) return;
  const std::size_t begin = first_group_[block], end = first_group_[block + 1];
  for (const auto* list : {&row_offsets_, &walls_, &ends_})
    ask_for(list->data() + begin * kLanes, (end - begin) * kLanes);
  memories_.ask(begin, end);
}

std::size_t WallContacts::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return memories_.bytes() + of(slots_) + of(row_offsets_) + of(walls_) + of(ends_) + of(power_) +
         of(first_group_) + of(first_quick_) + of(first_) + of(place_);
}

}  // namespace interstice::dem
