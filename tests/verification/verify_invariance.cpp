// What no choice of origin, direction, frame, mirror or kernel may change: three grains that collide with
// each other and a wall, everything modelled, with every listed combination of laws.
#include <array>

#include "dem/kernels/kernels.h"
#include "dem/kernels/listed_laws.h"
#include "tests/verification/set_up.h"

namespace interstice::dem::verification {
namespace {

class Invariance : public OnEachBackEnd {};

constexpr double kRadius = 2e-5, kSpeed = 0.2, kStep = 1e-8;
constexpr std::int64_t kSteps = 4000;  // 40 us: each pair meets, and two grains the wall
constexpr Material kPowder{8200, 1e9, 0.3};

using Rotation = std::array<Vec3d, 3>;  // rows
Vec3d turned(const Rotation& q, const Vec3d& v) { return {dot(q[0], v), dot(q[1], v), dot(q[2], v)}; }
constexpr Rotation kNone{Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}};
constexpr Rotation mirror_of(int axis) {
  Rotation q = kNone;
  q[static_cast<std::size_t>(axis)][axis] = -1;
  return q;
}

/// About an axis that is no axis of the coordinates.
Rotation oblique() {
  const double angle = 1.1;
  Vec3d n{0.3, -0.8, 0.5};
  n = (1 / norm(n)) * n;
  Rotation q;
  for (int c = 0; c < 3; ++c) {
    Vec3d e{0, 0, 0};
    e[c] = 1;
    const Vec3d image =
        std::cos(angle) * e + std::sin(angle) * cross(n, e) + (1 - std::cos(angle)) * dot(n, e) * n;
    q[0][c] = image.x, q[1][c] = image.y, q[2][c] = image.z;
  }
  return q;
}

/// How the collision is looked at.
struct View {
  Rotation rotation = kNone;
  Vec3d shift{0, 0, 0};  // [m]
  Vec3d frame{0, 0, 0};  // velocity that everything has besides [m/s]
  bool wall = true;
};

/// Positions, velocities and spins of the three grains.
struct Outcome {
  std::array<Vec3d, 3> position, velocity, spin;
};

Simulation collision(const Laws& laws, const View& view, const SimulationOptions& options) {
  Model m = plain_model(kPowder,
                        {.restitution = 0.6,
                         .friction = 0.3,
                         .rolling_friction = 0.05,
                         .cohesion_energy_density = 1e6,
                         .work_of_adhesion = 0.01,
                         .hamaker_constant = 1e-19,
                         .cutoff = 1e-9,
                         .range = 1e-7,
                         .stiffness = 2000},
                        laws);
  const Rotation& q = view.rotation;
  if (view.wall) {
    m.walls = {{.shape = Plane{turned(q, {0, 0, -1.05 * kRadius}) + view.shift, turned(q, {0, 0, 1})},
                .material = 0}};
  }
  Simulation sim(m, kStep, options);
  const double mirror = dot(q[0], cross(q[1], q[2])) < 0 ? -1 : 1;  // spins are pseudovectors
  const auto grain = [&](const Vec3d& x, double r, const Vec3d& v, const Vec3d& w) {
    return sphere(turned(q, x) + view.shift, r, turned(q, v) + view.frame, mirror * turned(q, w));
  };
  const double v = kSpeed, w = 0.3 * kSpeed / kRadius;
  sim.add_grains(std::vector<NewGrain>{
      grain({-1.1 * kRadius, 0, 0}, kRadius, {v, 0.3 * v, -0.5 * v}, {w, -2 * w, w}),
      grain({1.02 * kRadius, 0.3 * kRadius, 0}, kRadius, {-v, 0, -0.5 * v}, {-w, 0.5 * w, 2 * w}),
      grain({0.1 * kRadius, 0.1 * kRadius, 1.45 * kRadius}, 0.7 * kRadius, {0.1 * v, 0, -2 * v},
            {0, 3 * w, -w})});
  if (view.wall) sim.set_wall_velocity(0, view.frame);
  return sim;
}

Outcome outcome(const Simulation& sim) {
  Outcome out;
  for (std::size_t i = 0; i < 3; ++i) {
    const GrainRow g = grain_of(sim, static_cast<std::int64_t>(i));
    out.position[i] = g.position(), out.velocity[i] = g.velocity(), out.spin[i] = g.spin();
  }
  return out;
}

Outcome collide(const Laws& laws, const View& view, const SimulationOptions& options) {
  Simulation sim = collision(laws, view, options);
  sim.advance(kSteps);
  return outcome(sim);
}

/// Largest difference of velocities and surface speeds of spin, over the speed of approach.
double difference(const Outcome& a, const Outcome& b, const View& view) {
  const double mirror = dot(view.rotation[0], cross(view.rotation[1], view.rotation[2])) < 0 ? -1 : 1;
  double worst = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    worst = std::max(worst, norm(turned(view.rotation, a.velocity[i]) + view.frame - b.velocity[i]));
    worst = std::max(worst, kRadius * norm(mirror * turned(view.rotation, a.spin[i]) - b.spin[i]));
  }
  return worst / kSpeed;
}

