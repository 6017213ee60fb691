#include "harness/files/csv_table.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

TEST(CsvTable, ReadsColumnsByName) {
  const CsvTable table = CsvTable::salvage("time_s,y_count\r\n0,-3\r\n1e-3,4\r\n");
  ASSERT_EQ(table.rows(), 2U);
  ASSERT_NE(table.find("y_count"), nullptr);
  EXPECT_EQ((*table.find("y_count"))[0], -3);
  EXPECT_EQ((*table.find("time_s"))[1], 1e-3);
  EXPECT_EQ(table.find("x_count"), nullptr);
}

TEST(CsvTable, LeavesOutALastLineWithoutItsEndBecauseItsNumberMayLackDigits) {
  const CsvTable table = CsvTable::salvage("time_s,y_position_m\n0,0.5\n1,0.12");
  EXPECT_EQ(table.rows(), 1U);
  EXPECT_TRUE(table.torn());
}

TEST(CsvTable, CountsWhatItCannotReadInsteadOfGuessing) {
  const CsvTable table = CsvTable::salvage("a,b\n1,2\n1\n1,2,3\n\nx,5\n,6\n1.5z,7\n");
  EXPECT_EQ(table.rows(), 4U);
  EXPECT_EQ(table.refused_rows(), 2U);
  EXPECT_EQ(table.refused_cells(), 2U);  // "x" and "1.5z"; an empty cell is missing, not wrong
  EXPECT_TRUE(std::isnan(table.column("a")[1]));
  EXPECT_TRUE(std::isnan(table.column("a")[2]));
  EXPECT_TRUE(std::isnan(table.column("a")[3]));
  EXPECT_EQ(table.column("b")[3], 7);
}

TEST(CsvTable, MakesNoRowsOfNothing) {
  EXPECT_EQ(CsvTable::salvage("").rows(), 0U);
  EXPECT_EQ(CsvTable::salvage("time_s").names().size(), 0U);  // a header cut off is no header
  EXPECT_EQ(CsvTable::salvage("time_s\n").rows(), 0U);
}

TEST(CsvTable, ATornLastLineIsLeftOutAndTold) {
  const auto table = CsvTable::parse("a,b\n1,2\n3,", "t.csv");
  EXPECT_EQ(table.rows(), 1U);
  EXPECT_TRUE(table.torn());
}

TEST(CsvTable, WhatIsNoNumberOrTooFewOrTooManyIsRefusedByLineAndColumn) {
  for (const auto& [text, said] : {
           std::pair{"a,b\n1,2\n3\n", "t.csv:3: 1 cells, and the header names 2 columns"},
           {"a,b\n1,2\n3,4,5\n", "t.csv:3: 3 cells, and the header names 2 columns"},
           {"a,b\n1,2\n\n", "t.csv:3: 0 cells, and the header names 2 columns"},
           {"a,b\n1,2\n3,x\n4\n", "t.csv:3: column b: 'x' is not a number"},
           {"a,b\n1,2\n3,4 \n", "t.csv:3: column b: '4 ' is not a number"},
           {"a,b\n1,2\n,4\n", "t.csv:3: column a: '' is not a number"},
           {"a,b\n1,2\n+-1,4\n", "t.csv:3: column a: '+-1' is not a number"},
           {"a,a\n1,2\n", "t.csv:1: column a appears twice"},
           {"", "t.csv: no header row"},
       }) {
    try {
      (void)CsvTable::parse(text, "t.csv");
      ADD_FAILURE() << text;
    } catch (const CsvError& error) {
      EXPECT_STREQ(error.what(), said);
    }
  }
  EXPECT_THROW((void)CsvTable::load("absent.csv"), CsvError);
}

TEST(CsvTable, NamesTheFileOfAColumnThatIsMissing) {
  const auto table = CsvTable::parse("a,b\n1,2\n", "t.csv");
  EXPECT_EQ(table.required("b", "t.csv").front(), 2);
  try {
    (void)table.required("c", "t.csv");
    ADD_FAILURE();
  } catch (const CsvError& error) {
    EXPECT_STREQ(error.what(), "t.csv: no column c");
  }
}

}  // namespace
}  // namespace towbench::harness
