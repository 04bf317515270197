#include "coupling/io/dump_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "coupling/io/columns.h"

namespace interstice::io {
namespace {

// The x, y and z of a dump come plain, unwrapped (xu), scaled by the box (xs) or both (xsu).
const std::vector<ColumnNames>& dump_names() {
  static const std::vector<ColumnNames> names =
      with_field_columns({{Quantity::id, "id", {"id"}},
                          {Quantity::x, "x", {"x", "xu", "xs", "xsu"}},
                          {Quantity::y, "y", {"y", "yu", "ys", "ysu"}},
                          {Quantity::z, "z", {"z", "zu", "zs", "zsu"}},
                          {Quantity::radius, "radius", {"radius"}},
                          {Quantity::diameter, "diameter", {"diameter"}},
                          {Quantity::vx, "vx", {"vx"}},
                          {Quantity::vy, "vy", {"vy"}},
                          {Quantity::vz, "vz", {"vz"}},
                          {Quantity::wx, "wx", {"omegax"}},
                          {Quantity::wy, "wy", {"omegay"}},
                          {Quantity::wz, "wz", {"omegaz"}},
                          {Quantity::density, "density", {"density"}},
                          {Quantity::material, "material", {"type"}}});
  return names;
}

/// What one unit of the file is in SI.
struct Units {
  double length = 1, time = 1, density = 1, stress = 1;
};

// LAMMPS manual, "units": the styles that a granular dump can have.
bool units_of_style(std::string_view style, Units& units) {
  if (style == "si")
    units = {1, 1, 1, 1};
  else if (style == "cgs")
    units = {1e-2, 1, 1e3, 0.1};
  else if (style == "micro")
    units = {1e-6, 1e-6, 1e3, 1e3};
  else if (style == "nano")
    units = {1e-9, 1e-9, 1e6, 1e6};
  else if (style == "metal")
    units = {1e-10, 1e-12, 1e3, 1e5};
  else if (style == "real")
    units = {1e-10, 1e-15, 1e3, 101325};
  else
    return false;
  return true;
}

/// A frame's sections before its rows.
struct Header {
  std::int64_t step = -1;
  double time = std::numeric_limits<double>::quiet_NaN();  // [the file's unit]
  std::int64_t atoms = -1;
  bool has_bounds = false;
  Box bounds;  // [the file's unit] of a tilted box: its lower corner, and from there its edges' lengths
  std::array<bool, 3> periodic{false, false, false};
  bool tilted = false, slanted = false;  // slanted: a period does not lie along its axis
  Vec3d tilt;                            // xy, xz, yz [the file's unit]
  ColumnMap map;
};

bool starts_with(std::string_view line, std::string_view start) {
  return line.substr(0, start.size()) == start;
}

bool is_scaled(const std::string& name) {
  return (name.size() == 2 || (name.size() == 3 && name[2] == 'u')) && name[0] >= 'x' && name[0] <= 'z' &&
         name[1] == 's';
}

/// LAMMPS manual, "Triclinic (non-orthogonal) simulation boxes": the bounds in a dump are those around the
/// tilted box; the box's own corner and edges follow from the tilts.
Box untilted(Box box, const Vec3d& tilt) {
  const auto [xy, xz, yz] = tilt;
  box.lo.x -= std::min({0.0, xy, xz, xy + xz});
  box.hi.x -= std::max({0.0, xy, xz, xy + xz});
  box.lo.y -= std::min(0.0, yz);
  box.hi.y -= std::max(0.0, yz);
  return box;
}

/// Box fractions to positions [the file's unit].
void unscale(const Header& header, ParticleFrame& frame, const std::array<bool, 3>& scaled) {
  const auto [xy, xz, yz] = header.tilt;
  const Box& box = header.bounds;
  const Vec3d edge = box.size();
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Vec3d s{frame.x[i], frame.y[i], frame.z[i]};
    if (scaled[0]) frame.x[i] = box.lo.x + s.x * edge.x + s.y * xy + s.z * xz;
    if (scaled[1]) frame.y[i] = box.lo.y + s.y * edge.y + s.z * yz;
    if (scaled[2]) frame.z[i] = box.lo.z + s.z * edge.z;
  }
}

class DumpReader : public ParticleReader {
 public:
  DumpReader(const std::filesystem::path& path, ReaderOptions options)
      : lines_(path), options_(std::move(options)) {
    if (options_.length_unit_given) units_.length = options_.length_unit;
  }

