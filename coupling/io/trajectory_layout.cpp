#include "coupling/io/trajectory_layout.h"

#include <zlib.h>

#include <algorithm>
#include <cstring>

namespace interstice::io::layout {

namespace {

WallRow row_of(const Plane& p) {
  return {"plane", {p.point.x, p.point.y, p.point.z, p.normal.x, p.normal.y, p.normal.z}};
}
WallRow row_of(const Box& b) { return {"box", {b.lo.x, b.lo.y, b.lo.z, b.hi.x, b.hi.y, b.hi.z}}; }

uLong add(uLong crc, const void* data, std::size_t bytes) {
  const auto* from = static_cast<const Bytef*>(data);
  while (bytes > 0) {
    const auto n = static_cast<uInt>(std::min<std::size_t>(bytes, std::size_t{1} << 30));
    crc = ::crc32(crc, from, n);
    from += n;
    bytes -= n;
  }
  return crc;
}

template <class Value>
uLong add_value(uLong crc, const Value& value) {
  return add(crc, &value, sizeof value);
}

template <class Columns>
uLong add_columns(uLong crc, const ParticleFrame& frame, const Columns& columns) {
  for (const auto& column : columns) {
    const auto& values = frame.*column.values;
    if (!values.empty())
      crc = add(add(crc, column.name, std::strlen(column.name)), values.data(),
                values.size() * sizeof values[0]);
  }
  return crc;
}

}  // namespace

WallRow wall_row(const Shape& shape) {
  return std::visit([](const auto& s) { return row_of(s); }, shape);
}

Hdf5Handle wall_type(std::size_t name_bytes) {
  const Hdf5Handle name = text_type(name_bytes);
  const Hdf5Handle kind = text_type(kWallKindBytes);
  const hsize_t count = kWallValues;
  const Hdf5Handle values(H5Tarray_create2(H5T_IEEE_F64LE, 1, &count), H5Tclose, "describing a wall");
  const std::size_t name_size = H5Tget_size(name);
  Hdf5Handle row(H5Tcreate(H5T_COMPOUND, name_size + kWallKindBytes + kWallValues * sizeof(double)), H5Tclose,
                 "describing a wall");
  checked(H5Tinsert(row, "name", 0, name), "describing a wall");
  checked(H5Tinsert(row, "kind", name_size, kind), "describing a wall");
  checked(H5Tinsert(row, "values", name_size + kWallKindBytes, values), "describing a wall");
  return row;
}

std::int64_t checksum(const ParticleFrame& frame) {
  uLong crc = add_value(add_value(::crc32(0, nullptr, 0), frame.time), frame.step);
  for (const bool periodic : frame.periodic) crc = add_value(crc, static_cast<std::int32_t>(periodic));
  if (frame.bounds) crc = add_value(crc, wall_row(*frame.bounds).values);
  crc = add_columns(add_columns(add_columns(crc, frame, kReal), frame, kLong), frame, kShort);
  for (const WallPose& wall : frame.walls) {
    const WallRow row = wall_row(wall.shape);
    crc = add(add(crc, wall.name.data(), wall.name.size()), row.kind, std::strlen(row.kind));
    crc = add_value(crc, row.values);
  }
  return static_cast<std::int64_t>(crc);
}

}  // namespace interstice::io::layout
