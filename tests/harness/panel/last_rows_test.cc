#include "harness/panel/last_rows.h"

#include <array>
#include <cstdint>
#include <stop_token>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

// All of a row's words say which one it is.
struct Row {
  std::array<std::uint64_t, 16> words{};
};

Row row_of(std::uint64_t number) {
  Row row;
  row.words.fill(number);
  return row;
}

TEST(LastRows, GivesRowsFromTheOneThatIsAskedFor) {
  LastRows<Row> last(100);
  std::vector<Row> rows{row_of(7)};
  EXPECT_EQ(last.copy(0, rows), 0U);
  EXPECT_TRUE(rows.empty());
  for (std::uint64_t i = 0; i < 100; ++i) {
    last.add(row_of(i));
  }
  EXPECT_EQ(last.written(), 100U);
  EXPECT_EQ(last.copy(40, rows), 40U);
  ASSERT_EQ(rows.size(), 60U);
  EXPECT_EQ(rows.front().words.back(), 40U);
  EXPECT_EQ(rows.back().words.back(), 99U);
  EXPECT_EQ(last.copy(100, rows), 100U);
  EXPECT_TRUE(rows.empty());
}

TEST(LastRows, KeepsTheYoungestAndSaysWhereTheyBegin) {
  LastRows<Row> last(100);
  for (std::uint64_t i = 0; i < 1000; ++i) {
    last.add(row_of(i));
  }
  std::vector<Row> rows;
  const auto first = last.copy(3, rows);
  EXPECT_GE(rows.size(), last.least());
  EXPECT_EQ(first + rows.size(), 1000U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].words.front(), first + i);
  }
}

TEST(LastRows, ClearedItHasNoneAndKeepsAsManyAsItIsTold) {
  LastRows<Row> last(10);
  last.add(row_of(0));
  last.clear(1000);
  EXPECT_EQ(last.written(), 0U);
  for (std::uint64_t i = 0; i < 5000; ++i) {
    last.add(row_of(i));
  }
  std::vector<Row> rows;
  (void)last.copy(0, rows);
  EXPECT_GE(rows.size(), 1000U);
  EXPECT_EQ(rows.back().words.front(), 4999U);
}

// A writer that goes round and round under the reader's hands: what is given is whole and in order.
TEST(LastRows, RowsThatAreWrittenOverMeanwhileAreNotGiven) {
  LastRows<Row> last(16);
  const std::jthread writer([&last](const std::stop_token& ending) {
    for (std::uint64_t i = 0; !ending.stop_requested(); ++i) {
      last.add(row_of(i));
    }
  });
  std::vector<Row> rows;
  std::uint64_t given = 0;
  std::uint64_t next = 0;
  std::uint64_t passed_over = 0;
  while (given < 20'000) {
    const auto first = last.copy(next, rows);
    ASSERT_GE(first, next);
    passed_over += first - next;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      ASSERT_EQ(rows[i].words, row_of(first + i).words);
    }
    given += rows.size();
    next = first + rows.size();
  }
  EXPECT_EQ(given + passed_over, next);
}

}  // namespace
}  // namespace towbench::harness
