// The upkeep of lists. Every grain has a reach that it may go before lists are made anew, and two grains are
// listed where their reaches meet: candidates by a long reach, found by a search in space, and of these the
// pairs that a step works on by a short one. A reach is made for some number of steps at the grain's own
// speed, so that a few fast grains above a bed at rest do not cost new lists of the bed. Bits do not depend
// on any of this, only speed does.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "dem/path_left.h"
#include "dem/simulation.h"
#include "dem/site_order.h"

namespace interstice::dem {
namespace {

constexpr std::int64_t kRebuildsPerSort = 32;

/// Steps for which near pairs shall last, and how many times as long candidates: a refresh takes some five
/// steps, a search three times that.
constexpr double kStepsAhead = 100, kCandidatesLast = 6;
/// Candidates that leave a grain fewer steps than this, and less than this share of its reach, are found
/// anew.
constexpr double kLeastSteps = 20, kLeastShare = 0.25;
/// A grain may become faster: its reach is so many times what it needs at its present speed.
constexpr double kHaste = 1.5;
/// The least and the greatest short reach, in mean diameters: where all is at rest lists need not last
/// forever, and where grains fly long reaches would list pairs that never touch. A wall that moves sets
/// grains at rest in motion all the time: their reach is longer then.
constexpr double kLeastReach = 0.001, kLeastReachWhilePushed = 0.01, kGreatestReach = 0.1;
/// The least long reach, in mean diameters.
constexpr double kLeastCandidateReach = 0.02;
/// Pairs this near, as a share of their short reaches, are next to touch. Where powder flows, groups that
/// must be worked on are so fewest: 12.7 of 16 places touch, 11.8 with 0.003, 12.3 with 0.1, 11.0 without.
constexpr double kNextShare = 0.03;
/// Reaches are kept in single precision: those that must fit are so much shorter.
constexpr double kFits = 1 - 1e-6;

}  // namespace

/// The short reach of something that moves with this speed [m]; `pushed`: some wall moves.
double Simulation::near_reach(double speed, bool pushed) const {
  if (options_.skin > 0) return options_.skin / (2 * kCandidatesLast);
  const double least = pushed ? kLeastReachWhilePushed : kLeastReach;
  return mean_diameter_ *
         std::clamp(kHaste * kStepsAhead * dt_ * speed / mean_diameter_, least, kGreatestReach);
}

double Simulation::speed_of(std::size_t slot) const {
  return grains_.with_rows([&](const auto& rows) {
    const auto& r = rows[slot];
    return std::sqrt(static_cast<double>(r.vx * r.vx + r.vy * r.vy + r.vz * r.vz));
  });
}

/// What is left of a long reach [m].
double Simulation::candidate_reach_left(std::size_t slot) const {
  return static_cast<double>(reach_[slot]) -
         norm(grains_.site(slot).position() - grains_.labels()[slot].built);
}

double Simulation::candidate_reach_of(std::size_t slot, bool pushed) const {
  if (options_.skin > 0) return options_.skin / 2;
  return std::max(kCandidatesLast * near_reach(speed_of(slot), pushed),
                  kLeastCandidateReach * mean_diameter_);
}

double Simulation::fastest_wall() const {
  double fastest = 0;
  for (const WallMotion& m : motion_of_wall_) fastest = std::max(fastest, norm(m.velocity));
  return fastest;
}

/// How far walls may go before those near grains are listed anew [m].
double Simulation::near_reach_of_walls() const {
  const double fastest = fastest_wall();
  return fastest > 0 ? near_reach(fastest, true) : 0;
}

double Simulation::wall_travel() const {
  double farthest = 0;
  for (std::size_t w = 0; w < walls_.size(); ++w) {
    const auto corner = [](const Shape& s) {
      return std::holds_alternative<Plane>(s) ? std::get<Plane>(s).point : std::get<Box>(s).lo;
    };
    farthest = std::max(farthest, norm(corner(walls_[w]) - corner(refreshed_walls_[w])));
  }
  return farthest;
}

/// Is enough left of all long reaches?
bool Simulation::candidates_last() const {
  const Blocks blocks{grains_.size(), 4096};
  std::vector<std::uint8_t> short_of(blocks.count(), 0);
  for_each_block(blocks, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (candidate_reach_left(i) <
          std::min(kLeastSteps * dt_ * speed_of(i), kLeastShare * static_cast<double>(reach_[i])))
        short_of[b] = 1;
  });
  return std::find(short_of.begin(), short_of.end(), 1) == short_of.end();
}

