#include "voxel/lattice.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/error.h"

namespace interstice::voxel {
namespace {

TEST(CubicLattice, CoversTheBoxAndExtendsItUpward) {
  const Lattice exact = cubic_lattice({{-0.5e-3, -0.9e-3, 0}, {18e-3, 0.9e-3, 2.2e-3}}, 0.1e-3);
  EXPECT_EQ(exact.n,
            (std::array<std::int64_t, 3>{185, 18, 22}));  // multiples do not gain a cell from rounding
  const Lattice longer = cubic_lattice({{0, 0, 0}, {1.01e-3, 1e-3, 0.99e-3}}, 0.1e-3);
  EXPECT_EQ(longer.n, (std::array<std::int64_t, 3>{11, 10, 10}));
  EXPECT_GE(longer.box().hi.x, 1.01e-3);
}

TEST(CubicLattice, AVoxelLargerThanTheBoxIsOneCell) {
  const Lattice lattice = cubic_lattice({{0, 0, 0}, {1e-3, 2e-3, 3e-3}}, 1);
  EXPECT_EQ(lattice.n, (std::array<std::int64_t, 3>{1, 1, 1}));
}

TEST(CubicLattice, RefusesWhatHasNoVolume) {
  const double inf = std::numeric_limits<double>::infinity(), nan = std::nan("");
  const Box box{{0, 0, 0}, {1, 1, 1}};
  for (const double voxel : {0., -1., inf, nan}) EXPECT_THROW(cubic_lattice(box, voxel), InputError);
  EXPECT_THROW(cubic_lattice({{0, 0, 0}, {1, 0, 1}}, .1), InputError);
  EXPECT_THROW(cubic_lattice({{0, 0, 0}, {1, -1, 1}}, .1), InputError);
  EXPECT_THROW(cubic_lattice({{0, 0, 0}, {1, inf, 1}}, .1), InputError);
  EXPECT_THROW(cubic_lattice({{nan, 0, 0}, {1, 1, 1}}, .1), InputError);
  EXPECT_THROW(cubic_lattice(box, 1e-10), InputError);                     // 10^10 cells along an axis
  EXPECT_THROW(cubic_lattice({{0, 0, 0}, {1, 1, 1}}, 5e-10), InputError);  // 2 * 10^9 each: too many in all
}

TEST(CellAlong, CellsAreHalfOpenAndTheUpperFaceIsTheLastCells) {
  const Lattice lattice = cubic_lattice({{-1e-3, 0, 0}, {17e-3, 1e-3, 1e-3}}, 0.1e-3);
  for (std::int64_t i = 0; i < lattice.n[0]; ++i) {
    const double lo = lattice.lo.x + static_cast<double>(i) * lattice.h.x;
    EXPECT_EQ(cell_along(lattice, 0, lo), i);
    EXPECT_EQ(cell_along(lattice, 0, lo + 0.99 * lattice.h.x), i);
    EXPECT_EQ(cell_along(lattice, 0, std::nextafter(lo, -1.)), i);  // a face up to rounding is the face
    EXPECT_EQ(cell_along(lattice, 0, std::nextafter(lo, 1.)), i);
  }
  EXPECT_EQ(cell_along(lattice, 0, lattice.box().hi.x), lattice.n[0] - 1);
  EXPECT_THROW(cell_along(lattice, 0, -1.01e-3), InputError);
  EXPECT_THROW(cell_along(lattice, 0, 17.2e-3), InputError);
  EXPECT_THROW(cell_along(lattice, 0, std::nan("")), InputError);
}

TEST(FloorIndex, NeverOverflows) {
  EXPECT_EQ(floor_index(-0.5), -1);
  EXPECT_EQ(floor_index(2.0), 2);
  EXPECT_EQ(floor_index(1e300), std::int64_t{1} << 60);
  EXPECT_EQ(floor_index(-1e300), -(std::int64_t{1} << 60));
}

}  // namespace
}  // namespace interstice::voxel
