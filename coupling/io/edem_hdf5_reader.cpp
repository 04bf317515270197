#include "coupling/io/edem_hdf5_reader.h"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.h"
#include "coupling/io/columns.h"
#include "coupling/io/hdf5_handles.h"

namespace interstice::io {
namespace {

constexpr int deepest = 4;  // groups below a particle type that are searched for its radius

// Closes for good: what the library leaves open after a damaged object goes with the file.
Hdf5Handle open_plain(const std::filesystem::path& path) {
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "preparing file access");
  checked(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "preparing file access");
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, "opening the file"};
}

bool has(hid_t group, const std::string& name) { return H5Lexists(group, name.c_str(), H5P_DEFAULT) > 0; }

Hdf5Handle group_in(hid_t parent, const std::string& name) {
  if (!has(parent, name)) throw Hdf5Error("there is no group " + shown(name));
  return {H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "opening a group"};
}

std::vector<std::string> names_in(hid_t group) {
  H5G_info_t info{};
  checked(H5Gget_info(group, &info), "listing a group");
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    std::array<char, 256> name{};
    checked(
        H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT),
        "listing a group");
    names.emplace_back(name.data());
  }
  return names;
}

/// The members whose names are numbers, in their order.
std::vector<std::int64_t> numbers_in(hid_t group) {
  std::vector<std::int64_t> numbers;
  for (const auto& name : names_in(group)) {
    std::int64_t number = 0;
    if (parse_number(name, number) && std::to_string(number) == name) numbers.push_back(number);
  }
  std::sort(numbers.begin(), numbers.end());
  return numbers;
}

/// All values of a dataset or an attribute of `components` numbers a row. HDF5 deflates at most 1032 times:
/// more values than that are damage, and must not become an allocation.
struct Values {
  std::vector<double> numbers;
  bool floats = false;  // kept in 32 bits
};

Values values_of(hid_t parent, const std::string& name, std::size_t components) {
  if (!has(parent, name)) throw Hdf5Error("there is no dataset " + shown(name));
  const Hdf5Handle set(H5Dopen2(parent, name.c_str(), H5P_DEFAULT), H5Dclose, "opening a dataset");
  const Hdf5Handle space(H5Dget_space(set), H5Sclose, "reading a dataset's size");
  const Hdf5Handle type(H5Dget_type(set), H5Tclose, "reading a dataset's type");
  const H5T_class_t kind = H5Tget_class(type);
  std::array<hsize_t, 2> size{0, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1 || rank > 2 || (kind != H5T_FLOAT && kind != H5T_INTEGER)) {
    throw Hdf5Error(fmt::format("dataset {} is no table of numbers", shown(name)));
  }
  checked(H5Sget_simple_extent_dims(space, size.data(), nullptr), "reading a dataset's size");
  if (size[1] != components) {
    throw Hdf5Error(
        fmt::format("dataset {} has {} numbers a particle, {} are due", shown(name), size[1], components));
  }
  const double bytes = static_cast<double>(size[0]) * static_cast<double>(components * H5Tget_size(type));
  if (bytes > 1100.0 * static_cast<double>(H5Dget_storage_size(set)) + 65536.0) {
    throw Hdf5Error(fmt::format("dataset {} is longer than the file can hold", shown(name)));
  }
  Values values;
  values.floats = kind == H5T_FLOAT && H5Tget_size(type) == sizeof(float);
  values.numbers.resize(static_cast<std::size_t>(size[0]) * components);
  checked(H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.numbers.data()),
          "reading a dataset");
  return values;
}

std::string letters_of(const std::string& name) {
  std::string out;
  for (const char c : name) {
    if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
    if (c >= 'a' && c <= 'z') out += c;
  }
  return out;
}

/// Radii by name, wherever below a particle type they are.
using Radii = std::map<std::string, std::vector<double>>;

