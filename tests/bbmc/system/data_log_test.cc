#include "bbmc/system/data_log.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "bbmc/system/perf_log.h"
#include "tests/bbmc/support/machine.h"
#include "tests/bbmc/support/motions.h"

namespace towbench::bbmc {
namespace {

TEST(Defect10DataLog, HoldsAsManyRowsAsItsStorageAndCountsTheRest) {
  std::array<DataLogRow, 8> storage;
  DataLog log(storage);
  for (int i = 0; i < 20; ++i) {
    DataLogRow row;
    row.time_ns = i;
    EXPECT_EQ(log.append(row), i < 8);
  }
  EXPECT_TRUE(log.full());
  EXPECT_EQ(log.refused(), 12U);
  ASSERT_EQ(log.rows().size(), 8U);
  EXPECT_EQ(log.rows().back().time_ns, 7);  // the oldest stay
  log.reset();
  EXPECT_TRUE(log.rows().empty());
  EXPECT_EQ(log.refused(), 0U);
}

TEST(Defect10DataLog, AFullLogStopsTheRecordingWithAMessageNotTheMachine) {
  tests::Machine machine;
  machine.keep_records = false;
  auto& log = machine.system().data_log();
  ASSERT_EQ(log.capacity(), 131'072U);
  DataLogRow row;
  while (log.append(row)) {
  }
  ASSERT_TRUE(
      machine.system().request_motion(tests::trapezoid(machine, core::Axis::kY, 0.05, 0.1)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  EXPECT_EQ(machine.system().status().last_motion_result, core::ErrorCode::kNone);
  int told = 0;
  for (const auto& event : machine.events) {
    told += event.kind == SystemEvent::Kind::kLogFull ? 1 : 0;
  }
  EXPECT_EQ(told, 1);
  EXPECT_EQ(log.rows().size(), log.capacity());
}

TEST(DataLog, RecordsEveryTickOfAMotionForTheAxesThatAreEnabled) {
  tests::Machine machine;
  auto& log = machine.system().data_log();
  log.enable(core::Axis::kX, false);
  machine.run_for(0.1);
  EXPECT_TRUE(log.rows().empty());  // nothing moves, nothing is recorded
  ASSERT_TRUE(
      machine.system().request_motion(tests::trapezoid(machine, core::Axis::kY, 0.05, 0.1)));
  ASSERT_TRUE(machine.run_until_rest(10.0));
  ASSERT_GT(log.rows().size(), 500U);
  for (std::size_t i = 1; i < log.rows().size(); ++i) {
    EXPECT_EQ(log.rows()[i].time_ns - log.rows()[i - 1].time_ns, core::kNanosecondsPerMillisecond);
    EXPECT_EQ(log.rows()[i].axes[core::Axis::kX].mode, AxisMode::kIdle);
  }
  EXPECT_NEAR(static_cast<double>(log.rows().back().axes[core::Axis::kY].count -
                                  log.rows().front().axes[core::Axis::kY].count),
              0.05 * 445'345, 10);
}

TEST(PerfLog, SortsIntoPowersOfTwoMicroseconds) {
  PerfLog perf;
  perf.record(0, 999);
  perf.record(1'000, 1'999);
  perf.record(4'000'000'000'000, -5);
  EXPECT_EQ(perf.lateness().samples, 3U);
  EXPECT_EQ(perf.lateness().max_ns, 4'000'000'000'000);
  EXPECT_EQ(perf.lateness().histogram[0], 1U);
  EXPECT_EQ(perf.lateness().histogram[1], 1U);
  EXPECT_EQ(perf.lateness().histogram[PerfLog::kBuckets - 1], 1U);
  EXPECT_EQ(perf.execution().min_ns, 0);  // a clock that went back is no negative time
  EXPECT_EQ(perf.execution().histogram[0], 2U);
  perf.enable(false);
  perf.record(1, 1);
  EXPECT_EQ(perf.lateness().samples, 3U);
  perf.reset();
  EXPECT_EQ(perf.lateness().samples, 0U);
}

}  // namespace
}  // namespace towbench::bbmc
