// Numbers in messages and metadata.
#pragma once

#include <cstdio>
#include <string>

namespace interstice::voxel {

/// `value` with so many significant digits; 17 give back the same bits.
inline std::string shown(double value, int digits = 9) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, value);
  return text;
}

}  // namespace interstice::voxel
