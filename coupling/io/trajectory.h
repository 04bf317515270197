// trajectory.h5part: particles over time in the H5Part layout, readable by ParaView and h5py, safe against a kill
// at any moment. See docs/FILES.md for the layout.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "coupling/io/particle_frame.h"

namespace interstice::io {

/// Appends frames to a trajectory. The file is whole and closed after each append(): a kill in between loses nothing,
/// a kill during append() loses at most that frame, and the next open (writer or reader) restores the frames before.
class TrajectoryWriter {
 public:
  /// Creates `path` (replacing any), or with `keep` continues it after dropping every frame later than `keep_until`
  /// [s]. Throws RunError when the file cannot be written.
  static TrajectoryWriter create(const std::filesystem::path& path);
  static TrajectoryWriter resume(const std::filesystem::path& path, double keep_until);

  void append(const ParticleFrame& frame);
  std::int64_t frames() const { return frames_; }

 private:
  explicit TrajectoryWriter(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path path_;
  std::int64_t frames_ = 0;
};

class TrajectoryReader {
 public:
  /// Throws InputError when the file is missing or is no trajectory.
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
