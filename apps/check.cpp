// interstice check SCENE.toml: what a run would do and cost, without doing it.
#include <fmt/format.h>
#include <tbb/info.h>

#include <cmath>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>

#include "apps/command.h"
#include "coupling/scene/read_scene.h"
#include "coupling/scene/sizes.h"
#include "coupling/stream/build_model.h"
#include "coupling/stream/contact_report.h"
#include "coupling/stream/field_memory.h"
#include "coupling/stream/schedule.h"
#include "coupling/stream/step_choice.h"
#include "dem/simd/pack.h"

namespace interstice::apps {
namespace {

// Measured on settled beds in double (docs/PERFORMANCE.md), the slowest of them: rows, lists, springs and
// results; and one core's rate by the registers that this program is built for.
constexpr double kBytesPerGrain = 600;
constexpr double kParticleStepsPerSecondPerCore = dem::simd::kNativeBytes == 64   ? 15e6
                                                  : dem::simd::kNativeBytes == 32 ? 8e6
                                                                                  : 4e6;

struct CheckArguments {
  std::string scene;
  std::vector<std::string> overrides;
  bool json = false;
};

struct Estimate {
  double grains = 0, simulated_at_most = 0, steps_at_most = 0, memory = 0, seconds = 0;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0;  // diameters [m]
};

/// What a step costs beside one in which nobody takes short steps: each of these works on small grains and
/// what they touch (docs/PERFORMANCE.md, Two rates of steps).
double cost_of_step(const scene::Scene& scene, const stream::StepChoice& choice) {
  if (choice.short_steps == 1) return 1;
  double small = 0, all = 0;
  for (const scene::Particles& p : scene.particles) {
    if (!p.rain) continue;
    constexpr int kSamples = 1000;
    const scene::SizeDistribution sizes(p.diameter);
    int below = 0;
    for (int i = 0; i < kSamples; ++i)
      below += sizes.quantile((i + 0.5) / kSamples) < *scene.step.short_below;
    small += static_cast<double>(p.count) * below / kSamples, all += static_cast<double>(p.count);
  }
  const double share = std::min(1.0, 0.05 + 4 * (all > 0 ? small / all : 0));
  return 1 + (choice.short_steps - 1) * share;
}

Estimate estimate(const scene::Scene& scene, const stream::StepChoice& choice) {
  Estimate e;
  for (const scene::Particles& p : scene.particles) {
    e.grains += static_cast<double>(p.list ? static_cast<std::int64_t>(p.list->grains.size()) : p.count);
    e.smallest = std::min(e.smallest, scene::smallest_diameter(p));
    e.largest = std::max(e.largest, scene::largest_diameter(p));
  }
  for (const scene::Phase& p : scene.phases) e.simulated_at_most += p.duration.value_or(p.at_most);
  e.steps_at_most = static_cast<double>(stream::steps_in(e.simulated_at_most, choice.step));
  e.memory = e.grains * kBytesPerGrain + stream::fields_memory(scene);
  e.seconds = e.grains * e.steps_at_most * cost_of_step(scene, choice) /
              (kParticleStepsPerSecondPerCore * tbb::info::default_concurrency());
  return e;
}

std::string duration(double s) {
  if (s < 120) return fmt::format("{:.0f} s", s);
  if (s < 7200) return fmt::format("{:.0f} min", s / 60);
  if (s < 172800) return fmt::format("{:.1f} h", s / 3600);
  return fmt::format("{:.1f} days", s / 86400);
}

nlohmann::ordered_json pair_json(const stream::PairReport& r) {
  const auto finite = [](double v) {
    return std::isfinite(v) ? nlohmann::ordered_json(v) : nlohmann::ordered_json(nullptr);
  };
  return {{"materials", {r.first, r.second}},
          {"wall", r.wall},
          {"median_diameter_m", r.diameter},
          {"pull_off_force_N", r.pull_off},
          {"bond_number", finite(r.bond)},
          {"bond_number_smallest", finite(r.bond_smallest)},
          {"bond_number_largest", finite(r.bond_largest)},
          {"tabor_number", r.tabor},
          {"sticking_speed_m_s", r.sticking_speed},
          {"equilibrium_overlap_diameters", r.equilibrium_overlap},
          {"impact_overlap_diameters", r.impact_overlap}};
}

void print_contacts(const stream::ContactReport& contacts) {
  fmt::print("  contact laws    {} ({} kernel)\n", contacts.laws, contacts.own_kernel ? "own" : "generic");
  for (const stream::PairReport& r : contacts.pairs) {
    fmt::print("    {} on {}{}, at {:.3g} um: overlap on impact {:.2g} d", r.first, r.second,
               r.wall ? " (wall)" : "", r.diameter * 1e6, r.impact_overlap);
    if (r.pull_off > 0) {
      fmt::print(
          ", at rest {:.2g} d;\n      pull-off {:.3g} N, Bond {:.3g} ({:.3g} smallest, {:.3g} largest), "
          "Tabor {:.2g}, sticks below {:.2g} m/s",
          r.equilibrium_overlap, r.pull_off, r.bond, r.bond_smallest, r.bond_largest, r.tabor,
          r.sticking_speed);
    }
    fmt::print("\n");
  }
}

nlohmann::ordered_json as_json(const scene::Scene& scene, const stream::StepChoice& c,
                               const stream::ContactReport& contacts, const Estimate& e) {
  nlohmann::ordered_json j;
  j["title"] = scene.title;
  j["particles"] = e.grains;
  j["diameter_min_m"] = e.smallest;
  j["diameter_max_m"] = e.largest;
  j["time_step_s"] = c.step;
  if (scene.step.short_below) j["short_steps"] = c.short_steps;
  j["time_step_limited_by"] = c.limited_by;
  j["rayleigh_time_s"] = c.limits.rayleigh_time;
  j["collision_time_s"] =
      std::isfinite(c.limits.collision_time) ? nlohmann::ordered_json(c.limits.collision_time) : nullptr;
  j["collision_speed_m_s"] = c.speed;
  j["laws"] = contacts.laws;
  j["kernel"] = contacts.own_kernel ? "own" : "generic";
  j["contacts"] = nlohmann::ordered_json::array();
  for (const stream::PairReport& r : contacts.pairs) j["contacts"].push_back(pair_json(r));
  j["simulated_at_most_s"] = e.simulated_at_most;
  j["steps_at_most"] = e.steps_at_most;
  j["memory_bytes"] = e.memory;
  j["estimated_wall_s"] = e.seconds;
  j["phases"] = scene.phases.size();
  j["walls"] = scene.walls.size();
  j["fields"] = scene.fields.size();
  return j;
}

void print(const scene::Scene& scene, const stream::StepChoice& c, const stream::ContactReport& contacts,
           const Estimate& e) {
  fmt::print("{}\n", scene.title.empty() ? scene.file : scene.title);
  fmt::print("  particles       {:.0f}, {:.3g} to {:.3g} um\n", e.grains, e.smallest * 1e6, e.largest * 1e6);
  fmt::print("  time step       {:.4g} s, limited by {}\n", c.step, c.limited_by);
  if (c.short_steps > 1)
    fmt::print("    short steps     {} of {:.4g} s each for grains below {:.3g} um\n", c.short_steps,
               c.short_step(), 1e6 * *scene.step.short_below);
  fmt::print("    Rayleigh time   {:.4g} s ({} step is {:.3g} of it)\n", c.limits.rayleigh_time,
             c.short_steps > 1 ? "a short" : "the", c.rayleigh_fraction);
  if (std::isfinite(c.limits.collision_time)) {
    fmt::print("    collision time  {:.4g} s at {:.3g} m/s ({} step is {:.3g} of it)\n",
               c.limits.collision_time, c.speed, c.short_steps > 1 ? "a short" : "the", c.collision_fraction);
  } else {
    fmt::print("    collision time  none: nothing moves\n");
  }
  print_contacts(contacts);
  fmt::print("  phases          {}, {:.4g} s at most, {:.4g} steps at most\n", scene.phases.size(),
             e.simulated_at_most, e.steps_at_most);
  fmt::print("  memory          about {:.0f} MB\n", e.memory / 1e6);
  fmt::print("  wall time       about {} at most on this machine\n", duration(e.seconds));
}

void check(const CheckArguments& a) {
  std::vector<std::string> warnings;
  const scene::Scene scene = scene::read_scene(a.scene, a.overrides, &warnings);
  const dem::Model model = stream::build_model(scene);
  const stream::StepChoice choice = stream::choose_step(scene, model);
  const stream::ContactReport contacts = stream::report_contacts(scene, model, choice.speed, choice.step);
  warnings.insert(warnings.end(), choice.warnings.begin(), choice.warnings.end());
  warnings.insert(warnings.end(), contacts.warnings.begin(), contacts.warnings.end());
  for (const std::string& w : warnings) fmt::print(stderr, "warning: {}\n", w);
  const Estimate e = estimate(scene, choice);
  if (a.json) {
    fmt::print("{}\n", as_json(scene, choice, contacts, e).dump(2));
  } else {
    print(scene, choice, contacts, e);
  }
}

}  // namespace

void add_check(CLI::App& root) {
  auto a = std::make_shared<CheckArguments>();
  CLI::App* c = root.add_subcommand("check", "validate a scene; print its time step, steps, memory and time");
  c->add_option("scene", a->scene, "scene file (TOML)")->required();
  c->add_option("--set", a->overrides, "override: path.to.key=value (repeatable)")->allow_extra_args(false);
  c->add_flag("--json", a->json, "print one JSON object");
  c->callback([a] { check(*a); });
}

}  // namespace interstice::apps
