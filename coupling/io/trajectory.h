// trajectory.h5part: particles over time in the H5Part layout, readable by ParaView and h5py, safe against a
// kill at any moment. See docs/FILES.md for the layout.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "coupling/io/particle_frame.h"

namespace interstice::io {

/// Appends frames to a trajectory. The file is whole and closed after each append(): a kill in between loses
/// nothing, a kill during append() loses at most that frame, and the next open (writer or reader) restores
/// the frames before.
class TrajectoryWriter {
 public:
  /// Creates `path`, replacing any. Throws RunError when the file cannot be written.
  static TrajectoryWriter create(const std::filesystem::path& path);
  /// Continues `path` (a missing one is created) after dropping the first frame later than `keep_until` [s]
  /// and all behind it. Throws RunError, and InputError when the file there is no trajectory of this program.
  static TrajectoryWriter resume(const std::filesystem::path& path, double keep_until);

  /// All frames of one trajectory should have the same columns: ParaView takes the list from the first frame
  /// and shows no frame that lacks one of them. A frame without particles counts as having the columns of a
  /// run. Throws RunError; the frames before are then untouched, and append() may be called again.
  void append(const ParticleFrame& frame);
  std::int64_t frames() const { return frames_; }

 private:
  explicit TrajectoryWriter(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
  std::int64_t frames_ = 0;
};

/// Reads a trajectory, also one that a running simulation appends to: it has the frames there were when it
/// was opened. (The HDF5 library works for one thread at a time; calls from several wait for one another.)
class TrajectoryReader {
 public:
  /// Throws InputError when the file is missing or is no trajectory. Also takes H5Part files of other
  /// programs that have x, y, z and radius.
  explicit TrajectoryReader(const std::filesystem::path& path);
  ~TrajectoryReader();
  TrajectoryReader(TrajectoryReader&&) noexcept;
  TrajectoryReader& operator=(TrajectoryReader&&) noexcept;

  std::int64_t frames() const;
  double time(std::int64_t frame) const;  // [s]
  ParticleFrame read(std::int64_t frame) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace interstice::io
