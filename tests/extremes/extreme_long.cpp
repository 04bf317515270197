// Runs of a million steps and more: an elastic gas keeps its energy, a settled bed keeps still.
#include "base/random.h"
#include "tests/extremes/beds.h"

namespace interstice::dem {
namespace {

using namespace testing;

struct Drift {
  double whole = 0;  // change of the energy over the run, relative
  double trend = 0;  // slope of a straight line through it, over the run
};

/// 343 elastic grains in a periodic box, 1e6 steps of 0.02 t_c of the smallest, fastest pair.
Drift elastic_gas(const BackEnd& b) {
  const double r = 2e-5, v = 1, pitch = 6e-5;
  Model m = open_model({8200, 1e9, 0.3}, {}, {}, 3.5 * pitch);
  m.boundary.fill(AxisBoundary::periodic);
  const double smallest = 0.7 * r, fastest = 2 * std::sqrt(3.0) * v;
  const double contact = collision_time(0.5 * sphere_mass(smallest, 8200), smallest / 2, 1e9 / 1.82, fastest);
  Simulation sim(m, 0.02 * contact, b.options);
  Random random(3, 0);
  std::vector<NewGrain> grains;
  for (int i = 0; i < 343; ++i) {
    grains.push_back(grain({(i % 7 - 3) * pitch, (i / 7 % 7 - 3) * pitch, (i / 49 - 3) * pitch},
                           r * random.uniform(0.7, 1.0),
                           {random.uniform(-v, v), random.uniform(-v, v), random.uniform(-v, v)}));
  }
  sim.add_grains(grains);
  const auto energy = [&] {
    const EnergyBalance e = energy_balance(sim);
    return e.kinetic + e.elastic_normal;
  };
  const double before = energy();
  const int points = 50;
  double first = 0, second = 0;  // means of the halves
  double last = 0;
  for (int k = 0; k < points; ++k) {
    sim.advance(1000000 / points);
    last = energy() / before - 1;
    (k < points / 2 ? first : second) += 2 * last / points;
  }
  return {last, 2 * (second - first)};
}

TEST(LongRun, AnElasticGasKeepsItsEnergy) {
  for (const BackEnd& b : back_ends()) {
    if (b.options.reference) continue;  // the same bits, many times the time
    const Drift d = elastic_gas(b);
    expect_outcome("long run",
                   fmt::format("343 grains, e = 1, mu = 0, periodic, 1e6 steps of 0.02 t_c ({})", b.name),
                   fmt::format("energy changes by {:.1e}, a trend of {:.1e} over the run", d.whole, d.trend),
                   std::fabs(d.whole) < 1e-4 && std::fabs(d.trend) < 1e-4);
  }
}

/// By id: does the grain bear load, with three contacts or more? The others lie loose in a hole of the bed or
/// on the floor, where nothing stops them from spinning about their one contact, or (without rolling
/// friction) from rolling on.
std::vector<bool> bearing(const Simulation& sim) {
  std::vector<bool> held(sim.grains());
  for (std::size_t slot = 0; slot < sim.grains(); ++slot) {
    int contacts = 0;
    for (const Adjacent& e : sim.pair_contacts().of(slot)) contacts += sim.pair_contacts().touching(e.pair);
    for (const WallContact& w : sim.wall_contacts().of(slot)) contacts += w.touching();
    held[static_cast<std::size_t>(sim.site(slot).id)] = contacts >= 3;
  }
  return held;
}

struct Rest {
  double crept = 0, loose_crept = 0;      // farthest, of those that bear load and of the others [d]
  double kinetic = 0, loose_kinetic = 0;  // largest, of those that bear load and of the others, over m g d
  int loose = 0;
};

Rest rest_of(const Simulation& sim, const GrainColumns& from, const std::vector<bool>& held) {
  Rest r;
  const GrainColumns to = columns(sim);
  for (const GrainRow& g : sim.rows()) {
    const std::size_t i = static_cast<std::size_t>(g.id);
    const Vec3d moved =
        separation({to.x[i], to.y[i], to.z[i]}, {from.x[i], from.y[i], from.z[i]}, sim.search_space());
    const double crept = norm(moved) / (2 * g.radius);
    const double kinetic = kinetic_energy(g) / (g.mass * 9.81 * 2 * g.radius);
    keep_worst(held[i] ? r.crept : r.loose_crept, crept);
    keep_worst(held[i] ? r.kinetic : r.loose_kinetic, kinetic);
    r.loose += held[i] ? 0 : 1;
  }
  return r;
}

/// A bed of 50 grains, settled for 1e6 steps and watched for `steps`.
void watch_bed(RollingLaw rolling, const char* name, std::int64_t steps, double kinetic_bound,
               const BackEnd& b, std::int64_t settling = 1000000) {
  Bed bed{.count = 50, .side = 4};
  bed.laws.rolling = rolling;
  Simulation sim = make_bed(bed, b.options);
  sim.advance(settling);
  const GrainColumns settled = columns(sim);
  const std::vector<bool> held = bearing(sim);
  sim.advance(steps);
  const Rest r = rest_of(sim, settled, held);
  expect_outcome(
      "long run",
      fmt::format("settled bed of 50 grains, {}, {:g} steps ({})", name, static_cast<double>(steps), b.name),
      fmt::format("creeps {:.1e} d, kinetic energy {:.1e} m g d; of {} loose grains {:.1e} d, {:.1e} m g d",
                  r.crept, r.kinetic, r.loose, r.loose_crept, r.loose_kinetic),
      r.crept < 1e-3 && r.kinetic < kinetic_bound && r.loose < 10);
}

TEST(LongRun, ASettledBedKeepsStill) {
  watch_bed(RollingLaw::none, "mindlin", 10000000, 1e-10, back_ends()[0]);
  watch_bed(RollingLaw::epsd2, "mindlin, epsd2", 10000000, 1e-10, back_ends()[0]);
  watch_bed(RollingLaw::epsd2, "mindlin, epsd2", 3000000, 1e-10, back_ends()[2]);
}

// Bounded near rest (cdt.h), the constant torque lets a bed creep into place more slowly than a spring would:
// it settles for longer before it is watched.
TEST(LongRun, ABedWithCdtKeepsStill) {
  watch_bed(RollingLaw::cdt, "mindlin, cdt", 3000000, 1e-10, back_ends()[0], 4000000);
}

}  // namespace
}  // namespace interstice::dem