  std::string kind() const override { return "LAMMPS dump"; }
  bool next(ParticleFrame& frame) override;
  bool skip() override;

 private:
  bool read_header(Header& header);
  void read_section(std::string_view item, Header& header);
  void read_bounds(std::string_view flags, Header& header);
  void drop_slanted_periods(Header& header);
  void read_units();
  ColumnMap read_columns(std::string_view names) const;
  void read_rows(const Header& header, ParticleFrame& frame, WrittenDigits& digits);
  double resolution(const Header& header, const WrittenDigits& digits) const;
  void to_si(const Header& header, ParticleFrame& frame);
  std::string_view line_of(const char* section);
  Place place() const { return {lines_, frame_}; }
  [[noreturn]] void cut(const std::string& what) const;
  [[noreturn]] void wrong(const std::string& what) const { throw InputError(place().text() + ": " + what); }

  TextLines lines_;
  ReaderOptions options_;
  Units units_;
  std::int64_t frame_ = 0;  // number of the frame that is read next
};

void DumpReader::cut(const std::string& what) const {
  const std::string reason = lines_.damage().empty() ? "the file ends early" : lines_.damage();
  const std::string before = frame_ == 0 ? "no frame before it; write the file again"
                             : frame_ == 1
                                 ? "frame 0 is whole; read it with --frame 0, or write the file again"
                                 : fmt::format(
                                       "frames 0 to {} are whole; read them with --frame N, or write "
                                       "the file again",
                                       frame_ - 1);
  throw InputError(fmt::format("{}: {}: {}; {}", place().text(), what, reason, before));
}

std::string_view DumpReader::line_of(const char* section) {
  std::string_view line;
  if (!lines_.next(line) || !lines_.line_was_whole()) cut(fmt::format("cut in section {}", section));
  return line;
}

void DumpReader::read_bounds(std::string_view flags, Header& header) {
  auto words = split(flags, {});
  if (!words.empty() && words[0] == "abc") {
    wrong(
        "a box with three general edge vectors; orthogonal or tilted (xy xz yz) boxes are read; write the "
        "dump with "
        "triclinic/general no");
  }
  header.tilted = words.size() >= 3 && words[0] == "xy";
  if (header.tilted) words.erase(words.begin(), words.begin() + 3);
  // LAMMPS manual, "dump": two letters an axis, p periodic, f fixed, s or m shrink-wrapped; old dumps have
  // none
  const auto is_flag = [](std::string_view w) {
    return w.size() == 2 && w.find_first_not_of("pfsm") == std::string_view::npos;
  };
  if (!words.empty() && (words.size() != 3 || !std::all_of(words.begin(), words.end(), is_flag))) {
    wrong(
        "the kinds of boundary cannot be read; three pairs of the letters p, f, s and m (or none) are "
        "allowed; correct the line");
  }
  for (std::size_t a = 0; a < words.size(); ++a) header.periodic[a] = words[a] == "pp";
  for (int axis = 0; axis < 3; ++axis) {
    const auto cells = split(line_of("BOX BOUNDS"), {});
    double lo = 0, hi = 0, tilt = 0;
    const std::size_t wanted = header.tilted ? 3 : 2;
    if (cells.size() < wanted || !parse_number(cells[0], lo) || !parse_number(cells[1], hi) ||
        (header.tilted && !parse_number(cells[2], tilt)) || !std::isfinite(lo) || !std::isfinite(hi) ||
        !std::isfinite(tilt) || hi < lo) {
      wrong(fmt::format(
          "box bounds cannot be read; {} finite numbers, low then high, are needed; correct the line",
          wanted));
    }
    header.bounds.lo[axis] = lo;
    header.bounds.hi[axis] = hi;
    header.tilt[axis] = tilt;
  }
  header.has_bounds = true;
  if (!header.tilted) return;
  header.bounds = untilted(header.bounds, header.tilt);
  if (!(header.bounds.hi.x >= header.bounds.lo.x && header.bounds.hi.y >= header.bounds.lo.y)) {
    wrong("the tilts are larger than the bounds around the box; the box has no width; correct the lines");
  }
  drop_slanted_periods(header);
}

// The edges of a tilted box are (lx, 0, 0), (xy, ly, 0) and (xz, yz, lz): an edge that lies along its axis
// can be a period of ours, whatever the others do.
void DumpReader::drop_slanted_periods(Header& header) {
  const bool y = header.periodic[1] && header.tilt.x != 0;
  const bool z = header.periodic[2] && (header.tilt.y != 0 || header.tilt.z != 0);
  if (!y && !z) return;
  header.slanted = true;
  if (y) header.periodic[1] = false;
  if (z) header.periodic[2] = false;
  const char* axes = y && z ? "y and z" : y ? "y" : "z";
  warn(fmt::format(
      "{}: the box is tilted and periodic along {}; fields repeat along the axes only, so images along {} "
      "are left out; for them run with an orthogonal box (change_box all ortho)",
      lines_.path().string(), axes, axes));
}

void DumpReader::read_units() {
  const std::string style(line_of("UNITS"));
  Units found;
  if (style == "lj") {
    if (!options_.length_unit_given) {
      warn(place().text() +
           ": lengths have no unit (units lj); read as metres; give the unit with --length-unit");
    }
    return;
  }
  if (!units_of_style(style, found)) {
    wrong(fmt::format(
        "units `{}` are not known; si, cgs, micro, nano, metal, real and lj are; write the dump in one "
        "of them",
        style.substr(0, 40)));
  }
  units_ = found;
  if (options_.length_unit_given) units_.length = options_.length_unit;
}

void DumpReader::read_section(std::string_view item, Header& header) {
  if (item == "TIMESTEP") {
    if (!parse_number(line_of("TIMESTEP"), header.step))
      wrong("the time step is no whole number; correct the line");
  } else if (item == "TIME") {
    if (!parse_number(line_of("TIME"), header.time) || !std::isfinite(header.time)) {
      wrong("the time is no finite number; correct the line");
    }
  } else if (item == "UNITS") {
    read_units();
  } else if (item == "NUMBER OF ATOMS") {
    const auto cells = split(line_of("NUMBER OF ATOMS"), {});
    if (cells.size() != 1 || !parse_number(cells[0], header.atoms) || header.atoms < 0) {
      wrong("the number of atoms is no whole number of 0 or more; correct the line");
    }
  } else if (starts_with(item, "BOX BOUNDS")) {
    read_bounds(item.substr(10), header);
  } else if (item == "LABEL") {
    line_of("LABEL");
  } else if (starts_with(item, "ENTRIES") || starts_with(item, "NUMBER OF ENTRIES")) {
    wrong("a dump of local entries (pairs, bonds), not of atoms; a dump custom with x y z radius is needed");
  } else {
    wrong(fmt::format(
        "section `{}` is not known; TIMESTEP, TIME, UNITS, NUMBER OF ATOMS, BOX BOUNDS and ATOMS are; "
        "check the file",
        item.substr(0, 40)));
  }
}

ColumnMap DumpReader::read_columns(std::string_view names) const {
  std::vector<std::string> present;
  for (const auto& name : split(names, {})) present.emplace_back(name);
  ColumnMap map = map_columns(present, dump_names(), options_.columns, place().text());
  for (auto& column : map.columns) {
    switch (column.quantity) {
      case Quantity::x:
      case Quantity::y:
      case Quantity::z:
        column.factor = is_scaled(column.name) ? 1 : units_.length;
        break;
      case Quantity::radius:
      case Quantity::diameter:
        column.factor = units_.length;
        break;
      case Quantity::vx:
      case Quantity::vy:
      case Quantity::vz:
        column.factor = units_.length / units_.time;
        break;
      case Quantity::wx:
      case Quantity::wy:
      case Quantity::wz:
        column.factor = 1 / units_.time;
        break;
      case Quantity::density:
        column.factor = units_.density;
        break;
      default:
        if (is_stress(column.quantity)) column.factor = units_.stress;
        break;
    }
  }
  return map;
}

bool DumpReader::read_header(Header& header) {
  std::string_view line;
  bool begun = false;
  while (lines_.next(line)) {
    if (split(line, {}).empty()) continue;
    if (!lines_.line_was_whole()) cut("cut in its header");
    if (!starts_with(line, "ITEM:")) {
      const bool after_rows = !begun && frame_ > 0;
      wrong(after_rows
                ? "more rows than NUMBER OF ATOMS says; ITEM: TIMESTEP is due here; correct the count or the "
                  "rows"
                : "not a section of a dump; a line that begins with ITEM: is due here; check the file");
    }
    begun = true;
    std::string item(line.substr(5));  // the line itself goes with the next one
    item.erase(0,
               item.find_first_not_of(' ') == std::string::npos ? item.size() : item.find_first_not_of(' '));
    while (!item.empty() && item.back() == ' ') item.pop_back();
    if (!starts_with(item, "ATOMS")) {
      read_section(item, header);
      continue;
    }
    if (header.atoms < 0)
      wrong("ITEM: ATOMS before ITEM: NUMBER OF ATOMS; the number is needed; check the file");
    header.map = read_columns(std::string_view(item).substr(5));
    return true;
  }
  if (begun || !lines_.damage().empty()) cut("cut in its header");
  return false;
}

void DumpReader::read_rows(const Header& header, ParticleFrame& frame, WrittenDigits& digits) {
  const auto expected = static_cast<std::size_t>(std::min<std::int64_t>(header.atoms, std::int64_t{1} << 20));
  for (auto* c : {&frame.x, &frame.y, &frame.z, &frame.radius})
    c->reserve(expected);  // a wrong count costs little
  std::string_view line;
  for (std::int64_t row = 0; row < header.atoms; ++row) {
    if (!lines_.next(line) || !lines_.line_was_whole()) {
      cut(fmt::format("cut after {} of {} rows", row, header.atoms));
    }
    if (starts_with(line, "ITEM:")) {
      wrong(fmt::format("{} rows where NUMBER OF ATOMS says {}; complete the frame or remove it", row,
                        header.atoms));
    }
    append_row(line, {}, header.map, place(), frame, &digits);
  }
}

void DumpReader::to_si(const Header& header, ParticleFrame& frame) {
  const std::array<bool, 3> scaled{is_scaled(header.map.find(Quantity::x)->name),
                                   is_scaled(header.map.find(Quantity::y)->name),
                                   is_scaled(header.map.find(Quantity::z)->name)};
  if (scaled[0] || scaled[1] || scaled[2]) {
    if (!header.has_bounds)
      wrong("scaled coordinates without BOX BOUNDS; the box is needed; dump x y z instead");
    if (header.tilted && !(scaled[0] && scaled[1] && scaled[2])) {
      wrong("only some coordinates are scaled in a tilted box; all or none must be; dump x y z instead");
    }
    Header box = header;
    for (auto* v : {&box.bounds.lo, &box.bounds.hi, &box.tilt}) *v = units_.length * *v;
    unscale(box, frame, scaled);
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (!std::isfinite(frame.x[i]) || !std::isfinite(frame.y[i]) || !std::isfinite(frame.z[i])) {
        wrong(
            "scaled coordinates leave the range of numbers; fractions of the box are expected; correct the "
            "rows");
      }
    }
  }
  frame.step = header.step;
  frame.time = header.time * units_.time;
  frame.periodic = header.periodic;
  if (header.has_bounds && !header.slanted)  // a slanted box is no box of ours to repeat
    frame.bounds = Box{units_.length * header.bounds.lo, units_.length * header.bounds.hi};
}