void add_attributes(hid_t object, Radii& radii) {
  for (const char* name : {"rawRadius", "raw radius", "RawRadius", "physicalRadius", "physical radius",
                           "PhysicalRadius", "radius", "Radius"}) {
    double value = 0;
    if (read_attribute(object, name, H5T_NATIVE_DOUBLE, &value, 1)) radii[letters_of(name)].push_back(value);
  }
}

void add_radii(hid_t group, int depth, Radii& radii) {
  add_attributes(group, radii);
  for (const auto& name : names_in(group)) {
    const Hdf5Handle object(H5Oopen(group, name.c_str(), H5P_DEFAULT), H5Oclose, "opening a particle type");
    const H5I_type_t kind = H5Iget_type(object);
    const std::string letters = letters_of(name);
    if (kind == H5I_GROUP && depth < deepest) add_radii(object, depth + 1, radii);
    if (kind == H5I_DATASET &&
        (letters == "rawradius" || letters == "physicalradius" || letters == "radius")) {
      const auto values = values_of(group, name, 1).numbers;
      radii[letters].insert(radii[letters].end(), values.begin(), values.end());
    }
  }
}

double raw_radius(hid_t file, const std::string& type) {
  const Hdf5Handle creator = group_in(group_in(file, "CreatorData"), "0");
  Radii radii;
  for (const char* folder : {"ParticleTypes", "Particles"}) {
    if (!has(creator, folder)) continue;
    const Hdf5Handle types = group_in(creator, folder);
    if (has(types, type)) add_radii(group_in(types, type), 0, radii);
  }
  for (const char* name : {"rawradius", "physicalradius", "radius"}) {
    const auto it = radii.find(name);
    if (it == radii.end()) continue;
    if (it->second.size() != 1) {
      throw Hdf5Error(fmt::format("particle type {} is made of {} spheres, single spheres are read",
                                  shown(type), it->second.size()));
    }
    if (std::isfinite(it->second[0]) && it->second[0] > 0) return it->second[0];
    throw Hdf5Error(fmt::format("the radius of particle type {} is not positive", shown(type)));
  }
  throw Hdf5Error(fmt::format("CreatorData/0 says no radius of particle type {}", shown(type)));
}

/// One particle type of one time step, behind what `frame` already has. Returns the farthest coordinate where
/// positions are floats, else 0.
double append_type(hid_t group, double radius, std::int64_t type, double unit, ParticleFrame& frame) {
  const Values position = values_of(group, "position", 3);
  const std::size_t n = position.numbers.size() / 3;
  const Values scale = values_of(group, "scale", 1), ids = values_of(group, "ids", 1);
  const Values velocity = has(group, "velocity") ? values_of(group, "velocity", 3) : Values{};
  if (scale.numbers.size() != n || ids.numbers.size() != n ||
      (!velocity.numbers.empty() && velocity.numbers.size() != 3 * n)) {
    throw Hdf5Error("position, scale, ids and velocity differ in length");
  }
  double farthest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double* p = &position.numbers[3 * i];
    const double r = unit * radius * scale.numbers[i], id = ids.numbers[i];
    if (!std::isfinite(p[0] + p[1] + p[2]) || !std::isfinite(r) || !(r > 0) || !(std::abs(id) < 0x1p63)) {
      throw Hdf5Error(
          fmt::format("position, scale or id of particle {} is not finite, or the scale not positive", i));
    }
    for (int a = 0; a < 3; ++a) farthest = std::max(farthest, std::abs(p[a]));
    frame.x.push_back(unit * p[0]);
    frame.y.push_back(unit * p[1]);
    frame.z.push_back(unit * p[2]);
    frame.radius.push_back(r);
    frame.id.push_back(static_cast<std::int64_t>(id));
    frame.material.push_back(static_cast<std::int32_t>(type));
    if (velocity.numbers.empty()) continue;
    const double* v = &velocity.numbers[3 * i];
    if (!std::isfinite(v[0] + v[1] + v[2]))
      throw Hdf5Error(fmt::format("velocity of particle {} is not finite", i));
    frame.vx.push_back(unit * v[0]);
    frame.vy.push_back(unit * v[1]);
    frame.vz.push_back(unit * v[2]);
  }
  return position.floats ? farthest : 0;
}

