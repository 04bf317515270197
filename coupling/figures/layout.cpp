#include "coupling/figures/layout.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "coupling/figures/gnuplot.h"

namespace interstice::figures {

// viridis (van der Walt and Smith 2015, CC0) at nine equal steps: equal steps of the value look equal, also
// in grey.
std::string sequential_palette() {
  return "set palette defined (0 '#440154', 1 '#472c7a', 2 '#3b518b', 3 '#2c718e', 4 '#21908d', "
         "5 '#27ad81', 6 '#5cc863', 7 '#aadc32', 8 '#fde725')\n";
}

std::string diverging_palette() {
  return "set palette defined (0 '#08306b', 1 '#0072b2', 2 '#8cc4e0', 3 '#f7f7f7', 4 '#f4b183', 5 '#d55e00', "
         "6 '#7a3000')\n";
}

std::string curve_colour(std::size_t index) {
  constexpr std::array<const char*, 7> colours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                               "#e69f00", "#56b4e9", "#000000"};
  return colours[index % colours.size()];
}

int curve_point_type(std::size_t index) {
  constexpr std::array<int, 7> types{7, 4, 9, 12, 5, 6, 10};
  return types[index % types.size()];
}

std::string place(const Canvas& canvas, const Frame& frame) {
  return fmt::format(
      "set lmargin at screen {:.5f}; set rmargin at screen {:.5f}; set tmargin at screen {:.5f}; "
      "set bmargin at screen {:.5f}\n",
      canvas.across(frame.left), canvas.across(frame.left + frame.width), canvas.up(frame.top),
      canvas.up(frame.top + frame.height));
}

std::string write(const Canvas& canvas, const Text& text) {
  return fmt::format("set label {} at screen {:.5f}, screen {:.5f} {} font ',{:g}'\n",
                     string_literal(text.text), canvas.across(text.x), canvas.up(text.y), text.options,
                     text.size);
}

std::string colour_bar(const Canvas& canvas, const Frame& frame, std::string_view label) {
  return fmt::format(
      "set colorbox vertical user origin screen {:.5f}, screen {:.5f} size screen {:.5f}, screen {:.5f}\n"
      "set cblabel {} font ',15' offset 1.2\n",
      canvas.across(frame.left), canvas.up(frame.top + frame.height), frame.width / canvas.width,
      frame.height / canvas.height, string_literal(label));
}

LengthUnit length_unit(double extent) {
  return extent < 0.3e-3 ? LengthUnit{1e6, "µm"} : LengthUnit{1e3, "mm"};
}

double tick_step(double extent, int most) {
  if (!(extent > 0)) return 1;
  const double power = std::pow(10.0, std::floor(std::log10(extent / most)));
  for (const double step : {1.0, 2.0, 5.0}) {
    if (extent / (step * power) <= most * (1 + 1e-9)) return step * power;
  }
  return 10 * power;
}

double text_width(std::string_view text, double size) {
  std::size_t letters = 0;
  for (const char c : text)
    letters += (static_cast<unsigned char>(c) & 0xC0) != 0x80;  // UTF-8: count lead bytes
  return static_cast<double>(letters) * size * 0.76;
}

std::string wrapped(std::string_view text, double size, double room) {
  std::string result, line;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const auto word = text.substr(begin, end - begin);
    begin = end + 1;
    if (!line.empty() && text_width(line, size) + text_width(word, size) + size > room) {
      result += line + "\n";
      line.clear();
    }
    if (!line.empty()) line += ' ';
    line += word;
  }
  return result + line;
}

}  // namespace interstice::figures
