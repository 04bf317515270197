// Particle files of any kind, frame by frame.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>

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
  /// What kind of file this is, for messages and summaries ("LAMMPS dump", "CSV", "H5Part").
  virtual std::string kind() const = 0;
};

/// Recognises the kind by content first, then by name.
std::unique_ptr<ParticleReader> open_particles(const std::filesystem::path& path, const ReaderOptions& options);

}  // namespace interstice::io
