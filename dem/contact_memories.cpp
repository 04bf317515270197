#include "dem/contact_memories.h"

namespace interstice::dem {

void ContactMemories::reset(std::size_t places) {
  bits_.assign(places / kLanes, {});
  if (kept_.sliding) sliding_.reset(kSpringReals * places);
  if (kept_.rolling) rolling_.reset(kSpringReals * places);
  forces_.reset(0);
  if (kept_.heat) heat_.assign(places, {});
}

void ContactMemories::inherit(std::size_t k, const ContactMemories& old, std::size_t from) {
  bits_[k / kLanes].inherit(k % kLanes, old.bits_[from / kLanes], from % kLanes);
  if (kept_.sliding) copy_spring(old.sliding_, from, sliding_, k);
  if (kept_.rolling) copy_spring(old.rolling_, from, rolling_, k);
}

void ContactMemories::set_touching(std::size_t k, const TangentialSpring<double>& sliding,
                                   const TangentialSpring<double>& rolling) {
  bits_[k / kLanes].touch(k % kLanes);
  if (kept_.sliding) set_spring(sliding_, k, sliding);
  if (kept_.rolling) set_spring(rolling_, k, rolling);
}

void ContactMemories::keep_forces(bool keep) {
  const std::size_t n = keep ? 3 * kLanes * bits_.size() : 0;
  if (forces_.size() != n) forces_.reset(n);
}

MemoryView ContactMemories::view() {
  const auto data = [](auto& v) { return v.empty() ? nullptr : v.data(); };
  return {bits_.data(), data(sliding_), data(rolling_), data(forces_), data(heat_)};
}

void ContactMemories::ask(std::size_t begin, std::size_t end) const {
  ask_for(bits_.data() + begin, end - begin);
  for (const Reals* springs : {&sliding_, &rolling_})
    if (!springs->empty())
      springs->ask(spring_index(begin * kLanes, 0), kSpringReals * (end - begin) * kLanes);
}

std::size_t ContactMemories::bytes() const {
  return bits_.capacity() * sizeof(GroupBits) + sliding_.bytes() + rolling_.bytes() + forces_.bytes() +
         heat_.capacity() * sizeof(PairHeat);
}

}  // namespace interstice::dem
