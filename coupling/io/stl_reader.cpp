#include "coupling/io/stl_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "base/error.h"

namespace interstice::io {
namespace {

constexpr std::size_t kHeader = 84, kRecord = 50;

std::string content_of(const std::filesystem::path& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw InputError(path.string() + ": a folder; an STL file is needed; name one");
  std::ifstream file(path, std::ios::binary);
  if (!file)
    throw InputError(
        fmt::format("{}: cannot be read: {}; check the name", path.string(), std::strerror(errno)));
  std::string content;
  char buffer[1 << 16];
  while (file.read(buffer, sizeof buffer) || file.gcount() > 0)
    content.append(buffer, static_cast<std::size_t>(file.gcount()));
  return content;
}

std::uint32_t word_at(std::string_view content, std::size_t at) {
  std::uint32_t word = 0;
  for (std::size_t b = 4; b-- > 0;) word = word << 8 | static_cast<unsigned char>(content[at + b]);
  return word;
}

std::vector<voxel::Triangle> from_binary(std::string_view content, double unit) {
  const std::size_t count = word_at(content, kHeader - 4);
  std::vector<voxel::Triangle> triangles(count);
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t c = 0; c < 9; ++c) {
      const float value =
          std::bit_cast<float>(word_at(content, kHeader + t * kRecord + 12 + 4 * c));  // behind the normal
      if (!std::isfinite(value))
        throw InputError(fmt::format(
            "triangle {}: a coordinate is not finite; finite numbers are needed; the file is damaged",
            t + 1));
      triangles[t][c / 3][static_cast<int>(c % 3)] = unit * static_cast<double>(value);
    }
  return triangles;
}

/// The words of an ASCII file.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word in small letters; empty at the end.
  const std::string& next() {
    while (at_ < text_.size() && is_blank(text_[at_])) line_ += text_[at_++] == '\n';
    word_.clear();
    while (at_ < text_.size() && !is_blank(text_[at_]) && word_.size() < 64)
      word_ += static_cast<char>(std::tolower(static_cast<unsigned char>(text_[at_++])));
    return word_;
  }
  void skip_line() { at_ = std::min(text_.find('\n', at_), text_.size()); }
  void expect(const char* word) {
    if (next() != word) wrong(fmt::format("where '{}' is due", word));
  }
  double number() {
    next();
    const char* begin = word_.data() + (!word_.empty() && word_[0] == '+');
    double value = 0;
    const auto [end, error] = std::from_chars(begin, word_.data() + word_.size(), value);
    if (word_.empty() || error != std::errc() || end != word_.data() + word_.size() || !std::isfinite(value))
      wrong("where a finite number is due");
    return value;
  }
  [[noreturn]] void wrong(const std::string& what) const {
    if (word_.empty())
      throw InputError(fmt::format("line {}: the file ends {}; it is cut off; write it again", line_, what));
    throw InputError(fmt::format("line {}: '{}' {}; the file is damaged or no STL; write it again", line_,
                                 printable(), what));
  }

 private:
  static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
  std::string printable() const {
    std::string text;
    for (const char c : word_.substr(0, 24)) text += c >= ' ' && c <= '~' ? c : '?';
    return text;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::int64_t line_ = 1;
  std::string word_;
};

std::vector<voxel::Triangle> from_text(std::string_view content, double unit) {
  Words words(content);
  std::vector<voxel::Triangle> triangles;
  words.expect("solid");
  words.skip_line();
  for (bool inside = true;;) {
    const std::string word = words.next();
    if (word.empty() && !inside) return triangles;
    if (word == "solid" && !inside) {
      inside = true;
      words.skip_line();
    } else if (word == "endsolid" && inside) {
      inside = false;
      words.skip_line();
    } else if (word == "facet" && inside) {
      words.expect("normal");
      for (int n = 0; n < 3; ++n) words.next();  // not used, and some programs write no numbers there
      words.expect("outer");
      words.expect("loop");
      voxel::Triangle& triangle = triangles.emplace_back();
      for (Vec3d& corner : triangle) {
        words.expect("vertex");
        for (int axis = 0; axis < 3; ++axis) corner[axis] = unit * words.number();
      }
      words.expect("endloop");
      words.expect("endfacet");
    } else {
      words.wrong(inside ? "where 'facet' or 'endsolid' is due" : "where 'solid' or the end is due");
    }
  }
}

bool begins_with_solid(std::string_view content) {
  const std::size_t at = content.find_first_not_of(" \t\r\n");
  if (at == std::string_view::npos) return false;
  std::string word(content.substr(at, 5));
  for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return word == "solid";
}

std::vector<voxel::Triangle> triangles_of(std::string_view content, double unit) {
  const std::size_t count = content.size() >= kHeader ? word_at(content, kHeader - 4) : 0;
  const bool whole = content.size() >= kHeader && content.size() == kHeader + kRecord * count;
  if (whole) return from_binary(content, unit);
  const bool text = begins_with_solid(content) && content.substr(0, 512).find('\0') == std::string_view::npos;
  if (text) return from_text(content, unit);
  if (content.size() < kHeader)
    throw InputError(
        fmt::format("{} bytes are no STL; ASCII begins with 'solid', binary has {} bytes and more; "
                    "check the file",
                    content.size(), kHeader));
  throw InputError(fmt::format(
      "{} bytes, but a binary STL of {} triangles, as its header says, has {}; the file is cut off, "
      "damaged or no STL; write it again",
      content.size(), count, kHeader + kRecord * count));
}

}  // namespace

voxel::TriangleMesh read_stl(const std::filesystem::path& path, double unit) {
  const std::string content = content_of(path);
  try {
    return voxel::closed_mesh(triangles_of(content, unit));
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", path.string(), error.what()));
  }
}

}  // namespace interstice::io