std::string name_of_laws(const Laws& l) {
  const char* tangential[] = {"-", "slider", "mindlin"};
  const char* rolling[] = {"-", "cdt", "epsd2"};
  const char* cohesion[] = {"-", "sjkr", "jkr", "dmt", "van_der_waals"};
  return std::string(l.normal == NormalLaw::hertz ? "hertz " : "hooke ") + (l.clip ? "clipped " : "") +
         tangential[static_cast<int>(l.tangential)] + ' ' + rolling[static_cast<int>(l.rolling)] + ' ' +
         cohesion[static_cast<int>(l.cohesion)];
}

/// Holds the collision seen in a view to the collision itself, for every listed combination: a row for the
/// combination that differs most.
void hold_view(const Reference& r, const View& view, const BackEnd& b, double tolerance) {
  double worst = -1;
  std::string which;
  for (const Laws& laws : kListedLaws) {
    const double d = difference(collide(laws, {}, b.options), collide(laws, view, b.options), view);
    EXPECT_LE(d, tolerance) << name_of_laws(laws);
    if (d > worst) worst = d, which = name_of_laws(laws);
  }
  expect_close(r, b.row("largest difference of velocities, " + which), worst, 0, tolerance);
}

const char* const kSymmetry = "symmetry of Newton's mechanics; all listed laws, three grains and a wall";

TEST_P(Invariance, TheCollisionIsOne) {
  // Else the rest of this program would hold nothing: every pair touches, and grains touch the wall.
  Simulation sim = collision(kListedLaws[3], {}, GetParam().options);
  std::array<bool, 3> pairs{};
  bool wall = false;
  for (std::int64_t s = 0; s < kSteps; ++s) {
    sim.advance(1);
    for (std::size_t k = 0; k < sim.pair_contacts().places(); ++k) {
      const PairRef p = sim.pair_contacts().pair(k);
      const auto ids = static_cast<std::size_t>(sim.site(p.a).id + sim.site(p.b).id);
      if (sim.pair_contacts().touching(k)) pairs[ids - 1] = true;
    }
    for (std::size_t k = 0; k < sim.wall_contacts().places(); ++k)
      wall = wall || sim.wall_contacts().at(k).touching();
  }
  EXPECT_TRUE(pairs[0] && pairs[1] && pairs[2] && wall) << pairs[0] << pairs[1] << pairs[2] << wall;
}

// Roundings of 1e-16 of the position are 3e-12 of the overlap; a collision multiplies differences by some
// ten.
TEST_P(Invariance, UnderRotation) {
  hold_view({"Rotated set-up, rotated result", kSymmetry}, {.rotation = oblique()}, GetParam(),
            GetParam().either(1e-10, 1e-4));
}

TEST_P(Invariance, UnderMirrorImages) {
  const char* planes[] = {"Mirror image in x, to the bit", "Mirror image in y, to the bit",
                          "Mirror image in z, to the bit"};
  for (int axis = 0; axis < 3; ++axis) {
    hold_view({planes[axis], kSymmetry}, {.rotation = mirror_of(axis)}, GetParam(), 0);
  }
}

