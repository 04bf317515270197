// What must not change a run: the order of the input, a mirror, a stop in between; and what it must conserve.
#include <numeric>

#include "base/random.h"
#include "tests/extremes/support.h"

namespace interstice::dem {
namespace {

using namespace testing;

const Laws kJkr{
    .tangential = TangentialLaw::mindlin, .rolling = RollingLaw::epsd2, .cohesion = CohesionLaw::jkr};
const Laws kVanDerWaals{.tangential = TangentialLaw::mindlin,
                        .rolling = RollingLaw::epsd2,
                        .cohesion = CohesionLaw::van_der_waals};
const Laws kDmt{.clip = true,
                .tangential = TangentialLaw::mindlin,
                .rolling = RollingLaw::cdt,
                .cohesion = CohesionLaw::dmt};

/// Grains of 10 to 22 um, to be thrown into a box: all laws at work.
std::vector<NewGrain> crowd(std::size_t count) {
  Random random(5, 0);
  std::vector<NewGrain> grains;
  for (std::size_t i = 0; i < count; ++i) {
    NewGrain g;
    g.radius = random.uniform(5e-6, 11e-6);
    const double side = 24e-6;
    g.position = {(static_cast<double>(i % 4) - 1.6) * side, (static_cast<double>(i / 4 % 4) - 1.4) * side,
                  (static_cast<double>(i / 16) + 0.6) * side};
    g.velocity = {random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0)};
    g.spin = {random.uniform(-1e3, 1e3), random.uniform(-1e3, 1e3), random.uniform(-1e3, 1e3)};
    grains.push_back(g);
  }
  return grains;
}

Model crowd_model(const Laws& laws) {
  Model m = open_model({4430, 1e7, 0.3}, {}, laws, 1e-3);
  m.pairs[0] = {.restitution = 0.5,
                .friction = 0.4,
                .rolling_friction = 0.02,
                .work_of_adhesion = 1e-3,
                .hamaker_constant = 1e-19,
                .cutoff = 2e-9,
                .range = 1e-6};
  m.gravity = {0, 0, -2e4};  // a centrifuge, so that they settle in 1e4 steps
  m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
  // The sides of each axis together, so that a mirrored grain in a corner sums its walls in the same order.
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}}) {
    for (const double side : {-1.0, 1.0}) m.walls.push_back({Plane{side * 55e-6 * axis, -side * axis}, 0});
  }
  return m;
}

constexpr double kStep = 2e-8;  // [s]: a thirtieth of the Rayleigh time of the smallest

/// Largest difference of positions, over the smallest radius.
double difference(const GrainColumns& a, const GrainColumns& b) {
  double worst = a.id.size() == b.id.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.id.size(), b.id.size()); ++i)
    keep_worst(worst, std::hypot(a.x[i] - b.x[i], a.y[i] - b.y[i], a.z[i] - b.z[i]) / 5e-6);
  return worst;
}

/// The crowd after 10,000 steps, in the midst of its collisions, as input.
std::vector<NewGrain> crowd_in_contact(const Laws& laws) {
  Simulation sim(crowd_model(laws), kStep);
  sim.add_grains(crowd(64));
  sim.advance(10000);
  EXPECT_GT(contact_statistics(sim).contacts, 30);
  const GrainColumns c = columns(sim);
  std::vector<NewGrain> grains;
  for (std::size_t i = 0; i < c.id.size(); ++i) {
    grains.push_back(grain({c.x[i], c.y[i], c.z[i]}, c.radius[i], {c.vx[i], c.vy[i], c.vz[i]},
                           {c.wx[i], c.wy[i], c.wz[i]}));
  }
  return grains;
}