/// Only the grains in these slots are left: what is known of their neighbours still holds.
void Simulation::drop_from_lists(const std::vector<std::uint32_t>& kept) {
  std::vector<std::uint32_t> new_slot(reach_.size(), PairContacts::kNoSlot);
  std::vector<std::uint32_t> stood_at(kept.size());
  for (std::uint32_t s = 0; s < kept.size(); ++s) {
    new_slot[kept[s]] = s;
    reach_[s] = reach_[kept[s]];
    stood_at[s] = stood_at_.empty() ? kept[s] : stood_at_[kept[s]];
  }
  stood_at_ = std::move(stood_at);
  reach_.resize(kept.size());
  std::size_t left = 0;
  for (const PairRef& c : candidates_) {
    const PairRef now{new_slot[c.a], new_slot[c.b]};
    if (now.a != PairContacts::kNoSlot && now.b != PairContacts::kNoSlot) candidates_[left++] = now;
  }
  candidates_.resize(left);
}

void Simulation::update_lists() {
  if (list_valid_ && !strayed_ && stood_at_.empty() &&
      wall_travel() + (options_.rates.two() ? dt_ * fastest_wall() : 0) <= reach_of_walls_)
    return;
  if (list_valid_ && candidates_last()) {
    refresh(stood_at_, grains_.sites());
    if (!stood_at_.empty()) note_ids();
  } else {
    rebuild();
  }
}

/// How far bodies act on each other beyond contact [m], at most.
double Simulation::attraction_reach(double largest) const {
  double reach = 0;
  for (const PairConstants<double>& c : constants_) {
    if (model_.laws.cohesion == CohesionLaw::jkr)  // grows with R*, which is at most the radius (at a wall)
      reach = std::max(reach, jkr_reach(c.effective_modulus, c.work_of_adhesion, largest));
    if (model_.laws.cohesion == CohesionLaw::van_der_waals) reach = std::max(reach, c.range);
  }
  return reach;
}

/// The longest reach with which no grain is near two images of another [m]. Throws InputError where a
/// periodic axis leaves none.
double Simulation::longest_reach(double largest) const {
  double longest = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    if (model_.boundary[axis] != AxisBoundary::periodic) continue;
    const double length = model_.domain.hi[axis] - model_.domain.lo[axis];
    longest = std::min(longest, kFits * (0.25 * length - 0.5 * attraction_ - largest));
    if (longest > 0) continue;
    throw InputError(
        "domain.box: the periodic axis " + std::string(1, "xyz"[axis]) +
        " is shorter than two of the largest grains; make it longer, or the boundary open or a wall");
  }
  return longest;
}

/// Now and then, or when grains came or went: neighbours in space beside each other in memory.
void Simulation::sort_grains(std::vector<GrainSite>& sites) {
  if (sorted_at_ >= 0 && sites.size() == built_ids_.size() && rebuilds_ - sorted_at_ < kRebuildsPerSort)
    return;
  std::vector<std::uint32_t> order = order_in_space(sites, search_space().periodic);
  if (rest_) put_awake_first(order);
  if (options_.rates.two()) put_beating_first(order);
  grains_.take(order);
  sites = grains_.sites();
  sorted_at_ = rebuilds_;
}

void Simulation::rebuild() {
  std::vector<GrainSite> sites = grains_.sites();
  double largest = 0, radius_sum = 0;
  for (const GrainSite& g : sites) largest = std::max(largest, g.radius), radius_sum += g.radius;
  mean_diameter_ = sites.empty() ? 0 : 2 * radius_sum / static_cast<double>(sites.size());
  attraction_ = attraction_reach(largest);
  std::vector<std::uint32_t> slot_of_id(static_cast<std::size_t>(next_id_), PairContacts::kNoSlot);
  for (std::uint32_t s = 0; s < built_ids_.size(); ++s) slot_of_id[built_ids_[s]] = s;
  sort_grains(sites);
  std::vector<std::uint32_t> old_slot(sites.size());
  for (std::size_t s = 0; s < sites.size(); ++s)
    old_slot[s] = slot_of_id[static_cast<std::size_t>(sites[s].id)];
  note_ids();
  for (std::size_t s = 0; s < sites.size(); ++s) grains_.labels()[s].built = sites[s].position();
  note_materials();
  find_candidates(sites, longest_reach(largest));
  refresh(old_slot, sites);
  list_valid_ = true;
  ++rebuilds_;
}

/// The list of pairs goes by the present slots.
void Simulation::note_ids() {
  built_ids_.resize(grains_.size());
  for (std::size_t s = 0; s < built_ids_.size(); ++s) built_ids_[s] = grains_.labels()[s].id;
  stood_at_.clear();
}

void Simulation::note_materials() {
  const std::vector<std::uint16_t>& materials = grains_.materials();
  only_material_ = materials.empty() ? 0 : materials[0];
  if (std::ranges::any_of(materials, [&](std::uint16_t m) { return m != only_material_; }))
    only_material_ = -1;
}

