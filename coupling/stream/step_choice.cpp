#include "coupling/stream/step_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "coupling/scene/sizes.h"
#include "coupling/stream/build_model.h"

namespace interstice::stream {
namespace {

// Restitution errors grow from here on, and from the second value the integration gains energy soon after
// (velocity Verlet on a Hertz contact: docs/PHYSICS.md).
constexpr double kWarnFraction = 0.05, kRefuseFraction = 0.2;

/// How far down (along gravity) a point lies [m].
double depth_of(const Vec3d& p, const Vec3d& down) { return dot(p, down); }

std::vector<Vec3d> corners_of(const Box& b) {
  std::vector<Vec3d> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back({i & 1 ? b.hi.x : b.lo.x, i & 2 ? b.hi.y : b.lo.y, i & 4 ? b.hi.z : b.lo.z});
  }
  return corners;
}

double shallowest(const Box& box, const Vec3d& down) {
  double depth = INFINITY;
  for (const Vec3d& c : corners_of(box)) depth = std::min(depth, depth_of(c, down));
  return depth;
}

/// The deepest upper surface on which a grain may land, as a depth; -inf where nothing stops a fall.
double deepest_floor(const dem::Model& model, const Vec3d& down) {
  double deepest = -INFINITY;
  for (const dem::Wall& wall : model.walls) {
    if (const auto* plane = std::get_if<Plane>(&wall.shape)) {
      const double facing = dot(plane->normal, down);
      if (facing > -1e-9) continue;  // a side wall or a ceiling
      deepest = std::max(deepest, depth_of(plane->point, down));
    } else {
      deepest = std::max(deepest, shallowest(std::get<Box>(wall.shape), down));
    }
  }
  return deepest;
}

double fastest_motion(const scene::Scene& scene, const dem::Model& model) {
  double speed = 0;
  for (const scene::Wall& wall : scene.walls) {
    for (const scene::Motion& m : wall.motion) speed = std::max(speed, norm(m.velocity));
  }
  const double g = norm(model.gravity);
  const Vec3d down = g > 0 ? (1 / g) * model.gravity : Vec3d{0, 0, 0};
  const double floor = deepest_floor(model, down);
  const auto landing_speed = [&](double start_speed, double start_depth) {
    const double fall = g > 0 && std::isfinite(floor) ? std::max(0.0, floor - start_depth) : 0.0;
    return std::sqrt(start_speed * start_speed + 2 * g * fall);
  };
  for (const scene::Particles& p : scene.particles) {
    if (p.rain) speed = std::max(speed, landing_speed(norm(p.rain->velocity), shallowest(p.rain->box, down)));
    if (!p.list) continue;
    for (const scene::PlacedGrain& grain : p.list->grains) {
      speed = std::max(speed, landing_speed(norm(grain.velocity), depth_of(grain.position, down)));
    }
  }
  return speed;
}

/// How many steps of the smallest grains make one of the smallest of those that are not below the scene's
/// limit: as many times as long a step they would be given.
int short_steps(const scene::Scene& scene, const dem::Model& model,
                const std::vector<dem::SmallestGrain>& smallest, const StepChoice& choice) {
  if (!scene.step.short_below || smallest.empty()) return 1;
  std::vector<dem::SmallestGrain> others = smallest;
  for (dem::SmallestGrain& g : others) g.radius = std::max(g.radius, 0.5 * *scene.step.short_below);
  const dem::StepLimits limits = dem::step_limits(model, others, choice.speed);
  const double by_rayleigh = limits.rayleigh_time / choice.limits.rayleigh_time;
  const double by_collision = std::isfinite(limits.collision_time)
                                  ? limits.collision_time / choice.limits.collision_time
                                  : by_rayleigh;
  return short_steps_in(std::min(by_rayleigh, by_collision));
}

}  // namespace

int short_steps_in(double times_as_long) {
  return static_cast<int>(std::clamp(std::floor(times_as_long * (1 + 1e-9)), 1.0, double{kMostShortSteps}));
}

StepChoice choose_step(const scene::Scene& scene, const dem::Model& model) {
  std::vector<dem::SmallestGrain> smallest;
  double smallest_radius = INFINITY;
  for (const scene::Particles& p : scene.particles) {
    const double radius = 0.5 * scene::smallest_diameter(p);
    if (!std::isfinite(radius)) continue;  // an empty list
    smallest.push_back({material_index(scene, p.material), radius});
    smallest_radius = std::min(smallest_radius, radius);
  }
  StepChoice choice;
  choice.speed = fastest_motion(scene, model);
  choice.limits = dem::step_limits(model, smallest, choice.speed);
  const double by_rayleigh = scene.step.rayleigh * choice.limits.rayleigh_time;
  const double by_collision = scene.step.collision * choice.limits.collision_time;
  choice.step = scene.step.fixed.value_or(std::min(by_rayleigh, by_collision));
  if (!std::isfinite(choice.step)) choice.step = 1e-6;  // no grains: any step will do
  choice.limited_by = scene.step.fixed              ? "the scene"
                      : by_rayleigh <= by_collision ? "Rayleigh time"
                                                    : "collision time";
  choice.rayleigh_fraction = choice.step / choice.limits.rayleigh_time;
  choice.collision_fraction = choice.step / choice.limits.collision_time;

  choice.short_steps = short_steps(scene, model, smallest, choice);
  if (scene.step.short_below && choice.short_steps == 1)
    choice.warnings.push_back(fmt::format(
        "time.short_steps_below: {:.3g} um is less than twice the smallest diameter, {:.3g} um: all "
        "grains take the same step",
        1e6 * *scene.step.short_below, 2e6 * smallest_radius));
  if (choice.collision_fraction > kRefuseFraction && !scene.step.allow_unstable) {
    throw InputError(
        fmt::format("{}: time.step: {:.3g} s is {:.2g} of the collision time {:.3g} s, where contacts gain "
                    "energy; at most 0.2 of "
                    "it is allowed; use {:.3g} s or less, or set time.allow_unstable = true",
                    scene.file, choice.step, choice.collision_fraction, choice.limits.collision_time,
                    kRefuseFraction * choice.limits.collision_time));
  }
  if (choice.collision_fraction > kWarnFraction) {
    choice.warnings.push_back(
        fmt::format("time step {:.3g} s is {:.2g} of the collision time {:.3g} s: restitution "
                    "will be wrong by percents; 0.04 is safe",
                    choice.step, choice.collision_fraction, choice.limits.collision_time));
  }
  if (choice.rayleigh_fraction > 0.2 * (1 + 1e-12)) {
    choice.warnings.push_back(
        fmt::format("time step {:.3g} s is {:.2g} of the Rayleigh time {:.3g} s; 0.2 is safe", choice.step,
                    choice.rayleigh_fraction, choice.limits.rayleigh_time));
  }
  if (choice.speed * choice.step > 0.5 * smallest_radius) {
    throw InputError(
        fmt::format("{}: time.step: in one step of {:.3g} s something moves {:.3g} m, more than half the "
                    "smallest radius {:.3g} m; "
                    "at most {:.3g} s is allowed at this speed; use a smaller step",
                    scene.file, choice.step, choice.speed * choice.step, smallest_radius,
                    0.5 * smallest_radius / choice.speed));
  }
  choice.step *= choice.short_steps;
  return choice;
}

}  // namespace interstice::stream