TEST(Order, OfTheInputDoesNotMatter) {
  // Forces on a grain are summed in the order of ids, so another order rounds differently: 1e-16 at first,
  // amplified by collisions. Single precision amplifies a flipped last bit, 6e-8.
  for (const auto& [laws, name] :
       {std::pair{kJkr, "jkr, epsd2"}, {kVanDerWaals, "van der Waals, epsd2"}, {kDmt, "dmt, cdt"}}) {
    const auto grains = crowd_in_contact(laws);
    std::vector<std::size_t> order(grains.size());
    std::iota(order.begin(), order.end(), 0);
    Random random(9, 0);
    for (std::size_t i = order.size() - 1; i > 0; --i)
      std::swap(order[i], order[static_cast<std::size_t>(random.uniform() * static_cast<double>(i + 1))]);
    std::vector<NewGrain> shuffled;
    for (const std::size_t i : order) shuffled.push_back(grains[i]);
    expect_small(
        "order of the grains", fmt::format("64 grains in contact, in two orders, 1000 steps, {}", name),
        "positions agree within (radii)", 1e-12, 1e-5, [&, chosen = laws](const BackEnd& b) {
          Simulation one(crowd_model(chosen), kStep, b.options), two(crowd_model(chosen), kStep, b.options);
          one.add_grains(grains);
          two.add_grains(shuffled);
          one.advance(1000);
          two.advance(1000);
          const GrainColumns c = columns(one), d = columns(two);
          GrainColumns back = d;
          for (std::size_t i = 0; i < order.size(); ++i)
            back.x[order[i]] = d.x[i], back.y[order[i]] = d.y[i], back.z[order[i]] = d.z[i];
          return difference(c, back);
        });
  }
}

TEST(Mirror, ReflectsARun) {
  for (const auto& [laws, name] :
       {std::pair{kJkr, "jkr, epsd2"}, {kVanDerWaals, "van der Waals, epsd2"}, {kDmt, "dmt, cdt"}}) {
    for (int axis = 0; axis < 2; ++axis) {
      for (const BackEnd& b : back_ends()) {
        auto grains = crowd(64);
        Simulation one(crowd_model(laws), kStep, b.options), two(crowd_model(laws), kStep, b.options);
        one.add_grains(grains);
        for (NewGrain& g : grains) {
          g.position[axis] = -g.position[axis];
          g.velocity[axis] = -g.velocity[axis];
          for (int k = 0; k < 3; ++k) g.spin[k] = k == axis ? g.spin[k] : -g.spin[k];  // an axial vector
        }
        two.add_grains(grains);
        one.advance(10000);
        two.advance(10000);
        const GrainColumns c = columns(one), d = columns(two);
        bool same = all_finite(c) && contact_statistics(one).contacts > 30;
        for (std::size_t i = 0; i < c.id.size(); ++i) {
          same = same && c.x[i] == (axis == 0 ? -1 : 1) * d.x[i] && c.y[i] == (axis == 1 ? -1 : 1) * d.y[i];
          same = same && c.vz[i] == d.vz[i] && c.wz[i] == -d.wz[i];
        }
        expect_outcome(
            "mirror",
            fmt::format("64 grains reflected in {}, 10000 steps, {} ({})", "xy"[axis], name, b.name),
            same ? "the reflected run, to the bit" : "differs", same);
      }
    }
  }
}

/// Is there a neck beyond touch, a loaded rolling spring, a pair attracting across a gap (as the laws allow)?
bool has_every_memory(const Simulation& sim) {
  bool neck = sim.model().laws.cohesion != CohesionLaw::jkr,
       gap = sim.model().laws.cohesion != CohesionLaw::van_der_waals;
  bool rolls = sim.model().laws.rolling != RollingLaw::epsd2;
  const PairContacts& list = sim.pair_contacts();
  for (std::size_t k = 0; k < list.places(); ++k) {
    const GrainSite a = sim.site(list.pair(k).a), b = sim.site(list.pair(k).b);
    const bool apart = norm(a.position() - b.position()) > a.radius + b.radius;
    neck = neck || (list.memories().state(k) == ContactState::touching && apart);
    gap = gap || list.memories().state(k) == ContactState::attracting;
    rolls = rolls || norm(list.memories().rolling(k).force) > 0;
  }
  return neck && gap && rolls;
}

TEST(Restart, ContinuesWithTheSameBits) {
  for (const auto& [laws, name] : {std::pair{kJkr, "jkr necks, epsd2 springs"},
                                   {kVanDerWaals, "van der Waals gaps, epsd2 springs"},
                                   {kDmt, "dmt, cdt"}}) {
    for (const BackEnd& b : back_ends()) {
      const std::int64_t steps = 12000;
      Simulation whole(crowd_model(laws), kStep, b.options), first(crowd_model(laws), kStep, b.options);
      whole.add_grains(crowd(64));
      first.add_grains(crowd(64));
      whole.advance(steps);
      first.advance(3000);
      while (first.step() < steps - 100 && !has_every_memory(first)) first.advance(7);
      const bool rich = has_every_memory(first);
      Simulation second(first.model(), first.time_step(), b.options);
      second.restore(first.save());
      second.advance(steps - first.step());
      const GrainColumns c = columns(whole), d = columns(second);
      const bool same =
          all_finite(c) && c.x == d.x && c.y == d.y && c.z == d.z && c.vx == d.vx && c.wy == d.wy;
      expect_outcome("restart", fmt::format("with {}, 12000 steps ({})", name, b.name),
                     fmt::format("{}{}", same ? "the same bits as uninterrupted" : "differs",
                                 rich ? "" : " (but no such memory arose)"),
                     same && rich);
    }
  }
}

