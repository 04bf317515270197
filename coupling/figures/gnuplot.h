// A figure's three files: NAME.dat and NAME.gp, then NAME.png as gnuplot draws it from them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "coupling/figures/formats.h"

namespace interstice::figures {

/// A text as a gnuplot string: single-quoted (nothing in it is substituted or executed), line breaks kept.
std::string string_literal(std::string_view text);

/// A text that people read, as a gnuplot string, with the units in it as they are printed: "um" becomes "µm",
/// "mm^2" "mm²".
std::string text_literal(std::string_view text);

struct Drawing {
  double width = 0, height = 0;  // in units of the layout, of which 1100 make the width of a page
  std::string data;              // NAME.dat; `data` in the script names it
  std::string script;            // gnuplot commands, without terminal and output
  Formats formats = {};          // NAME.pdf and NAME.svg beside the PNG
};

/// Writes data and script, runs gnuplot in their folder, and puts each picture in place when it is whole.
/// Throws RunError with gnuplot's first error line.
void draw(const std::filesystem::path& png, const Drawing& drawing);

}  // namespace interstice::figures
