// Ways to stop a writer: a process killed at a chosen change of the disk, a disk that fails at it.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <functional>
#include <system_error>

#include "coupling/io/posix_file.h"

namespace interstice::io::testing {

enum class Stop { before, halfway, disk_full };

inline constexpr int kKilled = 42;
inline int changes_left = 0;
inline Stop stop = Stop::before;

inline void stop_at_change(const DiskChange& change) {
  if (changes_left-- > 0) return;
  if (stop == Stop::disk_full) throw std::system_error(ENOSPC, std::generic_category());
  if (stop == Stop::halfway && change.data != nullptr) {
    [[maybe_unused]] const auto written =
        ::pwrite(change.descriptor, change.data, change.bytes / 2, static_cast<off_t>(change.offset));
  }
  ::_exit(kKilled);
}

/// From now on the process (or the disk) stops at change `n` (0: the first) of the disk.
inline void stop_after(int n, Stop how) {
  changes_left = n;
  stop = how;
  before_disk_change = stop_at_change;
}
inline void stop_never() { before_disk_change = nullptr; }

/// Runs `body` in a child process and gives its wait status; an exception there is exit status 99.
inline int in_child(const std::function<void()>& body) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      body();
    } catch (...) {
      ::_exit(99);
    }
    ::_exit(0);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

}  // namespace interstice::io::testing
