#include "harness/record/row_blocks.h"

#include <latch>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/allocation_guard.h"

namespace towbench::harness {
namespace {

struct Keep {
  std::vector<int>* kept = nullptr;
  std::latch* open = nullptr;  // nothing is written before
  void operator()(std::span<const int> rows) const noexcept {
    if (open != nullptr) {
      open->wait();
    }
    kept->insert(kept->end(), rows.begin(), rows.end());
  }
};

std::vector<int> zero_to(int count) {
  std::vector<int> numbers(static_cast<std::size_t>(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

TEST(RowBlocks, WriteEveryRowOnceAndInOrder) {
  constexpr int kRows = 100'003;
  std::vector<int> kept;
  BackgroundWriter writer;
  RowBlocks<int, Keep> blocks(writer, {.kept = &kept}, 16);
  for (int i = 0; i < kRows; ++i) {
    blocks.add(i);
  }
  blocks.hand_over();
  writer.wait();
  EXPECT_EQ(kept, zero_to(kRows));
}

TEST(RowBlocks, RowsThatComeTogetherAreWrittenTogether) {
  std::vector<int> kept;
  BackgroundWriter writer;
  RowBlocks<int, Keep> blocks(writer, {.kept = &kept}, 8);
  const auto rows = zero_to(7);
  for (int i = 0; i < 100; ++i) {
    blocks.add(rows);
  }
  blocks.hand_over();
  writer.wait();
  ASSERT_EQ(kept.size(), 700U);
  EXPECT_EQ(kept[693], 0);
}

// The real-time loops record by this: a block is full in one of 256 of their ticks.
TEST(RowBlocks, TakeNoHeapWhileTheWriterKeepsUpAndWhileItWaits) {
  std::vector<int> kept;
  kept.reserve(1000);
  std::latch open(1);
  BackgroundWriter writer;
  RowBlocks<int, Keep> blocks(writer, {.kept = &kept, .open = &open}, 16);
  {
    const tests::AllocationGuard guard;
    for (int i = 0; i < 100; ++i) {  // six full blocks of eight, while the writer stands
      blocks.add(i);
    }
    open.count_down();
    for (int i = 100; i < 1000; ++i) {
      blocks.add(i);
    }
  }
  blocks.hand_over();
  writer.wait();
  EXPECT_EQ(kept, zero_to(1000));
}

TEST(BackgroundWriter, FinishesWhatItWasGivenWhenItEnds) {
  std::vector<int> kept;
  {
    BackgroundWriter writer;
    RowBlocks<int, Keep> blocks(writer, {.kept = &kept}, 4);
    for (int i = 0; i < 10; ++i) {
      blocks.add(i);
    }
    writer.wait();
  }
  EXPECT_EQ(kept, zero_to(8));  // the last two were not handed over
}

}  // namespace
}  // namespace towbench::harness
