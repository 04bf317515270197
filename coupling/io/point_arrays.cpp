#include "coupling/io/point_arrays.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/error.h"
#include "coupling/io/columns.h"

namespace interstice::io {
namespace {

template <class Number>
void append_as(const char* bytes, std::size_t count, bool swap, std::vector<double>& to) {
  for (std::size_t i = 0; i < count; ++i) {
    char raw[sizeof(Number)];
    std::memcpy(raw, bytes + i * sizeof(Number), sizeof(Number));
    if (swap) std::reverse(raw, raw + sizeof(Number));
    Number value;
    std::memcpy(&value, raw, sizeof(Number));
    to.push_back(static_cast<double>(value));
  }
}

// Names in the files of LIGGGHTS (dump custom/vtk, pizza's dump2vtk and lpp), MercuryDPM, YADE and others.
const std::vector<ColumnNames>& array_names() {
  static const std::vector<ColumnNames> names = with_field_columns(
      {{Quantity::x, "x", {"Points:0"}},
       {Quantity::y, "y", {"Points:1"}},
       {Quantity::z, "z", {"Points:2"}},
       {Quantity::id, "id", {"id", "ids", "GlobalIds", "GlobalPointIds", "atom_id"}},
       {Quantity::radius, "radius", {"radius", "radii", "r"}},
       {Quantity::diameter, "diameter", {"diameter", "d"}},
       {Quantity::vx, "vx", {"v:0", "velocity:0", "vel:0", "linVelVec:0", "vx"}},
       {Quantity::vy, "vy", {"v:1", "velocity:1", "vel:1", "linVelVec:1", "vy"}},
       {Quantity::vz, "vz", {"v:2", "velocity:2", "vel:2", "linVelVec:2", "vz"}},
       {Quantity::wx, "wx", {"omega:0", "angularVelocity:0", "angVelVec:0", "omegax", "wx"}},
       {Quantity::wy, "wy", {"omega:1", "angularVelocity:1", "angVelVec:1", "omegay", "wy"}},
       {Quantity::wz, "wz", {"omega:2", "angularVelocity:2", "angVelVec:2", "omegaz", "wz"}},
       {Quantity::density, "density", {"density", "rho"}},
       {Quantity::material, "material", {"material", "type", "atom_type"}}});
  return names;
}

/// One component of one array.
struct Strand {
  const PointArray* array = nullptr;
  std::size_t component = 0;
  double at(std::size_t i) const { return array->values[i * array->components + component]; }
};

[[noreturn]] void bad_value(const std::string& where, const std::string& name, std::size_t point,
                            double value, const char* what) {
  throw InputError(fmt::format("{}: {} of point {}: {} {}; correct or remove the point", where, shown(name),
                               point, value, what));
}

void append_whole(const Strand& strand, const ColumnMap::Column& column, std::size_t points,
                  const std::string& where, ParticleFrame& frame) {
  const bool id = column.quantity == Quantity::id;
  for (std::size_t i = 0; i < points; ++i) {
    const double value = strand.at(i);
    if (!(std::abs(value) < (id ? 0x1p63 : 0x1p31)) || value != std::floor(value)) {
      bad_value(where, column.name, i, value, "is no whole number of the range; whole numbers only");
    }
    if (id) {
      frame.id.push_back(static_cast<std::int64_t>(value));
    } else {
      whole_column(frame, column.quantity)->push_back(static_cast<std::int32_t>(value));
    }
  }
}

void append_real(const Strand& strand, const ColumnMap::Column& column, std::size_t points, double factor,
                 const std::string& where, ParticleFrame& frame) {
  auto& to = *real_column(frame, column.quantity);
  to.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    double value = factor * strand.at(i);
    if (!std::isfinite(value)) {
      bad_value(where, column.name, i, strand.at(i), "is not finite; finite numbers only");
    }
    if (is_size(column.quantity)) {
      value = radius_of(column.quantity, value);
      if (!(value > 0)) bad_value(where, column.name, i, strand.at(i), "is not positive; sizes above 0");
    }
    to.push_back(value);
  }
}

}  // namespace

std::size_t bytes_of(NumberType type) {
  constexpr std::array<std::size_t, 10> bytes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return bytes[static_cast<std::size_t>(type)];
}

void append_numbers(const char* bytes, std::size_t count, NumberType type, bool swap,
                    std::vector<double>& to) {
  switch (type) {
    case NumberType::int8:
      return append_as<std::int8_t>(bytes, count, swap, to);
    case NumberType::uint8:
      return append_as<std::uint8_t>(bytes, count, swap, to);
    case NumberType::int16:
      return append_as<std::int16_t>(bytes, count, swap, to);
    case NumberType::uint16:
      return append_as<std::uint16_t>(bytes, count, swap, to);
    case NumberType::int32:
      return append_as<std::int32_t>(bytes, count, swap, to);
    case NumberType::uint32:
      return append_as<std::uint32_t>(bytes, count, swap, to);
    case NumberType::int64:
      return append_as<std::int64_t>(bytes, count, swap, to);
    case NumberType::uint64:
      return append_as<std::uint64_t>(bytes, count, swap, to);
    case NumberType::float32:
      return append_as<float>(bytes, count, swap, to);
    case NumberType::float64:
      return append_as<double>(bytes, count, swap, to);
  }
}

bool machine_is_big_endian() {
  const std::uint16_t one = 1;
  char first = 0;
  std::memcpy(&first, &one, 1);
  return first == 0;
}

ParticleFrame frame_of(const PointSet& set, const ReaderOptions& options, const std::string& where) {
  const std::size_t points = set.places.values.size() / 3;
  ParticleFrame frame;
  frame.time = set.time;
  frame.step = set.step;
  if (points == 0) return frame;  // a dump of no grains often leaves their arrays out
  std::vector<std::string> names;
  std::vector<Strand> strands;
  const auto add = [&](const PointArray& array) {
    if (array.values.size() != points * array.components) {
      throw InputError(
          fmt::format("{}: array `{}` has {} numbers for {} points; {} a point are due; write the file again",
                      where, shown(array.name), array.values.size(), points, array.components));
    }
    for (std::size_t c = 0; c < array.components && c < 9; ++c) {
      names.push_back(array.components == 1 ? array.name : fmt::format("{}:{}", array.name, c));
      strands.push_back({&array, c});
    }
  };
  add(set.places);
  for (const auto& array : set.arrays) add(array);
  const ColumnMap map = map_columns(names, array_names(), options.columns, where);
  for (std::size_t c = 0; c < names.size(); ++c) {
    const auto& column = map.columns[c];
    if (column.quantity == Quantity::none) continue;
    if (real_column(frame, column.quantity) == nullptr) {
      append_whole(strands[c], column, points, where, frame);
    } else {
      const bool scaled = is_length(column.quantity) || is_velocity(column.quantity);
      append_real(strands[c], column, points, scaled ? options.length_unit : 1, where, frame);
    }
  }
  return frame;
}

}  // namespace interstice::io
