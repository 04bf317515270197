#include "coupling/io/mercury_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "coupling/io/columns.h"

namespace interstice::io {
namespace {

struct Header {
  std::int64_t particles = 0;
  double time = 0;
  Box bounds;
  bool flat = false;
};

// False for what is no header: a wrong count of numbers, no whole number first, bounds the wrong way round.
bool parse_header(std::string_view line, Header& header) {
  const auto cells = split(line, {});
  if (cells.size() != 6 && cells.size() != 8) return false;
  header = Header{};
  header.flat = cells.size() == 6;
  std::array<double, 7> v{};
  for (std::size_t c = 1; c < cells.size(); ++c) {
    if (!parse_number(cells[c], v[c - 1]) || !std::isfinite(v[c - 1])) return false;
  }
  header.time = v[0];
  const std::size_t axes = header.flat ? 2 : 3;
  for (std::size_t a = 0; a < axes; ++a) {
    header.bounds.lo[static_cast<int>(a)] = v[1 + a];
    header.bounds.hi[static_cast<int>(a)] = v[1 + a + axes];
    if (v[1 + a] > v[1 + a + axes]) return false;
  }
  return parse_number(cells[0], header.particles) && header.particles >= 0;
}

ColumnMap columns_of(bool flat, double length) {
  using Q = Quantity;
  const std::vector<std::pair<Q, const char*>> solid{
      {Q::x, "x"},       {Q::y, "y"},       {Q::z, "z"},       {Q::vx, "vx"},    {Q::vy, "vy"},
      {Q::vz, "vz"},     {Q::radius, "r"},  {Q::none, "qx"},   {Q::none, "qy"},  {Q::none, "qz"},
      {Q::wx, "omegax"}, {Q::wy, "omegay"}, {Q::wz, "omegaz"}, {Q::none, "info"}};
  const std::vector<std::pair<Q, const char*>> disc{{Q::x, "x"},      {Q::y, "y"},      {Q::vx, "vx"},
                                                    {Q::vy, "vy"},    {Q::radius, "r"}, {Q::none, "q"},
                                                    {Q::wz, "omega"}, {Q::none, "info"}};
  ColumnMap map;
  for (const auto& [quantity, name] : flat ? disc : solid) {
    map.columns.push_back({quantity, name, is_length(quantity) || is_velocity(quantity) ? length : 1});
  }
  return map;
}

class MercuryReader : public ParticleReader {
 public:
  MercuryReader(const std::filesystem::path& path, double length_unit)
      : lines_(path), length_unit_(length_unit) {}

  std::string kind() const override { return "MercuryDPM data"; }
  bool next(ParticleFrame& frame) override;
  bool skip() override;

 private:
  bool read_header(Header& header);
  Place place() const { return {lines_, frame_}; }
  [[noreturn]] void wrong(const std::string& what) const { throw InputError(place().text() + ": " + what); }
  [[noreturn]] void cut(std::int64_t rows, std::int64_t of) const;

  TextLines lines_;
  double length_unit_;
  std::int64_t frame_ = 0;  // number of the frame that is read next
};

void MercuryReader::cut(std::int64_t rows, std::int64_t of) const {
  const std::string reason = lines_.damage().empty() ? "the file ends early" : lines_.damage();
  wrong(fmt::format("cut after {} of {} rows; {}; {}", rows, of, reason,
                    frame_ == 0 ? "no frame before it; write the file again"
                                : "the frames before it are whole; read them with --frame N"));
}

bool MercuryReader::read_header(Header& header) {
  std::string_view line;
  do {
    if (lines_.next(line)) continue;
    if (!lines_.damage().empty()) wrong(lines_.damage() + "; a whole file is needed; write it again");
    return false;
  } while (split(line, {}).empty());
  if (!parse_header(line, header)) {
    wrong(
        "not a frame's first line; `N time xmin ymin zmin xmax ymax zmax` (2-D: without z) is due; check the "
        "number of rows before it");
  }
  return true;
}

bool MercuryReader::next(ParticleFrame& frame) {
  frame = ParticleFrame{};
  Header header;
  if (!read_header(header)) return false;
  const ColumnMap map = columns_of(header.flat, length_unit_);
  WrittenDigits digits;
  std::string_view line;
  for (std::int64_t row = 0; row < header.particles; ++row) {
    if (!lines_.next(line) || !lines_.damage().empty()) cut(row, header.particles);
    append_row(line, {}, map, place(), frame, &digits);
    // the row's last number, info, is not used: a cut within it costs nothing
  }
  if (header.flat) {
    frame.z.assign(frame.size(), 0.0);
    warn(lines_.path().string() + ": a 2-D file; its discs are read as spheres in the plane z = 0");
  } else {
    frame.bounds = Box{length_unit_ * header.bounds.lo, length_unit_ * header.bounds.hi};
  }
  frame.time = header.time;
  position_resolution_ = digits.resolution({length_unit_, length_unit_, length_unit_});
  finish(frame, place().text(), lines_.path());
  ++frame_;
  return true;
}

bool MercuryReader::skip() {
  Header header;
  if (!read_header(header)) return false;
  const std::int64_t rows = lines_.skip(header.particles);
  if (rows < header.particles) cut(rows, header.particles);
  ++frame_;
  return true;
}

}  // namespace

bool looks_like_mercury(const std::string& head) {
  const auto end = head.find_first_of("\r\n");
  Header header;
  return end != std::string::npos && parse_header(std::string_view(head).substr(0, end), header);
}

std::unique_ptr<ParticleReader> open_mercury(const std::filesystem::path& path,
                                             const ReaderOptions& options) {
  if (!options.columns.empty()) {
    throw InputError(path.string() +
                     ": --columns does not apply to MercuryDPM files; their columns have fixed places; leave "
                     "the option out");
  }
  return std::make_unique<MercuryReader>(path, options.length_unit);
}

}  // namespace interstice::io
