#include "coupling/figures/gnuplot.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <fstream>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/figures/process.h"
#include "coupling/io/atomic_file.h"

namespace interstice::figures {
namespace {

constexpr std::chrono::seconds patience{60};
constexpr const char* program = "gnuplot";

/// gnuplot echoes the faulty line and a caret before it says what is wrong: the line with "line N:" says it.
std::string first_error_line(const std::string& errors) {
  std::string first;
  for (std::size_t begin = 0; begin < errors.size();) {
    const std::size_t end = std::min(errors.find('\n', begin), errors.size());
    const std::string line = errors.substr(begin, end - begin);
    begin = end + 1;
    const bool blank = line.find_first_not_of(" \t\r^") == std::string::npos;
    if (blank || line.find("warning:") != std::string::npos) continue;
    if (first.empty()) first = line;
    const std::size_t place = line.find("line ");
    if (place != std::string::npos && line.find(':', place) != std::string::npos) return line;
  }
  return first.empty() ? "no message" : first;
}

/// A PNG begins with its signature and ends with an IEND chunk; anything else was cut short.
bool is_whole_png(const std::filesystem::path& path) {
  constexpr std::array<char, 8> signature{'\x89', 'P', 'N', 'G', '\r', '\n', '\x1a', '\n'};
  std::ifstream file(path, std::ios::binary);
  std::array<char, 8> head{}, tail{};
  if (!file.read(head.data(), head.size()) || head != signature) return false;
  file.seekg(-8, std::ios::end);
  return file.read(tail.data(), tail.size()) && std::string_view(tail.data(), 4) == "IEND";
}

/// For comments, which end where the line does.
std::string on_one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return text;
}

// Names begin with ./ because gnuplot takes a leading < or | for a command to run.
std::string script_head(const std::string& stem, const Drawing& drawing) {
  return fmt::format(
      "# Draws {0}.png from {0}.dat. To draw it again: gnuplot {0}.gp   (in this folder)\n"
      "if (!exists('target')) target = {1}\n"
      "data = {2}\n"
      "set encoding utf8\n"
      "set terminal pngcairo noenhanced size {3},{4} font 'DejaVu Sans,15' linewidth 1.6 background "
      "'#ffffff'\n"
      "set output target\n",
      on_one_line(stem), string_literal("./" + stem + ".png"), string_literal("./" + stem + ".dat"),
      drawing.width, drawing.height);
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) throw RunError(fmt::format("cannot make {}: {}", folder.string(), problem.message()));
}

}  // namespace

std::string string_literal(std::string_view text) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      // A doubled quote would do inside a string, but gnuplot takes one at its beginning for the end.
      result += "'.\"'\".'";
    } else if (c == '\n') {
      result += "'.\"\\n\".'";
    } else {
      result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return result + "'";
}

void draw(const std::filesystem::path& png, const Drawing& drawing) {
  const auto gnuplot = find_program(program);
  if (!gnuplot) {
    throw RunError(fmt::format("cannot draw {}: gnuplot is not on PATH; install gnuplot-nox", png.string()));
  }
  const auto folder = std::filesystem::absolute(png).parent_path();
  const std::string stem = png.stem().string();
  make_folder(folder);
  const auto script = folder / (stem + ".gp");
  io::write_text_atomically(folder / (stem + ".dat"), drawing.data);
  io::write_text_atomically(script, script_head(stem, drawing) + drawing.script);

  io::write_atomically(folder / (stem + ".png"), [&](const std::filesystem::path& target) {
    // --default-settings: a user's own start-up file must not change what a figure looks like.
    const std::string set_target = "target = " + string_literal("./" + target.filename().string());
    const auto result =
        run_process(*gnuplot, {"--default-settings", "-e", set_target, "./" + script.filename().string()},
                    folder, patience);
    if (result.timed_out) throw RunError(fmt::format("gnuplot took more than {} s", patience.count()));
    if (result.status != 0) throw RunError("gnuplot: " + first_error_line(result.errors));
    if (!is_whole_png(target))
      throw RunError("gnuplot left no whole PNG: " + first_error_line(result.errors));
  });
}

bool plotting_available() { return find_program(program).has_value(); }

}  // namespace interstice::figures
