// Void fraction along the bed against time, from the bed profiles of an input's frames.
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "coupling/figures/formats.h"

namespace interstice::studies {

struct TimeSpaceFrame {
  std::int64_t number = 0;
  double time = NAN;             // [s]; NaN where the source does not say
  std::int64_t step = -1;        // -1 where the source does not say
  std::filesystem::path folder;  // that holds its bed profile
};

struct TimeSpaceText {
  std::string title, note;
};

/// Writes folder/time_space.csv (frame, step, time_s, x_m, void_fraction, solid_fraction; every slab of every
/// frame) and, if `figure`, folder/time_space.png. Frames are in the order of the source. Time is the axis
/// where all frames have one and it rises, else their steps, else their numbers. Frames of other boxes are
/// shown side by side on one axis. Does nothing for fewer than two frames.
void write_time_space(const std::filesystem::path& folder, const std::vector<TimeSpaceFrame>& frames,
                      const TimeSpaceText& text, bool figure, const figures::Formats& formats);

}  // namespace interstice::studies
