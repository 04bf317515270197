// CSV in: whole tables, tables cut short by a kill, and every kind of malformed row with its place.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error.h"
#include "coupling/studies/table.h"
#include "tests/coupling/figures/temporary_folder.h"

namespace {

using namespace interstice;

class TableFile : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) {
    fixtures::write(folder / "t.csv", text);
    return folder / "t.csv";
  }
  std::string error_of(const std::string& text, const studies::TableOptions& options = {}) {
    try {
      studies::read_table(file(text), options);
    } catch (const InputError& error) {
      const std::string what = error.what();
      return what.substr(what.find("t.csv"));
    }
    return "no error";
  }
  fixtures::TemporaryFolder folder;
};

TEST_F(TableFile, NumbersTextsEmptyCellsAndQuotes) {
  const auto t = studies::read_table(
      file("a,phase,\"b, c\"\r\n1e-3,spread,nan\r\n+2,\"say \"\"x\"\"\",\r\n\r\n"), {{"phase"}, false});
  ASSERT_EQ(t.rows(), 2U);
  EXPECT_EQ(t.numbers("a"), (std::vector<double>{1e-3, 2}));
  EXPECT_EQ(t.texts("phase"), (std::vector<std::string>{"spread", "say \"x\""}));
  EXPECT_TRUE(std::isnan(t.numbers("b, c")[0]));
  EXPECT_TRUE(std::isnan(t.numbers("b, c")[1]));
}

TEST_F(TableFile, TheLastLineMayLackItsEnd) {
  EXPECT_EQ(studies::read_table(file("a,b\n1,2\n3,4")).rows(), 2U);
}

TEST_F(TableFile, AGrowingFileLosesTheRowThatAKillCutShort) {
  const auto t = studies::read_table(file("a,b\n1,2\n3,41"), {{}, true});  // 41 might have become 417
  EXPECT_EQ(t.numbers("b"), std::vector<double>{2});
}

TEST_F(TableFile, FaultsAreNamedWithTheirPlace) {
  EXPECT_EQ(error_of("a,b\n1,2\n3\n").find("t.csv:3:1: 1 cells; the header names 2 columns"), 0U);
  EXPECT_EQ(error_of("a,b\n1,2,3\n").find("t.csv:2:1: 3 cells"), 0U);
  EXPECT_EQ(error_of("a,b\n1,2\n10,2.5x\n"), "t.csv:3:4: b: '2.5x' is no number");
  EXPECT_EQ(error_of("a,b\n1,two\n"), "t.csv:2:3: b: 'two' is no number");
  EXPECT_EQ(error_of("").find("t.csv:1:1: no header"), 0U);
  EXPECT_EQ(error_of("\n1,2\n").find("t.csv:1:1: no header"), 0U);
}

TEST_F(TableFile, MissingFilesAndColumnsAreNamed) {
  EXPECT_THROW(studies::read_table(folder / "none.csv"), InputError);
  EXPECT_THROW(studies::read_table(folder.path()), InputError);
  const auto t = studies::read_table(file("a,b\n1,2\n"));
  EXPECT_FALSE(t.has("c"));
  try {
    t.numbers("c");
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("no column c; there are a, b"), std::string::npos);
  }
}

TEST_F(TableFile, CellsReadBackAsTheyWere) {
  for (const double v : {0.1, 1.0 / 3, 1e-300, -17.25, 0.0}) EXPECT_EQ(std::stod(studies::csv_cell(v)), v);
  EXPECT_EQ(studies::csv_cell(std::nan("")), "");
  EXPECT_EQ(studies::csv_cell("plain"), "plain");
  EXPECT_EQ(studies::csv_cell("y@x=1,z=\"2\""), "\"y@x=1,z=\"\"2\"\"\"");
}

}  // namespace
