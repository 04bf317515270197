#include "coupling/stream/contact_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/error.h"
#include "coupling/scene/sizes.h"
#include "coupling/stream/build_model.h"
#include "dem/kernels/kernels.h"

namespace interstice::stream {
namespace {

// Beyond these, small-strain contact laws are stretched: 5 % of the radius is a contact circle of a third of
// it.
constexpr double kLargestOverlap = 0.025;         // of the diameter
constexpr double kJkrFrom = 5, kDmtUpTo = 0.1;    // Tabor numbers (Johnson & Greenwood 1997)
constexpr double kVanDerWaalsStepsPerCutoff = 5;  // steps in which the cut-off distance is crossed

/// Diameters of one material's grains [m].
struct Sizes {
  double smallest = INFINITY, median = 0, largest = 0;
};

Sizes sizes_of(const scene::Scene& scene, const std::string& material) {
  constexpr std::int64_t kSamples = 1001;  // of a distribution, for its median
  std::vector<double> all;
  Sizes sizes;
  for (const scene::Particles& p : scene.particles) {
    if (p.material != material) continue;
    sizes.smallest = std::min(sizes.smallest, scene::smallest_diameter(p));
    sizes.largest = std::max(sizes.largest, scene::largest_diameter(p));
    if (p.list) {
      for (const scene::PlacedGrain& g : p.list->grains) all.push_back(g.diameter);
    } else {
      const auto drawn = scene::sample_diameters(p.diameter, std::min(p.count, kSamples), scene.seed, 0);
      all.insert(all.end(), drawn.begin(), drawn.end());
    }
  }
  if (all.empty()) return sizes;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2), all.end());
  sizes.median = all[all.size() / 2];
  return sizes;
}

double mass_of(double diameter, const dem::Material& material) {
  return M_PI / 6 * diameter * diameter * diameter * material.density;
}

dem::Encounter meeting(double a, double mass_a, double b, double mass_b) {
  return {0.5 * a * b / (a + b), mass_a * mass_b / (mass_a + mass_b)};
}

/// Everything about one pair; `other` is null for a wall.
PairReport report_pair(const dem::Model& model, const dem::PairConstants<double>& c,
                       const dem::Material& material, const Sizes& sizes, const dem::Material* other,
                       const Sizes& other_sizes, double speed) {
  const double gravity = norm(model.gravity);
  const auto encounter = [&](double d, double d_other) {
    const double mass = mass_of(d, material);
    return other ? meeting(d, mass, d_other, mass_of(d_other, *other)) : dem::Encounter{0.5 * d, mass};
  };
  const auto bond = [&](double d, double d_other) {
    return dem::bond_number(model.laws, c, encounter(d, d_other), mass_of(d, material), gravity);
  };
  PairReport r;
  r.wall = other == nullptr;
  r.diameter = sizes.median;
  r.encounter = encounter(sizes.median, other_sizes.median);
  r.pull_off = dem::pull_off_force(model.laws, c, r.encounter);
  r.impact_overlap = dem::impact_overlap(model.laws, c, r.encounter, speed) / sizes.median;
  if (model.laws.cohesion == dem::CohesionLaw::none) return r;
  r.bond = bond(sizes.median, other_sizes.median);
  r.bond_smallest = bond(sizes.smallest, other_sizes.smallest);
  r.bond_largest = bond(sizes.largest, other_sizes.largest);
  r.tabor = dem::tabor_number(model.laws, c, r.encounter);
  r.sticking_speed = dem::sticking_speed(model.laws, c, r.encounter);
  r.equilibrium_overlap = dem::equilibrium_overlap(model.laws, c, r.encounter) / sizes.median;
  return r;
}

void warn_of_range(const dem::Model& model, const PairReport& r, ContactReport& report) {
  const std::string who = fmt::format("{} on {}{}", r.first, r.second, r.wall ? " (wall)" : "");
  const auto warn = [&](const std::string& text) {
    report.warnings.push_back(fmt::format("contact of {}: {}", who, text));
  };
  const bool attracts = r.pull_off > 0;
  if (model.laws.cohesion == dem::CohesionLaw::jkr && attracts && r.tabor < kJkrFrom) {
    warn(fmt::format("Tabor number {:.3g}, and jkr holds above {}: {}", r.tabor, kJkrFrom,
                     r.tabor < kDmtUpTo ? "use dmt, whose pull-off force is 4/3 of it"
                                        : "the pull-off force lies between jkr's and 4/3 of it (dmt)"));
  }
  if (model.laws.cohesion == dem::CohesionLaw::dmt && attracts && r.tabor > kDmtUpTo) {
    warn(fmt::format("Tabor number {:.3g}, and dmt holds below {}: {}", r.tabor, kDmtUpTo,
                     r.tabor > kJkrFrom ? "use jkr, whose pull-off force is 3/4 of it"
                                        : "the pull-off force lies between dmt's and 3/4 of it (jkr)"));
  }
  if (r.equilibrium_overlap > kLargestOverlap) {
    warn(
        fmt::format("adhesion alone presses grains {:.2g} of a diameter into each other, where contact laws "
                    "for small strains end ({} is sound): stiffen the material or weaken the cohesion",
                    r.equilibrium_overlap, kLargestOverlap));
  }
  if (r.impact_overlap > kLargestOverlap) {
    warn(fmt::format(
        "at the scene's largest speed grains overlap by {:.2g} of a diameter, and contact laws are "
        "for small strains ({} is sound): stiffen the material, or read void fractions with care",
        r.impact_overlap, kLargestOverlap));
  }
}

