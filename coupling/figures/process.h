// Another program, started without a shell and never waited for longer than it was given.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace interstice::figures {

struct ProcessResult {
  int status = 0;          // exit status; 128 + signal where a signal ended it
  bool timed_out = false;  // killed after the time-out
  std::string errors;      // what it wrote to standard error (the first 64 KiB)
};

/// The full path of `program` on PATH (read at each call), if it is there and can be executed.
std::optional<std::filesystem::path> find_program(const std::string& program);

/// Runs `program` with `arguments` in `folder`, standard input and output on /dev/null. It gets a process
/// group of its own, so that Ctrl-C at the terminal stops the simulation in good order instead of spoiling
/// its figures. Throws RunError when it cannot be started.
ProcessResult run_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                          const std::filesystem::path& folder, std::chrono::milliseconds timeout);

}  // namespace interstice::figures
