// What all figures share: colours, where panels and texts stand on the canvas, units of lengths.
#pragma once

#include <string>
#include <string_view>

namespace interstice::figures {

/// The palettes, defined once: viridis (sequential), the same in `bands` equal bands (for whole numbers), and
/// blue-white-vermillion (for differences).
std::string sequential_palette();
std::string banded_palette(int bands);
std::string diverging_palette();

/// Curve number `index` in Okabe and Ito's colours, which colour-blind people and grey printers keep apart,
/// dark ones first and yellow never on white.
std::string curve_colour(std::size_t index);
/// A hollow or filled mark of its own for curve number `index`.
int curve_point_type(std::size_t index);

/// A rectangle on the canvas, from its top left corner.
struct Frame {
  double left = 0, top = 0, width = 0, height = 0;
};
/// What a full-width figure measures; 1100 units are 1600 px, or 16.5 cm in print.
struct Canvas {
  double width = 1100, height = 700;  // units of the layout

  double across(double x) const { return x / width; }  // screen coordinates, which count from the bottom left
  double up(double y) const { return 1 - y / height; }
};

/// The next plot fills `frame`.
std::string place(const Canvas& canvas, const Frame& frame);

struct Text {
  double x = 0, y = 0;  // from the top left; y at half the height of the letters
  std::string text;
  double size = 15;              // [pt]
  std::string options = "left";  // gnuplot's: left | center | right, rotate, tc
};
/// A label, for the next plot only (`unset label` follows every plot).
std::string write(const Canvas& canvas, const Text& text);

/// The figure's headline: smaller where it would not fit.
std::string headline(const Canvas& canvas, double left, const std::string& text);
/// The note at the foot, in as many lines as it takes, and how high these are.
std::string foot_note(const Canvas& canvas, double left, const std::string& text);
double foot_note_height(const Canvas& canvas, double left, const std::string& text);

/// Labels of a plot's axes, at places of our own: gnuplot's depend on the kind of figure and on the tics.
/// That of the y axis stands `away` from it, which suffices for tics of five letters.
std::string x_label(const Canvas& canvas, const Frame& frame, std::string_view text);
std::string y_label(const Canvas& canvas, const Frame& frame, std::string_view text, double away = 80);

/// The colour bar of the next plot, vertical, filling `frame`, its label on the far side.
std::string colour_bar(const Canvas& canvas, const Frame& frame, std::string_view label);

/// The style of a plot of so many cells: a bitmap, in a PDF cell by cell unless it becomes too large.
std::string cells_style(std::size_t cells);

/// The unit in which an extent [m] reads best: mm, or um below 0.3 mm.
struct LengthUnit {
  double per_metre = 1e3;
  const char* name = "mm";
};
LengthUnit length_unit(double extent);

/// A step of 1, 2 or 5 times a power of ten that cuts `extent` into at most `most` intervals.
double tick_step(double extent, int most);

/// How wide a text prints, roughly, in letters of `size` [pt].
double text_width(std::string_view text, double size);

/// `text` in lines of at most `room` each, broken at spaces.
std::string wrapped(std::string_view text, double size, double room);

}  // namespace interstice::figures
