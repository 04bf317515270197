// A figure's three files: NAME.dat and NAME.gp, then NAME.png as gnuplot draws it from them.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace interstice::figures {

/// A text as a gnuplot string: single-quoted (nothing in it is substituted or executed), line breaks kept.
std::string string_literal(std::string_view text);

struct Drawing {
  int width = 1600, height = 900;  // [px]
  std::string data;                // NAME.dat; `data` in the script names it
  std::string script;              // gnuplot commands, without terminal and output
};

/// Writes data and script, runs gnuplot in their folder, and puts the PNG in place when it is whole.
/// Throws RunError with gnuplot's first error line.
void draw(const std::filesystem::path& png, const Drawing& drawing);

}  // namespace interstice::figures
