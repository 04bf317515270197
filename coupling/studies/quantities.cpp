#include "coupling/studies/quantities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "coupling/studies/moment_files.h"

namespace interstice::studies {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

void add_missing(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  std::size_t count = 0;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    sum += v;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : none;
}

double extreme(const std::vector<double>& values, bool largest) {
  double found = none;
  for (const double v : values) {
    if (std::isfinite(v) && (std::isnan(found) || (largest ? v > found : v < found))) found = v;
  }
  return found;
}

/// Sample standard deviation (N - 1).
double deviation(const std::vector<double>& values) {
  const double m = mean(values);
  double sum = 0;
  std::size_t count = 0;
  for (const double v : values) {
    if (!std::isfinite(v)) continue;
    sum += (v - m) * (v - m);
    ++count;
  }
  return count > 1 ? std::sqrt(sum / static_cast<double>(count - 1)) : none;
}

/// The samples of `values` that lie in the phase: after its start, up to its end (a sample at the moment
/// where one phase ends and the next begins belongs to the one that ends). A run's first sample belongs to
/// its first phase.
std::vector<double> within(const RunFolder& run, const PhaseSpan& phase, const std::vector<double>& values) {
  const auto& time = run.series.numbers("time_s");
  const double slack = 1e-9 * std::max(std::abs(phase.start), std::abs(phase.end));
  const bool first = !run.phases.empty() && &phase == &run.phases.front();
  std::vector<double> inside;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool after_start = first ? time[i] >= phase.start - slack : time[i] > phase.start + slack;
    if (after_start && time[i] <= phase.end + slack) inside.push_back(values[i]);
  }
  return inside;
}

/// What one run says about one phase; NaN where it lacks the phase or the column.
using OfRun = std::function<std::vector<double>(const RunFolder&)>;
double over_phase(const RunFolder& run, const std::string& phase, const OfRun& column, bool largest = false) {
  const PhaseSpan* span = run.phase(phase);
  if (span == nullptr) return none;
  const auto values = column(run);
  if (values.empty()) return none;
  return largest ? extreme(within(run, *span, values), true) : mean(within(run, *span, values));
}

OfRun column(const std::string& name) {
  return [name](const RunFolder& run) {
    return run.series.has(name) ? run.series.numbers(name) : std::vector<double>();
  };
}

OfRun column_per(const std::string& total, const std::string& per) {
  return [total, per](const RunFolder& run) {
    if (!run.series.has(total) || !run.series.has(per)) return std::vector<double>();
    return per_unit(run.series.numbers(total), run.series.numbers(per));
  };
}

/// Keeps a row unless neither run has the number.
void add(std::vector<Quantity>& rows, Quantity row) {
  if (!std::isnan(row.a) || !std::isnan(row.b)) rows.push_back(std::move(row));
}

struct Runs {
  const RunFolder &a, &b;
};

void add_over_phase(std::vector<Quantity>& rows, const Runs& runs, const std::string& phase,
                    const std::string& name, const OfRun& values, const std::string& meaning,
                    bool largest = false) {
  add(rows, {phase + "/" + name, over_phase(runs.a, phase, values, largest),
             over_phase(runs.b, phase, values, largest), meaning});
}

void add_wall(std::vector<Quantity>& rows, const Runs& runs, const std::string& phase,
              const std::string& wall) {
  struct Kind {
    const char *name, *column, *phrase;
  };
  // Shear forces of many grains partly cancel: the force on the wall is the magnitude of their vector sum,
  // what the grains rub with is the sum of their magnitudes.
  for (const Kind& kind : {Kind{"normal", "normal_force_N", "normal force"},
                           Kind{"shear", "shear_force_N", "shear force (vector sum)"},
                           Kind{"shear_sum", "shear_force_sum_N", "shear forces (sum of magnitudes)"}}) {
    const std::string total = wall + "_" + kind.column;
    const auto row = [&](const char* suffix, const OfRun& values, const char* what) {
      add_over_phase(rows, runs, phase, fmt::format("{}/{}_{}", wall, kind.name, suffix), values,
                     fmt::format("{} on {}, {}; mean over the phase", kind.phrase, wall, what));
    };
    row("force_N", column(total), "total");
    row("force_per_contact_N", column_per(total, wall + "_contacts"), "total per contact");
    row("force_per_particle_N", column_per(total, wall + "_particles"), "total per touching particle");
    row("stress_contact_area_Pa", column_per(total, wall + "_contact_area_m2"),
        "total per area of contact circles");
    row("stress_footprint_Pa", column_per(total, wall + "_footprint_area_m2"),
        "total per area that powder covers");
  }
  for (const char* suffix : {"contacts", "particles", "contact_area_m2", "footprint_area_m2"}) {
    add_over_phase(rows, runs, phase, wall + "/" + suffix, column(wall + "_" + suffix),
                   "mean over the phase");
  }
}

