// The few POSIX file calls that the writers need, with every failure turned into a thrown errno. C++ streams
// hide the reason of a failure and cannot flush to the disk.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

namespace interstice::io {

/// The reason of a failed system call in words a user can act on ("the disk is full (No space left on
/// device)").
std::string system_reason(int error);

/// An open file; closed with the object. The calls retry when a signal interrupts them and throw
/// std::system_error.
class PosixFile {
 public:
  PosixFile(const std::filesystem::path& path, int flags, mode_t mode = 0666);
  ~PosixFile();
  PosixFile(PosixFile&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  PosixFile& operator=(PosixFile&&) = delete;

  void write(std::uint64_t offset, const void* data, std::size_t bytes) const;
  /// Bytes read: fewer than asked only at the end of the file.
  std::size_t read(std::uint64_t offset, void* data, std::size_t bytes) const;
  std::uint64_t size() const;
  void truncate(std::uint64_t size) const;
  void sync() const;  ///< flushes data and length to the disk
  void close();       ///< the last place where a network file system reports a failed write
  int descriptor() const { return descriptor_; }

 private:
  int descriptor_ = -1;
};

/// Renames over any file of that name.
void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);
/// Removes a file; a missing one is none the less removed.
void remove_file(const std::filesystem::path& path);

/// A change of the disk that is about to happen: a write (`data` set), or a cut, a flush, a rename, a
/// removal.
struct DiskChange {
  int descriptor;
  std::uint64_t offset;
  const void* data;
  std::size_t bytes;
};

/// Null but in tests, which put here a function that is called before every change and may throw (a failing
/// disk) or never return (a kill): so each point at which a writer can be stopped is tried, not a random few.
extern void (*before_disk_change)(const DiskChange&);

/// Makes names created in, renamed in or removed from `folder` durable. Does nothing where the file system
/// cannot.
void sync_folder(const std::filesystem::path& folder);

/// The folder that holds `path` ("." for a bare name).
std::filesystem::path folder_of(const std::filesystem::path& path);

}  // namespace interstice::io
