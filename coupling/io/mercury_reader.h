// MercuryDPM's `.data` files, after the column formats of its documentation and of its loadData tools (format
// 14 and format 8). A frame is one line and a row a particle:
//   3-D:  N time xmin ymin zmin xmax ymax zmax     x y z vx vy vz r qx qy qz wx wy wz info
//   2-D:  N time xmin ymin xmax ymax               x y vx vy r q w info
// SI by convention (--length-unit where a simulation has another unit of length). A 2-D file holds discs;
// they are read as spheres in the plane z = 0, with a warning.
#pragma once

#include <memory>
#include <string>

#include "coupling/io/particle_reader.h"

namespace interstice::io {

/// Does a text that begins so (its first bytes) have such a line first?
bool looks_like_mercury(const std::string& head);

std::unique_ptr<ParticleReader> open_mercury(const std::filesystem::path& path, const ReaderOptions& options);

}  // namespace interstice::io
