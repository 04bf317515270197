#include "coupling/io/text_lines.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "base/error.h"

namespace interstice::io {
namespace {
constexpr std::size_t first_buffer = std::size_t{1} << 18;
constexpr std::size_t longest_line = std::size_t{1} << 23;  // bytes; beyond it, this is no table of particles
}  // namespace

TextLines::TextLines(std::filesystem::path path) : path_(std::move(path)), buffer_(first_buffer) {
  std::error_code error;
  if (std::filesystem::is_directory(path_, error)) {
    throw InputError(path_.string() + ": is a folder; a particle file is needed; name the file itself");
  }
  errno = 0;
  file_ = gzopen(path_.c_str(), "rb");
  if (file_ == nullptr) {
    const std::string reason = errno != 0 ? std::generic_category().message(errno) : "out of memory";
    throw InputError(path_.string() + ": cannot be opened (" + reason + "); name a file that can be read");
  }
  gzbuffer(file_, 1u << 17);
}

TextLines::~TextLines() { gzclose_r(file_); }

std::string TextLines::where() const { return path_.string() + ":" + std::to_string(line_number_); }

bool TextLines::fill() {
  if (at_end_) return false;
  if (begin_ > 0) {
    std::memmove(buffer_.data(), buffer_.data() + begin_, end_ - begin_);
    end_ -= begin_;
    begin_ = 0;
  }
  if (end_ == buffer_.size()) {
    if (buffer_.size() >= longest_line) {
      throw InputError(path_.string() + ":" + std::to_string(line_number_ + 1) +
                       ": a line of more than 8 MiB; this is no text file of particles; check the file");
    }
    buffer_.resize(2 * buffer_.size());
  }
  const int got = gzread(file_, buffer_.data() + end_, static_cast<unsigned>(buffer_.size() - end_));
  if (got > 0) {
    end_ += static_cast<std::size_t>(got);
    return true;
  }
  at_end_ = true;
  int code = Z_OK;
  const std::string message = gzerror(file_, &code);
  if (code == Z_BUF_ERROR) {
    damage_ = "the compressed data end early";
  } else if (code == Z_ERRNO) {
    damage_ = "the file cannot be read on (" + std::generic_category().message(errno) + ")";
  } else if (code != Z_OK && code != Z_STREAM_END) {
    damage_ = "the compressed data are damaged (" + message + ")";
  }
  return false;
}

bool TextLines::next(std::string_view& line) {
  std::size_t searched = 0;  // bytes after begin_ known to hold no line end
  for (;;) {
    const char* from = buffer_.data() + begin_;
    const void* found = std::memchr(from + searched, '\n', end_ - begin_ - searched);
    if (found != nullptr) {
      const auto length = static_cast<std::size_t>(static_cast<const char*>(found) - from);
      line = {from, length};
      begin_ += length + 1;
      whole_ = true;
      break;
    }
    searched = end_ - begin_;
    if (fill()) continue;
    if (begin_ == end_) return false;
    line = {buffer_.data() + begin_, end_ - begin_};
    begin_ = end_;
    whole_ = false;
    break;
  }
  ++line_number_;
  if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
  return true;
}

std::size_t TextLines::read(char* to, std::size_t count) {
  std::size_t got = 0;
  while (got < count) {
    if (begin_ == end_ && !fill()) break;
    const std::size_t part = std::min(count - got, end_ - begin_);
    std::memcpy(to + got, buffer_.data() + begin_, part);
    begin_ += part;
    got += part;
  }
  return got;
}

std::int64_t TextLines::skip(std::int64_t count) {
  std::int64_t passed = 0;
  std::string_view line;
  while (passed < count && next(line)) ++passed;
  return passed;
}

}  // namespace interstice::io