void Simulation::find_candidates(const std::vector<GrainSite>& sites, double longest) {
  std::vector<GrainSite> reaching = sites;
  reach_.resize(sites.size());
  const bool pushed = fastest_wall() > 0;
  for (std::size_t s = 0; s < sites.size(); ++s) {
    reach_[s] = static_cast<float>(std::min(candidate_reach_of(s, pushed), longest));
    reaching[s].radius += static_cast<double>(reach_[s]);
  }
  SearchSpace space = search_space();
  space.skin = attraction_;
  candidates_ = options_.reference ? find_pairs_brute_force(reaching, space) : find_pairs(reaching, space);
}

/// Of the candidates those whose short reaches meet; and the walls near grains.
void Simulation::refresh(const std::vector<std::uint32_t>& old_slot, const std::vector<GrainSite>& sites) {
  SearchSpace space = search_space();
  space.skin = attraction_;
  const NearTest near(space);
  std::vector<GrainSite> reaching = sites;
  path_left_.assign(groups_for(sites.size()) * kLanes, 0);
  const double kept_back = reserve();
  const bool pushed = fastest_wall() > 0;
  for (std::size_t s = 0; s < sites.size(); ++s) {
    const double reach = std::min(near_reach(speed_of(s), pushed) + kept_back, candidate_reach_left(s));
    path_left_[s] = rounded_down(reach - kept_back);
    reaching[s].radius += reach;
  }
  const Blocks blocks{candidates_.size(), 4096};
  std::array<std::vector<std::vector<PairRef>>, PairClasses::kCount> by_class;
  by_class.fill(std::vector<std::vector<PairRef>>(blocks.count()));
  const auto is_quick = [&](std::uint32_t slot) {
    return options_.rates.two() && options_.rates.is_quick(sites[slot].radius);
  };
  const auto in_part = [&](std::uint32_t slot) {
    GrainSite site = sites[slot];
    site.radius += kNextShare * (reaching[slot].radius - site.radius);
    return site;
  };
  const auto sleeps = [&](std::uint32_t slot) { return rest_ && grains_.rests()[slot].asleep(); };
  for_each_block(blocks, [&](std::size_t b, std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const PairRef& c = candidates_[k];
      if (!near(reaching[c.a], reaching[c.b])) continue;
      const std::size_t rank = near(sites[c.a], sites[c.b])       ? PairClasses::kTouching
                               : near(in_part(c.a), in_part(c.b)) ? PairClasses::kNext
                                                                  : PairClasses::kNear;
      by_class[sleeps(c.a) && sleeps(c.b)       ? PairClasses::kAsleep
               : is_quick(c.a) || is_quick(c.b) ? PairClasses::kQuick + rank
                                                : rank][b]
          .push_back(c);
    }
  });
  std::vector<PairRef> pairs;
  pairs.reserve(candidates_.size());
  PairClasses classes;
  for (std::size_t rank = 0; rank < by_class.size(); ++rank) {
    for (const auto& block : by_class[rank]) pairs.insert(pairs.end(), block.begin(), block.end());
    classes.end[rank] = pairs.size();
  }
  reach_of_walls_ = near_reach_of_walls();
  wall_contacts_.replace(sites, reaching, walls_, reach_of_walls_ + attraction_, old_slot);
  std::vector<std::uint32_t> walls_near(sites.size());
  for (std::size_t s = 0; s < sites.size(); ++s)
    walls_near[s] = static_cast<std::uint32_t>(wall_contacts_.places_of(s).size());
  pair_contacts_.replace(pairs, classes, sites, old_slot, parts(), farthest_in_part(), walls_near);
  wall_contacts_.place_ends(pair_contacts_);
  if (options_.rates.two()) note_quick_slots(sites);
  refreshed_walls_ = walls_;
  survey_due_ = true;
  strayed_ = false;
}

/// One for each thread: what parts share is worked on apart, which costs more. Where grains sleep, parts are
/// uneven, and several a thread keep the fastest from waiting for the slowest.
Parts Simulation::parts() const {
  if (options_.reference || threads() == 1) return {grains_.size(), 1};
  return {grains_.size(), threads() * (rest_ ? 2 : 1)};
}

/// How far apart rows may lie whose pairs are worked on within a part: of the largest whole slabs one and a
/// half, beyond most grains in the next; smaller ones may be two apart. Energies are accounted for when all
/// pairs are done.
std::size_t Simulation::farthest_in_part() const { return options_.energies ? 0 : kMostInSlab * 3 / 2; }

}  // namespace interstice::dem
