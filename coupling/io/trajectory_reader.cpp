// The reader of trajectory.h5part. It also reads H5Part files of other programs that have x, y, z and radius.
#include <algorithm>
#include <charconv>
#include <cstring>
#include <new>
#include <string_view>
#include <system_error>

#include "base/error.h"
#include "coupling/io/chunked_column.h"
#include "coupling/io/guarded_file.h"
#include "coupling/io/hdf5_handles.h"
#include "coupling/io/rollback_file_driver.h"
#include "coupling/io/trajectory.h"
#include "coupling/io/trajectory_layout.h"

namespace interstice::io {

namespace {

namespace fs = std::filesystem;

/// A frame by its place in the file. Once written it never moves, whereas the lists of names change with
/// every frame that a running simulation appends: they are read once, at the start.
struct StoredFrame {
  std::int64_t number;
  haddr_t group;
  haddr_t walls = HADDR_UNDEF;
  double time = std::numeric_limits<double>::quiet_NaN();
};

/// k of "Step#k", or -1.
std::int64_t step_number(std::string_view name) {
  constexpr std::string_view prefix = "Step#";
  std::int64_t number = -1;
  if (!name.starts_with(prefix)) return -1;
  const char* end = name.data() + name.size();
  const auto [next, error] = std::from_chars(name.data() + prefix.size(), end, number);
  return error == std::errc() && next == end ? number : -1;
}

herr_t collect_step(hid_t, const char* name, const H5L_info_t* link, void* frames) {
  const std::int64_t number = step_number(name);
  if (number >= 0 && link->type == H5L_TYPE_HARD)
    static_cast<std::vector<StoredFrame>*>(frames)->push_back({number, link->u.address});
  return 0;
}

std::vector<StoredFrame> list_steps(hid_t group) {
  std::vector<StoredFrame> steps;
  checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_step, &steps), "listing the frames");
  std::sort(steps.begin(), steps.end(), [](const auto& a, const auto& b) { return a.number < b.number; });
  return steps;
}

bool has_link(hid_t group, const char* name) {
  return checked(H5Lexists(group, name, H5P_DEFAULT), "looking for a dataset") > 0;
}

Hdf5Handle open_object(hid_t file, haddr_t address, H5I_type_t kind) {
  Hdf5Handle object(H5Oopen_by_addr(file, address), H5Oclose, "opening a frame");
  if (H5Iget_type(object) != kind) throw Hdf5Error("opening a frame failed: it is no frame");
  return object;
}

std::vector<StoredFrame> list_frames(hid_t file) {
  std::vector<StoredFrame> frames = list_steps(file);
  for (StoredFrame& frame : frames)
    read_attribute(open_object(file, frame.group, H5I_GROUP), "TimeValue", H5T_NATIVE_DOUBLE, &frame.time, 1);
  if (!has_link(file, layout::kWallGroup)) return frames;
  const Hdf5Handle group(H5Gopen2(file, layout::kWallGroup, H5P_DEFAULT), H5Gclose, "opening the walls");
  auto frame = frames.begin();
  for (const StoredFrame& table : list_steps(group)) {
    while (frame != frames.end() && frame->number < table.number) ++frame;
    if (frame != frames.end() && frame->number == table.number) frame->walls = table.group;
  }
  return frames;
}

/// The length of a 1-D dataset. Deflate shrinks at most 1032 times: a length beyond that is damage, not data,
/// and must not become an allocation.
std::size_t checked_length(hid_t dataset) {
  const Hdf5Handle space(H5Dget_space(dataset), H5Sclose, "reading a column's size");
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose, "reading a column's type");
  if (H5Sget_simple_extent_ndims(space) != 1)
    throw Hdf5Error("reading a column failed: it is not one-dimensional");
  const hssize_t length = checked(H5Sget_simple_extent_npoints(space), "reading a column's size");
  const double stored = static_cast<double>(H5Dget_storage_size(dataset));
  if (static_cast<double>(length) * static_cast<double>(H5Tget_size(type)) > 1100.0 * stored + 65536.0)
    throw Hdf5Error("reading a column failed: its length does not fit its size in the file");
  return static_cast<std::size_t>(length);
}

