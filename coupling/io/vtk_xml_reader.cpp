#include "coupling/io/vtk_xml_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "coupling/io/columns.h"
#include "coupling/io/vtk_xml_data.h"

namespace interstice::io {
namespace {

constexpr std::int64_t most_points = std::int64_t{1} << 40;  // counts above are damage, not powder
constexpr std::int64_t most_components = 1024;

const std::map<std::string, NumberType>& number_types() {
  static const std::map<std::string, NumberType> types{
      {"Int8", NumberType::int8},      {"UInt8", NumberType::uint8},   {"Int16", NumberType::int16},
      {"UInt16", NumberType::uint16},  {"Int32", NumberType::int32},   {"UInt32", NumberType::uint32},
      {"Int64", NumberType::int64},    {"UInt64", NumberType::uint64}, {"Float32", NumberType::float32},
      {"Float64", NumberType::float64}};
  return types;
}

enum class Section { none, points, point_data, field_data };

/// An array whose numbers come later, in AppendedData.
struct Appended {
  std::int64_t offset = 0, count = 0;
  NumberType type = NumberType::float32;
  Section section = Section::none;
  PointArray array;
};

class XmlReader : public ParticleReader {
 public:
  XmlReader(const std::filesystem::path& path, ReaderOptions options)
      : xml_(path), options_(std::move(options)) {}

  std::string kind() const override { return "VTK XML"; }
  std::int64_t frames() const override { return 1; }
  bool next(ParticleFrame& frame) override;

 private:
  void read_file_tag();
  bool read_tag();
  void read_piece();
  void read_array();
  void read_inline(Appended& what, const std::string& format);
  void read_appended();
  void keep(Section section, NumberType type, PointArray array);
  std::string text(const std::string& attribute, const std::string& otherwise) const;
  std::int64_t number(const std::string& attribute, std::int64_t otherwise, std::int64_t most) const;

