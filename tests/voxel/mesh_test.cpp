// Solids made of triangles against the same solids in closed form.
#include "voxel/mesh.h"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <numbers>

#include "base/error.h"
#include "base/random.h"
#include "tests/voxel/support.h"
#include "voxel/solids.h"
#include "voxel/touch.h"
#include "voxel/walls.h"

namespace interstice::voxel::test {
namespace {

constexpr double kPi = std::numbers::pi;

/// The twelve triangles between eight corners, turned outwards; corner c lies at the upper end of axis a
/// where bit a of c is set.
std::vector<Triangle> box_triangles(const std::array<Vec3d, 8>& corners) {
  std::vector<Triangle> triangles;
  constexpr std::array<std::array<std::size_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& [a, b, c, d] : kFaces) {
    triangles.push_back({corners[a], corners[b], corners[c]});
    triangles.push_back({corners[a], corners[c], corners[d]});
  }
  return triangles;
}

std::array<Vec3d, 8> corners_of(const Box& box) {
  std::array<Vec3d, 8> corners;
  for (std::size_t c = 0; c < 8; ++c)
    corners[c] = {c & 1 ? box.hi.x : box.lo.x, c & 2 ? box.hi.y : box.lo.y, c & 4 ? box.hi.z : box.lo.z};
  return corners;
}

std::vector<Triangle> box_triangles(const Box& box) { return box_triangles(corners_of(box)); }

/// A prism over a regular polygon whose area is that of the circle.
std::vector<Triangle> prism_triangles(double radius, double height, int sides) {
  const double r = radius * std::sqrt(2 * kPi / sides / std::sin(2 * kPi / sides));
  const auto rim = [&](int s, double z) {
    const double angle = 2 * kPi * (s % sides) / sides;
    return Vec3d{r * std::cos(angle), r * std::sin(angle), z};
  };
  std::vector<Triangle> triangles;
  for (int s = 0; s < sides; ++s) {
    const Vec3d a = rim(s, 0), b = rim(s + 1, 0), c = rim(s, height), d = rim(s + 1, height);
    triangles.push_back({a, b, d});
    triangles.push_back({a, d, c});
    triangles.push_back({Vec3d{0, 0, 0}, b, a});
    triangles.push_back({Vec3d{0, 0, height}, c, d});
  }
  return triangles;
}

/// A ball as an octahedron divided `times` times, its corners on the sphere.
std::vector<Triangle> ball_triangles(double radius, int times) {
  std::vector<Triangle> triangles;
  for (const double x : {1., -1.})
    for (const double y : {1., -1.})
      for (const double z : {1., -1.}) {
        const bool turned = x * y * z < 0;
        triangles.push_back(turned ? Triangle{Vec3d{x, 0, 0}, Vec3d{0, 0, z}, Vec3d{0, y, 0}}
                                   : Triangle{Vec3d{x, 0, 0}, Vec3d{0, y, 0}, Vec3d{0, 0, z}});
      }
  const auto between = [](const Vec3d& a, const Vec3d& b) {
    // the same bits whichever way round
    const Vec3d sum = a + b;
    return (1 / norm(sum)) * sum;
  };
  for (int t = 0; t < times; ++t) {
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const Vec3d ab = between(a, b), bc = between(b, c), ca = between(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  for (Triangle& triangle : triangles)
    for (Vec3d& p : triangle) p = radius * p;
  return triangles;
}

MeshSolid solid_of(std::vector<Triangle> triangles, const Vec3d& at = {0, 0, 0}) {
  return {std::make_shared<TriangleMesh>(closed_mesh(std::move(triangles))), at};
}

/// Balls around points in and about the solids, of radii so that some touch and some do not.
TEST(WithinReach, OfTrianglesIsThatOfTheSameSolid) {
  const Box box{{-1, -2, -0.5}, {1.5, 1, 2}};
  const Vec3d at{0.3, -0.7, 0.1};
  const MeshSolid mesh = solid_of(box_triangles(box), at);
  const Box moved{box.lo + at, box.hi + at};
  int touching = 0;
  for (std::uint64_t s = 0; s < 3000; ++s) {
    Random random(17, s);
    const Vec3d p{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)};
    const double reach = random.uniform(1e-3, 1.5);
    const bool touches = within_reach(moved, p, reach);
    EXPECT_EQ(within_reach(mesh, p, reach), touches) << p.x << ' ' << p.y << ' ' << p.z << ' ' << reach;
    touching += touches;
  }
  EXPECT_GT(touching, 300);
  EXPECT_LT(touching, 2700);
}

TEST(WithinReach, EndsAtTheReach) {
  const double e = 1e-9;
  const auto ends = [&](const auto& solid, const Vec3d& p, double reach) {
    EXPECT_TRUE(within_reach(solid, p, reach * (1 + e)));
    EXPECT_FALSE(within_reach(solid, p, reach * (1 - e)));
  };
  ends(Plane{{0, 0, 1}, {0, 0, 1}}, {5, 5, 3}, 2);
  ends(Ball{{1, 0, 0}, 2}, {1, 4, 3}, 3);
  ends(Box{{0, 0, 0}, {1, 1, 1}}, {4, 5, 0.5}, 5);                             // an edge
  ends(Cylinder{{0, 0, 0}, {0, 0, 2}, 1}, {4, 0, 6}, 5);                       // its rim
  ends(solid_of(box_triangles(Box{{0, 0, 0}, {1, 1, 1}})), {3, 3, 2}, 3);      // a corner
  ends(solid_of(box_triangles(Box{{0, 0, 0}, {1, 1, 1}})), {0.4, 0.3, 3}, 2);  // inside a face
  for (const double reach : {0.01, 10.0})  // wholly inside, the surface in reach or not
    EXPECT_TRUE(within_reach(solid_of(box_triangles(Box{{0, 0, 0}, {1, 1, 1}})), {0.4, 0.3, 0.5}, reach));
}

/// Every cell's share, by blocks as fields take them.
std::vector<double> shares_of(const Solids& solids, const Lattice& lattice) {
  const Solids local = relative_to(solids, lattice);
  const BlockGrid grid(lattice);
  std::vector<double> shares(static_cast<std::size_t>(lattice.cells()));
  for (const WallBlock& block : wall_blocks(local, lattice)) {
    const CellRange cells = block_cells(lattice, grid.block(block.key));
    double fractions[kBlockCells];
    if (block.full)
      std::fill_n(fractions, kBlockCells, 1.);
    else
      wall_fractions(local, lattice, cells, fractions);
    const double* next = fractions;
    for (std::int64_t i = cells.lo[0]; i < cells.hi[0]; ++i)
      for (std::int64_t j = cells.lo[1]; j < cells.hi[1]; ++j)
        for (std::int64_t k = cells.lo[2]; k < cells.hi[2]; ++k)
          shares[static_cast<std::size_t>((i * lattice.n[1] + j) * lattice.n[2] + k)] = *next++;
  }
  return shares;
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t c = 0; c < a.size(); ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  return largest;
}

double sum_of(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

TEST(Mesh, ABoxIsTheBox) {
  const Lattice lattice = cubic_lattice({{-3e-3, 1e-3, 2e-3}, {-2.6e-3, 1.35e-3, 2.3e-3}}, 10e-6);
  const Box box{{-2.943e-3, 1.0521e-3, 1.9e-3}, {-2.7113e-3, 1.3e-3, 2.2077e-3}};
  // rounding: corners 1e-3 / 1e-5 cells away, 1e-16 each
  EXPECT_LT(largest_difference(shares_of({.meshes = {solid_of(box_triangles(box))}}, lattice),
                               shares_of({.shapes = {box}}, lattice)),
            1e-11);
}

TEST(Mesh, AnObliquePlaneIsTheFaceOfATurnedBox) {
  // a box turned about all axes, and the plane of one of its faces, far from the others
  const double a = .3, b = .7;
  const auto turned = [&](const Vec3d& p) {
    const Vec3d q{std::cos(a) * p.x - std::sin(a) * p.y, std::sin(a) * p.x + std::cos(a) * p.y, p.z};
    return Vec3d{q.x, std::cos(b) * q.y - std::sin(b) * q.z, std::sin(b) * q.y + std::cos(b) * q.z};
  };
  std::array<Vec3d, 8> corners = corners_of({{-20, -20, -20}, {20, 20, 0}});
  for (Vec3d& p : corners) p = turned(p) + Vec3d{.2, .1, .3};
  const Plane plane{{.2, .1, .3}, turned({0, 0, 1})};
  const Lattice lattice = cubic_lattice({{-1, -1, -1}, {1, 1, 1}}, .07);
  EXPECT_LT(largest_difference(shares_of({.meshes = {solid_of(box_triangles(corners))}}, lattice),
                               shares_of({.shapes = {plane}}, lattice)),
            1e-11);  // 20 / 0.07 cells at 1e-16, some tens of pieces
}

TEST(Mesh, APrismNearsTheCylinder) {
  // a polygon of n sides and the circle's area strays from the circle by R (pi/n)^2 / 3 at most, both ways:
  // in a cell of h that is a share of R/h (pi/n)^2 / 3, times at most sqrt(2) for a slanting cut
  const double radius = 7, h = 1;
  const Lattice lattice = cubic_lattice({{-9.3, -9.1, -2.4}, {9, 9, 7}}, h);
  const std::vector<double> exact = shares_of({.cylinders = {{{0, 0, 0}, {0, 0, 5.3}, radius}}}, lattice);
  double last = 1;
  for (const int sides : {32, 128, 512}) {
    const auto shares = shares_of({.meshes = {solid_of(prism_triangles(radius, 5.3, sides))}}, lattice);
    const double difference = largest_difference(shares, exact);
    EXPECT_LT(difference, std::sqrt(2.) * radius / h * std::pow(kPi / sides, 2) / 3) << sides;
    EXPECT_LT(difference, last / 8) << sides;  // second order: a sixteenth at four times the sides
    EXPECT_NEAR(sum_of(shares) / (kPi * radius * radius * 5.3), 1, 1e-12);
    last = difference;
  }
}

TEST(Mesh, ADividedOctahedronNearsTheBall) {
  // the middle of a face with edges e lies inside the sphere by e^2 / (6 R), and no plane cuts a cell of h in
  // more than sqrt(2) h^2: the share of a cell between face and sphere is at most sqrt(2) e^2 / (6 R h)
  const double radius = 5.5, h = .5;
  const Lattice lattice = cubic_lattice({{-7.2, -7.1, -7.3}, {7, 7, 7}}, h);
  const auto exact = shares_of({.balls = {{{.1, .2, .3}, radius}}}, lattice);
  double last = 1;
  for (const int times : {3, 4, 5}) {
    const MeshSolid mesh = solid_of(ball_triangles(radius, times), {.1, .2, .3});
    const auto shares = shares_of({.meshes = {mesh}}, lattice);
    const double difference = largest_difference(shares, exact);
    EXPECT_LT(difference, .35 * last) << times;  // second order: a quarter at each division
    double edge = 0;
    for (const Triangle& t : mesh.mesh->triangles)
      edge = std::max({edge, norm(t[1] - t[0]), norm(t[2] - t[1])});
    EXPECT_LT(difference, std::sqrt(2.) * edge * edge / (6 * radius * h)) << times;
    last = difference;
    // the polyhedron's own volume, to rounding
    EXPECT_NEAR(sum_of(shares) * .125 / mesh.mesh->volume, 1, 1e-12) << times;
  }
}

TEST(Mesh, TellsItsVolumeInAnyBox) {
  const MeshSolid ball = solid_of(ball_triangles(1, 4));
  const Solids solids{.meshes = {ball}};
  for (std::uint64_t i = 0; i < 50; ++i) {
    Random random(41, i);
    const auto point = [&] {
      return Vec3d{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    };
    const Vec3d p = point(), q = point();
    Box box;
    for (int axis = 0; axis < 3; ++axis)
      box.lo[axis] = std::min(p[axis], q[axis]), box.hi[axis] = std::max(p[axis], q[axis]);
    // parts of the box make the box
    double parts = 0;
    const Vec3d middle{random.uniform(box.lo.x, box.hi.x), random.uniform(box.lo.y, box.hi.y),
                       random.uniform(box.lo.z, box.hi.z)};
    for (int c = 0; c < 8; ++c)
      parts += solid_volume(
          solids, {{c & 1 ? middle.x : box.lo.x, c & 2 ? middle.y : box.lo.y, c & 4 ? middle.z : box.lo.z},
                   {c & 1 ? box.hi.x : middle.x, c & 2 ? box.hi.y : middle.y, c & 4 ? box.hi.z : middle.z}});
    EXPECT_NEAR(parts, solid_volume(solids, box), 1e-13);
  }
  EXPECT_NEAR(solid_volume(solids, {{-2, -2, -2}, {2, 2, 2}}), ball.mesh->volume, 1e-13);
}

TEST(Mesh, KnowsCavities) {
  std::vector<Triangle> triangles = box_triangles({{0, 0, 0}, {9, 9, 9}});
  for (Triangle t : box_triangles({{2, 2, 2}, {7, 6, 5}})) {
    std::swap(t[1], t[2]);
    triangles.push_back(t);
  }
  const MeshSolid mesh = solid_of(triangles);
  EXPECT_NEAR(mesh.mesh->volume, 729 - 60, 1e-10);
  EXPECT_NEAR(solid_volume({.meshes = {mesh}}, {{1, 1, 1}, {3, 3, 3}}), 7, 1e-12);
  EXPECT_NEAR(solid_volume({.meshes = {mesh}}, {{3, 3, 3}, {4, 4, 4}}), 0, 1e-12);
}

TEST(Mesh, TurnsASurfaceThatIsInsideOut) {
  std::vector<Triangle> triangles = box_triangles({{0, 0, 0}, {1, 2, 3}});
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  const MeshSolid mesh = solid_of(triangles);
  EXPECT_NEAR(mesh.mesh->volume, 6, 1e-14);
  EXPECT_NEAR(solid_volume({.meshes = {mesh}}, {{.5, 0, 0}, {1, 2, 3}}), 3, 1e-14);
}

TEST(Mesh, RefusesWhatHasNoInside) {
  const std::vector<Triangle> good = box_triangles({{0, 0, 0}, {1, 1, 1}});
  const auto error_of = [](std::vector<Triangle> triangles) {
    try {
      closed_mesh(std::move(triangles));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(error_of(good), "");
  auto open = good;
  open.pop_back();
  EXPECT_NE(error_of(open).find("not closed: 3 edges"), std::string::npos) << error_of(open);
  auto moved = good;
  moved[3][1].x += 1e-9;  // a corner that no longer meets its neighbours
  EXPECT_NE(error_of(moved).find("not closed"), std::string::npos) << error_of(moved);
  auto turned = good;
  std::swap(turned[5][0], turned[5][1]);
  EXPECT_NE(error_of(turned).find("not turned the same way"), std::string::npos) << error_of(turned);
  EXPECT_NE(error_of({}).find("without triangles"), std::string::npos);
  auto needle = good;
  needle.push_back({Vec3d{5, 5, 5}, Vec3d{5, 5, 5}, Vec3d{6, 6, 6}});  // no area, no harm
  EXPECT_EQ(error_of(needle), "");
}

TEST(Mesh, RefusesASecondBodyThatIsInsideOut) {
  std::vector<Triangle> triangles = box_triangles({{0, 0, 0}, {9, 9, 9}});
  for (Triangle t : box_triangles({{20, 0, 0}, {25, 5, 5}})) {
    std::swap(t[1], t[2]);
    triangles.push_back(t);
  }
  const Lattice lattice = cubic_lattice({{0, 0, 0}, {30, 10, 10}}, 1);
  const Solids local = relative_to({.meshes = {solid_of(triangles)}}, lattice);
  EXPECT_THROW(wall_blocks(local, lattice), InputError);
}

TEST(Mesh, GivesTheSameBitsForAnyNumberOfThreads) {
  const Lattice lattice = cubic_lattice({{-7.2, -7.1, -7.3}, {7, 7, 7}}, .5);
  const Solids solids{.meshes = {solid_of(ball_triangles(5.5, 4), {.1, .2, .3})}};
  std::vector<double> one, two;
  tbb::task_arena(1).execute([&] { one = shares_of(solids, lattice); });
  tbb::task_arena(2).execute([&] { two = shares_of(solids, lattice); });
  EXPECT_EQ(one, two);
}

}  // namespace
}  // namespace interstice::voxel::test
