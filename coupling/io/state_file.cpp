// Layout: groups /real, /integer and /text with one dataset per entry; after the HDF5 content a trailer with
// the length and the checksum of all that precedes it. HDF5 ignores what lies beyond its end of file, and the
// reader checks the trailer before it lets the library look at the file: a damaged checkpoint is refused,
// never half understood.
#include "coupling/io/state_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <zlib.h>

#include <array>
#include <cstring>
#include <new>

#include "base/error.h"
#include "coupling/io/atomic_file.h"
#include "coupling/io/hdf5_handles.h"
#include "coupling/io/posix_file.h"
#include "coupling/io/rollback_file_driver.h"

namespace interstice::io {

namespace {

namespace fs = std::filesystem;

constexpr const char* kFormat = "interstice-state";
constexpr std::int64_t kVersion = 1;

struct Trailer {
  std::array<char, 8> mark;
  std::uint64_t length;  // bytes before the trailer
  std::uint64_t checksum;
};
static_assert(sizeof(Trailer) == 24);
constexpr std::array<char, 8> kTrailerMark{'I', 'N', 'T', 'R', 'S', 'T', 'A', 'T'};

std::uint64_t checksum(const PosixFile& file, std::uint64_t length) {
  std::vector<unsigned char> buffer(std::size_t{1} << 20);
  uLong crc = ::crc32(0, nullptr, 0);
  for (std::uint64_t at = 0; at < length;) {
    const std::size_t n = file.read(at, buffer.data(), std::min<std::uint64_t>(buffer.size(), length - at));
    if (n == 0) break;
    crc = ::crc32(crc, buffer.data(), static_cast<uInt>(n));
    at += n;
  }
  return crc;
}

/// A slash would nest, an empty name or a dot is refused by HDF5: these are written as %XX.
std::string dataset_name(const std::string& key) {
  static constexpr const char* digits = "0123456789ABCDEF";
  std::string name;
  for (const char c : key) {
    if (c == '/' || c == '%' || c == '.' || c == '\0')
      name.append(
          {'%', digits[static_cast<unsigned char>(c) >> 4], digits[static_cast<unsigned char>(c) & 15]});
    else
      name += c;
  }
  return name.empty() ? "%" : name;
}

std::string key_of(const std::string& name) {
  std::string key;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name[i] != '%') {
      key += name[i];
    } else if (i + 2 < name.size()) {
      key += static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16));
      i += 2;
    }
  }
  return key;
}

void write_dataset(hid_t group, const std::string& key, hid_t type, hid_t space, const void* data) {
  const Hdf5Handle dataset(
      H5Dcreate2(group, dataset_name(key).c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Dclose, "creating an array");
  if (H5Sget_simple_extent_npoints(space) > 0)
    checked(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "writing an array");
}

Hdf5Handle create_group(hid_t file, const char* name) {
  return Hdf5Handle(H5Gcreate2(file, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose,
                    "creating a group");
}

void write_content(hid_t file, const State& state) {
  write_text_attribute(file, "format", kFormat);
  write_attribute(file, "version", H5T_STD_I64LE, H5T_NATIVE_INT64, &kVersion, 1);
  const Hdf5Handle real = create_group(file, "real");
  for (const auto& [key, values] : state.real)
    write_dataset(real, key, H5T_IEEE_F64LE, simple_space(values.size()), values.data());
  const Hdf5Handle integer = create_group(file, "integer");
  for (const auto& [key, values] : state.integer)
    write_dataset(integer, key, H5T_STD_I64LE, simple_space(values.size()), values.data());
  const Hdf5Handle texts = create_group(file, "text");
  for (const auto& [key, text] : state.text) {
    const Hdf5Handle space(H5Screate(text.empty() ? H5S_NULL : H5S_SCALAR), H5Sclose, "describing a text");
    write_dataset(texts, key, text_type(text.size()), space, text.data());
  }
}

void append_trailer(const fs::path& path) {
  const PosixFile file(path, O_RDWR);
  const std::uint64_t length = file.size();
  const Trailer trailer{kTrailerMark, length, checksum(file, length)};
  file.write(length, &trailer, sizeof trailer);
}

herr_t collect_name(hid_t, const char* name, const H5L_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

/// Calls read(dataset, key, elements) for every dataset of a group.
template <class Read>
void for_each_dataset(hid_t file, const char* group_name, const Read& read) {
  const Hdf5Handle group(H5Gopen2(file, group_name, H5P_DEFAULT), H5Gclose, "opening a group");
  std::vector<std::string> names;
  checked(H5Literate(group, H5_INDEX_NAME, H5_ITER_INC, nullptr, collect_name, &names), "listing a group");
  for (const std::string& name : names) {
    const Hdf5Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, "opening an array");
    const Hdf5Handle space(H5Dget_space(dataset), H5Sclose, "reading an array's size");
    const hssize_t elements = checked(H5Sget_simple_extent_npoints(space), "reading an array's size");
    read(dataset, key_of(name), static_cast<std::size_t>(elements));
  }
}

template <class Value>
void read_arrays(hid_t file, const char* group, hid_t type,
                 std::map<std::string, std::vector<Value>>& arrays) {
  for_each_dataset(file, group, [&](hid_t dataset, const std::string& key, std::size_t elements) {
    std::vector<Value>& values = arrays[key];
    values.resize(elements);
    if (elements > 0)
      checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), "reading an array");
  });
}

