// Maps over time, vector graphics and printed units.
#include <gtest/gtest.h>

#include <zlib.h>

#include <cmath>
#include <sstream>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/figures/gnuplot.h"
#include "tests/coupling/figures/png.h"

namespace {

using namespace interstice;
using fixtures::content;
using fixtures::png_size;

figures::MapFigure map(std::size_t columns, const std::vector<double>& moments) {
  figures::MapFigure figure;
  figure.title = "Void fraction along the bed";
  figure.x_label = "x [mm]";
  figure.y_label = "time [ms]";
  figure.colour_label = "void fraction";
  for (std::size_t c = 0; c < columns; ++c) figure.x.push_back(0.02 * static_cast<double>(c));
  figure.y = moments;
  for (std::size_t r = 0; r < moments.size(); ++r) {
    figure.values.emplace_back(columns, 0.5);
    if (columns > 0) figure.values.back()[0] = r == 0 ? NAN : 0.25;
  }
  return figure;
}

class Maps : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!figures::plotting_available()) GTEST_SKIP() << "gnuplot is not on PATH";
  }
  fixtures::TemporaryFolder folder;
};

TEST_F(Maps, EvenAndUnevenMomentsSingleRowsAndSingleColumnsAreDrawn) {
  int i = 0;
  for (const auto& figure :
       {map(50, {0, 1, 2, 3}), map(50, {0, 1, 5, 5.5}), map(50, {7}), map(1, {0, 1, 2}), map(1, {3})}) {
    const auto png = folder / ("map" + std::to_string(i++) + ".png");
    figures::write_map(png, figure);
    EXPECT_TRUE(png_size(png)) << png;
  }
  std::istringstream data(content(folder / "map1.dat"));
  std::size_t rows = 0;
  for (std::string line; std::getline(data, line);) rows += !line.empty() && line[0] != '#';
  EXPECT_EQ(rows, 4u * 50u);
  // The row at t = 1 reaches from half way to 0 to half way to 5.
  EXPECT_NE(content(folder / "map1.dat").find("0 1 0.25 -0.01 0.01 0.5 3\n"), std::string::npos);
}

TEST_F(Maps, LargeMomentsLeaveRoomForTheirAxisLabel) {
  figures::write_map(folder / "m.png", map(50, {100000, 400000, 700000}));
  const std::string script = content(folder / "m.gp");
  const auto pixels_after = [&](const std::string& text, const std::string& key) {
    const std::size_t at = script.find(text), number = script.find(key, at) + key.size();
    return at == std::string::npos ? NAN : 1600 * std::stod(script.substr(number));
  };
  const double axis = pixels_after("set lmargin", "at screen ");
  const double label = pixels_after("'time [ms]'", "at screen ");
  // Six digits of 12.8 px, as measured in such a figure, 10 px of tics, half the label's height of 20 px.
  EXPECT_LT(label + 10, axis - 10 - 6 * 12.8);
  EXPECT_GT(label, 10);
}

TEST_F(Maps, FiguresThatMakeNoSenseAreRefused) {
  auto backwards = map(5, {0, 2, 1}), short_row = map(5, {0, 1}), no_range = map(5, {0, 1}),
       lacking = map(5, {0, 1});
  short_row.values[1].pop_back();
  no_range.hi = no_range.lo;
  lacking.values.pop_back();
  for (const auto& figure : {backwards, short_row, no_range, lacking, map(0, {0, 1}), map(5, {})}) {
    EXPECT_THROW(figures::write_map(folder / "no.png", figure), InputError);
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "no.png"));
}

