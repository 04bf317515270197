// Text dumps of LIGGGHTS and LAMMPS (dump custom, atom): any columns in any order, many frames, plain or
// gzipped.
#pragma once

#include <memory>

#include "coupling/io/particle_reader.h"

namespace interstice::io {

std::unique_ptr<ParticleReader> open_dump(const std::filesystem::path& path, const ReaderOptions& options);

}  // namespace interstice::io
