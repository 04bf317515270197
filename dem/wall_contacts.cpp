#include "dem/wall_contacts.h"

#include <algorithm>
#include <utility>

#include "base/parallel.h"
#include "dem/contacts.h"
#include "dem/wall_distance.h"

namespace interstice::dem {

WallContacts::WallContacts(const KeptMemories& kept, Precision precision, const Rates& rates)
    : kept_(kept), rates_(rates), sliding_(precision), rolling_(precision), forces_(precision) {}

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
  bits_.assign(places() / kLanes, {});
  if (kept_.sliding) sliding_.reset(kSpringReals * places());
  if (kept_.rolling) rolling_.reset(kSpringReals * places());
  forces_.reset(0);
  if (kept_.heat) heat_.assign(places(), {}), power_.assign(places(), 0);
  for (std::size_t s = 0; s < sites.size(); ++s) {
    const std::size_t before = old_slot.empty() ? s : old_slot[s];
    for (const std::uint32_t k : places_of(s)) {
      bits_[k / kLanes].list(k % kLanes);
      if (before == PairContacts::kNoSlot) continue;
      for (const std::uint32_t from : old.places_of(before)) {
        if (old.walls_[from] != walls_[k]) continue;
        bits_[k / kLanes].inherit(k % kLanes, old.bits_[from / kLanes], from % kLanes);
        if (kept_.sliding) copy_spring(old.sliding_, from, sliding_, k);
        if (kept_.rolling) copy_spring(old.rolling_, from, rolling_, k);
      }
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
  contact.state = bits_[k / kLanes].state(k % kLanes);
  contact.sliding = spring_at(sliding_, k);
  contact.rolling = spring_at(rolling_, k);
  contact.force = vector_at(forces_, k);
  if (kept_.heat) contact.heat = heat_[k], contact.power = power_[k];
  return contact;
}

void WallContacts::set_touching(std::size_t k, const TangentialSpring<double>& sliding,
                                const TangentialSpring<double>& rolling) {
  bits_[k / kLanes].touch(k % kLanes);
  if (kept_.sliding) set_spring(sliding_, k, sliding);
  if (kept_.rolling) set_spring(rolling_, k, rolling);
}

void WallContacts::keep_forces(bool keep) {
  const std::size_t n = keep ? 3 * places() : 0;
  if (forces_.size() != n) forces_.reset(n);
}

WallView WallContacts::view() {
  const auto data = [](auto& reals) { return reals.empty() ? nullptr : reals.data(); };
  return {slots_.data(),  walls_.data(), ends_.data(), bits_.data(), data(sliding_),
          data(rolling_), data(forces_), data(heat_),  data(power_)};
}

std::size_t WallContacts::bytes() const {
  const auto of = [](const auto& v) { return v.capacity() * sizeof(v[0]); };
  return of(slots_) + of(walls_) + of(ends_) + of(bits_) + of(first_quick_) + sliding_.bytes() +
         rolling_.bytes() + forces_.bytes() + of(heat_) + of(power_) + of(first_group_) + of(first_) +
         of(place_);
}

}  // namespace interstice::dem