  XmlScanner xml_;
  ReaderOptions options_;
  VtkEncoding encoding_;
  PointSet set_;
  WrittenDigits digits_;
  Section section_ = Section::none;
  std::int64_t piece_points_ = 0, points_ = 0;
  bool has_places_ = false, done_ = false;
  std::vector<Appended> appended_;
};

std::string XmlReader::text(const std::string& attribute, const std::string& otherwise) const {
  const std::string* value = xml_.attribute(attribute);
  return value == nullptr ? otherwise : *value;
}

std::int64_t XmlReader::number(const std::string& attribute, std::int64_t otherwise,
                               std::int64_t most) const {
  const std::string* value = xml_.attribute(attribute);
  if (value == nullptr) return otherwise;
  std::int64_t parsed = -1;
  if (parse_number(*value, parsed) && parsed >= 0 && parsed <= most) return parsed;
  xml_.wrong(fmt::format("{}: `{}`; whole numbers from 0 to {} are allowed; write the file again", attribute,
                         shown(*value), most));
}

void XmlReader::read_file_tag() {
  if (xml_.next() != XmlScanner::Tag::open || xml_.name() != "VTKFile") {
    xml_.wrong("no VTK file; the element VTKFile is due first; check the file");
  }
  const std::string type = text("type", "");
  if (type != "PolyData" && type != "UnstructuredGrid") {
    xml_.wrong(fmt::format("VTK file of type `{}`; PolyData and UnstructuredGrid are read; {}", shown(type),
                           type == "Collection" || type.rfind('P', 0) == 0
                               ? "give the .vtp files that it lists"
                               : "write the particles as PolyData"));
  }
  const std::string order = text("byte_order", "LittleEndian");
  if (order != "LittleEndian" && order != "BigEndian") {
    xml_.wrong(
        fmt::format("byte_order `{}`; LittleEndian and BigEndian are allowed; correct it", shown(order)));
  }
  encoding_.swap = (order == "BigEndian") != machine_is_big_endian();
  const std::string header = text("header_type", "UInt32");
  if (header != "UInt32" && header != "UInt64") {
    xml_.wrong(fmt::format("header_type `{}`; UInt32 and UInt64 are allowed; correct it", shown(header)));
  }
  encoding_.header_bytes = header == "UInt64" ? 8 : 4;
  const std::string compressor = text("compressor", "");
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
    xml_.wrong(
        fmt::format("compressor `{}`; vtkZLibDataCompressor or none are read; write the file with one of "
                    "these",
                    shown(compressor)));
  }
  encoding_.zlib = !compressor.empty();
}

void XmlReader::read_piece() {
  piece_points_ = number("NumberOfPoints", 0, most_points);
  if (piece_points_ > 0 && points_ > 0) {
    xml_.wrong(
        "more than one Piece with points; one is read; merge them (ParaView: Append Geometry) and write "
        "again");
  }
  points_ += piece_points_;
}

void XmlReader::keep(Section section, NumberType type, PointArray array) {
  if (section == Section::points) {
    const double unit = options_.length_unit;
    position_resolution_ = digits_.resolution({unit, unit, unit});
    if (type == NumberType::float32 && position_resolution_ == 0) {
      double largest = 0;
      for (const double v : array.values) largest = std::max(largest, std::isfinite(v) ? std::abs(v) : 0);
      position_resolution_ = unit * float_resolution(largest);
    }
    array.name = "Points";
    set_.places = std::move(array);
    has_places_ = true;
  } else if (section == Section::point_data) {
    set_.arrays.push_back(std::move(array));
  } else if (array.values.size() == 1 && std::isfinite(array.values[0]) &&
             (array.name == "TimeValue" || array.name == "TIME")) {
    set_.time = array.values[0];
  }
}

void XmlReader::read_inline(Appended& what, const std::string& format) {
  if (!xml_.has_content() || what.count == 0) {
    if (what.count > 0) {
      xml_.wrong(fmt::format("array `{}` is empty; {} numbers are due; write the file again",
                             shown(what.array.name), what.count));
    }
  } else if (format == "ascii") {
    read_vtk_text(xml_, what.count, what.array.name, what.array.values,
                  what.section == Section::points ? &digits_ : nullptr);
  } else {
    VtkBytes bytes(xml_, true);
    read_vtk_binary(bytes, encoding_, what.type, what.count, what.array.name, what.array.values);
  }
  keep(what.section, what.type, std::move(what.array));
}

void XmlReader::read_array() {
  const auto type = number_types().find(text("type", ""));
  if (section_ == Section::none || type == number_types().end()) return xml_.skip_element();  // texts, bits
  Appended what;
  what.section = section_;
  what.type = type->second;
  what.array.name = text("Name", "");
  const std::int64_t components = number("NumberOfComponents", 1, most_components);
  const std::int64_t tuples =
      section_ == Section::field_data ? number("NumberOfTuples", 0, most_points) : piece_points_;
  if (components == 0) return xml_.skip_element();
  if (section_ == Section::points && (components != 3 || has_places_)) {
    xml_.wrong("Points are due once, with NumberOfComponents 3; write the file again");
  }
  what.array.components = static_cast<std::size_t>(components);
  what.count = tuples * components;
  const std::string format = text("format", "ascii");
  if (format == "appended") {
    if (xml_.attribute("offset") == nullptr)
      xml_.wrong("an appended array without offset; write the file again");
    what.offset = number("offset", 0, INT64_MAX);
    appended_.push_back(std::move(what));
    return;
  }
  if (format != "ascii" && format != "binary") {
    xml_.wrong(fmt::format("format `{}`; ascii, binary and appended are allowed; correct it", shown(format)));
  }
  read_inline(what, format);
}

// Arrays lie one after another; they are read in that order, whatever the order of their tags.
void XmlReader::read_appended() {
  const std::string encoding = text("encoding", "base64");
  if (encoding != "raw" && encoding != "base64") {
    xml_.wrong(fmt::format("encoding `{}`; raw and base64 are allowed; correct it", shown(encoding)));
  }
  while (xml_.peek() >= 0 && xml_.peek() != '_' && xml_.peek() <= ' ') xml_.get();
  if (xml_.get() != '_') xml_.wrong("AppendedData without its `_`; write the file again");
  std::stable_sort(appended_.begin(), appended_.end(),
                   [](const Appended& a, const Appended& b) { return a.offset < b.offset; });
  VtkBytes bytes(xml_, encoding == "base64");
  for (auto& what : appended_) {
    if (what.offset < bytes.taken()) {
      xml_.wrong(
          fmt::format("array `{}` begins within the one before it; its offset is wrong; write the file again",
                      shown(what.array.name)));
    }
    bytes.pass_to(what.offset);
    read_vtk_binary(bytes, encoding_, what.type, what.count, what.array.name, what.array.values);
    keep(what.section, what.type, std::move(what.array));
  }
  appended_.clear();
}

// False at the end, and behind the last of the appended data.
bool XmlReader::read_tag() {
  const auto tag = xml_.next();
  if (tag == XmlScanner::Tag::none) return false;
  const std::string name = xml_.name();
  if (tag == XmlScanner::Tag::close) {
    if (name == "Points" || name == "PointData" || name == "FieldData") section_ = Section::none;
    return true;
  }
  if (name == "Piece") {
    read_piece();
  } else if (name == "Points") {
    section_ = Section::points;
  } else if (name == "PointData") {
    section_ = Section::point_data;
  } else if (name == "FieldData") {
    section_ = Section::field_data;
  } else if (name == "DataArray") {
    read_array();
  } else if (name == "AppendedData") {
    read_appended();
    return false;
  } else if (name != "PolyData" && name != "UnstructuredGrid") {
    xml_.skip_element();  // cells and what lies on them
  }
  return true;
}

bool XmlReader::next(ParticleFrame& frame) {
  if (done_) return false;
  read_file_tag();
  while (read_tag()) {
  }
  if (!appended_.empty()) xml_.wrong("appended arrays without AppendedData; the file is cut; write it again");
  if (points_ > 0 && !has_places_)
    xml_.wrong("a Piece without Points; positions are due; write the file again");
  frame = frame_of(set_, options_, xml_.path().string());
  set_ = PointSet{};
  finish(frame, xml_.path().string(), xml_.path());
  done_ = true;
  return true;
}

}  // namespace

std::unique_ptr<ParticleReader> open_vtk_xml(const std::filesystem::path& path,
                                             const ReaderOptions& options) {
  return std::make_unique<XmlReader>(path, options);
}

}  // namespace interstice::io
