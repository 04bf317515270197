// The writer of trajectory.h5part.
#include "coupling/io/trajectory.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <system_error>

#include "base/error.h"
#include "coupling/io/atomic_file.h"
#include "coupling/io/chunked_column.h"
#include "coupling/io/guarded_file.h"
#include "coupling/io/hdf5_handles.h"
#include "coupling/io/rollback_file_driver.h"
#include "coupling/io/trajectory_layout.h"

namespace interstice::io {

namespace {

namespace fs = std::filesystem;

constexpr hsize_t kChunk =
    65536;  // elements: half a megabyte of doubles, the grain of reading and of compression
constexpr unsigned kDeflateLevel =
    1;  // higher levels gain a few percent on mantissas and cost several times the time

[[noreturn]] void cannot_write(const fs::path& path, const std::string& reason) {
  throw RunError("cannot write " + path.string() + ": " + reason);
}

void check_lengths(const fs::path& path, const ParticleFrame& frame) {
  const auto check = [&](const auto& columns) {
    for (const auto& column : columns) {
      const std::size_t n = (frame.*column.values).size();
      if (n == frame.size() || (n == 0 && !layout::required(column.name))) continue;
      cannot_write(path, std::string("column ") + column.name + " has " + std::to_string(n) + " values for " +
                             std::to_string(frame.size()) + " particles");
    }
  };
  check(layout::kReal);
  check(layout::kLong);
  check(layout::kShort);
}

Hdf5Handle column_properties(hsize_t elements) {
  Hdf5Handle properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describing a column");
  if (elements == 0) return properties;
  const hsize_t chunk = std::min(elements, kColumnChunk);
  checked(H5Pset_chunk(properties, 1, &chunk), "describing a column");
  checked(H5Pset_shuffle(properties), "describing a column");
  checked(H5Pset_deflate(properties, kDeflateLevel), "describing a column");
  return properties;
}

void write_column(hid_t group, const char* name, hid_t file_type, hid_t memory_type, const void* values,
                  hsize_t elements) {
  const Hdf5Handle space = simple_space(elements);
  const Hdf5Handle dataset(
      H5Dcreate2(group, name, file_type, space, H5P_DEFAULT, column_properties(elements), H5P_DEFAULT),
      H5Dclose, "creating a column");
  if (elements > 0)
    checked(H5Dwrite(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "writing a column");
}

/// Writes the columns that the frame has. A frame without particles cannot tell which it lacks: it gets all
/// that a run writes, because ParaView shows only what the first frame has.
template <class Columns>
void write_columns(hid_t group, const ParticleFrame& frame, const Columns& columns, hid_t file_type,
                   hid_t memory_type) {
  for (const auto& column : columns) {
    const auto& values = frame.*column.values;
    const bool density = std::strcmp(column.name, "density") == 0;
    if (values.empty() && (frame.size() > 0 || density)) continue;
    write_column(group, column.name, file_type, memory_type, values.data(), values.size());
  }
}

void write_header(hid_t group, const ParticleFrame& frame) {
  write_attribute(group, "TimeValue", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, &frame.time, 1);
  write_attribute(group, "step", H5T_STD_I64LE, H5T_NATIVE_INT64, &frame.step, 1);
  const std::int64_t checksum = layout::checksum(frame);
  write_attribute(group, "checksum", H5T_STD_I64LE, H5T_NATIVE_INT64, &checksum, 1);
  std::array<std::int32_t, 3> periodic{};
  std::copy(frame.periodic.begin(), frame.periodic.end(), periodic.begin());
  write_attribute(group, "periodic", H5T_STD_I32LE, H5T_NATIVE_INT32, periodic.data(), 3);
  if (!frame.bounds) return;
  const Vec3d& lo = frame.bounds->lo;
  const Vec3d& hi = frame.bounds->hi;
  const std::array<double, 6> bounds{lo.x, hi.x, lo.y, hi.y, lo.z, hi.z};
  write_attribute(group, "bounds", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, bounds.data(), 6);
}

void write_walls(hid_t group, const std::string& name, const std::vector<WallPose>& walls) {
  if (walls.empty()) return;
  std::size_t name_bytes = 1;
  for (const WallPose& wall : walls) name_bytes = std::max(name_bytes, wall.name.size());
  const Hdf5Handle type = layout::wall_type(name_bytes);
  const std::size_t row_bytes = H5Tget_size(type);
  std::vector<char> table(row_bytes * walls.size(), '\0');
  for (std::size_t i = 0; i < walls.size(); ++i) {
    char* row = table.data() + i * row_bytes;
    const layout::WallRow wall = layout::wall_row(walls[i].shape);
    std::memcpy(row, walls[i].name.data(), walls[i].name.size());
    std::memcpy(row + name_bytes, wall.kind, std::strlen(wall.kind));
    std::memcpy(row + name_bytes + layout::kWallKindBytes, wall.values.data(), sizeof wall.values);
  }
  const Hdf5Handle space = simple_space(walls.size());
  const Hdf5Handle dataset(
      H5Dcreate2(group, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose,
      "creating a wall table");
  checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, table.data()), "writing a wall table");
}

void write_frame(hid_t file, std::int64_t number, const ParticleFrame& frame) {
  const std::string name = layout::step_name(number);
  const Hdf5Handle group(H5Gcreate2(file, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                         "creating a frame");
  write_header(group, frame);
  write_columns(group, frame, layout::kReal, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE);
  write_columns(group, frame, layout::kLong, H5T_STD_I64LE, H5T_NATIVE_INT64);
  write_columns(group, frame, layout::kShort, H5T_STD_I32LE, H5T_NATIVE_INT32);
  const Hdf5Handle walls(H5Gopen2(file, layout::kWallGroup, H5P_DEFAULT), H5Gclose, "opening the walls");
  write_walls(walls, name, frame.walls);
}

void write_empty_trajectory(const fs::path& path) {
  GuardedFile guarded(path, GuardedFile::Mode::create);
  write_guarded(path, guarded, [](hid_t file) {
    write_text_attribute(file, "format", layout::kFormat);
    write_attribute(file, "version", H5T_STD_I64LE, H5T_NATIVE_INT64, &layout::kVersion, 1);
    write_text_attribute(
        file, "units",
        "TimeValue s; x y z radius bounds Walls m; velocity_0..2 m/s; omega_0..2 rad/s; density kg/m^3");
    Hdf5Handle(H5Gcreate2(file, layout::kWallGroup, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
               "creating the walls");
  });
}

/// Runs change(file) on the trajectory: all of it takes effect, or nothing. True in `done` once it will
/// survive, which may be before a late failure is thrown.
void change_file(const fs::path& path, bool& done, const std::function<void(hid_t)>& change) {
  try {
    GuardedFile guarded(path, GuardedFile::Mode::change);
    try {
      write_guarded(path, guarded, change);
      done = true;
    } catch (...) {
      done = guarded.committed();
      throw;
    }
  } catch (const std::system_error& error) {
    cannot_write(path, system_reason(error.code().value()));
  }
}

/// Frames are not appended to what other programs, or later versions of this one, wrote.
void require_ours(const fs::path& path) {
  const TrajectoryReader readable(path);  // names every other defect
  const Hdf5Session session;
  GuardedFile guarded(path, GuardedFile::Mode::read);
  std::string format;
  std::int64_t version = 0;
  try {
    const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, guarded_access(guarded)), H5Fclose,
                          "opening the file");
    format = read_text_attribute(file, "format");
    read_attribute(file, "version", H5T_NATIVE_INT64, &version, 1);
  } catch (const Hdf5Error&) {
    format.clear();
  }
  if (format != layout::kFormat || version != layout::kVersion)
    throw InputError(path.string() +
                     ": not a trajectory that this version can continue; choose another folder");
}

}  // namespace

TrajectoryWriter TrajectoryWriter::create(const fs::path& path) {
  try {
    remove_file(GuardedFile::journal_of(path));  // first: it must not be replayed on the new file
  } catch (const std::system_error& error) {
    cannot_write(path, system_reason(error.code().value()));
  }
  write_atomically(path, write_empty_trajectory);
  return TrajectoryWriter(path);
}

TrajectoryWriter TrajectoryWriter::resume(const fs::path& path, double keep_until) {
  if (!fs::exists(path)) return create(path);
  require_ours(path);
  TrajectoryWriter writer(path);
  std::int64_t frames = 0;
  {
    const TrajectoryReader reader(path);
    frames = reader.frames();
    while (writer.frames_ < frames && !(reader.time(writer.frames_) > keep_until)) ++writer.frames_;
  }
  if (writer.frames_ == frames) return writer;
  bool done = false;
  change_file(path, done, [&](hid_t file) {
    const Hdf5Handle walls(H5Gopen2(file, layout::kWallGroup, H5P_DEFAULT), H5Gclose, "opening the walls");
    for (std::int64_t frame = writer.frames_; frame < frames; ++frame) {
      const std::string name = layout::step_name(frame);
      checked(H5Ldelete(file, name.c_str(), H5P_DEFAULT), "dropping a frame");
      if (checked(H5Lexists(walls, name.c_str(), H5P_DEFAULT), "looking for a wall table") > 0)
        checked(H5Ldelete(walls, name.c_str(), H5P_DEFAULT), "dropping a wall table");
    }
  });
  return writer;
}

void TrajectoryWriter::append(const ParticleFrame& frame) {
  check_lengths(path_, frame);
  bool done = false;
  try {
    change_file(path_, done, [&](hid_t file) { write_frame(file, frames_, frame); });
  } catch (...) {
    if (done) ++frames_;
    throw;
  }
  ++frames_;
}

}  // namespace interstice::io