/// A gas of 27 grains in a periodic box.
Simulation gas(const PairCoefficients& pair, const Laws& laws, double fraction, const BackEnd& b) {
  Model m = open_model({8200, 1e9, 0.3}, pair, laws, 1e-4);
  m.boundary.fill(AxisBoundary::periodic);
  const double r = 2e-5, v = 1;
  const double smallest = 0.6 * r, fastest = 2 * std::sqrt(3.0) * v;  // the shortest contact that may come
  const double contact = collision_time(0.5 * sphere_mass(smallest, 8200), smallest / 2, 1e9 / 1.82, fastest);
  Simulation sim(m, fraction * contact, b.options);
  Random random(3, 0);
  std::vector<NewGrain> grains;
  for (int i = 0; i < 27; ++i) {
    const double pitch = 2e-4 / 3;
    grains.push_back(grain({(i % 3 - 1) * pitch, (i / 3 % 3 - 1) * pitch, (i / 9 - 1) * pitch},
                           r * (0.6 + 0.01 * i),
                           {random.uniform(-v, v), random.uniform(-v, v), random.uniform(-v, v)}));
  }
  sim.add_grains(grains);
  return sim;
}

Vec3d momentum(const Simulation& sim, double* magnitude) {
  Vec3d sum{0, 0, 0};
  *magnitude = 0;
  for (const GrainRow& g : sim.rows())
    sum += g.mass * g.velocity(), *magnitude += g.mass * norm(g.velocity());
  return sum;
}

TEST(Momentum, OfAGasStays) {
  // Pairs exert equal and opposite forces to the bit; what is left is the rounding of a million additions to
  // 27 velocities, 1e-16 sqrt(1e6) = 1e-13. In mixed a grain's forces are summed in single: a grain with two
  // contacts at once, in some hundredth of the steps, rounds a step's impulse (1e-2 of its momentum) by 6e-8,
  // 6e-10 / 27 sqrt(1e4) = 2e-9 at most.
  expect_small("momentum", "27 grains, mindlin, periodic, 1e6 steps",
               "sum drifts by (of the sum of magnitudes)", 1e-12, 2e-9, [](const BackEnd& b) {
                 Simulation sim = gas({.restitution = 1, .friction = 0.3},
                                      {.tangential = TangentialLaw::mindlin}, 0.02, b);
                 double scale = 0, now = 0;
                 const Vec3d before = momentum(sim, &scale);
                 sim.advance(b.options.reference ? 100000 : 1000000);  // the same bits, at more cost
                 return norm(momentum(sim, &now) - before) / scale;
               });
}

TEST(Energy, OfAnElasticGasStaysAtEveryStep) {
  // A contact errs by up to |e - 1| (1e-5, 4e-5, 4.3e-4 for velocity Verlet) either way, twice that in
  // energy, of which each pair has a thirteenth; some 400 collisions add up like a random walk.
  const double table[][2] = {{0.01, 3e-5}, {0.02, 1e-4}, {0.05, 1.3e-3}};
  for (const auto& [fraction, bound] : table) {
    expect_small("elastic gas",
                 fmt::format("27 grains, e = 1, mu = 0, periodic, 2e5 steps of {} t_c", fraction),
                 "energy drifts by", bound, bound, [step = fraction](const BackEnd& b) {
                   Simulation sim = gas({}, {}, step, b);
                   const double before = energy_balance(sim).kinetic;
                   sim.advance(b.options.reference ? 20000 : 200000);
                   const EnergyBalance e = energy_balance(sim);
                   return std::fabs((e.kinetic + e.elastic_normal) / before - 1);
                 });
  }
}

}  // namespace
}  // namespace interstice::dem
