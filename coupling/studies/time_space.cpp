#include "coupling/studies/time_space.h"

#include <fmt/format.h>

#include <algorithm>

#include "coupling/figures/figures.h"
#include "coupling/io/atomic_file.h"
#include "coupling/studies/bed_profile.h"
#include "coupling/studies/table.h"

namespace interstice::studies {
namespace {

std::string csv_of(const std::vector<TimeSpaceFrame>& frames, const std::vector<BedProfile>& profiles) {
  std::string text =
      fmt::format("frame,step,time_s,{}_m,void_fraction,solid_fraction\n", "xy"[profiles.front().axis]);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const auto& profile = profiles[f];
    const std::string step = frames[f].step >= 0 ? fmt::format("{}", frames[f].step) : std::string();
    for (std::size_t i = 0; i < profile.at.size(); ++i) {
      text +=
          fmt::format("{},{},{},{},{},{}\n", frames[f].number, step, csv_cell(frames[f].time), profile.at[i],
                      csv_cell(profile.void_fraction[i]), csv_cell(profile.solid_fraction[i]));
    }
  }
  return text;
}

struct Clock {
  std::string label;
  std::vector<double> values;
};

bool rises(const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i]) || (i > 0 && !(values[i] > values[i - 1]))) return false;
  }
  return true;
}

Clock clock_of(const std::vector<TimeSpaceFrame>& frames) {
  Clock time{"time [ms]", {}}, step{"time step", {}}, number{"frame", {}};
  for (const auto& frame : frames) {
    time.values.push_back(1e3 * frame.time);
    step.values.push_back(frame.step >= 0 ? static_cast<double>(frame.step) : NAN);
    number.values.push_back(static_cast<double>(frame.number));
  }
  if (rises(time.values)) {
    if (time.values.back() - time.values.front() > 1e4) {
      time.label = "time [s]";
      for (double& t : time.values) t *= 1e-3;
    }
    return time;
  }
  return rises(step.values) ? step : number;
}

double spacing_of(const BedProfile& profile) {
  return profile.at.size() > 1
             ? (profile.at.back() - profile.at.front()) / static_cast<double>(profile.at.size() - 1)
             : 0;
}

/// All profiles on the slabs of the widest span: each slab there gets the value of the slab it lies in.
figures::MapFigure map_of(const std::vector<BedProfile>& profiles, double per_metre) {
  double lo = INFINITY, hi = -INFINITY, h = INFINITY;
  for (const auto& profile : profiles) {
    lo = std::min(lo, profile.at.front());
    hi = std::max(hi, profile.at.back());
    if (profile.at.size() > 1) h = std::min(h, spacing_of(profile));
  }
  if (!std::isfinite(h)) h = 1;
  figures::MapFigure map;
  const auto slabs = static_cast<std::size_t>(std::clamp(std::round((hi - lo) / h) + 1, 1.0, 20000.0));
  for (std::size_t i = 0; i < slabs; ++i) map.x.push_back((lo + h * static_cast<double>(i)) * per_metre);
  for (const auto& profile : profiles) {
    std::vector<double> row(slabs, NAN);
    const double step = spacing_of(profile) > 0 ? spacing_of(profile) : h;
    for (std::size_t i = 0; i < slabs; ++i) {
      const double place = (lo + h * static_cast<double>(i) - profile.at.front()) / step + 0.5;
      if (place >= 0 && place < static_cast<double>(profile.at.size())) {
        row[i] = profile.void_fraction[static_cast<std::size_t>(place)];
      }
    }
    map.values.push_back(std::move(row));
  }
  return map;
}

}  // namespace

void write_time_space(const std::filesystem::path& folder, const std::vector<TimeSpaceFrame>& frames,
                      const TimeSpaceText& text, bool figure, const figures::Formats& formats) {
  std::vector<BedProfile> profiles;
  std::vector<TimeSpaceFrame> used;
  for (const auto& frame : frames) {
    BedProfile profile = read_bed_profile(frame.folder / kBedProfileFile);
    if (!profiles.empty() && profile.axis != profiles.front().axis) continue;
    profiles.push_back(std::move(profile));
    used.push_back(frame);
  }
  if (used.size() < 2) return;
  io::write_text_atomically(folder / "time_space.csv", csv_of(used, profiles));
  if (!figure) return;
  const Clock clock = clock_of(used);
  auto map = map_of(profiles, 1e3);
  map.title = text.title;
  map.note = text.note;
  map.x_label = fmt::format("{} [mm]", "xy"[profiles.front().axis]);
  map.y_label = clock.label;
  map.y = clock.values;
  map.colour_label = "void fraction";
  figures::write_map(folder / "time_space.png", map, formats);
}

}  // namespace interstice::studies