void read_texts(hid_t file, std::map<std::string, std::string>& texts) {
  for_each_dataset(file, "text", [&](hid_t dataset, const std::string& key, std::size_t elements) {
    std::string& text = texts[key];
    if (elements == 0) return;
    const Hdf5Handle type(H5Dget_type(dataset), H5Tclose, "reading a text's type");
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0 || elements != 1)
      throw Hdf5Error("reading a text failed: it is stored in an unknown way");
    text.resize(H5Tget_size(type));
    checked(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "reading a text");
  });
}

State read_content(const fs::path& path) {
  const Hdf5Session session;
  const Hdf5Handle access = oldest_format_access();
  const Hdf5Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose, "opening the file");
  if (read_text_attribute(file, "format") != kFormat)
    throw InputError(path.string() + ": not a state file of this program; give the checkpoint.h5 of a run");
  std::int64_t version = 0;
  read_attribute(file, "version", H5T_NATIVE_INT64, &version, 1);
  if (version != kVersion)
    throw InputError(path.string() + ": state file of version " + std::to_string(version) +
                     "; this program reads version " + std::to_string(kVersion) +
                     "; resume with the program that wrote it");
  State state;
  read_arrays(file, "real", H5T_NATIVE_DOUBLE, state.real);
  read_arrays(file, "integer", H5T_NATIVE_INT64, state.integer);
  read_texts(file, state.text);
  return state;
}

/// Refuses what is not exactly the file that write_state() wrote.
void check_whole(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode))
    throw InputError(path.string() + ": not a file; give the checkpoint.h5 of a run");
  const PosixFile file(path, O_RDONLY);
  static constexpr std::array<char, 8> signature{'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  std::array<char, 8> head{};
  file.read(0, head.data(), head.size());
  if (head != signature)
    throw InputError(path.string() + ": not a state file of this program; give the checkpoint.h5 of a run");
  const std::uint64_t size = file.size();
  Trailer trailer{};
  if (size > sizeof trailer) file.read(size - sizeof trailer, &trailer, sizeof trailer);
  if (trailer.mark != kTrailerMark || trailer.length != size - sizeof trailer ||
      trailer.checksum != checksum(file, trailer.length))
    throw InputError(
        path.string() +
        ": truncated, damaged or no state file (its checksum is wrong); use another copy or start anew");
}

}  // namespace

void write_state(const fs::path& path, const State& state) {
  write_atomically(path, [&](const fs::path& temporary) {
    {
      GuardedFile guarded(temporary, GuardedFile::Mode::create);
      write_guarded(temporary, guarded, [&](hid_t file) { write_content(file, state); });
    }
    append_trailer(temporary);
  });
}

State read_state(const fs::path& path) {
  try {
    check_whole(path);
    return read_content(path);
  } catch (const std::system_error& error) {
    throw InputError(path.string() + ": cannot be read: " + system_reason(error.code().value()) +
                     "; check the name and the permissions");
  } catch (const Hdf5Error& error) {
    throw InputError(path.string() + ": not a readable state file: " + error.what() +
                     "; use another copy or start anew");
  }
}

}  // namespace interstice::io
