// Quantities beside volume fractions, against sums over spheres written out cell by cell in the test, and
// against what must hold whatever the spheres: conservation, a common velocity, partition, threads.
#include "voxel/quantities.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <functional>
#include <limits>

#include "base/error.h"
#include "tests/voxel/support.h"
#include "voxel/field.h"
#include "voxel/overlap.h"
#include "voxel/sample.h"

namespace interstice::voxel::test {
namespace {

constexpr double kFloat = 1.2e-7;  // two roundings to float, relative

/// Spheres with all columns.
struct Grains : Spheres {
  std::array<std::vector<double>, 3> v;
  std::vector<double> coordination;
  std::array<std::vector<double>, 6> stress;
  std::vector<std::int32_t> bonded, group;

  SpheresView view() const {
    SpheresView all = Spheres::view();
    for (std::size_t a = 0; a < 3; ++a) all.velocity[a] = v[a].data();
    for (std::size_t c = 0; c < 6; ++c) all.stress[c] = stress[c].data();
    all.coordination = coordination.data(), all.bonded = bonded.data(), all.group = group.data();
    return all;
  }
  Vec3d velocity(std::size_t s) const { return {v[0][s], v[1][s], v[2][s]}; }
};

Grains grains_of(const Spheres& spheres, std::uint64_t seed = 3) {
  Grains grains;
  static_cast<Spheres&>(grains) = spheres;
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    Random random(seed, s);
    for (auto& column : grains.v) column.push_back(random.uniform(-1, 2));
    for (auto& column : grains.stress) column.push_back(random.uniform(-2e4, 1e4));
    grains.coordination.push_back(std::floor(random.uniform(0, 9)));
    grains.bonded.push_back(random.uniform() < 0.3);
    grains.group.push_back(static_cast<std::int32_t>(random.uniform(0, 4)) - 1);
  }
  return grains;
}

QuantityRequest everything() { return {true, true, true, true, true, true, {"small", "middle", "large"}}; }

FieldRequest request_for(const Box& box, double voxel) {
  FieldRequest request;
  request.lattice = cubic_lattice(box, voxel);
  request.quantities = everything();
  return request;
}

const QuantityGrid& quantity(const Field& field, const std::string& name) {
  for (const QuantityGrid& q : field.quantities)
    if (q.full_name() == name) return q;
  throw InputError("no quantity " + name);
}

double at(const FloatGridPtr& grid, const openvdb::Coord& cell) {
  return static_cast<double>(grid->tree().getValue(cell));
}

/// A number of each sphere, and the name of the mean over the solid of it, or of its sum a volume.
struct Linear {
  const char* name;
  std::function<double(const Grains&, std::size_t)> of;
  double scale;  // of its values
};

std::vector<Linear> linear() {
  const auto stress = [](std::size_t c) {
    return [c](const Grains& g, std::size_t s) { return g.stress[c][s]; };
  };
  const auto in_group = [](std::int32_t n) {
    return [n](const Grains& g, std::size_t s) { return g.group[s] == n ? 1.0 : 0.0; };
  };
  const auto velocity = [](std::size_t a) {
    return [a](const Grains& g, std::size_t s) { return g.v[a][s]; };
  };
  return {
      {"mean_diameter", [](const Grains& g, std::size_t s) { return 2 * g.radius[s]; }, 65e-6},
      {"coordination", [](const Grains& g, std::size_t s) { return g.coordination[s]; }, 9},
      {"stress_xx", stress(0), 2e4},
      {"stress_yy", stress(1), 2e4},
      {"stress_zz", stress(2), 2e4},
      {"stress_xy", stress(3), 2e4},
      {"stress_yz", stress(4), 2e4},
      {"stress_xz", stress(5), 2e4},
      {"pressure",
       [](const Grains& g, std::size_t s) { return -(g.stress[0][s] + g.stress[1][s] + g.stress[2][s]) / 3; },
       2e4},
      {"bonded_fraction", [](const Grains& g, std::size_t s) { return double(g.bonded[s]); }, 1},
      {"solid_fraction_small", in_group(0), 1},
      {"solid_fraction_middle", in_group(1), 1},
      {"solid_fraction_large", in_group(2), 1},
      {"velocity_x", velocity(0), 2},
      {"velocity_y", velocity(1), 2},
      {"velocity_z", velocity(2), 2}};
}

/// Each sphere's share of each cell, one after the other; periodic images where asked for.
std::vector<std::vector<double>> shares_of(const Spheres& spheres, const FieldRequest& request) {
  const Lattice& lattice = request.lattice;
  const Vec3d size = lattice.box().size();
  std::vector<std::vector<double>> shares(static_cast<std::size_t>(lattice.cells()),
                                          std::vector<double>(spheres.size(), 0.0));
  for (std::size_t s = 0; s < spheres.size(); ++s)
    for (int image = 0; image < 27; ++image) {
      const std::array<int, 3> m{image % 3 - 1, image / 3 % 3 - 1, image / 9 - 1};
      Vec3d center = spheres.center(s);
      bool used = true;
      for (int axis = 0; axis < 3; ++axis) {
        used = used && (m[axis] == 0 || request.periodic[axis]);
        center[axis] += m[axis] * size[axis];
      }
      if (!used) continue;
      for_each_overlap(lattice, center, spheres.radius[s], all_cells(lattice),
                       [&](std::int64_t i, std::int64_t j, std::int64_t k, double volume) {
                         shares[static_cast<std::size_t>((i * lattice.n[1] + j) * lattice.n[2] + k)][s] +=
                             volume / lattice.cell_volume();
                       });
    }
  return shares;
}

template <class Visit>
void for_cells(const Lattice& lattice, const Visit& visit) {
  std::size_t n = 0;
  for (int i = 0; i < lattice.n[0]; ++i)
    for (int j = 0; j < lattice.n[1]; ++j)
      for (int k = 0; k < lattice.n[2]; ++k) visit(openvdb::Coord(i, j, k), n++);
}

/// The temperature of spheres that have these shares, about their own mean, in two passes.
double temperature_of(const Grains& grains, const std::vector<double>& shares) {
  double solid = 0, squared = 0;
  Vec3d sum{0, 0, 0};
  for (std::size_t s = 0; s < shares.size(); ++s) solid += shares[s], sum += shares[s] * grains.velocity(s);
  const Vec3d mean = (1 / solid) * sum;
  for (std::size_t s = 0; s < shares.size(); ++s) {
    const Vec3d u = grains.velocity(s) - mean;
    squared += shares[s] * dot(u, u);
  }
  return squared / (3 * solid);
}

void expect_sums_over_spheres(const Field& field, const Grains& grains,
                              const std::vector<std::vector<double>>& shares, double tolerance) {
  for_cells(field.lattice, [&](const openvdb::Coord& cell, std::size_t n) {
    double solid = 0;
    for (const double share : shares[n]) solid += share;
    if (solid < 1e-9) return;  // a mean over next to nothing is worth as little
    for (const Linear& number : linear()) {
      const QuantityGrid& q = quantity(field, number.name);
      double sum = 0;
      for (std::size_t s = 0; s < shares[n].size(); ++s) sum += shares[n][s] * number.of(grains, s);
      const double expected = q.per_solid ? sum / solid : sum;
      ASSERT_NEAR(at(q.grid, cell), expected, tolerance * number.scale) << number.name << cell;
    }
    ASSERT_NEAR(at(quantity(field, "temperature").grid, cell), temperature_of(grains, shares[n]), tolerance)
        << cell;
  });
}

TEST(Quantities, AreSumsOverSpheresInEveryVoxel) {
  for (const double voxel :
       {4e-6, 17.3e-6, 90e-6})  // the first: larger spheres go the other way of overlap.h
    for (const bool periodic : {false, true}) {
      const Box box{{0, 0, 0}, {180e-6, 180e-6, 90e-6}};
      const Grains grains = grains_of(random_spheres(25, box, 3e-6, 33e-6, 8));
      FieldRequest request = request_for(box, voxel == 17.3e-6 ? 18e-6 : voxel == 4e-6 ? 4.5e-6 : voxel);
      request.periodic = {periodic, periodic, false};
      const Field field = compute_field(grains.view(), {}, request);
      // a share of 1e-9 is known to 1e-16 (R/h)^3 of the cell, 5e-14: far below what a float keeps
      expect_sums_over_spheres(field, grains, shares_of(grains, request), 1e-6);
    }
}

TEST(Quantities, HaveNoValueWithoutSolid) {
  Spheres one;
  one.add({52e-6, 48e-6, 50e-6}, 21e-6);
  Grains grain = grains_of(one);
  grain.group = {1}, grain.bonded = {1};
  const Field field = compute_field(grain.view(), {}, request_for({{0, 0, 0}, {1e-4, 1e-4, 1e-4}}, 10e-6));
  const auto solid = field.solid_fraction->activeVoxelCount();
  EXPECT_GT(solid, 0u);
  for (const QuantityGrid& q : field.quantities) {
    EXPECT_EQ(q.grid->activeVoxelCount(), solid) << q.full_name();
    EXPECT_EQ(q.grid->background(), 0) << q.full_name();
  }
  // one sphere: its own numbers wherever it is, to the bit, and no temperature at all
  for (auto it = field.solid_fraction->cbeginValueOn(); it; ++it) {
    const openvdb::Coord cell = it.getCoord();
    EXPECT_EQ(at(quantity(field, "velocity_y").grid, cell), static_cast<float>(grain.v[1][0]));
    EXPECT_EQ(at(quantity(field, "temperature").grid, cell), 0);
    EXPECT_FLOAT_EQ(static_cast<float>(at(quantity(field, "mean_diameter").grid, cell)), 42e-6f);
    EXPECT_EQ(at(quantity(field, "bonded_mask").grid, cell), 1);
    const double share = static_cast<double>(it.getValue());
    EXPECT_NEAR(at(quantity(field, "stress_xy").grid, cell), share * grain.stress[3][0], kFloat * 2e4);
    EXPECT_EQ(at(quantity(field, "solid_fraction_middle").grid, cell), share);
    EXPECT_EQ(at(quantity(field, "solid_fraction_small").grid, cell), 0);
  }
  const Samples line = sample_line(field, 0, {0, 5e-6, 5e-6});
  for (const SampledQuantity& q : line.quantities)
    for (const double value : q.values) EXPECT_TRUE(std::isnan(value)) << q.name;
}

TEST(Quantities, AreConserved) {
  const Box box = bed_box();
  const Grains grains = grains_of(bed());
  for (const double voxel : {2.1e-6, 17.3e-6, 400e-6}) {
    FieldRequest request = request_for(box, voxel);
    const Field field = compute_field(grains.view(), {}, request);
    for (const Linear& number : linear()) {
      double sum = 0, magnitude = 0;
      for (std::size_t s = 0; s < grains.size(); ++s) {
        const double volume = sphere_box_volume(grains.center(s), grains.radius[s], request.lattice.box());
        sum += volume * number.of(grains, s);
        magnitude += volume * std::abs(number.of(grains, s));
      }
      // as the solid volume is conserved (the contract)
      EXPECT_NEAR(quantity(field, number.name).integral, sum, 1e-12 * magnitude) << number.name;
    }
    // second moments: what is in the temperature, and what is in the mean (both as floats)
    double moments = 0, expected = 0;
    for (auto it = field.solid_fraction->cbeginValueOn(); it; ++it) {
      const openvdb::Coord cell = it.getCoord();
      double squared = 3 * at(quantity(field, "temperature").grid, cell);
      for (const char* name : {"velocity_x", "velocity_y", "velocity_z"})
        squared += std::pow(at(quantity(field, name).grid, cell), 2);
      moments += static_cast<double>(it.getValue()) * squared * request.lattice.cell_volume();
    }
    for (std::size_t s = 0; s < grains.size(); ++s)
      expected += sphere_box_volume(grains.center(s), grains.radius[s], request.lattice.box()) *
                  dot(grains.velocity(s), grains.velocity(s));
    EXPECT_NEAR(moments / expected, 1, 2 * kFloat);
  }
}

TEST(Quantities, InOneVoxelAreThoseOfAllSpheres) {
  const Box box{{0, 0, 0}, {1e-3, 1e-3, 1e-3}};
  const Grains grains =
      grains_of(random_spheres(50, {{4e-4, 4e-4, 4e-4}, {6e-4, 6e-4, 6e-4}}, 3e-6, 33e-6, 2));
  const Field field = compute_field(grains.view(), {}, request_for(box, 1e-3));
  std::vector<double> volumes;
  for (const double r : grains.radius) volumes.push_back(ball_volume(r));
  EXPECT_NEAR(quantity(field, "temperature").mean / temperature_of(grains, volumes), 1, 1e-12);
  EXPECT_NEAR(
      quantity(field, "mean_diameter").integral,
      [&] {
        double sum = 0;
        for (std::size_t s = 0; s < grains.size(); ++s) sum += volumes[s] * 2 * grains.radius[s];
        return sum;
      }(),
      1e-12 * quantity(field, "mean_diameter").integral);
}

TEST(Quantities, ACommonVelocityIsNoTemperature) {
  const Grains still = grains_of(bed());
  const FieldRequest request = request_for(bed_box(), 17.3e-6);
  const Field field = compute_field(still.view(), {}, request);
  for (const double speed : {1.0, 1e4, 1e8}) {
    Grains moving = still;
    for (auto& column : moving.v)
      for (double& v : column) v += speed;
    const Field moved = compute_field(moving.view(), {}, request);
    for (auto it = quantity(field, "temperature").grid->cbeginValueOn(); it; ++it) {
      const double t = static_cast<double>(it.getValue());
      // velocities themselves are rounded to 1.1e-16 of the common one when it is added
      ASSERT_NEAR(at(quantity(moved, "temperature").grid, it.getCoord()), t, kFloat * t + 1e-15 * speed * 4)
          << speed;
    }
  }
}

TEST(Quantities, AShearIsNoTemperatureOfTheGrainsBesideIt) {
  // slow grains in one voxel, fast ones in the next: what differs from place to place costs no digits either
  Spheres spheres;
  for (int n = 0; n < 8; ++n)
    spheres.add({(n < 4 ? 20e-6 : 60e-6) + 3e-6 * (n % 2), 12e-6 + 4e-6 * (n % 4), 20e-6}, 2e-6);
  Grains grains = grains_of(spheres);
  for (int n = 0; n < 8; ++n) {
    const auto s = static_cast<std::size_t>(n);
    grains.v[0][s] = (n < 4 ? 0 : 1e6) + (n % 2 ? 0.25 : -0.25);
    grains.v[1][s] = grains.v[2][s] = 0;
  }
  const Field field =
      compute_field(grains.view(), {}, request_for({{0, 0, 0}, {80e-6, 40e-6, 40e-6}}, 40e-6));
  for (const int i : {0, 1})
    EXPECT_NEAR(at(quantity(field, "temperature").grid, {i, 0, 0}), 0.0625 / 3, kFloat * 0.0625);
}

TEST(Quantities, OfAnyMethodAreSumsOverSpheres) {
  const Box box{{0, 0, 0}, {120e-6, 120e-6, 120e-6}};
  const Solids floor{{Plane{{0, 0, 11e-6}, {0, 0, 1}}}};
  const Grains grains = grains_of(random_spheres(12, box, 6e-6, 30e-6, 5));
  for (const Method method :
       {Method::exact, Method::centre, Method::subsample, Method::divided, Method::kernel}) {
    FieldRequest request = request_for(box, 15e-6);
    request.method = method;
    request.subsample = 3;
    request.kernel_length = 40e-6;
    const Field field = compute_field(grains.view(), floor, request);
    std::vector<std::vector<double>> shares(static_cast<std::size_t>(field.lattice.cells()),
                                            std::vector<double>(grains.size(), 0.0));
    for (std::size_t s = 0; s < grains.size(); ++s) {  // each sphere by itself
      Spheres one;
      one.add(grains.center(s), grains.radius[s]);
      FieldRequest alone = request;
      alone.quantities = {};
      const Field share = compute_field(one.view(), floor, alone);
      for_cells(field.lattice, [&](const openvdb::Coord& cell, std::size_t n) {
        shares[n][s] = at(share.solid_fraction, cell);
      });
    }
    // shares as floats: up to 6e-8 of a share of up to 9 (centre) in each of the 12 spheres
    expect_sums_over_spheres(field, grains, shares, 5e-6);
  }
}

TEST(Quantities, WhereSpheresOverlapClassesShareWhatIsLeft) {
  const Box box{{0, 0, 0}, {120e-6, 120e-6, 120e-6}};
  Grains grains = grains_of(random_spheres(40, box, 14e-6, 22e-6, 6));
  for (std::int32_t& group : grains.group) group = std::max(group, 0);
  FieldRequest request = request_for(box, 15e-6);
  const Field sum = compute_field(grains.view(), {}, request);
  request.overlap = Overlap::united;
  const Field field = compute_field(grains.view(), {}, request);
  ASSERT_GT(field.sums.overlap_volume, 0.1 * field.sums.solid_volume_field);
  double classes = 0;
  for (const char* name : {"solid_fraction_small", "solid_fraction_middle", "solid_fraction_large"})
    classes += quantity(field, name).integral;
  EXPECT_NEAR(classes / field.sums.solid_volume_field, 1, 1e-12);
  bool hidden = false;  // such a sphere does not count, so that means may differ
  for (std::size_t a = 0; a < grains.size(); ++a)
    for (std::size_t b = 0; b < grains.size(); ++b)
      hidden = hidden ||
               (a != b && norm(grains.center(a) - grains.center(b)) + grains.radius[a] <= grains.radius[b]);
  ASSERT_FALSE(hidden);
  for (auto it = field.solid_fraction->cbeginValueOn(); it; ++it) {
    const openvdb::Coord cell = it.getCoord();
    for (const char* name :
         {"velocity_x", "mean_diameter", "temperature", "coordination", "bonded_fraction"}) {
      const double mean = at(quantity(sum, name).grid, cell);
      ASSERT_NEAR(at(quantity(field, name).grid, cell), mean, 2 * kFloat * std::abs(mean)) << name;
    }
    const double left = static_cast<double>(it.getValue()) / at(sum.solid_fraction, cell);
    ASSERT_NEAR(at(quantity(field, "pressure").grid, cell), left * at(quantity(sum, "pressure").grid, cell),
                4 * kFloat * 2e4);
  }
}

TEST(Quantities, DeletedSolidTakesItsPartAlong) {
  const Grains grains = grains_of(bed());
  FieldRequest request = request_for(bed_box(), 20e-6);
  request.method = Method::divided;
  request.least_void = 0.1;
  const Field field = compute_field(grains.view(), {}, request);
  ASSERT_GT(field.sums.deleted_volume, 0);
  request.quantities.groups = {"all"};
  Grains same = grains;
  same.group.assign(grains.size(), 0);
  const Field all = compute_field(same.view(), {}, request);
  EXPECT_NEAR(quantity(all, "solid_fraction_all").integral / field.sums.solid_volume_field, 1, 1e-12);
}

TEST(Quantities, OfTwoHalvesAreThoseOfTheWhole) {
  const Grains grains = grains_of(bed());
  const double h = 15e-6;
  const Box whole{{0, 0, 0}, {240e-6, 240e-6, 150e-6}};
  const Field all = compute_field(grains.view(), {}, request_for(whole, h));
  const Field low = compute_field(grains.view(), {}, request_for({whole.lo, {105e-6, 240e-6, 150e-6}}, h));
  const Field high = compute_field(grains.view(), {}, request_for({{105e-6, 0, 0}, whole.hi}, h));
  for (const Linear& number : linear()) {
    const QuantityGrid &a = quantity(all, number.name), &b = quantity(low, number.name),
                       &c = quantity(high, number.name);
    EXPECT_NEAR(b.integral + c.integral, a.integral, 1e-12 * number.scale * all.sums.solid_volume_field);
    for (auto it = a.grid->cbeginValueOn(); it; ++it) {
      const openvdb::Coord cell = it.getCoord();
      const double part = cell.x() < 7 ? at(b.grid, cell) : at(c.grid, cell.offsetBy(-7, 0, 0));
      ASSERT_NEAR(part, static_cast<double>(it.getValue()), 1e-6 * number.scale) << number.name << cell;
    }
  }
}

TEST(Quantities, AveragesAreSumsOverTheWindow) {
  const Box box{{0, 0, 0}, {120e-6, 120e-6, 120e-6}};
  const Grains grains = grains_of(random_spheres(20, box, 6e-6, 20e-6, 9));
  for (const bool periodic : {false, true}) {
    FieldRequest request = request_for(box, 15e-6);
    request.periodic = {periodic, periodic, periodic};
    request.average_length = 45e-6;  // three voxels: whole neighbours
    const Field field = compute_field(grains.view(), {}, request);
    const auto shares = shares_of(grains, request);
    const auto n = static_cast<int>(field.lattice.n[0]);
    for_cells(field.lattice, [&](const openvdb::Coord& cell, std::size_t) {
      std::vector<double> window(grains.size(), 0.0);
      double cells = 0, solid = 0;
      for (int d = 0; d < 27; ++d) {
        std::array<int, 3> c{cell.x() + d % 3 - 1, cell.y() + d / 3 % 3 - 1, cell.z() + d / 9 - 1};
        bool inside = true;
        for (int& i : c) {
          if (periodic) i = (i + n) % n;
          inside = inside && i >= 0 && i < n;
        }
        if (!inside) continue;
        ++cells;
        for (std::size_t s = 0; s < grains.size(); ++s)
          window[s] += shares[static_cast<std::size_t>((c[0] * n + c[1]) * n + c[2])][s];
      }
      for (const double share : window) solid += share;
      if (solid < 1e-6) return;
      for (const Linear& number : linear()) {
        const QuantityGrid& q = quantity(field, number.name);
        double sum = 0;
        for (std::size_t s = 0; s < grains.size(); ++s) sum += window[s] * number.of(grains, s);
        // sums along rows are differences of prefix sums: 1e-16 of some cells, over 1e-6 of a cell
        ASSERT_NEAR(at(q.averaged, cell), sum / (q.per_solid ? solid : cells), 1e-6 * number.scale)
            << number.name << cell;
      }
      ASSERT_NEAR(at(quantity(field, "temperature").averaged, cell), temperature_of(grains, window), 1e-6);
    });
  }
}

TEST(Quantities, AreTheSameBitsForAnyNumberOfThreads) {
  const Grains grains = grains_of(bed());
  FieldRequest request = request_for(bed_box(), 5e-6);
  request.average_length = 40e-6;
  std::vector<Field> fields;
  for (const std::size_t threads : {1, 2, 5}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    fields.push_back(compute_field(grains.view(), {}, request));
  }
  for (std::size_t f = 1; f < fields.size(); ++f)
    for (std::size_t q = 0; q < fields[0].quantities.size(); ++q) {
      const QuantityGrid &a = fields[0].quantities[q], &b = fields[f].quantities[q];
      ASSERT_EQ(a.integral, b.integral);
      for (auto it = a.grid->cbeginValueOn(); it; ++it)
        ASSERT_EQ(it.getValue(), b.grid->tree().getValue(it.getCoord()));
      ASSERT_EQ(a.averaged == nullptr, b.averaged == nullptr);
      for (auto it = a.averaged ? a.averaged->cbeginValueOn() : a.grid->cbeginValueOn(); it && a.averaged;
           ++it)
        ASSERT_EQ(it.getValue(), b.averaged->tree().getValue(it.getCoord()));
    }
}

TEST(Quantities, ChangeNothingElse) {
  const Grains grains = grains_of(bed());
  FieldRequest request = request_for(bed_box(), 5e-6);
  const Field with = compute_field(grains.view(), {}, request);
  request.quantities = {};
  const Field without = compute_field(grains.view(), {}, request);
  EXPECT_TRUE(without.quantities.empty());
  EXPECT_EQ(with.sums.solid_volume_field, without.sums.solid_volume_field);
  for_cells(with.lattice, [&](const openvdb::Coord& cell, std::size_t) {
    ASSERT_EQ(at(with.solid_fraction, cell), at(without.solid_fraction, cell));
    ASSERT_EQ(at(with.void_fraction, cell), at(without.void_fraction, cell));
  });
}

TEST(Quantities, NameTheColumnsThatAreMissing) {
  Grains grains = grains_of(bed(5));
  grains.group = {0, 2, -1, 1, 1};
  const auto message = [&](const QuantityRequest& asked, const SpheresView& view) -> std::string {
    FieldRequest request = request_for(bed_box(), 40e-6);
    request.quantities = asked;
    try {
      compute_field(view, {}, request);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  QuantityRequest velocity, temperature, coordination, stress, bonded, classes;
  velocity.velocity = temperature.temperature = coordination.coordination = true;
  stress.stress = bonded.bonded = true;
  classes.groups = {"a", "b", "c"};
  SpheresView bare = grains.view();
  bare.velocity = {}, bare.stress = {}, bare.coordination = nullptr, bare.bonded = nullptr,
  bare.group = nullptr;
  EXPECT_NE(message(velocity, bare).find("vx, vy and vz"), std::string::npos);
  EXPECT_NE(message(temperature, bare).find("vx, vy and vz"), std::string::npos);
  EXPECT_NE(message(coordination, bare).find("column coordination"), std::string::npos);
  EXPECT_NE(message(stress, bare).find("stress_xx"), std::string::npos);
  EXPECT_NE(message(bonded, bare).find("column bonded"), std::string::npos);
  EXPECT_NE(message(classes, bare).find("class"), std::string::npos);
  EXPECT_EQ(message(velocity, grains.view()), "");
  classes.groups = {"a"};  // and there are three
  EXPECT_NE(message(classes, grains.view()).find("is of class"), std::string::npos);
  Grains broken = grains;
  broken.v[2][3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(velocity, broken.view()).find("velocity of sphere 3"), std::string::npos);
  broken.stress[4][1] = std::numeric_limits<double>::infinity();
  EXPECT_NE(message(stress, broken.view()).find("stress of sphere 1"), std::string::npos);
}

TEST(Quantities, OfNoSpheresAreEmpty) {
  const Field field = compute_field({}, {}, request_for(bed_box(), 40e-6));
  for (const QuantityGrid& q : field.quantities) {
    EXPECT_TRUE(q.grid->empty()) << q.full_name();
    EXPECT_EQ(q.integral, 0);
    EXPECT_EQ(std::isnan(q.mean), q.per_solid) << q.full_name();
  }
}

}  // namespace
}  // namespace interstice::voxel::test
