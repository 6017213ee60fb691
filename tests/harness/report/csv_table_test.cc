#include "harness/report/csv_table.h"

#include <cmath>

#include <gtest/gtest.h>

namespace towbench::harness::report {
namespace {

TEST(CsvTable, ReadsColumnsByName) {
  const CsvTable table = parse_csv("time_s,y_count\r\n0,-3\r\n1e-3,4\r\n");
  ASSERT_EQ(table.rows, 2U);
  ASSERT_NE(table.find("y_count"), nullptr);
  EXPECT_EQ((*table.find("y_count"))[0], -3);
  EXPECT_EQ((*table.find("time_s"))[1], 1e-3);
  EXPECT_EQ(table.find("x_count"), nullptr);
}

TEST(CsvTable, LeavesOutALastLineWithoutItsEndBecauseItsNumberMayLackDigits) {
  const CsvTable table = parse_csv("time_s,y_position_m\n0,0.5\n1,0.12");
  EXPECT_EQ(table.rows, 1U);
  EXPECT_TRUE(table.last_line_cut);
}

TEST(CsvTable, CountsWhatItCannotReadInsteadOfGuessing) {
  const CsvTable table = parse_csv("a,b\n1,2\n1\n1,2,3\nx,5\n,6\n1.5z,7\n");
  EXPECT_EQ(table.rows, 4U);
  EXPECT_EQ(table.refused_rows, 2U);
  EXPECT_EQ(table.refused_cells, 2U);  // "x" and "1.5z"; an empty cell is missing, not wrong
  EXPECT_TRUE(std::isnan(table.columns[0][1]));
  EXPECT_TRUE(std::isnan(table.columns[0][2]));
  EXPECT_TRUE(std::isnan(table.columns[0][3]));
  EXPECT_EQ(table.columns[1][3], 7);
}

TEST(CsvTable, MakesNoRowsOfNothing) {
  EXPECT_EQ(parse_csv("").rows, 0U);
  EXPECT_EQ(parse_csv("time_s").names.size(), 0U);  // a header cut off is no header
  EXPECT_EQ(parse_csv("time_s\n").rows, 0U);
}

}  // namespace
}  // namespace towbench::harness::report
