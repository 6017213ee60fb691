#include "harness/panel/live_tap.h"

#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

TEST(LiveTap, KeepsWhatThePageShowsWhateverTheExchange) {
  const auto tap = std::make_unique<LiveTap>();
  for (const core::Nanoseconds exchange_ns : {1'000'000, 200'000}) {
    tap->clear(exchange_ns, LiveTap::Histogram::kTook, false);
    EXPECT_EQ(tap->rows().written(), 0U);
    bbmc::TelemetryRow row;
    emulator::TruthRow truth;
    for (; row.time_ns < 60 * core::kNanosecondsPerSecond; row.time_ns += exchange_ns) {
      truth.time_ns = row.time_ns;
      tap->row(row, {});
      tap->truth(truth);
    }
    std::vector<LiveRow> rows;
    std::vector<LiveTruth> truths;
    (void)tap->rows().copy(0, rows);
    (void)tap->truths().copy(0, truths);
    EXPECT_EQ(rows.back().time_ns, 60 * core::kNanosecondsPerSecond - exchange_ns);
    EXPECT_EQ(truths.back().time_ns, rows.back().time_ns);
    EXPECT_LE(rows.front().time_ns, 40 * core::kNanosecondsPerSecond) << exchange_ns;
    EXPECT_LE(truths.front().time_ns, 40 * core::kNanosecondsPerSecond) << exchange_ns;
  }
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
  tap->clear(core::kNanosecondsPerMillisecond, LiveTap::Histogram::kTook, false);
  EXPECT_EQ(tap->dropped(), 0U);
}

TEST(LiveTap, ByTheWallClockBinsAreOfDistancesFromThePeriod) {
  const auto tap = std::make_unique<LiveTap>();
  tap->clear(core::kNanosecondsPerMillisecond, LiveTap::Histogram::kOffPeriod, false);
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
