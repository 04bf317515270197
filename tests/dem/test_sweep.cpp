// The order in which a step works on pairs: whatever pairs there are, nothing that a block of rows needs
// comes after the block has moved, and pairs that are only near share few groups with those that touch.
#include "dem/sweep.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "base/random.h"

namespace interstice::dem {
namespace {

/// Pairs at random of rows near each other in memory, some of them far, class by class.
struct Pairs {
  std::vector<PairRef> pairs;
  PairClasses classes;
};
Pairs pairs_at_random(std::uint32_t rows, std::size_t each, bool two_rates) {
  Random random(7, 0);
  const auto below = [&](double n) { return static_cast<std::uint32_t>(random.uniform() * n); };
  Pairs p;
  for (std::size_t c = 0; c < PairClasses::kCount; ++c) {
    for (std::size_t k = 0; k < each && (two_rates || c < PairClasses::kQuick); ++k) {
      const std::uint32_t a = below(rows),
                          b = k % 50 == 0 ? below(rows) : std::min(rows - 1, a + 1 + below(300));
      if (a != b) p.pairs.push_back(k % 2 == 0 ? PairRef{a, b} : PairRef{b, a});
    }
    p.classes.end[c] = p.pairs.size();
  }
  return p;
}

std::size_t part_of(const Parts& parts, std::size_t row) {
  std::size_t part = 0;
  while (parts.first_block[part + 1] <= row / kRowsPerBlock) ++part;
  return part;
}

class Order : public ::testing::TestWithParam<std::tuple<std::size_t, bool>> {
 protected:
  static constexpr std::uint32_t kRows = 12000;
  static constexpr std::size_t kFarthest = 4096;

  bool two_rates() const { return std::get<1>(GetParam()); }
  Pairs all_ = pairs_at_random(kRows, 20000, two_rates());
  Parts parts_{kRows, std::get<0>(GetParam())};
  PairOrder order_ = order_pairs(all_.pairs, all_.classes, parts_, kFarthest);

  std::size_t group_of(std::size_t k) const { return order_.place[k] / kLanes; }
  std::size_t block_of(std::size_t k) const {
    return std::min(all_.pairs[k].a, all_.pairs[k].b) / kRowsPerBlock;
  }
  bool is_shared(std::size_t k) const { return group_of(k) < order_.sweep.shared_groups; }
};

TEST_P(Order, GivesEveryPairAPlaceOfItsOwn) {
  EXPECT_EQ(order_.places % kLanes, 0u);
  std::set<std::uint32_t> taken(order_.place.begin(), order_.place.end());
  EXPECT_EQ(taken.size(), all_.pairs.size());
  EXPECT_LT(*taken.rbegin(), order_.places);
}

TEST_P(Order, DoesPairsOfTwoPartsAndOfRowsFarApartFirst) {
  std::size_t far = 0;
  for (std::size_t k = 0; k < all_.pairs.size(); ++k) {
    const auto [first, last] = std::minmax(all_.pairs[k].a, all_.pairs[k].b);
    const bool apart = part_of(parts_, first) != part_of(parts_, last);
    EXPECT_EQ(is_shared(k), apart || last - first > kFarthest) << k;
    far += !apart && last - first > kFarthest;
    if (!is_shared(k)) {
      EXPECT_GE(group_of(k), order_.sweep.first_group[part_of(parts_, first)]) << k;
    }
  }
  EXPECT_EQ(far > 0, parts_.count() < 3);  // five parts are shorter
}

TEST_P(Order, SharesAllWhereNoneMayBeApart) {
  const PairOrder order = order_pairs(all_.pairs, all_.classes, parts_, 0);
  EXPECT_EQ(order.sweep.shared_groups * kLanes, order.places);
  EXPECT_LE(order.sweep.widest, kRowsPerBlock);
}

TEST_P(Order, KnowsOverHowManyRowsTheWorkOfABlockReaches) {
  std::size_t widest = 0;
  for (std::size_t k = 0; k < all_.pairs.size(); ++k) {
    if (is_shared(k)) continue;
    const std::size_t last = std::max(all_.pairs[k].a, all_.pairs[k].b);
    widest = std::max(widest, last + 1 - parts_.begin_row(block_of(k)));
  }
  EXPECT_EQ(order_.sweep.widest, widest);
  EXPECT_GT(widest, 1000u);
  EXPECT_LE(widest, kFarthest + kRowsPerBlock);
}

/// A block moves when the groups before `done_before` are done, which touch no row from `front` on.
TEST_P(Order, HasDoneAllThatABlockNeedsBeforeItMoves) {
  for (std::size_t k = 0; k < all_.pairs.size(); ++k) {
    if (is_shared(k)) continue;
    EXPECT_LT(group_of(k), order_.sweep.done_before[block_of(k)]) << k;
    EXPECT_LT(std::max(all_.pairs[k].a, all_.pairs[k].b), order_.sweep.front[block_of(k)]) << k;
  }
}

/// One a block where classes turn, one where a part begins; in each of the two runs of shared pairs as many
/// as it has borders between classes.
TEST_P(Order, MixesPairsThatTouchWithOthersInFewGroups) {
  std::vector<std::set<bool>> touching(order_.places / kLanes);
  for (std::size_t k = 0; k < all_.pairs.size(); ++k) {
    const std::size_t c = all_.classes.of(k);
    touching[group_of(k)].insert(c == PairClasses::kTouching || c == PairClasses::kQuick);
  }
  const auto mixed =
      std::count_if(touching.begin(), touching.end(), [](const auto& t) { return t.size() > 1; });
  const std::size_t runs = two_rates() ? 2 : 1;
  EXPECT_LE(static_cast<std::size_t>(mixed), runs * (parts_.blocks() + 2) + parts_.count());
  EXPECT_GT(mixed, 0);  // pairs do not come in sixteens
}

TEST_P(Order, KeepsQuickPairsInGroupsOfTheirOwn) {
  const Sweep& sweep = order_.sweep;
  for (std::size_t k = 0; k < all_.pairs.size(); ++k) {
    const std::size_t first_quick = is_shared(k) ? sweep.shared_quick : sweep.quick[block_of(k)];
    EXPECT_EQ(group_of(k) >= first_quick, all_.classes.is_quick(k) && two_rates()) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Sweeps, Order, ::testing::Combine(::testing::Values(1u, 2u, 5u), ::testing::Bool()));

}  // namespace
}  // namespace interstice::dem
