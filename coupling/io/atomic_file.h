// Files that appear under their final name only when whole.
#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace interstice::io {

/// Calls write(temporary path beside `path`), flushes that file to the disk and renames it to `path`.
/// On any failure the temporary is removed and RunError("cannot write PATH: reason") thrown.
void write_atomically(const std::filesystem::path& path,
                      const std::function<void(const std::filesystem::path&)>& write);

/// The same for a text known in full.
void write_text_atomically(const std::filesystem::path& path, std::string_view text);

}  // namespace interstice::io
