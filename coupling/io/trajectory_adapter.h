// Our own trajectory.h5part (coupling/io/trajectory.h) through the common reader: SI, with walls.
#pragma once

#include <memory>

#include "coupling/io/particle_reader.h"

namespace interstice::io {

std::unique_ptr<ParticleReader> open_trajectory(const std::filesystem::path& path,
                                                const ReaderOptions& options);

}  // namespace interstice::io
