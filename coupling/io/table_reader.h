// Tables of one frame: CSV with a header (commas, semicolons, tabs or blanks between the columns, a unit in
// brackets where wanted: `x [um]`), and the text exports of YADE (`x y z r`, with or without a `#format`
// line).
#pragma once

#include <memory>

#include "coupling/io/particle_reader.h"

namespace interstice::io {

std::unique_ptr<ParticleReader> open_table(const std::filesystem::path& path, const ReaderOptions& options);

}  // namespace interstice::io
