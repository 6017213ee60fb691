#include "protocol/carriers/line_debouncer.h"

#include <gtest/gtest.h>

namespace towbench::protocol {
namespace {

constexpr core::Nanoseconds kMs = core::kNanosecondsPerMillisecond;

TEST(LineDebouncer, ALineThatBouncesCountsOnceItHasComeToRest) {
  LineDebouncer lines(0, 5 * kMs);
  for (int i = 0; i < 9; ++i) {
    lines.edge(2, i % 2 == 0, i * kMs);  // the last one up, at 8 ms
    EXPECT_EQ(lines.settled(i * kMs), 0U);
  }
  EXPECT_EQ(lines.settled(13 * kMs - 1), 0U);
  EXPECT_EQ(lines.settled(13 * kMs), 1U << 2U);
}

TEST(LineDebouncer, ALineThatChattersForEverHoldsBackNoOther) {
  LineDebouncer lines(0, 5 * kMs);
  lines.edge(4, true, 0);  // the kill switch
  for (int i = 0; i < 10; ++i) {
    lines.edge(0, i % 2 == 0, i * kMs);
  }
  EXPECT_EQ(lines.settled(10 * kMs), 1U << 4U);
}

TEST(LineDebouncer, ABurstThatEndsWhereItBeganIsNoChange) {
  LineDebouncer lines(1, 5 * kMs);
  lines.edge(0, false, kMs);
  lines.edge(0, true, 2 * kMs);
  EXPECT_EQ(lines.settled(2 * kMs), 1U);
  EXPECT_EQ(lines.settled(100 * kMs), 1U);
}

TEST(LineDebouncer, WithoutADebounceAChangeCountsAtOnce) {
  LineDebouncer lines(0, 0);
  lines.edge(15, true, 7);
  EXPECT_EQ(lines.settled(7), 1U << 15U);
}

}  // namespace
}  // namespace towbench::protocol
