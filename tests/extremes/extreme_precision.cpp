// Laws and forces in single precision (motion in double) against everything in double, on the same scenes.
#include "tests/extremes/beds.h"

namespace interstice::dem {
namespace {

using namespace testing;

const BackEnd kDouble = back_ends()[0], kMixed = back_ends()[2];

TEST(Precision, OverlapAndForceAtRest) {
  // Closed form: F = m g, overlap (m g / (4/3 E* sqrt(R)))^(2/3). Mixed: force and overlap to 6e-8 of
  // themselves, because the overlap is taken in double before it is rounded.
  for (const double radius : {5e-8, 20e-6, 1e-3, 0.5}) {
    const double mass = sphere_mass(radius, 8200), modulus = 1e9 / 1.82;
    const double expected = std::pow(mass * 9.81 / (4.0 / 3 * modulus * std::sqrt(radius)), 2.0 / 3);
    const auto rest = [&](const BackEnd& b) {
      Model m = open_model({8200, 1e9, 0.3}, {.restitution = 0.01}, {}, 1e3 * radius);
      m.gravity = {0, 0, -9.81};
      m.walls = {{Plane{{0, 0, 0}, {0, 0, 1}}, 0}};
      const double stiffness = 2 * modulus * std::sqrt(radius * expected);
      Simulation sim(m, 0.1 * std::sqrt(mass / stiffness), b.options);
      sim.add_grains(std::vector<NewGrain>{grain({0, 0, radius - 0.9 * expected}, radius)});
      sim.advance(2000);
      const double overlap = radius - columns(sim).z[0];
      return std::pair{overlap / expected - 1, wall_statistics(sim, 0).normal_force / (mass * 9.81) - 1};
    };
    const auto exact = rest(kDouble), mixed = rest(kMixed);
    // In double, too, the position rounds the overlap: 1e-16 R / overlap.
    const double rounding = 1e-15 * radius / expected + 1e-9;
    expect_outcome(
        "single precision laws", fmt::format("grain of {:g} m at rest: overlap, force", 2 * radius),
        fmt::format("off by {:.0e}, {:.0e} (double); {:.0e}, {:.0e} (mixed)", exact.first, exact.second,
                    mixed.first, mixed.second),
        std::fabs(exact.first) < rounding && std::fabs(exact.second) < 2 * rounding &&
            std::fabs(mixed.first) < rounding + 3e-7 && std::fabs(mixed.second) < 2 * rounding + 3e-7);
  }
}

TEST(Precision, SettledPacking) {
  // Chaos makes two packings of one start; what must agree are their statistics, to what seeds differ by.
  const Bed bed{};
  const std::int64_t steps = 24000;  // 30 ms: the fall takes 10 ms
  double fraction[2] = {0, 0}, coordination[2] = {0, 0}, square = 0;
  const int seeds = 3;
  for (int seed = 1; seed <= seeds; ++seed) {
    for (const bool mixed : {false, true}) {
      Bed one = bed;
      one.seed = static_cast<std::uint64_t>(seed);
      Simulation sim = make_bed(one, mixed ? kMixed.options : kDouble.options);
      sim.advance(steps);
      const BedState s = state_of(sim, one);
      fraction[mixed] += s.fraction / seeds;
      coordination[mixed] += s.coordination / seeds;
      if (!mixed) square += s.fraction * s.fraction / seeds;
      EXPECT_LT(s.kinetic, 1e-3);
    }
  }
  const double sd = std::sqrt(std::max(0.0, square - fraction[0] * fraction[0]) * seeds / (seeds - 1));
  // A poured frictional bed of a dozen layers with a free surface: 0.01 of solid fraction between seeds.
  expect_outcome(
      "single precision laws", fmt::format("packing of {} settled grains, {} seeds", bed.count, seeds),
      fmt::format("solid fraction {:.4f} (double, sd {:.4f}) and {:.4f} (mixed); contacts a grain {:.3f} and "
                  "{:.3f}",
                  fraction[0], sd, fraction[1], coordination[0], coordination[1]),
      std::fabs(fraction[0] - fraction[1]) < 0.01 && std::fabs(coordination[0] - coordination[1]) < 0.25);
}

TEST(Precision, RestingHeapAtSmallSteps) {
  // At small steps the increments of a spring, k v dt, may fall below the last bit of its force. A
  // tetrahedron of grains on a floor settles for 25 ms and is then watched.
  for (const double step : {0.1, 0.01, 1e-3}) {
    std::string outcome;
    bool right = true;
    for (const BackEnd& b : {kDouble, kMixed}) {
      const double r = Bed::kRadius, a = 2 * r * 0.9999, c = 3 * 2 * r;
      const Model m = make_bed({.count = 1}, b.options).model();
      Simulation sim(m, step * rayleigh_time(r, m.materials[0]), b.options);
      sim.add_grains(std::vector<NewGrain>{
          grain({c, c, r}, r), grain({c + a, c, r}, r), grain({c + 0.5 * a, c + a * std::sqrt(0.75), r}, r),
          grain({c + 0.5 * a, c + a / std::sqrt(12), r + a * std::sqrt(2.0 / 3)}, r)});
      sim.advance(static_cast<std::int64_t>(2000 / step));  // 25 ms
      const GrainColumns settled = columns(sim);
      sim.advance(300000);
      const double crept = creep(settled, columns(sim));
      outcome += fmt::format("{}{:.1e} d ({})", outcome.empty() ? "creeps " : ", ", crept, b.name);
      right = right && crept < 1e-3;  // the bound for a settled bed
    }
    expect_outcome("single precision laws", fmt::format("heap of four at rest, 3e5 steps of {:g} t_R", step),
                   outcome, right);
  }
}

TEST(Adhesion, LoosensAPacking) {
  // The more grains stick, the looser they lie.
  for (const BackEnd& b : {kDouble, kMixed}) {
    std::vector<double> fractions;
    std::string outcome = "solid fraction";
    bool right = true;
    for (const double bond : {0.0, 1.0, 10.0, 100.0}) {
      Bed bed{.bond = bond};
      Simulation sim = make_bed(bed, b.options);
      sim.advance(20000);
      const BedState s = state_of(sim, bed);
      outcome += fmt::format("{} {:.3f}", fractions.empty() ? "" : ",", s.fraction);
      right = right && s.kinetic < 1e-3 && (fractions.empty() || s.fraction < fractions.back() + 0.01);
      fractions.push_back(s.fraction);
    }
    right = right && fractions.back() < fractions.front() - 0.03;
    expect_outcome("adhesion in a bed", fmt::format("jkr, Bond number 0, 1, 10, 100 ({})", b.name), outcome,
                   right);
  }
}

}  // namespace
}  // namespace interstice::dem
