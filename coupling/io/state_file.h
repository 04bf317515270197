// A named set of arrays in one HDF5 file, written whole or not at all: the container of checkpoints.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace interstice::io {

struct State {
  std::map<std::string, std::vector<double>> real;  // bit-exact
  std::map<std::string, std::vector<std::int64_t>> integer;
  std::map<std::string, std::string> text;
};

/// Writes beside `path`, flushes to the disk, renames. Throws RunError.
void write_state(const std::filesystem::path& path, const State& state);

/// Throws InputError when the file is missing, truncated or no state file.
State read_state(const std::filesystem::path& path);

}  // namespace interstice::io