void warn_of_steep_attraction(const scene::Scene& scene, double speed, double step, ContactReport& report) {
  for (const scene::ContactPair& p : scene.contact.pairs) {
    const double crossed = speed * step;
    if (!(p.cutoff > 0) || crossed * kVanDerWaalsStepsPerCutoff <= p.cutoff) continue;
    report.warnings.push_back(
        fmt::format("contact of {} on {}: in one step of {:.3g} s grains at {:.3g} m/s move {:.3g} m, and "
                    "the van der Waals "
                    "force changes within the cut-off of {:.3g} m: the energy of their approach will be "
                    "wrong; use steps of "
                    "{:.2g} s, or a larger cutoff with hamaker_constant / cutoff^2 (the pull-off force) kept",
                    p.materials[0], p.materials[1], step, speed, crossed, p.cutoff,
                    p.cutoff / (kVanDerWaalsStepsPerCutoff * speed)));
  }
}

std::string words_of(const scene::Contact& c, const dem::Laws& laws) {
  std::string words = laws.normal == dem::NormalLaw::hertz ? "hertz" : "hooke";
  if (laws.tangential == dem::TangentialLaw::slider) words += ", slider";
  if (laws.tangential == dem::TangentialLaw::mindlin) words += ", mindlin";
  if (laws.rolling == dem::RollingLaw::cdt) words += ", cdt";
  if (laws.rolling == dem::RollingLaw::epsd2) words += ", epsd2";
  switch (laws.cohesion) {
    case dem::CohesionLaw::none:
      break;
    case dem::CohesionLaw::sjkr:
      words += ", sjkr";
      break;
    case dem::CohesionLaw::jkr:
      words += ", jkr";
      break;
    case dem::CohesionLaw::dmt:
      words += ", dmt";
      break;
    case dem::CohesionLaw::van_der_waals:
      words += ", van der Waals";
      break;
  }
  return words + (c.damping == scene::Damping::tension   ? "; damping with tension"
                  : c.damping == scene::Damping::clipped ? "; damping clipped"
                                                         : "; damping clipped, not corrected");
}

}  // namespace

ContactReport report_contacts(const scene::Scene& scene, const dem::Model& model, double speed, double step) {
  ContactReport report;
  report.laws = words_of(scene.contact, model.laws);
  report.own_kernel = dem::has_own_kernel(model.laws);
  std::set<std::string> wall_materials;
  for (const scene::Wall& w : scene.walls) wall_materials.insert(w.material);
  for (const std::string& m : scene.domain.wall_material) {
    if (!m.empty()) wall_materials.insert(m);
  }
  std::vector<std::string> grains;
  for (const scene::Particles& p : scene.particles) {
    if (std::find(grains.begin(), grains.end(), p.material) == grains.end()) grains.push_back(p.material);
  }
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Sizes sizes = sizes_of(scene, grains[i]);
    if (!(sizes.median > 0)) continue;
    const std::size_t a = material_index(scene, grains[i]);
    const auto add = [&](const std::string& second, bool wall) {
      const std::size_t b = material_index(scene, second);
      const Sizes other = wall ? Sizes{} : sizes_of(scene, second);
      if (!wall && !(other.median > 0)) return;
      PairReport r = report_pair(model, model.constants(a, b), model.materials[a], sizes,
                                 wall ? nullptr : &model.materials[b], other, speed);
      r.first = grains[i], r.second = second;
      if (!std::isfinite(r.pull_off)) {
        throw InputError(
            fmt::format("{}: contact.pair: {} on {}: the cohesion outweighs the linear spring at every "
                        "overlap; it must be "
                        "below k / (2 pi R*) = {:.3g} J/m^3; weaken it or raise the stiffness",
                        scene.file, r.first, second,
                        model.constants(a, b).stiffness / (2 * M_PI * r.encounter.effective_radius)));
      }
      warn_of_range(model, r, report);
      report.pairs.push_back(std::move(r));
    };
    for (std::size_t j = i; j < grains.size(); ++j) add(grains[j], false);
    for (const std::string& wall : wall_materials) add(wall, true);
  }
  warn_of_steep_attraction(scene, speed, step, report);
  return report;
}

}  // namespace interstice::stream
