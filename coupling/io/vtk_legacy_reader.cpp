#include "coupling/io/vtk_legacy_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/error.h"
#include "coupling/io/columns.h"
#include "coupling/io/point_arrays.h"

namespace interstice::io {
namespace {

constexpr std::int64_t most_numbers = std::int64_t{1} << 40;  // counts above are damage, not powder

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return out;
}

// "bit" is stored eight to a byte and "string" in lengths of its own; neither describes grains.
std::optional<NumberType> number_type(const std::string& name) {
  static const std::map<std::string, NumberType> types{
      {"CHAR", NumberType::int8},          {"UNSIGNED_CHAR", NumberType::uint8},
      {"SHORT", NumberType::int16},        {"UNSIGNED_SHORT", NumberType::uint16},
      {"INT", NumberType::int32},          {"UNSIGNED_INT", NumberType::uint32},
      {"LONG", NumberType::int64},         {"UNSIGNED_LONG", NumberType::uint64},
      {"VTKTYPEINT64", NumberType::int64}, {"VTKTYPEUINT64", NumberType::uint64},
      {"VTKIDTYPE", NumberType::int32},    {"FLOAT", NumberType::float32},
      {"DOUBLE", NumberType::float64}};
  const auto it = types.find(upper(name));
  return it == types.end() ? std::nullopt : std::optional(it->second);
}

// vtkDataWriter writes blanks and other odd characters of a name as %XX.
std::string decoded(const std::string& name) {
  const auto hex = [](char c) {
    const std::size_t at = std::string_view("0123456789ABCDEFabcdef").find(c);
    return at == std::string_view::npos ? -1 : static_cast<int>(at < 16 ? at : at - 6);
  };
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool escaped =
        name[i] == '%' && i + 2 < name.size() && hex(name[i + 1]) >= 0 && hex(name[i + 2]) >= 0;
    out += escaped ? static_cast<char>(16 * hex(name[i + 1]) + hex(name[i + 2])) : name[i];
    if (escaped) i += 2;
  }
  return out;
}

class LegacyReader : public ParticleReader {
 public:
  LegacyReader(const std::filesystem::path& path, ReaderOptions options)
      : lines_(path), options_(std::move(options)) {}

  std::string kind() const override { return "VTK legacy"; }
  std::int64_t frames() const override { return 1; }
  bool next(ParticleFrame& frame) override;

 private:
  using Words = std::vector<std::string>;
  void read_header();
  bool next_words(Words& words);
  void read_section(const Words& words);
  bool read_attribute(const Words& words, const std::string& keyword);
  void read_points(const Words& words);
  void read_cells(const Words& words);
  void read_field(const Words& words);
  void pass_metadata();
  void read_array(const std::string& name, std::int64_t tuples, std::int64_t components,
                  const std::string& type);
  void read_numbers(std::int64_t count, const std::string& type, std::vector<double>* keep,
                    WrittenDigits* digits = nullptr);
  void read_text(std::int64_t count, std::vector<double>* keep, WrittenDigits* digits);
  void read_bytes(std::int64_t count, NumberType type, std::vector<double>* keep);
  std::int64_t count_of(const Words& words, std::size_t at) const;
  void keep_or_drop(PointArray array);
  [[noreturn]] void cut(const std::string& what) const;
  [[noreturn]] void wrong(const std::string& what) const { throw InputError(lines_.where() + ": " + what); }

  TextLines lines_;
  ReaderOptions options_;
  PointSet set_;
  bool binary_ = false, cell_connectivity_ = false;
  enum class Target { dataset, points, cells } target_ = Target::dataset;
  std::int64_t points_ = -1, tuples_ = 0;
  std::int64_t offsets_ = 0, connectivity_ = 0;  // counts that the last line of cells of version 5.1 gave
  bool done_ = false;
};

