#include "coupling/io/vtk_xml_data.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <new>

#include "base/error.h"
#include "coupling/io/columns.h"

namespace interstice::io {
namespace {

constexpr std::size_t part_bytes = std::size_t{1} << 16;

int value_of_letter(int c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::uint64_t header_number(VtkBytes& bytes, const VtkEncoding& encoding) {
  std::array<char, 8> raw{};
  bytes.read(raw.data(), encoding.header_bytes);
  const bool big = encoding.swap != machine_is_big_endian();
  std::uint64_t number = 0;
  for (std::size_t i = 0; i < encoding.header_bytes; ++i) {
    number = number << 8 | static_cast<unsigned char>(raw[big ? i : encoding.header_bytes - 1 - i]);
  }
  return number;
}

[[noreturn]] void wrong_length(const VtkBytes& bytes, const std::string& name, std::uint64_t stored,
                               std::uint64_t wanted) {
  bytes.xml().wrong(fmt::format(
      "array `{}` says it holds {} bytes; {} are due for the number of points; check byte_order and "
      "header_type, or write the file again",
      shown(name), stored, wanted));
}

/// Cuts a stream of bytes, in parts of any length, into numbers.
class Numbers {
 public:
  Numbers(NumberType type, bool swap, std::vector<double>& to)
      : type_(type), size_(bytes_of(type)), swap_(swap), to_(to) {}

  void add(const char* bytes, std::size_t count) {
    while (!rest_.empty() && count > 0) {
      rest_.push_back(*bytes++);
      --count;
      if (rest_.size() < size_) continue;
      append_numbers(rest_.data(), 1, type_, swap_, to_);
      rest_.clear();
    }
    append_numbers(bytes, count / size_, type_, swap_, to_);
    const char* end = bytes + count;
    rest_.insert(rest_.end(), end - count % size_, end);
  }

 private:
  NumberType type_;
  std::size_t size_;
  bool swap_;
  std::vector<double>& to_;
  std::vector<char> rest_;  // the first bytes of a number whose others come with the next part
};

/// zlib's stream, ended with its owner.
struct Inflater {
  z_stream stream{};
  Inflater() {
    if (inflateInit(&stream) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { inflateEnd(&stream); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
};

// One block of `packed` bytes that must become `plain` bytes.
void inflate_block(VtkBytes& bytes, z_stream& z, std::uint64_t packed, std::uint64_t plain,
                   const std::string& name, Numbers& numbers) {
  std::vector<char> in(part_bytes), out(part_bytes);
  inflateReset(&z);
  std::uint64_t produced = 0;
  int state = Z_OK;
  const auto damaged = [&] {
    bytes.xml().wrong(
        fmt::format("array `{}`: its compressed data are damaged; whole ones are needed; write the "
                    "file again",
                    shown(name)));
  };
  while (packed > 0) {
    const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(packed, part_bytes));
    bytes.read(in.data(), now);
    packed -= now;
    z.next_in = reinterpret_cast<Bytef*>(in.data());
    z.avail_in = static_cast<uInt>(now);
    do {
      z.next_out = reinterpret_cast<Bytef*>(out.data());
      z.avail_out = static_cast<uInt>(part_bytes);
      if (state == Z_STREAM_END) break;  // bytes behind the end of the block's stream: VTK leaves none
      state = inflate(&z, Z_NO_FLUSH);
      const std::size_t got = part_bytes - z.avail_out;
      if ((state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR) || produced + got > plain)
        damaged();
      numbers.add(out.data(), got);
      produced += got;
    } while (z.avail_in > 0 || z.avail_out == 0);
    if (z.avail_in > 0) damaged();
  }
  if (produced != plain || state != Z_STREAM_END) damaged();
}

void read_compressed(VtkBytes& bytes, const VtkEncoding& encoding, std::uint64_t wanted,
                     const std::string& name, Numbers& numbers) {
  const std::uint64_t blocks = header_number(bytes, encoding);
  if (blocks == 0) {
    if (wanted != 0) wrong_length(bytes, name, 0, wanted);
    return;
  }
  const std::uint64_t whole = header_number(bytes, encoding), last = header_number(bytes, encoding);
  // written so that no product or sum of damaged numbers can run over
  const std::uint64_t before = last > 0 ? blocks - 1 : blocks;
  if (whole == 0 || last > wanted || before > wanted / whole || before * whole != wanted - last) {
    wrong_length(bytes, name, last, wanted);
  }
  std::vector<std::uint64_t> packed;  // grows as it is read: a wrong count costs little
  for (std::uint64_t b = 0; b < blocks; ++b) packed.push_back(header_number(bytes, encoding));
  bytes.realign();
  Inflater inflater;
  for (std::uint64_t b = 0; b < blocks; ++b) {
    const bool shorter = b + 1 == blocks && last > 0;
    inflate_block(bytes, inflater.stream, packed[b], shorter ? last : whole, name, numbers);
  }
}

}  // namespace

int VtkBytes::letter() {
  for (;;) {
    const int c = xml_.get();
    if (c < 0) {
      xml_.wrong((xml_.damage().empty() ? std::string("the file ends early") : xml_.damage()) +
                 " within an array; a whole file is needed; write it again");
    }
    ++taken_;
    if (c != ' ' && c != '\n' && c != '\r' && c != '\t') return c;
  }
}

// Four letters become three bytes; `=` at their end makes them fewer. More may follow: VTK encodes parts
// apart.
void VtkBytes::decode() {
  std::uint32_t bits = 0;
  std::size_t padding = 0;
  for (int i = 0; i < 4; ++i) {
    const int c = letter();
    const int value = c == '=' && i >= 2 ? 0 : padding == 0 ? value_of_letter(c) : -1;
    if (value < 0) {
      xml_.wrong(
          fmt::format("`{}` in base64 data; letters, digits, + and / are due (the data may be cut); write "
                      "the file again",
                      shown(std::string(1, static_cast<char>(c)))));
    }
    padding += c == '=' ? 1 : 0;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
  }
  for (int i = 0; i < 3; ++i) group_[i] = static_cast<unsigned char>(bits >> (16 - 8 * i) & 0xff);
  held_ = 3 - padding;
  used_ = 0;
}

void VtkBytes::read(char* to, std::size_t count) {
  if (!base64_) {
    const std::size_t got = xml_.read(to, count);
    taken_ += static_cast<std::int64_t>(got);
    if (got == count) return;
    xml_.wrong((xml_.damage().empty() ? std::string("the file ends early") : xml_.damage()) +
               " within the appended data; a whole file is needed; write it again");
  }
  for (std::size_t i = 0; i < count; ++i) {
    while (used_ == held_) decode();
    to[i] = static_cast<char>(group_[used_++]);
  }
}

void VtkBytes::pass_to(std::int64_t offset) {
  realign();
  std::vector<char> part(part_bytes);
  while (taken_ < offset) {
    if (base64_) {
      letter();
      continue;
    }
    read(part.data(), static_cast<std::size_t>(std::min<std::int64_t>(offset - taken_, part_bytes)));
  }
}

void read_vtk_binary(VtkBytes& bytes, const VtkEncoding& encoding, NumberType type, std::int64_t count,
                     const std::string& name, std::vector<double>& to) {
  const std::uint64_t wanted = static_cast<std::uint64_t>(count) * bytes_of(type);
  Numbers numbers(type, encoding.swap, to);
  if (encoding.zlib) return read_compressed(bytes, encoding, wanted, name, numbers);
  const std::uint64_t stored = header_number(bytes, encoding);
  if (stored != wanted) wrong_length(bytes, name, stored, wanted);
  std::vector<char> part(part_bytes);
  for (std::uint64_t left = wanted; left > 0;) {
    const auto now = static_cast<std::size_t>(std::min<std::uint64_t>(left, part_bytes));
    bytes.read(part.data(), now);
    numbers.add(part.data(), now);
    left -= now;
  }
}

void read_vtk_text(XmlScanner& xml, std::int64_t count, const std::string& name, std::vector<double>& to,
                   WrittenDigits* digits) {
  std::int64_t read = 0;
  for (;;) {
    while (xml.peek() >= 0 && xml.peek() <= ' ') xml.get();
    if (xml.peek() < 0 || xml.peek() == '<') break;
    std::string number;
    while (xml.peek() > ' ' && xml.peek() != '<' && number.size() < 64)
      number += static_cast<char>(xml.get());
    double value = 0;
    if (read == count || !parse_number(number, value)) {
      xml.wrong(fmt::format("array `{}`: `{}` where {}; correct the array, or write the file again",
                            shown(name), shown(number),
                            read == count ? "all numbers are there" : "a number is due"));
    }
    if (digits != nullptr) digits->add(static_cast<std::size_t>(read % 3), number, value);
    to.push_back(value);
    ++read;
  }
  if (read < count) {
    xml.wrong(
        fmt::format("array `{}` has {} numbers; {} are due for the number of points; write the file again",
                    shown(name), read, count));
  }
}

}  // namespace interstice::io
