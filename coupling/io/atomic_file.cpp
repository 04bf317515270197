#include "coupling/io/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <new>
#include <string>

#include "base/error.h"
#include "coupling/io/posix_file.h"

namespace interstice::io {

namespace {

namespace fs = std::filesystem;

std::string host_name() {
  std::array<char, 256> buffer{};
  if (::gethostname(buffer.data(), buffer.size() - 1) != 0) return "host";
  std::string name(buffer.data());
  std::erase_if(name, [](unsigned char c) { return std::isalnum(c) == 0; });
  return name.substr(0, 40);
}

/// `.NAME.tmp-HOST-`, to which the process and a count are added. NAME is cut so that the whole stays a legal
/// name.
std::string temporary_prefix(const fs::path& path) {
  std::string prefix(1, '.');
  return prefix.append(path.filename().string(), 0, 150).append(".tmp-").append(host_name()).append("-");
}

/// Hidden, beside `path` (a rename must not cross file systems), unlike any other in use on any host, and
/// with the extension of `path`, by which some libraries choose the format.
fs::path temporary_beside(const fs::path& path) {
  static std::atomic<unsigned> count{0};
  const std::string name =
      temporary_prefix(path) + std::to_string(::getpid()) + "-" + std::to_string(count++);
  return folder_of(path) / (name + path.extension().string());
}

/// Removes the temporaries that killed processes of this host left for the same `path`.
void remove_abandoned(const fs::path& path) {
  const std::string prefix = temporary_prefix(path);
  std::error_code ignored;
  fs::directory_iterator entry(folder_of(path), ignored);
  for (; !ignored && entry != fs::directory_iterator(); entry.increment(ignored)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(prefix)) continue;
    long process = 0;
    const char* end = name.data() + name.size();
    const auto [next, error] = std::from_chars(name.data() + prefix.size(), end, process);
    if (error != std::errc() || next == end || *next != '-' || process <= 0) continue;
    if (::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH) {
      std::error_code failed;
      fs::remove(entry->path(), failed);
    }
  }
}

/// Removes the temporary unless it has been renamed.
struct Temporary {
  fs::path path;
  bool renamed = false;

  ~Temporary() {
    std::error_code ignored;
    if (!renamed) fs::remove(path, ignored);
  }
};

[[noreturn]] void cannot_write(const fs::path& path, const std::string& reason) {
  throw RunError("cannot write " + path.string() + ": " + reason);
}

/// A writer's own message, with the name the user knows in place of the temporary's, and said once only.
[[noreturn]] void rethrow_named(const fs::path& path, const fs::path& temporary, std::string reason) {
  const std::string hidden = temporary.string();
  for (auto at = reason.find(hidden); at != std::string::npos; at = reason.find(hidden))
    reason.replace(at, hidden.size(), path.string());
  if (reason.starts_with("cannot write ")) throw RunError(reason);
  cannot_write(path, reason);
}

}  // namespace

void write_atomically(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  const fs::path folder = folder_of(path);
  std::error_code failed;
  if (!fs::is_directory(folder, failed)) cannot_write(path, "there is no folder " + folder.string());
  if (fs::is_directory(path, failed)) cannot_write(path, "a folder has this name");
  remove_abandoned(path);
  Temporary temporary{temporary_beside(path)};
  try {
    write(temporary.path);
    PosixFile file(temporary.path, O_RDWR);
    file.sync();
    file.close();
    rename_file(temporary.path, path);
    temporary.renamed = true;
    sync_folder(folder);
  } catch (const InputError&) {
    throw;  // not a failure of writing: the text of these is already the user's
  } catch (const UnstableError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::system_error& error) {
    const bool from_errno = error.code().category() == std::generic_category() ||
                            error.code().category() == std::system_category();
    cannot_write(path, from_errno ? system_reason(error.code().value()) : std::string(error.what()));
  } catch (const std::exception& error) {
    rethrow_named(path, temporary.path, error.what());
  }
}

void write_text_atomically(const fs::path& path, std::string_view text) {
  write_atomically(path, [&](const fs::path& temporary) {
    PosixFile file(temporary, O_WRONLY | O_CREAT | O_EXCL);
    file.write(0, text.data(), text.size());
    file.close();
  });
}

}  // namespace interstice::io
