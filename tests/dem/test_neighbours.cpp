// The grid search against trying every pair.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "base/random.h"
#include "dem/neighbours.h"

namespace interstice::dem {
namespace {

std::vector<GrainSite> cloud(std::size_t n, double smallest, double largest, const Box& box,
                             std::uint64_t seed) {
  Random random(seed, 1);
  std::vector<GrainSite> rows(n);
  for (std::size_t i = 0; i < n; ++i) {
    rows[i] = {};
    rows[i].radius = smallest * std::pow(largest / smallest, random.uniform());
    rows[i].x = random.uniform(box.lo.x, box.hi.x);
    rows[i].y = random.uniform(box.lo.y, box.hi.y);
    rows[i].z = random.uniform(box.lo.z, box.hi.z);
    rows[i].id = static_cast<std::int64_t>((i * 7919) % n);  // ids are not in the order of slots
  }
  return rows;
}

std::set<std::pair<std::uint32_t, std::uint32_t>> as_set(const std::vector<PairRef>& pairs) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> s;
  for (const PairRef& p : pairs) EXPECT_TRUE(s.insert({p.a, p.b}).second) << "a pair was found twice";
  return s;
}

struct Case {
  const char* name;
  std::size_t n;
  double smallest, largest;
  Box box;
  std::array<bool, 3> periodic;
};

class Search : public ::testing::TestWithParam<Case> {};

TEST_P(Search, FindsExactlyThePairsThatBruteForceFinds) {
  const Case& c = GetParam();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const auto rows = cloud(c.n, c.smallest, c.largest, c.box, seed);
    const SearchSpace space{c.box, c.periodic, 2e-6};
    const auto found = as_set(find_pairs(rows, space)),
               expected = as_set(find_pairs_brute_force(rows, space));
    EXPECT_EQ(found, expected);
    EXPECT_GT(expected.size(), 10u);
    for (const auto& [a, b] : found) EXPECT_LT(rows[a].id, rows[b].id);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Clouds, Search,
    ::testing::Values(
        Case{"equal", 800, 20e-6, 20e-6, {{0, 0, 0}, {5e-4, 5e-4, 5e-4}}, {false, false, false}},
        Case{"thirteen_to_one", 800, 2.5e-6, 32.5e-6, {{0, 0, 0}, {4e-4, 4e-4, 4e-4}}, {false, false, false}},
        Case{"hundred_to_one", 600, 1e-6, 100e-6, {{0, 0, 0}, {1e-3, 1e-3, 1e-3}}, {false, false, false}},
        Case{"periodic", 600, 5e-6, 30e-6, {{-1e-4, 0, 0}, {2e-4, 3e-4, 3e-4}}, {true, true, false}},
        Case{"narrow_periodic", 400, 5e-6, 20e-6, {{0, 0, 0}, {1e-4, 1.1e-4, 6e-4}}, {true, true, true}},
        Case{"long_and_thin", 500, 2e-6, 30e-6, {{0, 0, 0}, {5e-3, 1e-4, 1e-4}}, {false, false, false}},
        Case{"far_away",
             500,
             5e-6,
             30e-6,
             {{10, 10, 10}, {10.0003, 10.0003, 10.0003}},
             {false, false, false}}),
    [](const auto& tested) { return tested.param.name; });

TEST(Search, EmptyAndLonely) {
  EXPECT_TRUE(find_pairs({}, {}).empty());
  EXPECT_TRUE(find_pairs(cloud(1, 1e-5, 1e-5, {{0, 0, 0}, {1, 1, 1}}, 1), {}).empty());
}

TEST(Search, AFewFineGrainsInALongDomainStayCheap) {
  // 20 grains of 1 um spread over a metre among large ones: cells of their own size would be 1e15.
  auto rows = cloud(50, 1e-3, 2e-3, {{0, 0, 0}, {1, 1, 1}}, 5);
  const auto fine = cloud(20, 1e-6, 1e-6, {{0, 0, 0}, {1, 1, 1}}, 6);
  rows.insert(rows.end(), fine.begin(), fine.end());
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i].id = static_cast<std::int64_t>(i);
  const SearchSpace space{{{0, 0, 0}, {1, 1, 1}}, {}, 1e-6};
  EXPECT_EQ(as_set(find_pairs(rows, space)), as_set(find_pairs_brute_force(rows, space)));
}

}  // namespace
}  // namespace interstice::dem
