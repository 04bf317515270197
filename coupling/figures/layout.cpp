#include "coupling/figures/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "coupling/figures/gnuplot.h"

namespace interstice::figures {

namespace {

// viridis (van der Walt and Smith 2015, CC0) at nine equal steps: equal steps of the value look equal, also
// in grey.
constexpr std::array<std::array<double, 3>, 9> viridis{{{0x44, 0x01, 0x54},
                                                        {0x47, 0x2c, 0x7a},
                                                        {0x3b, 0x51, 0x8b},
                                                        {0x2c, 0x71, 0x8e},
                                                        {0x21, 0x90, 0x8d},
                                                        {0x27, 0xad, 0x81},
                                                        {0x5c, 0xc8, 0x63},
                                                        {0xaa, 0xdc, 0x32},
                                                        {0xfd, 0xe7, 0x25}}};

/// The colour at `t` in [0, 1], between its two neighbours in the table.
std::string viridis_at(double t) {
  const double place = std::clamp(t, 0.0, 1.0) * (viridis.size() - 1);
  const auto below = std::min(static_cast<std::size_t>(place), viridis.size() - 2);
  const double share = place - static_cast<double>(below);
  std::array<int, 3> rgb{};
  for (std::size_t c = 0; c < 3; ++c) {
    rgb[c] = static_cast<int>(std::lround((1 - share) * viridis[below][c] + share * viridis[below + 1][c]));
  }
  return fmt::format("'#{:02x}{:02x}{:02x}'", rgb[0], rgb[1], rgb[2]);
}

}  // namespace

std::string sequential_palette() {
  std::string steps;
  for (std::size_t i = 0; i < viridis.size(); ++i) {
    steps += fmt::format("{}{} {}", i == 0 ? "" : ", ", i,
                         viridis_at(static_cast<double>(i) / (viridis.size() - 1)));
  }
  return "set palette defined (" + steps + ")\n";
}

std::string banded_palette(int bands) {
  std::string steps;
  for (int i = 0; i < bands; ++i) {
    const std::string colour = viridis_at(bands > 1 ? static_cast<double>(i) / (bands - 1) : 0.5);
    steps += fmt::format("{}{} {}, {} {}", i == 0 ? "" : ", ", i, colour, i + 1, colour);
  }
  return "set palette defined (" + steps + ")\n";
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
                     text_literal(text.text), canvas.across(text.x), canvas.up(text.y), text.options,
                     text.size);
}

std::string x_label(const Canvas& canvas, const Frame& frame, std::string_view text) {
  return write(canvas, {frame.left + 0.5 * frame.width, frame.top + frame.height + 50, std::string(text), 15,
                        "center"});
}

std::string y_label(const Canvas& canvas, const Frame& frame, std::string_view text, double away) {
  return write(canvas,
               {frame.left - away, frame.top + 0.5 * frame.height, std::string(text), 15, "center rotate"});
}

std::string colour_bar(const Canvas& canvas, const Frame& frame, std::string_view label) {
  return fmt::format(
      "set colorbox vertical user origin screen {:.5f}, screen {:.5f} size screen {:.5f}, screen {:.5f}\n"
      "{}",
      canvas.across(frame.left), canvas.up(frame.top + frame.height), frame.width / canvas.width,
      frame.height / canvas.height,
      write(canvas, {frame.left + frame.width + 72, frame.top + 0.5 * frame.height, std::string(label), 15,
                     "center rotate"}));
}

std::string headline(const Canvas& canvas, double left, const std::string& text) {
  const double size = 18, width = text_width(text, size), room = canvas.width - left - 10;
  return write(canvas, {left, 30, text, width > room ? std::max(9.0, size * room / width) : size, "left"});
}

namespace {
constexpr double note_size = 12, note_line = 19, note_margin = 26;
}

double foot_note_height(const Canvas& canvas, double left, const std::string& text) {
  if (text.empty()) return 0;
  const std::string lines = wrapped(text, note_size, canvas.width - left - 10);
  return note_margin + note_line * static_cast<double>(1 + std::count(lines.begin(), lines.end(), '\n'));
}

std::string foot_note(const Canvas& canvas, double left, const std::string& text) {
  if (text.empty()) return "";
  return write(canvas,
               {left, canvas.height - foot_note_height(canvas, left, text) + note_line,
                wrapped(text, note_size, canvas.width - left - 10), note_size, "left tc rgb '#404040'"});
}

std::string cells_style(std::size_t cells) {
  constexpr std::size_t most_in_vectors = 50'000;  // some 0.8 MB
  return cells <= most_in_vectors ? "@cells" : "image";
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
  return static_cast<double>(letters) * size * 0.72;
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
