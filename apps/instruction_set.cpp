#include "apps/instruction_set.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "base/version.h"

namespace interstice::apps {
namespace {

namespace fs = std::filesystem;

/// Set when a program has taken over, which must not look for another again.
constexpr const char* kTakenOver = "INTERSTICE_TAKEN_OVER";

char** call = nullptr;

/// The levels of the x86-64 ABI, poorest first.
struct Level {
  const char* name;
  bool here;  // does this machine have it?
};
std::vector<Level> levels() {
  return {{"x86-64", true},
          {"x86-64-v2", __builtin_cpu_supports("x86-64-v2") != 0},
          {"x86-64-v3", __builtin_cpu_supports("x86-64-v3") != 0},
          {"x86-64-v4", __builtin_cpu_supports("x86-64-v4") != 0}};
}

std::optional<fs::path> program_for(const std::string& level) {
  const fs::path folder = fs::read_symlink("/proc/self/exe").parent_path();
  for (const fs::path& place : {folder, folder.parent_path() / "libexec" / "interstice"}) {
    const fs::path program = place / ("interstice-" + level);
    if (::access(program.c_str(), X_OK) == 0) return program;
  }
  return std::nullopt;
}

[[noreturn]] void hand_over(const fs::path& program) {
  ::setenv(kTakenOver, "1", 1);
  ::execv(program.c_str(), call);
  throw std::runtime_error(fmt::format("{}: cannot be run: {}", program.string(), std::strerror(errno)));
}

void hand_over_to_richest() {
  const std::string own = *kBuildArch ? kBuildArch : "x86-64";
  const std::vector<Level> all = levels();
  for (auto level = all.rbegin(); level != all.rend() && level->name != own; ++level) {
    if (!level->here) continue;
    if (const auto program = program_for(level->name)) hand_over(*program);
  }
}

bool is_level(const std::string& name) {
  for (const Level& level : levels())
    if (level.name == name) return true;
  return false;
}

}  // namespace

void note_call(char** arguments) { call = arguments; }

void run_on_instruction_set(const std::string& asked) {
  const bool taken_over = std::getenv(kTakenOver) != nullptr;
  ::unsetenv(kTakenOver);
  if (asked == kBuildArch) return;
  if (asked == "auto") {
    // A program made for one machine is the best there: `native`, or the name of a processor.
    if (!taken_over && (!*kBuildArch || is_level(kBuildArch))) hand_over_to_richest();
    return;
  }
  std::vector<std::string> allowed{"auto"};
  if (*kBuildArch) allowed.emplace_back(kBuildArch);
  for (const Level& level : levels()) {
    const auto program = taken_over ? std::nullopt : program_for(level.name);
    if (level.name == asked && program && level.here) hand_over(*program);
    if (level.name == asked && program)
      throw InputError(
          fmt::format("--isa: this machine does not have {}; allowed: auto; leave the option out", asked));
    if (program && level.here && level.name != std::string_view(kBuildArch)) allowed.emplace_back(level.name);
  }
  throw InputError(
      fmt::format("--isa: no program for '{}' is here; allowed: {}; leave the option out, or build with "
                  "-DINTERSTICE_ARCH={}",
                  asked, fmt::join(allowed, ", "), asked));
}

}  // namespace interstice::apps
