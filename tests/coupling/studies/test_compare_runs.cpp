// Two made-up runs compared: every number of comparison.csv is known beforehand (see synthetic_run.h).
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "base/error.h"
#include "coupling/figures/figures.h"
#include "coupling/studies/compare_runs.h"
#include "coupling/studies/moment_files.h"
#include "tests/coupling/figures/png.h"
#include "tests/coupling/studies/synthetic_run.h"

namespace {

using namespace interstice;
using fixtures::SyntheticRun;
namespace fs = std::filesystem;

class CompareRuns : public ::testing::Test {
 protected:
  studies::Comparison compare(const SyntheticRun& a, const SyntheticRun& b) {
    fixtures::write_run(folder / "a", a);
    fixtures::write_run(folder / "b", b);
    return again();
  }
  studies::Comparison again() {
    return studies::compare_runs(folder / "a", folder / "b", {"static", "compactors"});
  }

  std::string error() {
    try {
      again();
    } catch (const InputError& e) {
      return e.what();
    }
    return "no error";
  }
  void change(const std::string& file, const std::string& from, const std::string& to) {
    auto text = fixtures::content(folder / file);
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from << " in " << file;
    fixtures::write(folder / file, text.replace(at, from.size(), to));
  }
  fixtures::TemporaryFolder folder;
};

/// Rows of comparison.csv as written: A, B, B - A, ratio.
std::map<std::string, std::array<double, 4>> rows_of(const fs::path& csv) {
  const auto table = studies::read_table(csv, {{"quantity", "meaning"}, false});
  std::map<std::string, std::array<double, 4>> rows;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    rows[table.texts("quantity")[i]] = {table.numbers("A")[i], table.numbers("B")[i],
                                        table.numbers("B - A")[i], table.numbers("ratio")[i]};
  }
  return rows;
}

TEST_F(CompareRuns, EveryNumberIsTheOneExpected) {
  SyntheticRun b;
  b.strength = 2;
  b.solid = 0.75;
  b.lost = 6;
  auto comparison = compare({}, b);
  comparison.figures.clear();
  studies::write_comparison(folder / "out", comparison);
  const auto rows = rows_of(folder / "out" / "comparison.csv");
  const std::map<std::string, std::array<double, 2>> expected{
      {"grains_inserted", {100, 100}},
      {"grains_lost", {3, 6}},
      {"spread/duration_s", {0.01, 0.01}},
      {"spread/contact_force_mean_N", {1e-6, 2e-6}},
      {"compact/contact_force_mean_N", {0.5e-6, 1e-6}},
      {"spread/contact_normal_force_mean_N", {0.75e-6, 1.5e-6}},
      {"spread/contact_force_max_N", {10e-6 + 10e-9, 20e-6 + 10e-9}},  // its last sample, at 10 ms
      {"compact/contact_force_max_N", {5e-6 + 20e-9, 10e-6 + 20e-9}},
      {"spread/coordination_mean", {4, 4}},
      {"spread/floor/normal_force_N", {6e-6, 12e-6}},
      {"spread/floor/normal_force_per_contact_N", {2e-6, 4e-6}},
      {"spread/floor/normal_force_per_particle_N", {3e-6, 6e-6}},
      {"spread/floor/normal_stress_contact_area_Pa", {3000, 6000}},
      {"spread/floor/normal_stress_footprint_Pa", {1200, 2400}},
      {"compact/floor/shear_force_N", {3e-6, 6e-6}},
      {"compact/floor/shear_force_per_contact_N", {1e-6, 2e-6}},
      {"compact/floor/shear_sum_force_per_contact_N", {1.5e-6, 3e-6}},
      {"compact/floor/shear_stress_contact_area_Pa", {1500, 3000}},
      {"compact/floor/shear_stress_footprint_Pa", {600, 1200}},
      {"spread/layer/solid_fraction_gap", {0.25, 0.25}},
      {"compact/layer/solid_fraction_gap", {0.5, 0.75}},
      {"end/layer/solid_fraction_gap", {0.5, 0.75}},
      {"end/layer/solid_fraction_sd", {0.0625, 0.0625}},
      {"end/layer/solid_height_m", {20e-6, 30e-6}},
      {"end/layer/surface_height_m", {30e-6, 30e-6}},
      {"end/layer/solid_fraction_below_surface", {0.5 / 1.5, 0.5}},
      {"end/layer/void_fraction_min", {0.5, 0.25}},
      {"end/layer/lines/y@x=5e-05,z=1e-05/void_fraction_min", {0.5, 0.25}},
      {"end/layer/lines/y@x=5e-05,z=1e-05/void_fraction_mean", {2.0 / 3, 0.5}},
      {"spread/layer/lines/y@x=5e-05,z=1e-05/void_fraction_min", {0.75, 0.75}},
  };
  for (const auto& [name, ab] : expected) {
    ASSERT_TRUE(rows.contains(name)) << name;
    const auto& row = rows.at(name);
    const double slack = 1e-12 * std::max(std::abs(ab[0]), std::abs(ab[1]));
    EXPECT_NEAR(row[0], ab[0], slack) << name;
    EXPECT_NEAR(row[1], ab[1], slack) << name;
    EXPECT_NEAR(row[2], ab[1] - ab[0], 2 * slack) << name;
    EXPECT_NEAR(row[3], ab[1] / ab[0], 1e-11) << name;
  }
}

