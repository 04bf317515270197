// What a test wants to know of a PNG: that it is whole, and how large.
#pragma once

#include <array>
#include <filesystem>
#include <optional>

#include "tests/coupling/figures/temporary_folder.h"

namespace interstice::fixtures {

/// Width and height [px], from the IHDR chunk; nothing where the file does not begin and end as a PNG does.
inline std::optional<std::array<unsigned, 2>> png_size(const std::filesystem::path& path) {
  const std::string bytes = content(path);
  if (bytes.size() < 45 || bytes.substr(0, 8) != "\x89PNG\r\n\x1a\n" || bytes.substr(12, 4) != "IHDR" ||
      bytes.substr(bytes.size() - 8, 4) != "IEND") {
    return std::nullopt;
  }
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  return std::array{number(16), number(20)};
}

}  // namespace interstice::fixtures