void read_values(hid_t dataset, hid_t memory_type, std::size_t element_bytes, std::size_t elements, bool ours,
                 void* values) {
  const Hdf5Handle type(H5Dget_type(dataset), H5Tclose, "reading a column's type");
  if (ours) {
    if (H5Tequal(type, memory_type) <= 0)
      throw Hdf5Error("reading a column failed: its type is not what was written");
    return read_own_column(dataset, element_bytes, elements, values);
  }
  if (const H5T_class_t kind = H5Tget_class(type); kind != H5T_FLOAT && kind != H5T_INTEGER)
    throw Hdf5Error("reading a column failed: it holds no numbers");
  checked(H5Dread(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values), "reading a column");
}

template <class Columns>
void read_columns(hid_t group, const Columns& columns, hid_t memory_type, bool ours, ParticleFrame& frame) {
  for (const auto& column : columns) {
    if (!has_link(group, column.name)) {
      if (layout::required(column.name))
        throw Hdf5Error(std::string("reading a frame failed: it has no column ") + column.name);
      continue;
    }
    const Hdf5Handle dataset(H5Dopen2(group, column.name, H5P_DEFAULT), H5Dclose, "opening a column");
    auto& values = frame.*column.values;
    if (checked_length(dataset) != frame.size())
      throw Hdf5Error(std::string("reading a frame failed: column ") + column.name +
                      " has another length than x");
    values.resize(frame.size());
    if (!values.empty())
      read_values(dataset, memory_type, sizeof values[0], values.size(), ours, values.data());
  }
}

void verify(hid_t group, const ParticleFrame& frame) {
  std::int64_t stored = -1;
  if (!read_attribute(group, "checksum", H5T_NATIVE_INT64, &stored, 1) || stored != layout::checksum(frame))
    throw Hdf5Error("reading a frame failed: its checksum is wrong");
}

void read_header(hid_t group, ParticleFrame& frame) {
  read_attribute(group, "TimeValue", H5T_NATIVE_DOUBLE, &frame.time, 1);
  read_attribute(group, "step", H5T_NATIVE_INT64, &frame.step, 1);
  std::array<std::int32_t, 3> periodic{};
  if (read_attribute(group, "periodic", H5T_NATIVE_INT32, periodic.data(), 3))
    for (std::size_t axis = 0; axis < 3; ++axis) frame.periodic[axis] = periodic[axis] != 0;
  std::array<double, 6> b{};
  if (read_attribute(group, "bounds", H5T_NATIVE_DOUBLE, b.data(), 6))
    frame.bounds = Box{{b[0], b[2], b[4]}, {b[1], b[3], b[5]}};
}

Shape shape_of(std::string_view kind, const std::array<double, layout::kWallValues>& v) {
  if (kind == "plane") return Plane{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  if (kind == "box") return Box{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  throw Hdf5Error("reading the walls failed: unknown shape '" + std::string(kind) +
                  "', written by a later version");
}

std::string_view text_in(const char* bytes, std::size_t size) { return {bytes, ::strnlen(bytes, size)}; }

std::vector<WallPose> read_walls(hid_t dataset) {
  const Hdf5Handle stored(H5Dget_type(dataset), H5Tclose, "reading the walls' type");
  const std::size_t fixed_bytes = layout::kWallKindBytes + layout::kWallValues * sizeof(double);
  const std::size_t row_bytes = H5Tget_size(stored);
  if (H5Tget_class(stored) != H5T_COMPOUND || row_bytes <= fixed_bytes)
    throw Hdf5Error("reading the walls failed: no wall table");
  const std::size_t name_bytes = row_bytes - fixed_bytes;
  const Hdf5Handle type = layout::wall_type(name_bytes);
  if (checked(H5Tequal(type, stored), "reading the walls' type") == 0)
    throw Hdf5Error("reading the walls failed: no wall table");
  std::vector<char> table(row_bytes * checked_length(dataset));
  checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, table.data()), "reading the walls");
  std::vector<WallPose> walls;
  for (const char* row = table.data(); row != table.data() + table.size(); row += row_bytes) {
    std::array<double, layout::kWallValues> values{};
    std::memcpy(values.data(), row + name_bytes + layout::kWallKindBytes, sizeof values);
    walls.push_back({std::string(text_in(row, name_bytes)),
                     shape_of(text_in(row + name_bytes, layout::kWallKindBytes), values)});
  }
  return walls;
}

}  // namespace

