// EDEM's HDF5 results (2017 and later), as far as their layout is known from the documentation of the EDEMpy
// library:
//   /TimestepData/<n>                       attribute time [s]
//   /TimestepData/<n>/ParticleTypes/<t>     position (N x 3) [m], ids (N), scale (N), velocity (N x 3) [m/s]
//   /CreatorData/0/ParticleTypes/<t> (or Particles/<t>)   rawRadius, physicalRadius or radius [m], as an
//   attribute or a
//                                           dataset, there or in groups below
// A grain's radius is its scale times the raw radius of its type. Grains of several spheres are refused, and
// so is, in one line, every file that is laid out otherwise: EDEM's CSV export has all that is needed.
#pragma once

#include <memory>

#include "coupling/io/particle_reader.h"

namespace interstice::io {

/// Is the file HDF5 with a group TimestepData?
bool looks_like_edem_hdf5(const std::filesystem::path& path);

std::unique_ptr<ParticleReader> open_edem_hdf5(const std::filesystem::path& path,
                                               const ReaderOptions& options);

}  // namespace interstice::io