TEST_F(CompareRuns, WhereNothingTouchesStressIsZero) {
  EXPECT_EQ(studies::per_unit({6, 0, 4}, {3, 0, 2}), (std::vector<double>{2, 0, 2}));
}

TEST_F(CompareRuns, APhaseThatOneRunLacksIsEmptyThereAndRemarkedOn) {
  SyntheticRun a;
  a.compacts = false;
  const auto comparison = compare(a, {});
  const auto find = [&](const std::string& name) {
    for (const auto& q : comparison.quantities) {
      if (q.name == name) return q;
    }
    ADD_FAILURE() << name;
    return studies::Quantity{};
  };
  EXPECT_TRUE(std::isnan(find("compact/contact_force_mean_N").a));
  EXPECT_NEAR(find("compact/contact_force_mean_N").b, 0.5e-6, 1e-18);
  // The end of A is the end of spread, of B the end of compact.
  EXPECT_EQ(find("end/layer/solid_fraction_gap").a, 0.25);
  EXPECT_EQ(find("end/layer/solid_fraction_gap").b, 0.5);
  EXPECT_NE(studies::comparison_csv(comparison.quantities).find("compact/duration_s,,0.01,,,of the phase"),
            std::string::npos);
  EXPECT_NE(studies::report(comparison).find("phase 'compact' is not in static"), std::string::npos);
}

TEST_F(CompareRuns, TheDifferenceFieldIsBMinusA) {
  SyntheticRun b;
  b.solid = 0.75;
  const auto comparison = compare({}, b);
  ASSERT_EQ(comparison.differences.size(), 1U);
  const auto& d = comparison.differences[0].difference;
  EXPECT_EQ(d.obstacle, "");
  EXPECT_TRUE(d.whole);
  EXPECT_EQ(d.field.lattice.n, (std::array<std::int64_t, 3>{4, 3, 2}));
  EXPECT_NEAR(d.mean, -0.125, 1e-7);  // -0.25 in the lower half
  EXPECT_NEAR(d.rms, 0.25 * std::sqrt(0.5), 1e-7);
  studies::write_difference(folder / "d", d, "b minus a");
  openvdb::io::File file((folder / "d.vdb").string());
  file.open();
  const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("void_fraction_difference"));
  EXPECT_FLOAT_EQ(grid->tree().getValue({3, 2, 0}), -0.25F);
  EXPECT_FLOAT_EQ(grid->tree().getValue({3, 2, 1}), 0.0F);
  EXPECT_NEAR(grid->indexToWorld(openvdb::Coord(0)).x(), 1e-5, 1e-12);
  EXPECT_TRUE(fs::exists(folder / "d.vti"));
}

