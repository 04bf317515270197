// Reading a column as this program writes it: 1-D, little-endian, in chunks, shuffled, deflated.
#pragma once

#include <cstddef>

#include "coupling/io/hdf5_handles.h"

namespace interstice::io {

inline constexpr hsize_t kColumnChunk = 65536;  // elements: half a megabyte of doubles

/// Reads `elements` values of `element_bytes` (1 to 8) each. Undoes the filters here and not in the library,
/// which (1.10) trusts that a chunk inflates to its nominal size and crashes on a damaged file where it does
/// not. Throws Hdf5Error where the dataset does not lie as this program writes it.
void read_own_column(hid_t dataset, std::size_t element_bytes, std::size_t elements, void* values);

}  // namespace interstice::io
