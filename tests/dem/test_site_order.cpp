// Neighbours in space lie near each other in memory, however large the bed.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "dem/site_order.h"

namespace interstice::dem {
namespace {

struct Spread {
  double far;            // share of pairs of neighbours that lie in different columns
  std::size_t farthest;  // of the others in memory
  std::size_t wrapped;   // the same of pairs through periodic faces
};

/// Of neighbours on a cubic lattice of grains that touch, also through periodic faces across y and z.
Spread spread_on_lattice(std::size_t nx, std::size_t ny, std::size_t nz,
                         const std::array<bool, 3>& periodic = {}) {
  const double d = 4e-5, gap = 1.0001 * d;  // no grain stands where two slabs meet
  std::vector<GrainSite> sites;
  for (std::size_t i = 0; i < nx * ny * nz; ++i) {
    GrainSite site{};
    site.x = gap * static_cast<double>(i % nx), site.y = gap * static_cast<double>(i / nx % ny);
    site.z = gap * static_cast<double>(i / nx / ny), site.radius = 0.5 * d;
    sites.push_back(site);
  }
  const std::vector<std::uint32_t> order = order_in_space(sites, periodic);
  std::vector<std::size_t> place(order.size(), order.size());
  for (std::size_t p = 0; p < order.size(); ++p) place[order[p]] = p;
  EXPECT_EQ(std::ranges::count(place, order.size()), 0) << "everyone once";
  Spread spread{0, 0, 0};
  double pairs = 0;
  const auto look_at = [&](std::size_t i, std::size_t j) {
    const std::size_t apart = std::max(place[i], place[j]) - std::min(place[i], place[j]);
    ++pairs;
    if (apart > 8192) {
      ++spread.far;
    } else {
      spread.farthest = std::max(spread.farthest, apart);
    }
  };
  for (std::size_t i = 0; i < sites.size(); ++i) {
    if (i % nx + 1 < nx) look_at(i, i + 1);
    if (i / nx % ny + 1 < ny) look_at(i, i + nx);
    if (i / nx / ny + 1 < nz) look_at(i, i + nx * ny);
    const auto look_through = [&](std::size_t j) {
      spread.wrapped = std::max(spread.wrapped, std::max(place[i], place[j]) - std::min(place[i], place[j]));
    };
    if (periodic[1] && i / nx % ny == 0) look_through(i + nx * (ny - 1));
    if (periodic[2] && i / nx / ny == 0) look_through(i + nx * ny * (nz - 1));
  }
  spread.far /= pairs;
  return spread;
}

TEST(SiteOrder, NeighboursOfABedOfSmallSectionLieInTheNextSlabAtMost) {
  for (const auto& [nx, ny, nz] :
       {std::array<std::size_t, 3>{300, 20, 25}, {60, 150, 60}, {40, 150, 60}, {200, 60, 40}}) {
    const std::size_t section = nx * ny * nz / std::max({nx, ny, nz});
    ASSERT_LE(section, kMostInSlab);
    const Spread small = spread_on_lattice(nx, ny, nz);
    EXPECT_EQ(small.far, 0) << nx;
    EXPECT_LE(small.farthest, section) << nx;  // the same place in the next slab
  }
}

TEST(SiteOrder, NeighboursThroughFacesOfASlabLieWithinTwoRows) {
  for (const auto& [nx, ny, nz] :
       {std::array<std::size_t, 3>{300, 20, 25}, {300, 25, 20}, {200, 60, 40}, {200, 40, 60}}) {
    for (const auto& periodic : {std::array{false, true, false}, {false, false, true}, {true, true, true}}) {
      const Spread spread = spread_on_lattice(nx, ny, nz, periodic);
      EXPECT_GT(spread.wrapped, 0u) << nx;
      EXPECT_LE(spread.wrapped, 2 * std::min(ny, nz)) << ny << ' ' << nz;
    }
  }
}

TEST(SiteOrder, ABedOfLargeSectionIsCutIntoColumns) {
  for (const auto& [nx, ny, nz] : {std::array<std::size_t, 3>{70, 70, 70}, {90, 150, 60}, {250, 80, 80}}) {
    const Spread large = spread_on_lattice(nx, ny, nz);
    EXPECT_LT(static_cast<double>(large.farthest), 3.5 * kGrainsInSlabOfColumn)
        << nx;                      // two slabs, and rounding
    EXPECT_GT(large.far, 0) << nx;  // between columns
    EXPECT_LT(large.far, 0.03) << nx;
  }
}

TEST(SiteOrder, OneGrainAndNone) {
  EXPECT_TRUE(order_in_space({}, {}).empty());
  EXPECT_EQ(order_in_space({GrainSite{}}, {}), std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace interstice::dem