double value_at(const RunFolder& run, const std::string& field, const FieldMoment* moment,
                const std::string& name) {
  const FieldRecord* record = run.field(field);
  if (record == nullptr || moment == nullptr || !record->numbers.has(name)) return none;
  return record->numbers.numbers(name)[moment->row];
}

void add_layer(std::vector<Quantity>& rows, const Runs& runs, const std::string& field,
               const MomentPair& moment) {
  const std::pair<const char*, const char*> numbers[] = {
      {"time_s", "time of this frame"},
      {"solid_fraction_gap", "solid volume in the layer gap per volume of the gap"},
      {"solid_fraction_sd", "sample standard deviation (N - 1) of the gap's solid fraction over columns"},
      {"solid_height_m", "solid volume per area"},
      {"surface_height_m", "height of the powder's surface, mean over columns"},
      {"solid_fraction_below_surface", "solid volume per volume below the surface"},
      {"solid_fraction_mean", "over the field's box"},
      {"void_fraction_mean", "over the field's box"},
      {"void_fraction_min", "smallest voxel of the field"},
  };
  for (const auto& [name, meaning] : numbers) {
    add(rows, {fmt::format("{}/{}/{}", moment.name, field, name), value_at(runs.a, field, moment.a, name),
               value_at(runs.b, field, moment.b, name), meaning});
  }
}

std::optional<Table> line_table(const FieldMoment* moment, const std::string& line) {
  if (moment == nullptr) return std::nullopt;
  const auto file = moment->folder / "lines" / (line + ".csv");
  std::error_code ignored;
  if (!std::filesystem::exists(file, ignored)) return std::nullopt;
  return read_table(file);
}

void add_lines(std::vector<Quantity>& rows, const std::string& field, const MomentPair& moment) {
  std::vector<std::string> lines;
  for (const FieldMoment* side : {moment.a, moment.b}) {
    if (side == nullptr) continue;
    for (const auto& name : tables_in(side->folder / "lines")) add_missing(lines, name);
  }
  for (const auto& line : lines) {
    const auto a = line_table(moment.a, line), b = line_table(moment.b, line);
    for (const char* kind : {"void_fraction", "void_fraction_averaged"}) {
      const auto row = [&](const char* suffix, const char* meaning, const auto& reduce) {
        const auto of = [&](const std::optional<Table>& table) {
          const bool wanted =
              kind == std::string_view("void_fraction");  // the averaged column may be missing
          return table && (wanted || table->has(kind)) ? reduce(line_values(*table, kind)) : none;
        };
        add(rows, {fmt::format("{}/{}/lines/{}/{}_{}", moment.name, field, line, kind, suffix), of(a), of(b),
                   meaning});
      };
      row("min", "smallest voxel on the line, clear of walls", [](const auto& v) { return extreme(v, false); });
      row("mean", "mean over the line's voxels, clear of walls", [](const auto& v) { return mean(v); });
      row("sd", "sample standard deviation (N - 1) over the line's voxels, clear of walls",
          [](const auto& v) { return deviation(v); });
    }
  }
}

/// The last moment of `phase` ("" for any).
const FieldMoment* last_moment(const RunFolder& run, const std::string& field, const std::string& phase) {
  const FieldRecord* record = run.field(field);
  const FieldMoment* last = nullptr;
  if (record == nullptr) return last;
  for (const auto& moment : record->moments) {
    if (phase.empty() || moment.phase == phase) last = &moment;
  }
  return last;
}

