#include "coupling/figures/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>

#include "base/error.h"

extern char** environ;

namespace interstice::figures {
namespace {

constexpr std::size_t kept_errors = 64 * 1024;

/// Both ends of a pipe, closed when no longer held.
struct Pipe {
  std::array<int, 2> end{-1, -1};
  Pipe() {
    if (::pipe2(end.data(), O_CLOEXEC) != 0) {
      throw RunError(fmt::format("cannot open a pipe: {}", std::strerror(errno)));
    }
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  ~Pipe() {
    close(0);
    close(1);
  }
  void close(std::size_t which) {
    if (end[which] >= 0) ::close(end[which]);
    end[which] = -1;
  }
};

/// What the child does between fork and exec.
struct SpawnPlan {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;

  SpawnPlan(const std::filesystem::path& folder, int error_end) {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, error_end, STDERR_FILENO);
    posix_spawn_file_actions_addchdir_np(&files, folder.c_str());
    sigset_t none, usual;
    sigemptyset(&none);
    sigemptyset(&usual);
    for (const int signal : {SIGINT, SIGTERM, SIGPIPE, SIGUSR1}) sigaddset(&usual, signal);
    posix_spawnattr_setpgroup(&attributes, 0);
    posix_spawnattr_setsigmask(&attributes, &none);
    posix_spawnattr_setsigdefault(&attributes, &usual);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  SpawnPlan(const SpawnPlan&) = delete;
  SpawnPlan& operator=(const SpawnPlan&) = delete;
  ~SpawnPlan() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
};

/// Takes what is in the pipe now; waits at most `patience` for the first byte.
void drain(int pipe, std::string& into, std::chrono::milliseconds patience) {
  pollfd ready{pipe, POLLIN, 0};
  while (::poll(&ready, 1, static_cast<int>(patience.count())) > 0) {
    std::array<char, 4096> buffer;
    const ssize_t got = ::read(pipe, buffer.data(), buffer.size());
    if (got <= 0) {
      if (got < 0 && errno == EINTR) continue;
      // End of file with the child still about: poll would return at once for ever, so wait the time out
      // instead.
      if (patience.count() > 0) ::usleep(static_cast<useconds_t>(patience.count()) * 1000);
      return;
    }
    const auto room = kept_errors - std::min(kept_errors, into.size());
    into.append(buffer.data(), std::min(static_cast<std::size_t>(got), room));
    patience = std::chrono::milliseconds(0);
  }
}

int status_of(int wait_status) {
  return WIFSIGNALED(wait_status) ? 128 + WTERMSIG(wait_status) : WEXITSTATUS(wait_status);
}

}  // namespace

std::optional<std::filesystem::path> find_program(const std::string& program) {
  const char* path = std::getenv("PATH");
  if (path == nullptr) return std::nullopt;
  const std::string folders = path;
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    if (end > begin) {  // an empty entry would mean the current folder: never start a program from there
      const auto candidate = std::filesystem::path(folders.substr(begin, end - begin)) / program;
      std::error_code ignored;
      if (std::filesystem::is_regular_file(candidate, ignored) && ::access(candidate.c_str(), X_OK) == 0) {
        return std::filesystem::absolute(candidate);
      }
    }
    begin = end + 1;
  }
  return std::nullopt;
}

ProcessResult run_process(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                          const std::filesystem::path& folder, std::chrono::milliseconds timeout) {
  const auto deadline = std::chrono::steady_clock::now() + timeout;
  Pipe errors;
  const SpawnPlan plan(folder, errors.end[1]);
  std::vector<char*> argv{const_cast<char*>(program.c_str())};
  for (const auto& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);

  pid_t child = 0;
  const int failed =
      ::posix_spawn(&child, program.c_str(), &plan.files, &plan.attributes, argv.data(), environ);
  if (failed != 0) {
    throw RunError(
        fmt::format("cannot start {} in {}: {}", program.string(), folder.string(), std::strerror(failed)));
  }
  errors.close(1);

  ProcessResult result;
  int wait_status = 0;
  for (;;) {
    drain(errors.end[0], result.errors, std::chrono::milliseconds(5));
    const pid_t ended = ::waitpid(child, &wait_status, WNOHANG);
    if (ended == child) break;
    if (ended < 0 && errno != EINTR) {
      throw RunError(fmt::format("lost track of {}: {}", program.string(), std::strerror(errno)));
    }
    if (!result.timed_out && std::chrono::steady_clock::now() > deadline) {
      result.timed_out = true;
      ::kill(child, SIGKILL);
    }
  }
  drain(errors.end[0], result.errors, std::chrono::milliseconds(0));
  result.status = status_of(wait_status);
  return result;
}

}  // namespace interstice::figures