TEST_P(Invariance, UnderAMovingFrame) {
  hold_view({"Galilean frame of 3 m/s", kSymmetry}, {.frame = {2, -1, 2}}, GetParam(),
            GetParam().either(1e-9, 1e-4));
}

TEST_P(Invariance, UnderAShift) {
  hold_view({"Shift by 25 radii", kSymmetry}, {.shift = {5e-4, -3e-4, 1e-4}}, GetParam(),
            GetParam().either(1e-9, 1e-4));
}

TEST_P(Invariance, OfMomentumAndAngularMomentum) {
  double worst = 0, worst_angular = 0;
  for (const Laws& laws : kListedLaws) {
    Simulation sim = collision(laws, {.wall = false}, GetParam().options);
    const auto momenta = [&] {
      Vec3d linear{0, 0, 0}, angular{0, 0, 0};
      for (std::int64_t i = 0; i < 3; ++i) {
        const GrainRow g = grain_of(sim, i);
        linear += g.mass * g.velocity();
        angular +=
            g.mass * cross(g.position(), g.velocity()) + (0.4 * g.mass * g.radius * g.radius) * g.spin();
      }
      return std::pair{linear, angular};
    };
    const auto before = momenta();
    sim.advance(kSteps);
    const auto after = momenta();
    const double scale = mass_of(kRadius, kPowder) * kSpeed;
    worst = std::max(worst, norm(after.first - before.first) / scale);
    worst_angular = std::max(worst_angular, norm(after.second - before.second) / (scale * kRadius));
  }
  const Reference r{"Momentum of three colliding grains", "action = reaction; all listed laws"};
  // Each of 4000 steps rounds the velocities to 1e-16; single precision rounds forces, but the same for both.
  expect_close(r, GetParam().row("largest change over m v"), worst, 0, 1e-13);
  // The torques on both grains are one force's, but in single precision each is rounded with its own arm.
  expect_close(r, GetParam().row("largest change of angular momentum over m v R"), worst_angular, 0,
               GetParam().either(1e-12, 1e-6));
}

TEST_P(Invariance, OfMomentumToTheBitForEqualGrains) {
  for (const Laws& laws : kListedLaws) {
    Simulation sim(collision(laws, {.wall = false}, {}).model(), kStep, GetParam().options);
    const double v = kSpeed, w = 0.3 * kSpeed / kRadius;
    sim.add_grains(
        std::vector<NewGrain>{sphere({-1.05 * kRadius, 0, 0}, kRadius, {v, 0.3 * v, 0.1 * v}, {w, w, -w}),
                              sphere({1.05 * kRadius, 0, 0}, kRadius, {-v, -0.3 * v, -0.1 * v}, {w, 0, w})});
    for (int i = 0; i < 40; ++i) {
      sim.advance(100);
      const GrainRow a = grain_of(sim, 0), b = grain_of(sim, 1);
      EXPECT_EQ(a.velocity(), -b.velocity()) << name_of_laws(laws);
    }
  }
}

TEST_P(Invariance, OfTheKernel) {
  double worst = -1;
  std::string which;
  for (const Laws& laws : kListedLaws) {
    EXPECT_TRUE(has_own_kernel(laws));
    SimulationOptions generic = GetParam().options;
    generic.energies = true;
    EXPECT_FALSE(collision(laws, {}, GetParam().options).generic_kernel());
    const double d = difference(collide(laws, {}, GetParam().options), collide(laws, {}, generic), {});
    if (d > worst) worst = d, which = name_of_laws(laws);
  }
  // Not to the bit: the compiler may fuse other multiply-adds in the one kernel than in the other.
  expect_close({"A combination's own kernel and the generic one", "the same laws"},
               GetParam().row("largest difference of velocities, " + which), worst, 0,
               GetParam().either(1e-10, 1e-4));
}

INSTANTIATE_TEST_SUITE_P(BackEnds, Invariance, ::testing::ValuesIn(back_ends()), name_of);

}  // namespace
}  // namespace interstice::dem::verification