TEST_F(Maps, VectorGraphicsStandBesideThePngWhereAskedFor) {
  figures::write_map(folder / "m.png", map(20, {0, 1, 2}), {true, true});
  EXPECT_TRUE(png_size(folder / "m.png"));
  EXPECT_EQ(content(folder / "m.pdf").substr(0, 5), "%PDF-");
  EXPECT_NE(content(folder / "m.svg").find("<svg"), std::string::npos);
  figures::write_map(folder / "only.png", map(20, {0, 1, 2}));
  EXPECT_FALSE(std::filesystem::exists(folder / "only.pdf"));
  EXPECT_FALSE(std::filesystem::exists(folder / "only.svg"));
}

/// What the first stream of a PDF says, unpacked: the page's drawing commands.
std::string page_of(const std::string& pdf) {
  const std::size_t start = pdf.find('\n', pdf.find("stream")) + 1;
  std::string page(1 << 22, '\0');
  z_stream z{};
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(pdf.data() + start));
  z.avail_in = static_cast<uInt>(pdf.size() - start);
  z.next_out = reinterpret_cast<Bytef*>(page.data());
  z.avail_out = static_cast<uInt>(page.size());
  inflateInit(&z);
  inflate(&z, Z_FINISH);
  page.resize(z.total_out);
  inflateEnd(&z);
  return page;
}

// 1100 units are 16.5 cm; a point of the layout is 1.16 units (docs/FIGURES.md: letters scale with the page).
TEST_F(Maps, LettersOfAPdfAreAsLargeAsThePngsAndItsCellsAreNoBitmap) {
  auto even = map(20, {0, 1, 2});
  even.values[0][0] = 0.5;  // without blanks, which are drawn otherwise
  figures::write_map(folder / "e.png", even, {true, false});
  const std::string pdf = content(folder / "e.pdf");
  EXPECT_EQ(pdf.find("/Image"), std::string::npos);
  std::istringstream page(page_of(pdf));
  double largest = 0;
  for (std::string line; std::getline(page, line);) {
    if (line.ends_with(" Tm")) largest = std::max(largest, std::stod(line));
  }
  const double headline = 18 * 1.16 * 16.5 / 1100 / 2.54 * 72;  // [pt]
  EXPECT_NEAR(largest, headline, 0.01 * headline);
}

TEST_F(Maps, HistogramsHaveALogarithmicAxisThatEmptyBinsLeave) {
  figures::CurveFigure figure;
  figure.title = "Histogram";
  figure.curves.push_back({"per voxel", {0.25, 0.5, 0.75}, {0.1, 0, 0.9}, true});
  figure.log_y = true;
  EXPECT_THROW(figures::write_curves(folder / "h.png", {figure}), InputError);  // no range
  figure.y_range = {0, 1};
  EXPECT_THROW(figures::write_curves(folder / "h.png", {figure}), InputError);  // from zero
  figure.y_range = {1e-3, 1};
  figures::write_curves(folder / "h.png", {figure});
  EXPECT_TRUE(png_size(folder / "h.png"));
  EXPECT_NE(content(folder / "h.dat").find("0.5 0\n"), std::string::npos);  // data as they are
}

TEST(FigureTexts, UnitsArePrintedAsInPapers) {
  using figures::text_literal;
  EXPECT_EQ(text_literal("voxel 17.3 um, averaged over 120 um"), "'voxel 17.3 µm, averaged over 120 µm'");
  EXPECT_EQ(text_literal("force [uN], area [mm^2], 3 m^3"), "'force [µN], area [mm²], 3 m³'");
  EXPECT_EQ(text_literal("sum of volumes, maximum, A^2, 5um"), "'sum of volumes, maximum, A^2, 5µm'");
}

TEST(FigureFormats, WhatIsNoKindOfFigureIsNamed) {
  const auto both = figures::parse_formats("png,pdf,svg", "--figures");
  EXPECT_TRUE(both.pdf && both.svg);
  EXPECT_FALSE(figures::parse_formats("png", "--figures").pdf);
  for (const char* text : {"", "bmp", "png,", "png;pdf", "PDF"}) {
    EXPECT_THROW(figures::parse_formats(text, "--figures"), InputError) << text;
  }
}

}  // namespace