class EdemHdf5Reader : public ParticleReader {
 public:
  EdemHdf5Reader(const std::filesystem::path& path, double length_unit)
      : path_(path), length_unit_(length_unit) {
    const Hdf5Session session;
    try {
      file_ = open_plain(path_);
      steps_ = numbers_in(group_in(file_, "TimestepData"));
      if (steps_.empty()) throw Hdf5Error("TimestepData has no time steps");
    } catch (const Hdf5Error& error) {
      refuse(path_.string(), error.what());
    }
  }
  ~EdemHdf5Reader() override {
    const Hdf5Session session;
    Hdf5Handle(std::move(file_));
  }

  std::string kind() const override { return "EDEM HDF5"; }
  std::int64_t frames() const override { return static_cast<std::int64_t>(steps_.size()); }

  bool next(ParticleFrame& frame) override {
    frame = ParticleFrame{};
    if (next_ >= steps_.size()) return false;
    const std::string where = fmt::format("{}: frame {}", path_.string(), next_);
    try {
      read(frame);
    } catch (const Hdf5Error& error) {
      refuse(where, error.what());
    }
    finish(frame, where, path_);
    ++next_;
    return true;
  }
  bool skip() override { return next_ < steps_.size() && ++next_ > 0; }

 private:
  [[noreturn]] static void refuse(const std::string& where, const std::string& what) {
    throw InputError(
        fmt::format("{}: not laid out as EDEM's results are expected ({}); "
                    "TimestepData/<n>/ParticleTypes/<t>/position, ids, scale and the types' radii in "
                    "CreatorData/0 are needed; export the particles as CSV from EDEM",
                    where, what));
  }

  void read(ParticleFrame& frame) {
    const Hdf5Session session;
    const Hdf5Handle step = group_in(group_in(file_, "TimestepData"), std::to_string(steps_[next_]));
    double time = 0, farthest = 0;
    if (read_attribute(step, "time", H5T_NATIVE_DOUBLE, &time, 1) && std::isfinite(time)) frame.time = time;
    frame.step = steps_[next_];
    const Hdf5Handle types = group_in(step, "ParticleTypes");
    bool velocities = true;
    for (const std::int64_t t : numbers_in(types)) {
      const std::string name = std::to_string(t);
      const Hdf5Handle type = group_in(types, name);
      if (!has(type, "position")) continue;  // a type of which there are no particles yet
      farthest = std::max(farthest, append_type(type, raw_radius(file_, name), t, length_unit_, frame));
      velocities = velocities && frame.vx.size() == frame.x.size();
    }
    if (!velocities) {  // some types only: a column is whole or not there
      for (auto* column : {&frame.vx, &frame.vy, &frame.vz}) column->clear();
    }
    position_resolution_ = length_unit_ * float_resolution(farthest);
  }

  std::filesystem::path path_;
  double length_unit_;
  Hdf5Handle file_;
  std::vector<std::int64_t> steps_;
  std::size_t next_ = 0;
};

}  // namespace

bool looks_like_edem_hdf5(const std::filesystem::path& path) {
  const Hdf5Session session;
  try {
    return has(open_plain(path), "TimestepData");
  } catch (const Hdf5Error&) {
    return false;
  }
}

std::unique_ptr<ParticleReader> open_edem_hdf5(const std::filesystem::path& path,
                                               const ReaderOptions& options) {
  if (!options.columns.empty()) {
    throw InputError(
        path.string() +
        ": --columns does not apply to EDEM's HDF5; its datasets have fixed names; leave the option out");
  }
  return std::make_unique<EdemHdf5Reader>(path, options.length_unit);
}

}  // namespace interstice::io