void LegacyReader::cut(const std::string& what) const {
  wrong(fmt::format("cut in {}; {}; write the file again", what,
                    lines_.damage().empty() ? "the file ends early" : lines_.damage()));
}

bool LegacyReader::next_words(Words& words) {
  words.clear();
  std::string_view line;
  while (lines_.next(line)) {
    for (const auto& word : split(line, {})) words.emplace_back(word);
    if (!words.empty()) return true;
  }
  if (!lines_.damage().empty()) wrong(lines_.damage() + "; a whole file is needed; write it again");
  return false;
}

std::int64_t LegacyReader::count_of(const Words& words, std::size_t at) const {
  std::int64_t count = -1;
  if (at >= words.size() || !parse_number(words[at], count) || count < 0 || count > most_numbers) {
    wrong(fmt::format("{}: a count of 0 or more is due as word {}; correct the line, or write the file again",
                      shown(words[0]), at + 1));
  }
  return count;
}

void LegacyReader::read_header() {
  std::string_view line;
  if (!lines_.next(line)) cut("its header");
  // "# vtk DataFile Version 3.0"; opening has seen all but the number. YADE ends it with a full stop
  if (!line.empty() && line.back() == '.') line.remove_suffix(1);
  const auto version = split(line, {});
  double number = 0;
  if (version.size() < 5 || !parse_number(version[4], number)) {
    wrong("`# vtk DataFile Version x.y` is due; check the file");
  }
  cell_connectivity_ = number >= 5;
  if (!lines_.next(line)) cut("its header");  // a title
  Words words;
  if (!next_words(words)) cut("its header");
  const std::string form = upper(words[0]);
  if (form != "ASCII" && form != "BINARY") wrong("ASCII or BINARY is due on the third line; check the file");
  binary_ = form == "BINARY";
  if (!next_words(words)) cut("its header");
  if (upper(words[0]) == "DATASET" && words.size() == 2) {
    const std::string type = upper(words[1]);
    if (type == "POLYDATA" || type == "UNSTRUCTURED_GRID") return;
    wrong(fmt::format(
        "a dataset {} has no particles; POLYDATA and UNSTRUCTURED_GRID are read; give the file of "
        "the particles (not of the mesh or the bounding box)",
        shown(words[1])));
  }
  wrong("DATASET POLYDATA or DATASET UNSTRUCTURED_GRID is due; check the file");
}

// In text, numbers run on over the ends of lines; in binary, they follow the line at once.
void LegacyReader::read_numbers(std::int64_t count, const std::string& type, std::vector<double>* keep,
                                WrittenDigits* digits) {
  if (binary_ && upper(type) == "BIT") return read_bytes((count + 7) / 8, NumberType::uint8, nullptr);
  const auto known = number_type(type);
  if (!known && upper(type) != "BIT") {
    wrong(
        fmt::format("numbers of type `{}` are not known; char to double are; write the array otherwise, or "
                    "leave it out",
                    shown(type)));
  }
  if (!binary_) return read_text(count, keep, digits);
  read_bytes(count, *known, keep);
}

void LegacyReader::read_text(std::int64_t count, std::vector<double>* keep, WrittenDigits* digits) {
  std::string_view line;
  std::int64_t read = 0;
  while (read < count) {
    if (!lines_.next(line)) cut(fmt::format("an array, after {} of {} numbers", read, count));
    for (const auto& cell : split(line, {})) {
      double value = 0;
      if (read == count || !parse_number(cell, value)) {
        wrong(fmt::format("`{}` where {}; correct the array, or write the file again", shown(cell),
                          read == count ? "the array is complete" : "a number is due"));
      }
      if (keep != nullptr) keep->push_back(value);
      if (digits != nullptr) digits->add(static_cast<std::size_t>(read % 3), cell, value);
      ++read;
    }
    // a file cut within its last number shows only here
    if (read == count && !lines_.line_was_whole()) {
      warn(lines_.where() + ": the last line has no line end; if the file was cut, its last number is wrong");
    }
  }
}

