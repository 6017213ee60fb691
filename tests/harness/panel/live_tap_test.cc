#include "harness/panel/live_tap.h"

#include <memory>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

TEST(LiveTap, AFullQueueDropsRowsAndCountsThemAndNeverWaits) {
  const auto tap = std::make_unique<LiveTap>();
  bbmc::TelemetryRow row;
  for (int i = 0; i < 20'000; ++i) {
    row.time_ns = i;
    tap->row(row);
  }
  EXPECT_EQ(tap->dropped(), 20'000U - 16'384U);
  LiveRow first;
  ASSERT_TRUE(tap->next(first));
  EXPECT_EQ(first.time_ns, 0) << "the oldest are kept: what is dropped is what came too late";
}

TEST(LiveTap, BinsAreOfDoublingWidth) {
  const auto tap = std::make_unique<LiveTap>();
  for (const core::Nanoseconds took_ns : {-5, 0, 999, 1000, 1999, 2000, 3999, 4000}) {
    tap->exchange(took_ns);
  }
  tap->exchange(core::kNanosecondsPerSecond * 1000);
  const auto bins = tap->exchange_times();
  EXPECT_EQ(bins[0], 3U);
  EXPECT_EQ(bins[1], 2U);
  EXPECT_EQ(bins[2], 2U);
  EXPECT_EQ(bins[3], 1U);
  EXPECT_EQ(bins[LiveTap::kBins - 1], 1U);
}

TEST(LiveTap, TextBeyondItsBoundIsDroppedWholeAndCounted) {
  const auto tap = std::make_unique<LiveTap>();
  const std::string line(1U << 19U, 'x');
  for (int i = 0; i < 3; ++i) {
    tap->event(line);
  }
  EXPECT_EQ(tap->take_events().size(), 2 * line.size());
  EXPECT_EQ(tap->dropped(), 1U);
  tap->clear(0);
  EXPECT_EQ(tap->dropped(), 0U);
}

TEST(LiveTap, ByTheWallClockBinsAreOfDistancesFromThePeriod) {
  const auto tap = std::make_unique<LiveTap>();
  tap->clear(core::kNanosecondsPerMillisecond);
  for (const core::Nanoseconds took_ns : {1'000'000, 1'000'900, 998'500, 1'001'500}) {
    tap->exchange(took_ns);
  }
  const auto bins = tap->exchange_times();
  EXPECT_EQ(bins[0], 2U);
  EXPECT_EQ(bins[1], 2U);
}

TEST(TextQueue, TextRunsRoundItsEndUnbroken) {
  TextQueue<16> queue;
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(queue.push("0123456789"));
    EXPECT_FALSE(queue.push("too long"));
    ASSERT_TRUE(queue.push("ab"));
    EXPECT_EQ(queue.take(), "0123456789ab");
  }
}

}  // namespace
}  // namespace towbench::harness