TEST_F(CompareRuns, ShiftedLatticesAreComparedWhereBothAre) {
  SyntheticRun b;
  b.solid = 0.75;
  b.shift = 1;
  const auto comparison = compare({}, b);
  const auto& d = comparison.differences.at(0).difference;
  EXPECT_EQ(d.obstacle, "");
  EXPECT_FALSE(d.whole);
  EXPECT_EQ(d.field.lattice.n, (std::array<std::int64_t, 3>{3, 3, 2}));
  EXPECT_NEAR(d.field.lattice.lo.x, 20e-6, 1e-12);
  EXPECT_NEAR(d.mean, -0.125, 1e-7);
  b.shift = 4;
  EXPECT_EQ(compare({}, b).differences.at(0).difference.obstacle, "their boxes do not overlap");
}

// OpenVDB refuses to make scalings as small as this anew.
TEST_F(CompareRuns, VoxelsOfAFewMicrometresHaveADifferenceToo) {
  SyntheticRun a, b;
  a.voxel = b.voxel = 4e-6;
  b.solid = 0.75;
  const auto comparison = compare(a, b);
  const auto& d = comparison.differences.at(0).difference;
  EXPECT_EQ(d.obstacle, "");
  EXPECT_NEAR(d.mean, -0.125, 1e-7);
  studies::write_difference(folder / "d", d, "b minus a");
  openvdb::io::File file((folder / "d.vdb").string());
  file.open();
  const auto grid = file.readGrid("void_fraction_difference");
  EXPECT_NEAR(grid->indexToWorld(openvdb::Coord(1, 0, 0)).x(), 6e-6, 1e-12);
}

TEST_F(CompareRuns, CellsOfDifferentSizeHaveNoDifferenceAndTheReportSaysWhy) {
  SyntheticRun b;
  b.voxel = 25e-6;
  const auto comparison = compare({}, b);
  EXPECT_NE(comparison.differences.at(0).difference.obstacle.find("25 um in B"), std::string::npos);
  EXPECT_NE(studies::report(comparison).find("no voxel-by-voxel difference"), std::string::npos);
}

TEST_F(CompareRuns, AllFiguresAreDrawn) {
  if (!figures::plotting_available()) GTEST_SKIP() << "gnuplot is not on PATH";
  SyntheticRun b;
  b.strength = 0.5;
  const auto comparison = compare({}, b);
  const auto files = studies::write_comparison(folder / "out", comparison);
  EXPECT_EQ(files.warning, "");
  for (const char* name : {"inter_particle_force", "bed", "force_floor", "stress_floor",
                           "layer_spread_slices", "layer_compact_slices", "layer_compact_slices_difference",
                           "layer_compact_lines_y", "layer_compact_profile_x", "layer_over_time"}) {
    EXPECT_TRUE(fixtures::png_size(folder / "out" / "figures" / (std::string(name) + ".png"))) << name;
  }
  for (const auto& path : files.written) EXPECT_TRUE(fs::exists(path)) << path;
}

TEST_F(CompareRuns, WithoutGnuplotTheNumbersAreWrittenAndAWarningGiven) {
  const auto comparison = compare({}, {});
  const fixtures::Environment path("PATH", "");
  const auto files = studies::write_comparison(folder / "out", comparison);
  EXPECT_NE(files.warning.find("gnuplot-nox"), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "out" / "comparison.csv"));
}

TEST_F(CompareRuns, RunsWithoutFieldsAndAHalfWrittenRowAreFine) {
  compare({}, {});
  fs::remove_all(folder / "a" / "fields");
  fixtures::write(folder / "b" / "series.csv", fixtures::content(folder / "b" / "series.csv") + "0.021,10");
  const auto comparison = again();
  EXPECT_NE(studies::report(comparison).find("field 'layer' is not in static"), std::string::npos);
}

TEST_F(CompareRuns, APhaseThatWasStillGoingOnReachesAsFarAsTheRun) {
  compare({}, {});
  change("b/run.json", R"("start_s": 0.01, "end_s": 0.02)", R"("start_s": 0.01, "end_s": 0, "ended_by": "")");
  change("b/run.json", R"("exit_reason": "done")", R"("exit_reason": "time limit", "time_s": 0.015)");
  const auto comparison = again();
  for (const auto& q : comparison.quantities) {
    if (q.name != "compact/duration_s") continue;
    EXPECT_NEAR(q.b, 0.005, 1e-15);
  }
  EXPECT_NE(studies::report(comparison).find("compactors did not come to its end: time limit"),
            std::string::npos);
}