// A fraction of the box is as coarse as the box is long.
double DumpReader::resolution(const Header& header, const WrittenDigits& digits) const {
  std::array<double, 3> unit{};
  const std::array<Quantity, 3> axes{Quantity::x, Quantity::y, Quantity::z};
  for (std::size_t a = 0; a < 3; ++a) {
    const bool scaled = is_scaled(header.map.find(axes[a])->name);
    unit[a] = units_.length * (scaled ? header.bounds.size()[static_cast<int>(a)] : 1);
  }
  return digits.resolution(unit);
}

bool DumpReader::next(ParticleFrame& frame) {
  frame = ParticleFrame{};
  Header header;
  if (!read_header(header)) {
    if (frame_ == 0) wrong("no frame in the file; ITEM: TIMESTEP is due; check the file");
    return false;
  }
  WrittenDigits digits;
  read_rows(header, frame, digits);
  to_si(header, frame);
  position_resolution_ = resolution(header, digits);
  finish(frame, place().text(), lines_.path());
  ++frame_;
  return true;
}

bool DumpReader::skip() {
  Header header;
  if (!read_header(header)) return false;
  const std::int64_t rows = lines_.skip(header.atoms);
  if (rows < header.atoms || !lines_.line_was_whole())
    cut(fmt::format("cut after {} of {} rows", rows, header.atoms));
  ++frame_;
  return true;
}

}  // namespace

std::unique_ptr<ParticleReader> open_dump(const std::filesystem::path& path, const ReaderOptions& options) {
  return std::make_unique<DumpReader>(path, options);
}

}  // namespace interstice::io
