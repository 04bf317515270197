#include "coupling/stream/build_model.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "coupling/scene/sizes.h"
#include "dem/contact/hooke.h"

namespace interstice::stream {
namespace {

/// The coefficients stated for two materials; zeros for a pair that cannot meet (read_scene() saw to that).
dem::PairCoefficients coefficients_of(const scene::Scene& scene, const std::string& a, const std::string& b) {
  for (const scene::ContactPair& p : scene.contact.pairs) {
    if ((p.materials[0] == a && p.materials[1] == b) || (p.materials[0] == b && p.materials[1] == a)) {
      return {p.restitution,      p.friction,         p.rolling_friction, p.cohesion_energy_density,
              p.work_of_adhesion, p.hamaker_constant, p.cutoff,           p.range,
              p.stiffness};
    }
  }
  return {};
}

/// The scene's words are the engine's, one by one.
dem::Laws laws_of(const scene::Contact& c) {
  using namespace dem;
  Laws laws;
  laws.normal = c.normal == scene::NormalLaw::hooke ? NormalLaw::hooke : NormalLaw::hertz;
  laws.clip = c.damping != scene::Damping::tension;
  switch (c.tangential) {
    case scene::TangentialLaw::none:
      break;
    case scene::TangentialLaw::slider:
      laws.tangential = TangentialLaw::slider;
      break;
    case scene::TangentialLaw::mindlin:
      laws.tangential = TangentialLaw::mindlin;
      break;
  }
  switch (c.rolling) {
    case scene::RollingLaw::none:
      break;
    case scene::RollingLaw::cdt:
      laws.rolling = RollingLaw::cdt;
      break;
    case scene::RollingLaw::epsd2:
      laws.rolling = RollingLaw::epsd2;
      break;
  }
  switch (c.cohesion) {
    case scene::CohesionLaw::none:
      break;
    case scene::CohesionLaw::sjkr:
      laws.cohesion = CohesionLaw::sjkr;
      break;
    case scene::CohesionLaw::jkr:
      laws.cohesion = CohesionLaw::jkr;
      break;
    case scene::CohesionLaw::dmt:
      laws.cohesion = CohesionLaw::dmt;
      break;
    case scene::CohesionLaw::van_der_waals:
      laws.cohesion = CohesionLaw::van_der_waals;
      break;
  }
  return laws;
}

/// The rules by which hooke gets its stiffness go by the largest grain, which presses hardest.
void derive_stiffness(const scene::Scene& scene, dem::Model& model) {
  const scene::Contact& c = scene.contact;
  if (c.normal != scene::NormalLaw::hooke || c.stiffness_rule == scene::StiffnessRule::given) return;
  double radius = 0, heaviest = 0;  // heaviest: r^3 rho
  for (const scene::Particles& p : scene.particles) {
    const double r = 0.5 * scene::largest_diameter(p),
                 rho = model.materials[material_index(scene, p.material)].density;
    if (r * r * r * rho > heaviest) radius = r, heaviest = r * r * r * rho;
  }
  if (!(radius > 0)) return;  // no grains: nothing to press
  const double mass = 4.0 / 3 * M_PI * heaviest;
  const double stiffness =
      c.stiffness_rule == scene::StiffnessRule::overlap
          ? dem::stiffness_for_overlap(0.5 * mass, c.design_speed, c.overlap_limit * 2 * radius)
          : dem::stiffness_for_velocity(mass, c.design_speed, radius);
  for (dem::PairCoefficients& pair : model.pairs) pair.stiffness = stiffness;
}

/// The planes of the axes whose boundary is a wall.
void add_bounding_walls(const scene::Scene& scene, dem::Model& model) {
  for (int axis = 0; axis < 3; ++axis) {
    if (scene.domain.boundary[axis] != scene::Boundary::wall) continue;
    const auto material = static_cast<std::uint16_t>(material_index(scene, scene.domain.wall_material[axis]));
    Vec3d inward{0, 0, 0};
    inward[axis] = 1;
    model.walls.push_back({Plane{scene.domain.box.lo, inward}, material});
    model.walls.push_back({Plane{scene.domain.box.hi, -inward}, material});
  }
}

}  // namespace

std::size_t material_index(const scene::Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (scene.materials[i].name == name) return i;
  }
  assert(!"read_scene() lets no unknown material through");
  return 0;
}

dem::Model build_model(const scene::Scene& scene) {
  dem::Model model;
  model.domain = scene.domain.box;
  for (int axis = 0; axis < 3; ++axis) {
    model.boundary[axis] = scene.domain.boundary[axis] == scene::Boundary::periodic
                               ? dem::AxisBoundary::periodic
                               : dem::AxisBoundary::open;
  }
  model.gravity = scene.domain.gravity;
  for (const scene::Material& m : scene.materials) {
    model.materials.push_back({m.density, m.youngs_modulus, m.poisson_ratio});
  }
  for (const scene::Material& a : scene.materials) {
    for (const scene::Material& b : scene.materials) {
      model.pairs.push_back(coefficients_of(scene, a.name, b.name));
    }
  }
  model.laws = laws_of(scene.contact);
  model.damping = scene.contact.damping == scene::Damping::clipped ? dem::DampingRule::exact_when_clipped
                                                                   : dem::DampingRule::exact_with_tension;
  if (scene.contact.slider_velocity > 0) model.slider_velocity = scene.contact.slider_velocity;
  derive_stiffness(scene, model);
  for (const scene::Wall& w : scene.walls) {
    model.walls.push_back({w.shape, static_cast<std::uint16_t>(material_index(scene, w.material))});
  }
  add_bounding_walls(scene, model);
  return model;
}

dem::Model relative_to(const Vec3d& origin, dem::Model model) {
  model.domain = {model.domain.lo - origin, model.domain.hi - origin};
  for (dem::Wall& wall : model.walls) wall.shape = translated(wall.shape, -origin);
  return model;
}

std::vector<PhasedRain> build_rain(const scene::Scene& scene, const Vec3d& origin) {
  std::vector<PhasedRain> all;
  for (std::size_t i = 0; i < scene.particles.size(); ++i) {
    const scene::Particles& p = scene.particles[i];
    if (!p.rain) continue;
    PhasedRain phased;
    phased.phase = p.rain->phase;
    phased.interval = p.rain->interval;
    // Two streams an entry: one draws sizes, one draws places.
    phased.rain.radii = scene::sample_diameters(p.diameter, p.count, scene.seed, 2 * i);
    for (double& r : phased.rain.radii) r *= 0.5;
    phased.rain.random = Random(scene.seed, 2 * i + 1);
    phased.rain.box = {p.rain->box.lo - origin, p.rain->box.hi - origin};
    phased.rain.velocity = p.rain->velocity;
    phased.rain.material = static_cast<std::uint16_t>(material_index(scene, p.material));
    all.push_back(std::move(phased));
  }
  return all;
}

std::vector<dem::NewGrain> build_placed_grains(const scene::Scene& scene, const Vec3d& origin) {
  std::vector<dem::NewGrain> grains;
  for (const scene::Particles& p : scene.particles) {
    if (!p.list) continue;
    const auto material = static_cast<std::uint16_t>(material_index(scene, p.material));
    for (const scene::PlacedGrain& g : p.list->grains) {
      grains.push_back({g.position - origin, 0.5 * g.diameter, g.velocity, g.spin, material, 0});
    }
  }
  return grains;
}

}  // namespace interstice::stream
