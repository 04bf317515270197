// Figures of made-up data: whole PNGs with all their data beside them, from scripts that run again.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <limits>
#include <string>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/figures/gnuplot.h"
#include "coupling/figures/process.h"
#include "tests/coupling/figures/png.h"

namespace {

using namespace interstice;
using fixtures::content;
using fixtures::png_size;

/// A slice normal to x: rows along y, columns along z, a void fraction that differs in every voxel.
voxel::Samples slice(std::int64_t rows, std::int64_t columns, double h = 20e-6) {
  voxel::Samples s;
  s.normal_axis = 0;
  s.axes = {1, 2};
  s.rows = rows;
  s.columns = columns;
  for (std::int64_t r = 0; r < rows; ++r) {
    for (std::int64_t c = 0; c < columns; ++c) {
      s.center.push_back({9e-3, (static_cast<double>(r) + 0.5) * h, (static_cast<double>(c) + 0.5) * h});
      s.void_fraction.push_back(static_cast<double>(r * columns + c) / static_cast<double>(rows * columns));
    }
  }
  return s;
}

figures::SliceFigure slice_figure(const voxel::Samples& samples) {
  figures::SliceFigure figure;
  figure.title = "Void fraction";
  figure.note = "voxel 20 µm";
  figure.panels.push_back({"X2: x = 9 mm", samples, false, {{"floor", Plane{{0, 0, 0}, {0, 0, 1}}}}});
  return figure;
}

figures::CurveFigure curve_figure(std::size_t points) {
  figures::CurveFigure figure;
  figure.title = "A curve";
  figure.x_label = "time [ms]";
  figure.y_label = "force [µN]";
  figure.marks = {{5, "end of spread"}, {5.1, "end of rest"}, {1e9, "far outside"}};
  for (const char* name : {"A", "B"}) {
    figures::Curve curve{name, {}, {}};
    for (std::size_t i = 0; i < points; ++i) {
      curve.x.push_back(static_cast<double>(i));
      curve.y.push_back(std::sin(static_cast<double>(i)) + (name[0] - 'A'));
    }
    figure.curves.push_back(curve);
  }
  return figure;
}

io::ParticleFrame grains() {
  io::ParticleFrame frame;
  for (int i = 0; i < 50; ++i) {
    frame.x.push_back(i * 40e-6);
    frame.y.push_back(0);
    frame.z.push_back((50 - i) * 1e-6);
    frame.radius.push_back(10e-6 + i * 0.1e-6);
    frame.layer.push_back(i % 3);
    frame.vx.push_back(0.01 * i);
    frame.vy.push_back(0);
    frame.vz.push_back(0);
  }
  frame.walls.push_back({"blade", Box{{1e-3, -1e-3, 0}, {1.1e-3, 1e-3, 1e-3}}});
  return frame;
}

/// Lines of NAME.dat that hold numbers.
std::size_t data_lines(const std::filesystem::path& dat) {
  std::istringstream text(content(dat));
  std::size_t n = 0;
  for (std::string line; std::getline(text, line);) n += !line.empty() && line[0] != '#';
  return n;
}

class Figures : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!figures::plotting_available()) GTEST_SKIP() << "gnuplot is not on PATH";
  }
  fixtures::TemporaryFolder folder;
};

TEST_F(Figures, SliceHasAllItsVoxelsBesideIt) {
  figures::write_slices(folder / "s.png", slice_figure(slice(75, 5)));
  const auto size = png_size(folder / "s.png");
  ASSERT_TRUE(size);
  EXPECT_EQ((*size)[0], 1600U);
  EXPECT_GT((*size)[1], 300U);
  EXPECT_EQ(data_lines(folder / "s.dat"), 75U * 5U);
  EXPECT_NE(content(folder / "s.dat").find("0.01 10 0\n"), std::string::npos);  // y [mm], z [um], first voxel
  EXPECT_NE(content(folder / "s.gp").find("stretched 3×"), std::string::npos);  // 15 : 1 is too thin to read
}

TEST_F(Figures, ScriptRunsAgainByHandInItsFolder) {
  figures::write_slices(folder / "s.png", slice_figure(slice(20, 10)));
  const std::string before = content(folder / "s.png");
  std::filesystem::remove(folder / "s.png");
  const auto result = figures::run_process(*figures::find_program("gnuplot"), {"s.gp"}, folder.path(),
                                           std::chrono::seconds(60));
  EXPECT_EQ(result.status, 0) << result.errors;
  EXPECT_EQ(content(folder / "s.png"), before);
}

