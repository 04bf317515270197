#include "coupling/figures/formats.h"

#include <fmt/format.h>

#include "base/error.h"

namespace interstice::figures {

Formats parse_formats(const std::string& text, const std::string& key) {
  Formats formats;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string name = text.substr(begin, end - begin);
    begin = end + 1;
    if (name == "pdf") {
      formats.pdf = true;
    } else if (name == "svg") {
      formats.svg = true;
    } else if (name != "png") {
      throw InputError(fmt::format(
          "{}: '{}' is no kind of figure; png, pdf, svg, separated by commas; write for example png,pdf", key,
          name));
    }
  }
  return formats;
}

}  // namespace interstice::figures
