// The errors that libraries throw. Each kind is one exit status of the command (see docs/COMMANDS.md).
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace interstice {

/// What the user gave is wrong; nothing was computed or written. Exit status 2.
/// `messages` holds every error found, one line each: "file:line:column: key: what; allowed; remedy".
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<std::string> messages)
      : std::runtime_error(join(messages)), messages_(std::move(messages)) {}
  explicit InputError(const std::string& message) : InputError(std::vector<std::string>{message}) {}
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  static std::string join(const std::vector<std::string>& lines) {
    std::string all;
    for (const auto& line : lines) all += (all.empty() ? "" : "\n") + line;
    return all;
  }
  std::vector<std::string> messages_;
};

/// The run failed for a reason outside the physics: a full disk, a file that cannot be written. Exit
/// status 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The simulation became unstable or hit a limit it refuses to pass. Exit status 3.
class UnstableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace interstice