void LegacyReader::read_bytes(std::int64_t count, NumberType type, std::vector<double>* keep) {
  const std::size_t size = bytes_of(type);
  std::vector<char> part(std::size_t{1} << 16);
  for (std::int64_t left = count; left > 0;) {
    const auto now = std::min<std::size_t>(static_cast<std::size_t>(left), part.size() / size);
    if (lines_.read(part.data(), now * size) != now * size) {
      cut(fmt::format("an array, after {} of {} numbers", count - left, count));
    }
    if (keep != nullptr) append_numbers(part.data(), now, type, !machine_is_big_endian(), *keep);
    left -= static_cast<std::int64_t>(now);
  }
}

void LegacyReader::read_points(const Words& words) {
  if (points_ >= 0) wrong("POINTS twice; one set of points is read; write the file again");
  if (words.size() != 3) wrong("POINTS: a count and a type are due; check the file");
  points_ = count_of(words, 1);
  WrittenDigits digits;
  read_numbers(3 * points_, words[2], &set_.places.values, &digits);
  const double unit = options_.length_unit;
  if (!binary_) {
    position_resolution_ = digits.resolution({unit, unit, unit});
  } else if (number_type(words[2]) == NumberType::float32) {
    double largest = 0;
    for (const double v : set_.places.values) largest = std::max(largest, std::isfinite(v) ? std::abs(v) : 0);
    position_resolution_ = unit * float_resolution(largest);
  }
}

// VERTICES and the like: until version 5.0 `cells numbers` and one list of integers, from 5.1 on `offsets
// connectivity` and two arrays with a line of their own.
void LegacyReader::read_cells(const Words& words) {
  const std::int64_t first = count_of(words, 1), second = count_of(words, 2);
  if (!cell_connectivity_) return read_numbers(second, "int", nullptr);
  offsets_ = first;
  connectivity_ = second;
}

void LegacyReader::keep_or_drop(PointArray array) {
  if (target_ == Target::points) set_.arrays.push_back(std::move(array));
  if (target_ != Target::dataset || array.values.size() != 1) return;
  const std::string name = upper(array.name);
  if ((name == "TIME" || name == "TIMEVALUE") && std::isfinite(array.values[0])) set_.time = array.values[0];
  if (name == "CYCLE" && std::abs(array.values[0]) < 0x1p53) {
    set_.step = static_cast<std::int64_t>(array.values[0]);
  }
}

void LegacyReader::read_array(const std::string& name, std::int64_t tuples, std::int64_t components,
                              const std::string& type) {
  if (components < 1 || components > 1024 || tuples > most_numbers / components) {
    wrong(fmt::format("array `{}`: {} numbers each for {} points; 1 to 1024 are read; write the file again",
                      shown(name), components, tuples));
  }
  PointArray array{decoded(name), static_cast<std::size_t>(components), {}};
  read_numbers(tuples * components, type, target_ == Target::cells ? nullptr : &array.values);
  keep_or_drop(std::move(array));
}

void LegacyReader::read_field(const Words& words) {
  const std::int64_t arrays = count_of(words, 2);
  Words line;
  for (std::int64_t a = 0; a < arrays; ++a) {
    if (!next_words(line)) cut(fmt::format("a field, after {} of {} arrays", a, arrays));
    if (upper(line[0]) == "METADATA") {
      pass_metadata();
      --a;
      continue;
    }
    if (line.size() != 4)
      wrong("an array of a field: name, components, tuples and type are due; check the file");
    read_array(line[0], count_of(line, 2), count_of(line, 1), line[3]);
  }
}

// vtkDataWriter: names of components and other notes, up to an empty line.
void LegacyReader::pass_metadata() {
  std::string_view line;
  while (lines_.next(line)) {
    if (split(line, {}).empty()) return;
  }
}

