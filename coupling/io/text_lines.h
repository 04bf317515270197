// A text file, plain or gzipped, line by line in constant memory.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <zlib.h>

namespace interstice::io {

class TextLines {
 public:
  /// Throws InputError when the file cannot be opened.
  explicit TextLines(std::filesystem::path path);
  ~TextLines();
  TextLines(const TextLines&) = delete;
  TextLines& operator=(const TextLines&) = delete;

  /// The next line without its end (LF or CRLF); valid until the next call. False at the end of the file, and
  /// where damage() says why no more can be read. Throws InputError for a line that no text file has.
  bool next(std::string_view& line);
  /// Passes over up to `count` lines; returns how many there were.
  std::int64_t skip(std::int64_t count);

  /// Up to `count` of the bytes that follow the last line, for binary parts of a file that begins as text;
  /// fewer at its end. Lines in them are not counted.
  std::size_t read(char* to, std::size_t count);

  /// Did the last line end with a line end? A file cut in the middle of a number shows only here.
  bool line_was_whole() const { return whole_; }
  /// Why reading stopped before the end ("the compressed data end early"); empty when all is well.
  const std::string& damage() const { return damage_; }
  /// "file:line" of the last line read.
  std::string where() const;
  const std::filesystem::path& path() const { return path_; }
  std::int64_t line_number() const { return line_number_; }

 private:
  bool fill();

  std::filesystem::path path_;
  gzFile file_ = nullptr;
  std::vector<char> buffer_;
  std::size_t begin_ = 0, end_ = 0;  // unread bytes of the buffer
  std::int64_t line_number_ = 0;
  bool whole_ = true;
  bool at_end_ = false;
  std::string damage_;
};

}  // namespace interstice::io
