#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/studies/compare_figures.h"

namespace interstice::studies {
namespace {

struct Series {
  const RunFolder &a, &b;
  const Labels& labels;
  TimeZero zero;
};

std::vector<double> milliseconds(const RunFolder& run, double zero) {
  std::vector<double> times = run.series.numbers("time_s");
  for (double& t : times) t = 1e3 * (t - zero);
  return times;
}

/// The unit that brings the largest value between 1 and 1000: "nN", "kPa", ...
struct Scale {
  double factor = 1;
  std::string unit;
};
Scale scale_for(const std::vector<figures::Curve>& curves, const std::string& unit) {
  if (unit.empty()) return {};
  double largest = 0;
  for (const auto& curve : curves) {
    for (const double y : curve.y) largest = std::isfinite(y) ? std::max(largest, std::abs(y)) : largest;
  }
  const std::pair<double, const char*> prefixes[] = {{1e6, "M"},  {1e3, "k"},  {1, ""},      {1e-3, "m"},
                                                     {1e-6, "µ"}, {1e-9, "n"}, {1e-12, "p"}, {1e-15, "f"}};
  for (const auto& [power, prefix] : prefixes) {
    if (largest >= power) return {1 / power, prefix + unit};
  }
  return {1, unit};
}

using OfRun = std::vector<double> (*)(const RunFolder&, const std::string&, const std::string&);

std::vector<double> plain(const RunFolder& run, const std::string& name, const std::string&) {
  return run.series.has(name) ? run.series.numbers(name) : std::vector<double>();
}
std::vector<double> ratio(const RunFolder& run, const std::string& total, const std::string& per) {
  if (!run.series.has(total) || !run.series.has(per)) return {};
  return per_unit(run.series.numbers(total), run.series.numbers(per));
}

struct PanelRequest {
  std::string column, per;  // per: empty for the column itself
  std::string label, unit;
};

/// A panel with what there is of A and B; without curves where neither has it.
figures::CurveFigure panel(const Series& s, const PanelRequest& request) {
  figures::CurveFigure figure;
  const OfRun values = request.per.empty() ? &plain : &ratio;
  const auto add = [&](const RunFolder& run, double zero, const std::string& label) {
    auto y = values(run, request.column, request.per);
    if (!y.empty()) figure.curves.push_back({label, milliseconds(run, zero), std::move(y)});
  };
  add(s.a, s.zero.a, s.labels[0]);
  add(s.b, s.zero.b, s.labels[1]);
  const Scale scale = scale_for(figure.curves, request.unit);
  for (auto& curve : figure.curves) {
    for (double& y : curve.y) y *= scale.factor;
  }
  figure.y_label = request.label + (scale.unit.empty() ? "" : " [" + scale.unit + "]");
  figure.marks = phase_marks(s.a, s.b, s.labels, s.zero);
  return figure;
}

void add_figure(std::vector<NamedFigure>& all, const Series& s, const std::string& name,
                const std::string& title, const std::string& note,
                const std::vector<PanelRequest>& requests) {
  std::vector<figures::CurveFigure> panels;
  for (const auto& request : requests) {
    auto made = panel(s, request);
    if (!made.curves.empty()) panels.push_back(std::move(made));
  }
  if (panels.empty()) return;
  panels.front().title = title;
  panels.back().x_label = s.zero.label();
  panels.back().note = note;
  all.push_back({name, std::move(panels)});
}

}  // namespace

std::string TimeZero::label() const {
  return phase.empty() ? "time [ms]" : fmt::format("time since the start of {} [ms]", phase);
}

TimeZero time_zero(const RunFolder& a, const RunFolder& b) {
  for (const auto& phase : a.phases) {
    const PhaseSpan* other = b.phase(phase.name);
    if (other == nullptr || phase.start == other->start) continue;
    return {phase.start, other->start, phase.name};
  }
  return {};
}

std::vector<figures::CurveFigure::Mark> phase_marks(const RunFolder& a, const RunFolder& b,
                                                    const Labels& labels, const TimeZero& zero) {
  std::vector<figures::CurveFigure::Mark> result;
  const auto end_of = [](const PhaseSpan& p, double from) { return 1e3 * (p.end - from); };
  for (const auto& phase : a.phases) {
    const PhaseSpan* other = b.phase(phase.name);
    const double at = end_of(phase, zero.a);
    const bool same =
        other != nullptr && std::abs(at - end_of(*other, zero.b)) < 1e-3 * std::max(1.0, std::abs(at));
    result.push_back(
        {at, same ? "end of " + phase.name : fmt::format("end of {} ({})", phase.name, labels[0])});
    if (other != nullptr && !same) {
      result.push_back({end_of(*other, zero.b), fmt::format("end of {} ({})", phase.name, labels[1])});
    }
  }
  for (const auto& phase : b.phases) {
    if (a.phase(phase.name) != nullptr) continue;
    result.push_back({end_of(phase, zero.b), fmt::format("end of {} ({})", phase.name, labels[1])});
  }
  std::sort(result.begin(), result.end(), [](const auto& p, const auto& q) { return p.x < q.x; });
  return result;
}

std::vector<NamedFigure> series_figures(const RunFolder& a, const RunFolder& b, const Labels& labels) {
  const Series s{a, b, labels, time_zero(a, b)};
  std::vector<NamedFigure> all;
  add_figure(all, s, "inter_particle_force", "Inter-particle forces", "mean over the contacts between grains",
             {{"contact_force_mean_N", "", "mean force per contact", "N"},
              {"contact_normal_force_mean_N", "", "mean normal force per contact", "N"},
              {"contact_force_max_N", "", "largest force", "N"}});
  add_figure(all, s, "bed", "State of the bed", "",
             {{"coordination_mean", "", "contacts per grain", ""},
              {"contacts", "", "contacts", ""},
              {"kinetic_energy_J", "", "kinetic energy", "J"},
              {"particles_lost", "", "grains lost", ""}});
  for (const auto& wall : walls_of_both(a, b)) {
    const std::string normal = wall + "_normal_force_N", shear = wall + "_shear_force_N";
    add_figure(
        all, s, "force_" + wall, "Forces on " + wall,
        "per contact: total / number of contacts; shear is the magnitude of the vector sum over contacts, "
        "'magnitudes' the sum of their magnitudes",
        {{normal, wall + "_contacts", "normal force per contact", "N"},
         {shear, wall + "_contacts", "shear force per contact", "N"},
         {wall + "_shear_force_sum_N", wall + "_contacts", "shear force per contact, magnitudes", "N"},
         {normal, "", "normal force, total", "N"},
         {shear, "", "shear force, total", "N"}});
    add_figure(all, s, "stress_" + wall, "Stresses on " + wall,
               "contact area: sum of the contact circles; footprint: cells of the wall that powder touches",
               {{normal, wall + "_contact_area_m2", "normal, per contact area", "Pa"},
                {shear, wall + "_contact_area_m2", "shear, per contact area", "Pa"},
                {normal, wall + "_footprint_area_m2", "normal, per footprint", "Pa"},
                {shear, wall + "_footprint_area_m2", "shear, per footprint", "Pa"}});
  }
  return all;
}

}  // namespace interstice::studies