struct TrajectoryReader::Impl {
  fs::path path;
  std::optional<GuardedFile> bytes;  // outlives `file`, which reads through it
  Hdf5Handle file;
  bool ours = false;  // written by this program: then nothing may deviate from how it writes
  std::vector<StoredFrame> frames;

  const StoredFrame& at(std::int64_t frame) const {
    if (frame < 0 || frame >= static_cast<std::int64_t>(frames.size()))
      throw InputError(path.string() + ": there is no frame " + std::to_string(frame) + "; it has " +
                       std::to_string(frames.size()) + ", counted from 0");
    return frames[static_cast<std::size_t>(frame)];
  }
};

TrajectoryReader::TrajectoryReader(const fs::path& path) : impl_(std::make_unique<Impl>()) {
  std::error_code failed;
  const fs::file_status status = fs::status(path, failed);
  if (!fs::exists(status)) throw InputError(path.string() + ": there is no such file; check the name");
  if (fs::is_directory(status))
    throw InputError(path.string() + ": a folder, not a trajectory; give the trajectory.h5part in it");
  const Hdf5Session session;
  impl_->path = path;
  try {
    impl_->bytes.emplace(path, GuardedFile::Mode::read);
    impl_->file = Hdf5Handle(H5Fopen(path.c_str(), H5F_ACC_RDONLY, guarded_access(*impl_->bytes)), H5Fclose,
                             "opening the file");
    impl_->ours = read_text_attribute(impl_->file, "format") == layout::kFormat;
    impl_->frames = list_frames(impl_->file);
    if (impl_->frames.empty() && !impl_->ours)
      throw InputError(path.string() +
                       ": an HDF5 file without frames (groups Step#0, Step#1, ...); give a trajectory");
    impl_->bytes->unlock();
  } catch (const Hdf5Error& error) {
    throw InputError(path.string() + ": no readable trajectory: " + error.what() +
                     "; if it was copied or moved, do so again together with its .journal");
  } catch (const std::system_error& error) {
    throw InputError(path.string() + ": cannot be read: " + system_reason(error.code().value()) +
                     "; check the permissions");
  }
}

TrajectoryReader::~TrajectoryReader() {
  if (!impl_) return;
  const Hdf5Session session;
  impl_.reset();
}
TrajectoryReader::TrajectoryReader(TrajectoryReader&&) noexcept = default;
TrajectoryReader& TrajectoryReader::operator=(TrajectoryReader&& other) noexcept {
  std::swap(impl_, other.impl_);
  return *this;
}

std::int64_t TrajectoryReader::frames() const { return static_cast<std::int64_t>(impl_->frames.size()); }

double TrajectoryReader::time(std::int64_t frame) const { return impl_->at(frame).time; }

ParticleFrame TrajectoryReader::read(std::int64_t frame) const {
  const StoredFrame& stored = impl_->at(frame);
  const auto damaged = [&](const std::string& reason) {
    return InputError(impl_->path.string() + ": frame " + std::to_string(frame) +
                      " cannot be read: " + reason + "; the other frames may be whole");
  };
  const Hdf5Session session;
  try {
    ParticleFrame result;
    const Hdf5Handle group = open_object(impl_->file, stored.group, H5I_GROUP);
    read_header(group, result);
    const Hdf5Handle x(H5Dopen2(group, "x", H5P_DEFAULT), H5Dclose, "opening column x");
    result.x.resize(checked_length(x));
    read_columns(group, layout::kReal, H5T_NATIVE_DOUBLE, impl_->ours, result);
    read_columns(group, layout::kLong, H5T_NATIVE_INT64, impl_->ours, result);
    read_columns(group, layout::kShort, H5T_NATIVE_INT32, impl_->ours, result);
    if (stored.walls != HADDR_UNDEF)
      result.walls = read_walls(open_object(impl_->file, stored.walls, H5I_DATASET));
    if (impl_->ours) verify(group, result);  // files of other programs have none
    return result;
  } catch (const Hdf5Error& error) {
    throw damaged(error.what());
  } catch (const std::bad_alloc&) {
    throw damaged("not enough memory for its particles");
  }
}

}  // namespace interstice::io
