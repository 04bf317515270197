#include "coupling/io/rollback_file_driver.h"

#include <array>
#include <cstring>
#include <new>

#include "base/error.h"

namespace interstice::io {

namespace {

/// What a file access property list carries.
struct Target {
  GuardedFile* file;
};

struct OpenFile : H5FD_t {
  GuardedFile* file;
  haddr_t allocated;  // HDF5's "end of allocated addresses"
};

OpenFile* ours(H5FD_t* file) { return static_cast<OpenFile*>(file); }
const OpenFile* ours(const H5FD_t* file) { return static_cast<const OpenFile*>(file); }

template <class Value>
Value value_at(const std::array<char, 64>& bytes, std::size_t offset) {
  Value value{};
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

/// The end of the content by the superblock (HDF5 File Format Specification, II.A), or the file's own size
/// where that cannot be told. A killed writer leaves the file longer than this.
std::uint64_t content_end(const GuardedFile& file) {
  std::array<char, 64> head{};
  file.read(0, head.data(), head.size());
  static constexpr std::array<char, 8> signature{'\x89', 'H', 'D', 'F', '\r', '\n', '\x1a', '\n'};
  const bool version_0 = head[8] == 0 && head[13] == 8;  // with addresses of 8 bytes
  if (std::memcmp(head.data(), signature.data(), signature.size()) != 0 || !version_0) return file.size();
  const auto base = value_at<std::uint64_t>(head, 24);
  const auto end = value_at<std::uint64_t>(head, 40);
  return base == 0 ? end : file.size();
}

// The callbacks. No exception may pass through the C library.

H5FD_t* open_file(const char*, unsigned flags, hid_t access, haddr_t) {
  const auto* target = static_cast<const Target*>(H5Pget_driver_info(access));
  if (target == nullptr) return nullptr;
  auto* open = new (std::nothrow) OpenFile{};
  if (open == nullptr) return nullptr;
  open->file = target->file;
  try {
    if ((flags & H5F_ACC_TRUNC) != 0)
      open->file->forget_beyond(0);
    else if ((flags & H5F_ACC_RDWR) != 0)
      open->file->forget_beyond(content_end(*open->file));
  } catch (...) {
    delete open;
    return nullptr;
  }
  return open;
}

herr_t close_file(H5FD_t* file) {
  delete ours(file);
  return 0;
}

/// Two opens are never the same file to HDF5: a reader may hold the trajectory open while it grows.
int compare(const H5FD_t* a, const H5FD_t* b) {
  const auto left = reinterpret_cast<std::uintptr_t>(a), right = reinterpret_cast<std::uintptr_t>(b);
  return left < right ? -1 : left > right ? 1 : 0;
}

herr_t query(const H5FD_t*, unsigned long* flags) {
  *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
           H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_allocation(const H5FD_t* file, H5FD_mem_t) { return ours(file)->allocated; }

herr_t set_end_of_allocation(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  ours(file)->allocated = address;
  return 0;
}

haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return ours(file)->file->size(); }

herr_t read_bytes(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t bytes, void* buffer) {
  try {
    ours(file)->file->read(address, buffer, bytes);
    return 0;
  } catch (...) {
    return -1;
  }
}

herr_t write_bytes(H5FD_t* file, H5FD_mem_t kind, hid_t, haddr_t address, std::size_t bytes,
                   const void* buffer) {
  ours(file)->file->write(address, buffer, bytes, kind != H5FD_MEM_DRAW);
  return 0;
}

herr_t truncate(H5FD_t* file, hid_t, hbool_t) {
  ours(file)->file->set_size(ours(file)->allocated);
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
  driver.name = "interstice_guarded";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(Target);
  driver.open = open_file;
  driver.close = close_file;
  driver.cmp = compare;
  driver.query = query;
  driver.get_eoa = end_of_allocation;
  driver.set_eoa = set_end_of_allocation;
  driver.get_eof = end_of_file;
  driver.read = read_bytes;
  driver.write = write_bytes;
  driver.truncate = truncate;
  constexpr std::array<H5FD_mem_t, H5FD_MEM_NTYPES> map = H5FD_FLMAP_DICHOTOMY;
  std::copy(map.begin(), map.end(), driver.fl_map);
  return driver;
}

hid_t driver_id() {
  static const H5FD_class_t driver = driver_class();
  static hid_t id = -1;
  if (id < 0 || H5Iis_valid(id) <= 0) id = checked(H5FDregister(&driver), "preparing file access");
  return id;
}

}  // namespace

void write_guarded(const std::filesystem::path& path, GuardedFile& guarded,
                   const std::function<void(hid_t file)>& write) {
  const Hdf5Session session;
  try {
    const Hdf5Handle access = guarded_access(guarded);
    Hdf5Handle file(guarded.size() > 0 ? H5Fopen(path.c_str(), H5F_ACC_RDWR, access)
                                       : H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access),
                    H5Fclose, "opening the file");
    write(file.get());
    file.close("closing the file");
  } catch (const Hdf5Error& error) {
    if (guarded.failure() == 0) throw RunError("cannot write " + path.string() + ": " + error.what());
  }
  guarded.commit();
}

Hdf5Handle guarded_access(GuardedFile& file) {
  Hdf5Handle access = oldest_format_access();
  const Target target{&file};
  checked(H5Pset_driver(access, driver_id(), &target), "preparing file access");
  return access;
}

}  // namespace interstice::io