bool LegacyReader::read_attribute(const Words& words, const std::string& keyword) {
  const auto need = [&](std::size_t count) {
    if (words.size() < count) wrong(keyword + ": a name and a type are due; check the file");
  };
  if (keyword == "SCALARS") {
    need(3);
    const std::int64_t components = words.size() > 3 ? count_of(words, 3) : 1;
    Words table;
    if (!next_words(table)) cut("SCALARS");
    if (upper(table[0]) != "LOOKUP_TABLE") wrong("LOOKUP_TABLE is due after SCALARS; check the file");
    read_array(words[1], tuples_, components, words[2]);
  } else if (keyword == "VECTORS" || keyword == "NORMALS") {
    need(3);
    read_array(words[1], tuples_, 3, words[2]);
  } else if (keyword == "TENSORS" || keyword == "TENSORS6") {
    need(3);
    read_array(words[1], tuples_, keyword == "TENSORS" ? 9 : 6, words[2]);
  } else if (keyword == "GLOBAL_IDS" || keyword == "PEDIGREE_IDS") {
    need(3);
    read_array(words[1], tuples_, 1, words[2]);
  } else if (keyword == "TEXTURE_COORDINATES") {
    need(4);
    read_array(words[1], tuples_, count_of(words, 2), words[3]);
  } else if (keyword == "COLOR_SCALARS") {
    need(3);
    read_array(words[1], tuples_, count_of(words, 2), binary_ ? "unsigned_char" : "float");
  } else if (keyword == "LOOKUP_TABLE") {
    need(3);
    const std::int64_t colours = count_of(words, 2);
    read_numbers(4 * colours, binary_ ? "unsigned_char" : "float", nullptr);
  } else {
    return false;
  }
  return true;
}

void LegacyReader::read_section(const Words& words) {
  const std::string keyword = upper(words[0]);
  static const std::vector<std::string> cells{"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS", "CELLS"};
  if (keyword == "POINTS") {
    read_points(words);
  } else if (std::find(cells.begin(), cells.end(), keyword) != cells.end()) {
    read_cells(words);
  } else if (keyword == "OFFSETS" || keyword == "CONNECTIVITY") {
    if (words.size() != 2) wrong(keyword + ": a type is due; check the file");
    read_numbers(keyword == "OFFSETS" ? offsets_ : connectivity_, words[1], nullptr);
  } else if (keyword == "CELL_TYPES") {
    read_numbers(count_of(words, 1), "int", nullptr);
  } else if (keyword == "POINT_DATA" || keyword == "CELL_DATA") {
    tuples_ = count_of(words, 1);
    target_ = keyword == "POINT_DATA" ? Target::points : Target::cells;
    if (target_ == Target::points && tuples_ != points_) {
      wrong(
          fmt::format("POINT_DATA for {} points, but POINTS has {}; equal numbers are needed; write the file "
                      "again",
                      tuples_, std::max<std::int64_t>(points_, 0)));
    }
  } else if (keyword == "FIELD") {
    read_field(words);
  } else if (keyword == "METADATA") {
    pass_metadata();
  } else if (!read_attribute(words, keyword)) {
    wrong(
        fmt::format("`{}` where a section of a VTK file (POINTS, POINT_DATA, SCALARS, ...) is due; check the "
                    "counts before it",
                    shown(words[0])));
  }
}

bool LegacyReader::next(ParticleFrame& frame) {
  if (done_) return false;
  read_header();
  Words words;
  while (next_words(words)) read_section(words);
  if (points_ < 0) wrong("no POINTS in the file; particles are points; check the file");
  frame = frame_of(set_, options_, lines_.path().string());
  set_ = PointSet{};
  finish(frame, lines_.path().string(), lines_.path());
  done_ = true;
  return true;
}

}  // namespace

std::unique_ptr<ParticleReader> open_vtk_legacy(const std::filesystem::path& path,
                                                const ReaderOptions& options) {
  return std::make_unique<LegacyReader>(path, options);
}

}  // namespace interstice::io