TEST_F(CompareRuns, AMissingFolderOrFileIsNamed) {
  EXPECT_NE(error().find("a: no such folder"), std::string::npos);
  EXPECT_NE(error().find("b: no such folder"), std::string::npos);  // both faults at once
  compare({}, {});
  fs::remove(folder / "a" / "run.json");
  EXPECT_NE(error().find("there is no run.json in it, nor summary.json"), std::string::npos);
  compare({}, {});
  fs::remove(folder / "b" / "series.csv");
  EXPECT_NE(error().find("b/series.csv: cannot be opened"), std::string::npos);
}

TEST_F(CompareRuns, OneWrongThingIsNamedWithItsPlace) {
  const auto after = [&](const std::string& file, const std::string& from, const std::string& to) {
    compare({}, {});
    change(file, from, to);
    return error();
  };
  EXPECT_NE(after("a/run.json", "\"phases\"", "\"stages\"").find("phases: missing"), std::string::npos);
  EXPECT_NE(after("a/run.json", "\"start_s\": 0,", "").find("phases[0].start_s"), std::string::npos);
  EXPECT_NE(after("a/run.json", "{", "").find("no JSON"), std::string::npos);
  EXPECT_NE(after("a/run.json", "\"end_s\": 0.01", "\"end_s\": -1").find("ends (-1 s) before"),
            std::string::npos);
  EXPECT_NE(after("b/series.csv", "time_s", "time").find("no column time_s"), std::string::npos);
  EXPECT_NE(after("b/series.csv", "\n0,100", "\n0,x").find("series.csv:2:3: particles: 'x'"),
            std::string::npos);
  EXPECT_NE(after("b/fields/layer.csv", "frame", "number").find("no column frame"), std::string::npos);
  EXPECT_NE(after("a/fields/layer_000012/lines/y@x=5e-05,z=1e-05.csv", "void_fraction,solid", "v,solid")
                .find("line"),
            std::string::npos);
  EXPECT_NE(after("a/fields/layer_000012/slices/x=5e-05.csv", "5e-05", "fifty").find(":2:1: x_m: 'fifty'"),
            std::string::npos);
  compare({}, {});
  fixtures::write(folder / "a" / "fields" / "layer_000012.vdb", "cut short");
  EXPECT_NE(error().find("layer_000012.vdb: cannot be read"), std::string::npos);
}

TEST(CompareLabels, AreTheFoldersNamesUnlessTheyAreTheSame) {
  EXPECT_EQ(studies::default_labels("runs/static", "runs/moving/"), (studies::Labels{"static", "moving"}));
  EXPECT_EQ(studies::default_labels("one/out", "two/out"), (studies::Labels{"A", "B"}));
}

// A wall takes all of the first voxel and half of the last; the third is half full of powder.
TEST(LineValues, LeaveOutWhatWallsTake) {
  const studies::Table line("line.csv",
                            {{"solid_fraction", {0, 0, 0.5, 0.1}, {}},
                             {"void_fraction", {0, 1, 0.5, 0.4}, {}},
                             {"void_fraction_averaged", {0.7, 0.7, 0.6, 0.6}, {}}},
                            4);
  const auto voxels = studies::line_values(line, "void_fraction");
  EXPECT_TRUE(std::isnan(voxels[0]) && std::isnan(voxels[3]));
  EXPECT_EQ(voxels[1], 1);
  EXPECT_EQ(voxels[2], 0.5);
  const auto averaged = studies::line_values(line, "void_fraction_averaged");
  EXPECT_TRUE(std::isnan(averaged[0]));
  EXPECT_EQ(std::vector<double>(averaged.begin() + 1, averaged.end()), (std::vector<double>{0.7, 0.6, 0.6}));
}

}  // namespace
