// CSV of EDEM's "Export Results Data" (EDEM Analyst): lines of a heading, and for each time step a line with
// the time, a line naming the columns (`Particle Position X (m)`, `Particle Diameter (m)`, ... also with `Q01
// : ` before the name, and with the words in other orders), and a row a particle. Also read: the time as a
// column of each row, and blocks without names of their own. The size is a radius, a diameter or a volume
// (then: of a sphere). Units come from the names' brackets; without one, SI. EDEM publishes no grammar of the
// file; this follows its user guide's description of the export, and what does not match is an error.
#pragma once

#include <memory>
#include <string>

#include "coupling/io/particle_reader.h"

namespace interstice::io {

/// Does a text that begins so (its first bytes) name EDEM's columns of positions in one of its lines?
bool looks_like_edem_csv(const std::string& head);

std::unique_ptr<ParticleReader> open_edem_csv(const std::filesystem::path& path,
                                              const ReaderOptions& options);

}  // namespace interstice::io
