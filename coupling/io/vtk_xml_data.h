// The content of a DataArray of VTK's XML files: numbers as text, or bytes (raw or base64), compressed by
// zlib or not.
//
// Layout after VTK's documentation of the XML formats (VTK User's Guide, file formats; vtkXMLDataParser):
// bytes begin with a header of 32- or 64-bit integers. Uncompressed: the number of bytes. Compressed: blocks,
// bytes of a block, bytes of the last block where it is shorter (else 0), and the compressed size of each
// block; then the blocks. In base64 the header of compressed data is encoded apart from the blocks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "coupling/io/point_arrays.h"
#include "coupling/io/xml_scanner.h"

namespace interstice::io {

/// What VTKFile's attributes say of all its arrays.
struct VtkEncoding {
  bool swap = false;  // the file's byte order is not this machine's
  std::size_t header_bytes = 4;
  bool zlib = false;
};

/// Bytes of the content of an element, as they are or out of base64.
class VtkBytes {
 public:
  VtkBytes(XmlScanner& xml, bool base64) : xml_(xml), base64_(base64) {}

  /// The next `count` bytes of the content. Throws InputError where there are fewer, or what is there is no
  /// base64.
  void read(char* to, std::size_t count);
  /// Letters (of base64) or bytes of the file taken so far: what offsets count.
  std::int64_t taken() const { return taken_; }
  /// Passes over letters or bytes until so many are taken.
  void pass_to(std::int64_t offset);
  /// Drops what is left of the last four letters: each array begins with new ones.
  void realign() { held_ = used_ = 0; }
  XmlScanner& xml() const { return xml_; }

 private:
  void decode();
  int letter();

  XmlScanner& xml_;
  bool base64_;
  std::int64_t taken_ = 0;
  unsigned char group_[3] = {0, 0, 0};
  std::size_t held_ = 0, used_ = 0;  // bytes of the group, and of these the ones already read
};

/// Appends `count` numbers. `name` is for messages.
void read_vtk_binary(VtkBytes& bytes, const VtkEncoding& encoding, NumberType type, std::int64_t count,
                     const std::string& name, std::vector<double>& to);

/// Appends `count` numbers in text; gathers the digits of positions where `digits` is given.
void read_vtk_text(XmlScanner& xml, std::int64_t count, const std::string& name, std::vector<double>& to,
                   class WrittenDigits* digits);

}  // namespace interstice::io
