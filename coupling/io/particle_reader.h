// Particle files of any kind, frame by frame. Frames are numbered from 0 in the order of the file; grains
// come sorted by id where the file has ids (so that sums do not depend on the order of writing), else in file
// order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "coupling/io/particle_frame.h"

namespace interstice::io {

struct ReaderOptions {
  std::map<std::string, std::string> columns;  // our name -> the file's, from --columns
  double length_unit = 1;                      // [m] per unit of the file, for kinds that carry none
  bool length_unit_given = false;
};

class ParticleReader {
 public:
  virtual ~ParticleReader() = default;
  /// Reads the next frame; false at the end. Throws InputError("file:line: what; allowed; remedy").
  virtual bool next(ParticleFrame& frame) = 0;
  /// Passes over the next frame without reading its numbers; false at the end. Throws as next() does.
  virtual bool skip();
  /// How many frames there are, where the kind knows without reading on; else -1.
  virtual std::int64_t frames() const { return -1; }
  /// What kind of file this is, for messages and summaries ("LAMMPS dump", "CSV", "H5Part").
  virtual std::string kind() const = 0;
  /// How finely the positions of the frame last read were told apart [m]: the largest distance between
  /// neighbouring numbers of the digits (or bits) that the file has; 0 where it keeps doubles.
  double position_resolution() const { return position_resolution_; }
  /// What looked odd so far but was read: one line each, no line twice.
  const std::vector<std::string>& warnings() const { return warnings_; }

 protected:
  void warn(const std::string& line);
  /// Warns, once a file, when the grains' sizes are no powder's: most likely the unit of length is another.
  void check_sizes(const ParticleFrame& frame, const std::filesystem::path& path);
  /// What every frame ends with: sorted by id (warned of where ids repeat), sizes checked.
  void finish(ParticleFrame& frame, const std::string& where, const std::filesystem::path& path);

  double position_resolution_ = 0;

 private:
  std::vector<std::string> warnings_;
  bool sizes_warned_ = false;
};

/// Recognises the kind by content first, then by name.
std::unique_ptr<ParticleReader> open_particles(const std::filesystem::path& path,
                                               const ReaderOptions& options);

}  // namespace interstice::io
