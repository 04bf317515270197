#include "coupling/io/chunked_column.h"

#include <zlib.h>

#include <algorithm>
#include <vector>

namespace interstice::io {

namespace {

[[noreturn]] void damaged(const char* what) {
  throw Hdf5Error(std::string("reading a column failed: ") + what);
}

void check_layout(hid_t dataset, std::size_t elements) {
  const Hdf5Handle properties(H5Dget_create_plist(dataset), H5Pclose, "reading a column's layout");
  hsize_t chunk = 0;
  if (H5Pget_layout(properties) != H5D_CHUNKED || H5Pget_chunk(properties, 1, &chunk) != 1 ||
      chunk != std::min<hsize_t>(elements, kColumnChunk))
    damaged("it does not lie in the chunks it was written in");
  if (H5Pget_nfilters(properties) != 2 ||
      H5Pget_filter2(properties, 0, nullptr, nullptr, nullptr, 0, nullptr, nullptr) != H5Z_FILTER_SHUFFLE ||
      H5Pget_filter2(properties, 1, nullptr, nullptr, nullptr, 0, nullptr, nullptr) != H5Z_FILTER_DEFLATE)
    damaged("it is not compressed as it was written");
}

void read_chunk(hid_t dataset, hsize_t first, std::vector<unsigned char>& packed) {
  hsize_t bytes = 0;
  checked(H5Dget_chunk_storage_size(dataset, &first, &bytes), "reading a column");
  if (bytes > ::compressBound(kColumnChunk * sizeof(double))) damaged("a chunk is larger than it can be");
  packed.resize(bytes);
  std::uint32_t skipped_filters = 0;
  checked(H5Dread_chunk(dataset, H5P_DEFAULT, &first, &skipped_filters, packed.data()), "reading a column");
  if (skipped_filters != 0) damaged("a chunk is not compressed as it was written");
}

/// HDF5's shuffle puts the first bytes of all values first, then the second bytes, and so on.
void unshuffle(const std::vector<unsigned char>& planes, std::size_t element_bytes, unsigned char* values) {
  const std::size_t n = planes.size() / element_bytes;
  for (std::size_t b = 0; b < element_bytes; ++b) {
    const unsigned char* plane = planes.data() + b * n;
    for (std::size_t i = 0; i < n; ++i) values[i * element_bytes + b] = plane[i];
  }
}

}  // namespace

void read_own_column(hid_t dataset, std::size_t element_bytes, std::size_t elements, void* values) {
  if (elements == 0) return;
  check_layout(dataset, elements);
  const std::size_t chunk = std::min<std::size_t>(elements, kColumnChunk);
  std::vector<unsigned char> packed, planes(chunk * element_bytes), unpacked(chunk * element_bytes);
  for (std::size_t first = 0; first < elements; first += chunk) {
    read_chunk(dataset, first, packed);
    uLongf bytes = planes.size();
    if (::uncompress(planes.data(), &bytes, packed.data(), packed.size()) != Z_OK || bytes != planes.size())
      damaged("a chunk does not inflate to what was written");
    unshuffle(planes, element_bytes, unpacked.data());
    const std::size_t wanted = std::min(chunk, elements - first);  // the last chunk is padded
    std::copy_n(unpacked.data(), wanted * element_bytes,
                static_cast<unsigned char*>(values) + first * element_bytes);
  }
}

}  // namespace interstice::io
