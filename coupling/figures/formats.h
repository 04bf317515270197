// Which kinds of files a figure is drawn as: PNG always, vector graphics where asked for.
#pragma once

#include <string>

namespace interstice::figures {

struct Formats {
  bool pdf = false, svg = false;
};

/// Of "png,pdf,svg", in any order. Throws InputError, led by `key`.
Formats parse_formats(const std::string& text, const std::string& key);

}  // namespace interstice::figures
