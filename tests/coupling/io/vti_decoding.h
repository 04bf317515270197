// Reads back what write_vti wrote, as VTK does: offsets from the XML, then block sizes, then zlib blocks.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace interstice::testing {

struct Vti {
  std::string xml;   // up to the appended data
  std::string data;  // from the byte after the underscore

  explicit Vti(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    const std::string all{std::istreambuf_iterator<char>(in), {}};
    const auto mark = all.find("<AppendedData encoding=\"raw\">");
    EXPECT_NE(mark, std::string::npos);
    if (mark == std::string::npos) return;
    const auto begin = all.find('_', mark) + 1;
    xml = all.substr(0, begin);
    data = all.substr(begin);
  }

  /// The value of `name="..."` after the text `after`.
  std::string attribute(const std::string& after, const std::string& name) const {
    const auto from = xml.find(name + "=\"", xml.find(after));
    if (xml.find(after) == std::string::npos || from == std::string::npos) return {};
    const auto begin = from + name.size() + 2;
    return xml.substr(begin, xml.find('"', begin) - begin);
  }

  bool has(const std::string& array) const { return xml.find("Name=\"" + array + "\"") != std::string::npos; }

  std::vector<float> array(const std::string& name) const {
    const char* at = data.data() + std::stoull(attribute("Name=\"" + name + "\"", "offset"));
    const auto number = [&](std::size_t i) {
      std::uint64_t value = 0;
      std::memcpy(&value, at + 8 * i, 8);
      return value;
    };
    const std::uint64_t blocks = number(0), full = number(1), last = number(2);
    const char* packed = at + 8 * (3 + blocks);
    std::vector<float> values;
    for (std::uint64_t b = 0; b < blocks; ++b) {
      uLongf bytes = static_cast<uLongf>(b + 1 == blocks && last != 0 ? last : full);
      std::vector<float> part(bytes / sizeof(float));
      const int status =
          uncompress(reinterpret_cast<Bytef*>(part.data()), &bytes, reinterpret_cast<const Bytef*>(packed),
                     static_cast<uLong>(number(3 + b)));
      EXPECT_EQ(status, Z_OK);
      EXPECT_EQ(bytes, part.size() * sizeof(float));
      values.insert(values.end(), part.begin(), part.end());
      packed += number(3 + b);
    }
    return values;
  }
};

}  // namespace interstice::testing
