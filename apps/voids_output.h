// One frame from particles to files: field, tables, summary, figures. What `voids` does frame after frame and
// `batch` on all cores.
#pragma once

#include <filesystem>
#include <string>

#include "apps/voids_frame.h"
#include "coupling/studies/time_space.h"

namespace interstice::apps {

/// Where a frame comes from and goes to.
struct FrameTask {
  std::filesystem::path input;
  std::string kind;         // of the input, as its reader calls it
  std::int64_t number = 0;  // of the frame in its input
  std::filesystem::path folder;
};

struct FrameOutput {
  io::FieldFilesRequest request;
  io::FieldFilesResult files;
  std::string missing_figures;  // why figures are missing; empty where all are there
};

/// "bed.dump: frame 3", for messages.
std::string place_of(const std::filesystem::path& path, std::int64_t frame);

/// What to warn of where a file repeats its box along axes for which --periodic was not given; else empty. A
/// dump knows its periodic axes, but only the user knows whether the box of the field is the box that
/// repeats.
std::string warning_of_periods(const io::ParticleFrame& frame, const VoidsOptions& options,
                               const std::string& where);

/// Computes and writes all of `task`. `frame` is changed where its grains are wrapped into a periodic box.
FrameOutput write_frame(const FrameTask& task, io::ParticleFrame& frame, FramePlan plan,
                        const VoidsOptions& options);

/// Title and note of the map of an input's frames over time.
studies::TimeSpaceText time_space_text(const std::filesystem::path& input, const VoidsOptions& options);

/// Lists the frame in series/fields.pvd, through which ParaView opens the frames as one animation; without a
/// time, steps or numbers order them.
void add_to_series(const std::filesystem::path& series, const std::filesystem::path& inner,
                   const FrameOutput& output);

/// Removes what an earlier call left in an input's folder, so that it does not lie between new files.
void clear_results(const std::filesystem::path& folder);

}  // namespace interstice::apps
