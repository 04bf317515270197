// How wrong restitution is over the width of the time step, the ratio of stiffness and the ratio of size;
// written as a table, stability_map.tsv, beside the other reports.
#include <cstdlib>
#include <fstream>

#include "tests/extremes/support.h"

namespace interstice::dem {
namespace {

using namespace testing;

const double kFractions[] = {0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
const double kStiffness[] = {1, 1e2, 1e4, 1e8, 1e12};
const double kSizes[] = {1, 3, 10, 100, 1000};
constexpr int kPhases = 20;  // of first touch within a step; not 0, where rounding decides which step it is

struct Cell {
  double mean = 0, least = INFINITY, most = -INFINITY;
};

Cell map_cell(double restitution, double fraction, double stiffness, double size, const BackEnd& b) {
  Cell cell;
  for (int p = 0; p < kPhases; ++p) {
    Impact i{.radius_b = 20e-6 * size, .fraction = fraction, .phase = (p + 0.5) / kPhases, .lasts = 2};
    i.b.youngs_modulus *= stiffness;
    i.pair.restitution = restitution;
    const double e = collide(i, b).restitution;
    cell.mean += e / kPhases;
    cell.least = std::min(cell.least, e);
    cell.most = std::max(cell.most, e);
  }
  return cell;
}

void write_cell(std::ofstream& out, const BackEnd& b, double set, double f, double k, double s,
                const Cell& c) {
  out << fmt::format("{}\t{:g}\t{:g}\t{:g}\t{:g}\t{:.6f}\t{:.6f}\t{:.6f}\n", b.name, set, f, k, s, c.mean,
                     c.least, c.most);
}

TEST(StabilityMap, DependsOnTheStepAlone) {
  std::ofstream out;
  if (const char* folder = std::getenv("INTERSTICE_REPORT")) {
    out.open(fmt::format("{}/stability_map.tsv", folder));
    out << "back end\te set\tdt/t_c\tstiffness ratio\tsize ratio\te mean\te least\te most\n";
  }
  for (const double set : {1.0, 0.5}) {
    for (const double fraction : kFractions) {
      double spread[3] = {0, 0, 0};
      Cell equal;
      for (std::size_t n = 0; n < 3; ++n) {
        const BackEnd b = back_ends()[n];
        if (b.options.reference) continue;  // the same laws and loops over a pair
        for (const double k : kStiffness) {
          for (const double s : kSizes) {
            const Cell c = map_cell(set, fraction, k, s, b);
            if (n == 0 && k == 1 && s == 1) equal = c;
            keep_worst(spread[n], std::fabs(c.mean - equal.mean) + std::fabs(c.most - equal.most));
            if (out.is_open()) write_cell(out, b, set, fraction, k, s, c);
          }
        }
      }
      // The equation of a pair has no other number in it than e and dt/t_c. Grains 1000 times as large round
      // their positions 1000 times as coarsely: 1e-18 m of an overlap of 1e-8 m.
      expect_outcome(
          "time step, stiffness and size",
          fmt::format("{} t_c, e = {:g}, stiffness 1..1e12, sizes 1..1000, {} phases", fraction, set,
                      kPhases),
          fmt::format("e = {:.4f} ({:.4f} to {:.4f}) for equal spheres; the ratios change it by {:.0e} "
                      "(double), {:.0e} (mixed)",
                      equal.mean, equal.least, equal.most, spread[0], spread[2]),
          spread[0] < 1e-6 && spread[2] < 1e-3);
    }
  }
}

/// The largest kinetic energy of a grain pressed between two plates and nudged, in steps 1900 to 2000, over
/// that which the nudge gave it; and the highest frequency that check_step gives meanwhile (beyond the limit
/// the contacts open and close, and it goes up and down).
std::pair<double, double> pressed(double omega_dt, const BackEnd& b) {
  const double r = 20e-6, overlap = 2e-7, nudge = 1e-10, modulus = 1e9 / 1.82, mass = sphere_mass(r, 8200);
  Model m = open_model({8200, 1e9, 0.3}, {}, {}, 1);
  m.walls = {{Plane{{0, 0, -r + overlap}, {0, 0, 1}}, 0}, {Plane{{0, 0, r - overlap}, {0, 0, -1}}, 0}};
  const double stiffness = 2 * 2 * modulus * std::sqrt(r * overlap);  // of both
  Simulation sim(m, omega_dt * std::sqrt(mass / stiffness), b.options);
  sim.add_grains(std::vector<NewGrain>{grain({0, 0, nudge}, r)});
  sim.advance(1900);
  double peak = 0, frequency = 0;
  for (int s = 0; s < 100; ++s) {  // more than a period of the slowest
    sim.advance(1);
    keep_worst(peak, kinetic_sum(sim));
    keep_worst(frequency, check_step(sim).frequency);
  }
  return {peak / (0.5 * stiffness * nudge * nudge), frequency};
}

TEST(StabilityMap, OfAPressedGrainEndsAtTwo) {
  for (const double omega_dt : {0.1, 1.0, 1.9, 1.98, 2.02, 2.1}) {
    for (const BackEnd& b : back_ends()) {
      std::string outcome;
      bool right = false;
      try {
        const auto [growth, frequency] = pressed(omega_dt, b);
        outcome = fmt::format("kinetic energy {:.3g} of the nudge's after 2000 steps; check_step says {:.3f}",
                              growth, frequency);
        right =
            omega_dt < 2 ? growth < 1.5 && std::fabs(frequency - omega_dt) < 0.01 * omega_dt : growth > 1.5;
        // Beyond 2 it grows until the contacts open and stiffen: it is the check that must see it.
        if (omega_dt > 2) right = right && frequency > 1.9;
      } catch (const UnstableError&) {
        outcome = "refused";
        right = omega_dt > 2;
      }
      expect_outcome("stability limit",
                     fmt::format("grain pressed between plates, omega dt = {} ({})", omega_dt, b.name),
                     outcome, right);
    }
  }
}

}  // namespace
}  // namespace interstice::dem
