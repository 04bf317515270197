#include "coupling/figures/gnuplot.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iterator>
#include <vector>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/figures/process.h"
#include "coupling/io/atomic_file.h"

namespace interstice::figures {
namespace {

constexpr std::chrono::seconds patience{60};
constexpr const char* program = "gnuplot";

struct Kind {
  const char* name;
  bool (*is_whole)(const std::filesystem::path&);
};

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

/// The other kinds end with a line of their own.
bool ends_with(const std::filesystem::path& path, std::string_view mark) {
  std::ifstream file(path, std::ios::binary);
  std::string tail(mark.size() + 2, '\0');
  if (!file.seekg(-static_cast<std::streamoff>(tail.size()), std::ios::end)) return false;
  return file.read(tail.data(), static_cast<std::streamsize>(tail.size())) &&
         tail.find(mark) != std::string::npos;
}
bool is_whole_pdf(const std::filesystem::path& path) { return ends_with(path, "%%EOF"); }
bool is_whole_svg(const std::filesystem::path& path) { return ends_with(path, "</svg>"); }

/// For comments, which end where the line does.
std::string on_one_line(std::string text) {
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  return text;
}

// The layout's unit in pixels and in centimetres: a full width is 1600 px on the screen and 16.5 cm in print,
// where axis labels are then 7 pt high.
constexpr double units_of_width = 1100, pixels_per_unit = 1600 / units_of_width,
                 cm_per_unit = 16.5 / units_of_width;

// gnuplot keeps numbers away from tics by letters of the unscaled font, in a PDF twice as large as they are
// drawn.
constexpr const char* pdf_tics = "; set xtics offset 0,0.5; set ytics offset 0.6,0; set cbtics offset -0.7,0";

// Fonts and lines scale with the canvas, so that all kinds look alike. Letters in PNG and PDF come out 4/3 as
// large as gnuplot is told: Pango takes 96 dots an inch.
std::string terminals(const Drawing& drawing) {
  const double points_per_unit = cm_per_unit / 2.54 * 72, letters = 1.16;  // units a point of the layout
  const long width = std::lround(drawing.width * pixels_per_unit),
             height = std::lround(drawing.height * pixels_per_unit);
  return fmt::format(
      "if (kind eq 'png') set terminal pngcairo noenhanced size {0},{1} font 'DejaVu Sans,15' fontscale "
      "{2:.4f} "
      "linewidth {3:.3f} pointscale {2:.3f} background '#ffffff'\n"
      "if (kind eq 'pdf') set terminal pdfcairo noenhanced size {4:.2f}cm,{5:.2f}cm font 'DejaVu Sans,15' "
      "fontscale {6:.4f} linewidth {7:.3f} pointscale {7:.3f} background '#ffffff'{9}\n"
      "if (kind eq 'svg') set terminal svg noenhanced size {0},{1} dynamic font 'DejaVu Sans,15' "
      "fontscale {8:.4f} linewidth {3:.3f} background '#ffffff'\n",
      width, height, 0.75 * letters * pixels_per_unit, 1.3 * pixels_per_unit, drawing.width * cm_per_unit,
      drawing.height * cm_per_unit, 0.75 * letters * points_per_unit, 2 * points_per_unit,
      letters * pixels_per_unit, pdf_tics);
}

// Names begin with ./ because gnuplot takes a leading < or | for a command to run.
std::string script_head(const std::string& stem, const Drawing& drawing) {
  return fmt::format(
      "# Draws {0}.png from {0}.dat. To draw it again: gnuplot {0}.gp   (in this folder)\n"
      "# As a vector graphic: gnuplot -e \"kind='pdf'; target='{0}.pdf'\" {0}.gp   (or svg)\n"
      "if (!exists('kind')) kind = 'png'\n"
      "if (!exists('target')) target = {1}\n"
      "data = {2}\n"
      "cells = kind eq 'pdf' ? 'image pixels' : 'image'   # viewers smooth bitmaps in a PDF\n"
      "set encoding utf8\n"
      "{3}set output target\n",
      on_one_line(stem), string_literal("./" + stem + ".png"), string_literal("./" + stem + ".dat"),
      terminals(drawing));
}

// A viewer smooths a bitmap of voxels unless it is told not to; the older word is for those that do not know
// the newer.
void show_voxels_sharply(const std::filesystem::path& svg) {
  std::ifstream in(svg, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  in.close();
  const std::string image = "<image ";
  for (std::size_t at = 0; (at = text.find(image, at)) != std::string::npos; at += image.size())
    text.insert(at + image.size(), "style='image-rendering:optimizeSpeed;image-rendering:pixelated' ");
  std::ofstream out(svg, std::ios::binary);
  out << text;
  if (!out.flush()) throw RunError(fmt::format("cannot write {}", svg.string()));
}

// Beside its place first, so that no half picture stands under the name.
void draw_kind(const Kind& kind, const std::filesystem::path& gnuplot, const std::filesystem::path& folder,
               const std::string& stem) {
  io::write_atomically(
      folder / fmt::format("{}.{}", stem, kind.name), [&](const std::filesystem::path& target) {
        // --default-settings: a user's own start-up file must not change what a figure looks like.
        const std::string settings = fmt::format("kind = '{}'; target = {}", kind.name,
                                                 string_literal("./" + target.filename().string()));
        const auto result = run_process(gnuplot, {"--default-settings", "-e", settings, "./" + stem + ".gp"},
                                        folder, patience);
        if (result.timed_out) throw RunError(fmt::format("gnuplot took more than {} s", patience.count()));
        if (result.status != 0) throw RunError("gnuplot: " + first_error_line(result.errors));
        if (!kind.is_whole(target)) {
          throw RunError(
              fmt::format("gnuplot left no whole {}: {}", kind.name, first_error_line(result.errors)));
        }
        if (std::string_view(kind.name) == "svg") show_voxels_sharply(target);
      });
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

std::string text_literal(std::string_view text) {
  std::string printed;
  const auto is_letter = [&](std::size_t at) {
    return at < text.size() && std::isalpha(static_cast<unsigned char>(text[at])) != 0;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool begins = i == 0 || !is_letter(i - 1);
    const bool micro = begins && text[i] == 'u' && i + 1 < text.size() &&
                       std::string_view("mNsJ").find(text[i + 1]) != std::string_view::npos &&
                       !is_letter(i + 2);
    const bool after_m = i > 0 && text[i - 1] == 'm' && i + 1 < text.size();
    if (micro) {
      printed += "µ";
    } else if (text[i] == '^' && after_m && (text[i + 1] == '2' || text[i + 1] == '3')) {
      printed += text[++i] == '2' ? "²" : "³";
    } else {
      printed += text[i];
    }
  }
  return string_literal(printed);
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

  std::vector<Kind> kinds{{"png", is_whole_png}};
  if (drawing.formats.pdf) kinds.push_back({"pdf", is_whole_pdf});
  if (drawing.formats.svg) kinds.push_back({"svg", is_whole_svg});
  for (const Kind& kind : kinds) draw_kind(kind, *gnuplot, folder, stem);
}

bool plotting_available() { return find_program(program).has_value(); }

}  // namespace interstice::figures
