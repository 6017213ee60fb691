#include "harness/board_bench/board_truth.h"

#include <gtest/gtest.h>

namespace towbench::harness {
namespace {

class Times final : public emulator::PlantObserver {
 public:
  void on_truth(const emulator::TruthRow& row) noexcept override {
    us.push_back(row.time_ns / 1000);
  }
  void on_event(const emulator::PlantEvent& /*event*/) noexcept override {}
  std::vector<core::Nanoseconds> us;
};

void plant_runs(BoardTruth& truth, core::Nanoseconds from_us, core::Nanoseconds to_us) {
  for (core::Nanoseconds us = from_us; us <= to_us; us += 100) {
    emulator::TruthRow row;
    row.time_ns = us * 1000;
    truth.on_truth(row);
  }
}

using Us = std::vector<core::Nanoseconds>;

TEST(BoardTruth, RowsStandWhereTheLogsRowsStandThoseBeforeTheFirstIncluded) {
  Times kept;
  BoardTruth truth(kept);
  truth.keep_every(1'000'000);
  plant_runs(truth, 100, 2700);
  EXPECT_TRUE(kept.us.empty()) << "nobody knows yet where the log's rows stand";
  truth.keep_from(2'700'000);
  EXPECT_EQ(kept.us, (Us{700, 1700, 2700}));
  plant_runs(truth, 2800, 4000);
  EXPECT_EQ(kept.us, (Us{700, 1700, 2700, 3700}));
}

TEST(BoardTruth, AnImageThatLogsNothingLosesNothing) {
  Times kept;
  BoardTruth truth(kept);
  truth.keep_every(1'000'000);
  plant_runs(truth, 100, 2500);
  truth.finish();
  EXPECT_EQ(kept.us, (Us{1000, 2000}));

  Times long_kept;
  BoardTruth silent(long_kept);
  silent.keep_every(1'000'000);
  plant_runs(silent, 100, 1'500'000);
  EXPECT_EQ(long_kept.us.size(), 1500U) << "nor does it hold rows without end";
}

TEST(BoardTruth, WithoutAPeriodEveryRowIsKept) {
  Times kept;
  BoardTruth truth(kept);
  truth.keep_from(300'000);
  plant_runs(truth, 100, 500);
  EXPECT_EQ(kept.us, (Us{100, 200, 300, 400, 500}));
}

}  // namespace
}  // namespace towbench::harness
