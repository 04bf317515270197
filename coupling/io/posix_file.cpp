#include "coupling/io/posix_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace interstice::io {

namespace {

[[noreturn]] void fail(int error) { throw std::system_error(error, std::generic_category()); }

/// Calls `call` until no signal interrupts it.
template <class Call>
auto uninterrupted(const Call& call) {
  auto result = call();
  while (result < 0 && errno == EINTR) result = call();
  return result;
}

void announce(int descriptor = -1, std::uint64_t offset = 0, const void* data = nullptr,
              std::size_t bytes = 0) {
  if (before_disk_change != nullptr) before_disk_change({descriptor, offset, data, bytes});
}

/// One call moves at most this much: Linux cuts off at 2^31 - 4096 bytes, some network file systems far
/// earlier.
constexpr std::size_t kLargestTransfer = std::size_t{1} << 30;

}  // namespace

void (*before_disk_change)(const DiskChange&) = nullptr;

std::string system_reason(int error) {
  const std::string words = std::generic_category().message(error);
  if (error == ENOSPC) return "the disk is full (" + words + "); free some space or choose another folder";
  if (error == EDQUOT)
    return "your disk quota is used up (" + words + "); free some space or choose another folder";
  return words;
}

PosixFile::PosixFile(const std::filesystem::path& path, int flags, mode_t mode)
    : descriptor_(uninterrupted([&] { return ::open(path.c_str(), flags | O_CLOEXEC, mode); })) {
  if (descriptor_ < 0) fail(errno);
}

PosixFile::~PosixFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void PosixFile::write(std::uint64_t offset, const void* data, std::size_t bytes) const {
  announce(descriptor_, offset, data, bytes);
  const char* from = static_cast<const char*>(data);
  while (bytes > 0) {
    const ssize_t n = uninterrupted([&] {
      return ::pwrite(descriptor_, from, std::min(bytes, kLargestTransfer), static_cast<off_t>(offset));
    });
    if (n < 0) fail(errno);
    if (n == 0) fail(EIO);
    from += n;
    offset += static_cast<std::uint64_t>(n);
    bytes -= static_cast<std::size_t>(n);
  }
}

std::size_t PosixFile::read(std::uint64_t offset, void* data, std::size_t bytes) const {
  char* to = static_cast<char*>(data);
  std::size_t done = 0;
  while (done < bytes) {
    const ssize_t n = uninterrupted([&] {
      return ::pread(descriptor_, to + done, std::min(bytes - done, kLargestTransfer),
                     static_cast<off_t>(offset + done));
    });
    if (n < 0) fail(errno);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

std::uint64_t PosixFile::size() const {
  struct stat status {};
  if (::fstat(descriptor_, &status) != 0) fail(errno);
  return static_cast<std::uint64_t>(status.st_size);
}

void PosixFile::truncate(std::uint64_t size) const {
  announce(descriptor_, size);
  if (uninterrupted([&] { return ::ftruncate(descriptor_, static_cast<off_t>(size)); }) != 0) fail(errno);
}

void PosixFile::sync() const {
  announce(descriptor_);
  if (uninterrupted([&] { return ::fsync(descriptor_); }) == 0) return;
  if (errno != EINVAL && errno != ENOTSUP) fail(errno);  // a pipe or a file system without flushing
}

void PosixFile::close() {
  const int descriptor = descriptor_;
  descriptor_ = -1;  // never closed twice: after a failed close the descriptor is gone all the same
  if (descriptor >= 0 && ::close(descriptor) != 0 && errno != EINTR) fail(errno);
}

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  announce();
  if (::rename(from.c_str(), to.c_str()) != 0) fail(errno);
}

void remove_file(const std::filesystem::path& path) {
  announce();
  if (::unlink(path.c_str()) != 0 && errno != ENOENT) fail(errno);
}

void sync_folder(const std::filesystem::path& folder) {
  try {
    PosixFile(folder, O_RDONLY | O_DIRECTORY).sync();
  } catch (const std::system_error& error) {
    if (error.code().value() != EACCES) throw;  // a folder one may write but not list
  }
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
  return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace interstice::io