TEST_F(Figures, SlicesOfEveryShapeAreDrawn) {
  auto figure = slice_figure(slice(20, 10));
  figure.contours = {0.4, 0.6};
  figure.panels.push_back({"one row", slice(1, 10), false, {}});
  figure.panels.push_back({"one column", slice(10, 1), false, {}});
  figure.panels.push_back({"one voxel", slice(1, 1), false, {}});
  auto holes = slice(20, 10);
  holes.void_fraction_averaged.assign(200, std::numeric_limits<double>::quiet_NaN());
  figure.panels.push_back({"nothing known", holes, true, {}});
  figures::write_slices(folder / "shapes.png", figure);
  EXPECT_TRUE(png_size(folder / "shapes.png"));
  EXPECT_EQ(data_lines(folder / "shapes.dat"), 200U + 10U + 10U + 1U + 200U);
}

TEST_F(Figures, TheColourBarStandsBesideTheTitlesOfNarrowPanels) {
  auto figure = slice_figure(slice(10, 40));
  figure.panels[0].title = "along y, averaged over 120 µm";
  figure.panels.push_back(figure.panels[0]);
  figure.panels.push_back(figure.panels[0]);
  figures::write_slices(folder / "s.png", figure);
  const std::string script = content(folder / "s.gp");
  const auto number_after = [&](const std::string& text, const std::string& unit) {
    const std::size_t at = script.find(text), number = script.find(unit, at) + unit.size();
    return at == std::string::npos ? NAN : std::stod(script.substr(number));
  };
  const double width = (*png_size(folder / "s.png"))[0];
  const double bar = width * number_after("set colorbox", "origin screen ");
  const double title = width * number_after("'along y", "at screen ");
  EXPECT_GT(bar, title + 29 * 13.7);  // 29 letters, 13.7 px each as measured in such a figure
}

TEST_F(Figures, CurvesHaveAllTheirPointsBesideThem) {
  auto with_gap = curve_figure(3000);
  with_gap.curves[0].y[7] = std::numeric_limits<double>::quiet_NaN();
  figures::write_curves(folder / "c.png", {with_gap, curve_figure(10)});
  const auto size = png_size(folder / "c.png");
  ASSERT_TRUE(size);
  EXPECT_EQ((*size)[0], 1600U);
  EXPECT_EQ(data_lines(folder / "c.dat"), 2U * 3000U + 2U * 10U);
  EXPECT_NE(content(folder / "c.dat").find("7 NaN"), std::string::npos);
}

TEST(Curves, AreTrimmedAtTheirEndsOnly) {
  const double gap = std::nan("");
  const figures::Curve curve = figures::trimmed({"a", {1, 2, 3, 4, 5}, {gap, 7, gap, 8, gap}});
  EXPECT_EQ(curve.x, (std::vector<double>{2, 3, 4}));
  EXPECT_EQ(curve.y.front(), 7);
  EXPECT_TRUE(std::isnan(curve.y[1]));
  EXPECT_EQ(curve.y.back(), 8);
  EXPECT_TRUE(figures::trimmed({"b", {1, 2}, {gap, gap}}).x.empty());
}

TEST_F(Figures, CurvesOfNothingOneThingAndEqualThingsAreDrawn) {
  figures::CurveFigure empty;
  empty.title = "nothing";
  auto single = curve_figure(1), flat = curve_figure(20), lost = curve_figure(5);
  for (auto& y : flat.curves[0].y) y = 3;
  flat.curves.resize(1);
  lost.curves[0].y.assign(5, std::numeric_limits<double>::quiet_NaN());
  lost.curves[1] = {"no points", {}, {}};
  for (const auto& figure : {empty, single, flat, lost}) {
    figures::write_curves(folder / "few.png", {figure});
    EXPECT_TRUE(png_size(folder / "few.png"));
  }
}

