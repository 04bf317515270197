// The difference of two fields, voxel by voxel: B - A on the cells that both cover.
#pragma once

#include <filesystem>
#include <string>

#include "voxel/field.h"

namespace interstice::studies {

/// `field` holds the differences B - A (0 where neither has powder) of void_fraction and solid_fraction, and
/// of their averages where both files have them; `obstacle` says why there is none.
struct FieldDifference {
  std::string obstacle;  // empty: there is a difference
  voxel::Field field;
  bool whole = false;  // both lattices are the same; otherwise only the common box is covered
  double mean = 0, rms = 0, largest = 0;  // of the void fraction's difference over the common cells
};

/// Reads two .vdb files of this tool. Fields with cells of different size, or lattices that are not shifted
/// by whole cells, have no difference voxel by voxel: `obstacle` tells. Throws InputError for a file that
/// cannot be read.
FieldDifference field_difference(const std::filesystem::path& a, const std::filesystem::path& b);

/// PATH.vdb with grids void_fraction_difference and so on, and PATH.vti for ParaView with the same numbers.
void write_difference(const std::filesystem::path& path_without_extension, const FieldDifference& difference,
                      const std::string& source);

}  // namespace interstice::studies