double lost(const RunFolder& run) {
  if (run.grains_lost) return *run.grains_lost;
  if (!run.series.has("particles_lost") || run.series.rows() == 0) return none;
  return run.series.numbers("particles_lost").back();
}

}  // namespace

double Quantity::ratio() const { return a == 0 ? none : b / a; }

std::vector<std::string> phases_of_both(const RunFolder& a, const RunFolder& b) {
  std::vector<std::string> names;
  for (const RunFolder* run : {&a, &b}) {
    for (const auto& phase : run->phases) add_missing(names, phase.name);
  }
  return names;
}

std::vector<std::string> fields_of_both(const RunFolder& a, const RunFolder& b) {
  std::vector<std::string> names;
  for (const RunFolder* run : {&a, &b}) {
    for (const auto& field : run->fields) add_missing(names, field.name);
  }
  return names;
}

std::vector<std::string> walls_of_both(const RunFolder& a, const RunFolder& b) {
  std::vector<std::string> names;
  for (const RunFolder* run : {&a, &b}) {
    for (const auto& wall : run->watched_walls()) add_missing(names, wall);
  }
  return names;
}

std::vector<MomentPair> moment_pairs(const RunFolder& a, const RunFolder& b, const std::string& field) {
  std::vector<MomentPair> pairs;
  const auto keep = [&](const std::string& name, const std::string& phase) {
    const MomentPair pair{name, last_moment(a, field, phase), last_moment(b, field, phase)};
    if (pair.a != nullptr || pair.b != nullptr) pairs.push_back(pair);
  };
  for (const auto& phase : phases_of_both(a, b)) keep(phase, phase);
  keep("end", "");
  return pairs;
}

std::vector<double> per_unit(const std::vector<double>& total, const std::vector<double>& per) {
  std::vector<double> result(total.size());
  for (std::size_t i = 0; i < total.size(); ++i) result[i] = per[i] == 0 ? 0 : total[i] / per[i];
  return result;
}

std::vector<Quantity> compare_quantities(const RunFolder& a, const RunFolder& b) {
  const Runs runs{a, b};
  std::vector<Quantity> rows;
  add(rows, {"grains_inserted", a.grains_inserted.value_or(none), b.grains_inserted.value_or(none),
             "over the run"});
  add(rows, {"grains_lost", lost(a), lost(b), "grains that left the domain, over the run"});
  for (const auto& phase : phases_of_both(a, b)) {
    const auto duration = [&](const RunFolder& run) {
      const PhaseSpan* span = run.phase(phase);
      return span == nullptr ? none : span->end - span->start;
    };
    add(rows, {phase + "/duration_s", duration(a), duration(b), "of the phase"});
    const std::pair<const char*, const char*> means[] = {
        {"contact_force_mean_N", "inter-particle force per contact; mean over the phase"},
        {"contact_normal_force_mean_N", "inter-particle normal force per contact; mean over the phase"},
        {"coordination_mean", "contacts per grain; mean over the phase"},
        {"contacts", "inter-particle contacts; mean over the phase"}};
    for (const auto& [name, meaning] : means) add_over_phase(rows, runs, phase, name, column(name), meaning);
    add_over_phase(rows, runs, phase, "contact_force_max_N", column("contact_force_max_N"),
                   "largest inter-particle force of the phase", true);
    for (const auto& wall : walls_of_both(a, b)) add_wall(rows, runs, phase, wall);
  }
  for (const auto& field : fields_of_both(a, b)) {
    for (const auto& moment : moment_pairs(a, b, field)) {
      add_layer(rows, runs, field, moment);
      add_lines(rows, field, moment);
    }
  }
  return rows;
}

std::string comparison_csv(const std::vector<Quantity>& quantities) {
  std::string csv = "quantity,A,B,B - A,ratio,meaning\n";
  for (const auto& q : quantities) {
    csv += fmt::format("{},{},{},{},{},{}\n", csv_cell(q.name), csv_cell(q.a), csv_cell(q.b),
                       csv_cell(q.difference()), csv_cell(q.ratio()), csv_cell(q.meaning));
  }
  return csv;
}

}  // namespace interstice::studies