TEST_F(Figures, TextsAreNeitherCodeNorFormat) {
  auto figure = curve_figure(5);
  figure.title = "it's `touch owned` $(touch owned) \"quoted\" a_b^{c} %d \\n 100 %";
  figure.curves[0].name = "'; system('touch owned'); '";
  figures::write_curves(folder / "it's x=0.0045.png", {figure});
  EXPECT_TRUE(png_size(folder / "it's x=0.0045.png"));
  for (const char* name : {"<touch owned.png", "|touch owned.png", "a\nsystem 'touch owned'.png", "-e.png"}) {
    figures::write_curves(folder / name, {figure});
    EXPECT_TRUE(png_size(folder / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "owned"));
}

TEST_F(Figures, GrainsAreSortedFarFirstAndCutToTheWindow) {
  const auto frame = grains();
  figures::GrainFigure figure;
  figure.title = "Grains";
  figure.window = {{-1e-5, -1e-3, 0}, {1e-3, 1e-3, 1e-3}};
  figures::write_grains(folder / "g.png", frame, figure);
  EXPECT_TRUE(png_size(folder / "g.png"));
  EXPECT_EQ(data_lines(folder / "g.dat"), 25U);  // x < 1 mm
  // z falls with x, so the farthest below is the one with the largest x.
  const std::string data = content(folder / "g.dat");
  EXPECT_LT(data.find("\n0.96 "), data.find("\n0 "));
}

TEST_F(Figures, GrainsTakeEveryColourAndView) {
  auto frame = grains();
  figures::GrainFigure figure;
  figure.window = {{-1e-5, -1e-4, 0}, {2e-3, 1e-4, 2e-4}};  // long and thin: in rows
  for (const auto view : {figures::GrainView::above, figures::GrainView::side}) {
    for (const auto colour :
         {figures::GrainColour::diameter, figures::GrainColour::speed, figures::GrainColour::layer}) {
      figure.view = view;
      figure.colour = colour;
      figures::write_grains(folder / "g.png", frame, figure);
      EXPECT_TRUE(png_size(folder / "g.png"));
    }
  }
  frame.vx.clear();
  figure.colour = figures::GrainColour::speed;
  EXPECT_THROW(figures::write_grains(folder / "g.png", frame, figure), InputError);
  frame.layer.clear();
  figure.colour = figures::GrainColour::layer;
  EXPECT_THROW(figures::write_grains(folder / "g.png", frame, figure), InputError);
  figure.colour = figures::GrainColour::diameter;
  figures::write_grains(folder / "none.png", io::ParticleFrame{}, figure);
  EXPECT_TRUE(png_size(folder / "none.png"));
}

TEST_F(Figures, AFigureThatMakesNoSenseIsRefused) {
  auto figure = slice_figure(slice(4, 4));
  figure.lo = figure.hi;
  EXPECT_THROW(figures::write_slices(folder / "s.png", figure), InputError);
  EXPECT_THROW(figures::write_slices(folder / "s.png", {}), InputError);
  auto averaged = slice_figure(slice(4, 4));
  averaged.panels[0].averaged = true;
  EXPECT_THROW(figures::write_slices(folder / "s.png", averaged), InputError);
  auto uneven = curve_figure(4);
  uneven.curves[0].y.pop_back();
  EXPECT_THROW(figures::write_curves(folder / "c.png", {uneven}), InputError);
  EXPECT_THROW(figures::write_curves(folder / "c.png", {}), InputError);
  EXPECT_THROW(figures::write_grains(folder / "g.png", grains(), {}), InputError);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST_F(Figures, WhatGnuplotSaysIsPassedOnAndNoPngIsLeft) {
  try {
    figures::draw(folder / "bad.png", {400, 300, "1 2\n", "set no_such_thing 3\nplot data\n"});
    FAIL() << "no error";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("line 12"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("bad.png"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "bad.png"));
  // A script that draws nothing leaves no whole PNG either; an earlier one stays as it was.
  fixtures::write(folder / "kept.png", "before");
  EXPECT_THROW(figures::draw(folder / "kept.png", {400, 300, "1 2\n", "set output\n"}), RunError);
  EXPECT_EQ(content(folder / "kept.png"), "before");
}

TEST_F(Figures, AFolderThatCannotBeWrittenIsNamed) {
  fixtures::write(folder / "file", "in the way");
  try {
    figures::write_curves(folder / "file" / "c.png", {curve_figure(3)});
    FAIL() << "no error";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("file"), std::string::npos) << error.what();
  }
  if (::geteuid() == 0) return;  // nothing is closed to root
  std::filesystem::create_directory(folder / "closed");
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_read);
  EXPECT_THROW(figures::write_curves(folder / "closed" / "c.png", {curve_figure(3)}), RunError);
  std::filesystem::permissions(folder / "closed", std::filesystem::perms::owner_all);
}

TEST(FiguresWithoutGnuplot, SayWhatIsMissing) {
  const fixtures::TemporaryFolder folder;
  const fixtures::Environment path("PATH", "");
  EXPECT_FALSE(figures::plotting_available());
  try {
    figures::write_curves(folder / "c.png", {curve_figure(3)});
    FAIL() << "no error";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("gnuplot-nox"), std::string::npos) << error.what();
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
