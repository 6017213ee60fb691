// How far a driven axis may be from its reference, of axes with limits of their own.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/judge/safety_checks.h"
#include "tests/harness/judge/synthetic_run.h"

namespace towbench::harness {
namespace {

using core::Axis;
using ::testing::HasSubstr;

struct Away {
  double y_m = 0;  // in the first half of a second
  double x_m = 0;  // in the second
  double duty_pct = 10;
};

// Y has 4 m and may be 0.25 m off, X has 0.68 m and may be a quarter of it off.
Check no_runaway_of(const Away& away) {
  SyntheticRun run;
  run.write(
      core::kNanosecondsPerMillisecond, core::kNanosecondsPerSecond,
      [&](double time_s, bbmc::TelemetryRow& row) {
        row.axes[Axis::kY].duty_pct = away.duty_pct;
        row.axes[Axis::kX].duty_pct = away.duty_pct;
        row.axes[Axis::kY].reference_m = time_s < 0.5 ? away.y_m : 0.0;
        row.axes[Axis::kX].reference_m = time_s < 0.5 ? 0.0 : away.x_m;
      },
      [](double /*time_s*/, emulator::TruthRow& /*row*/) {});
  auto data = run.load();
  data.limits[Axis::kX].hard_min_m = 0.0;
  data.limits[Axis::kX].hard_max_m = 0.68;
  for (const auto& check : safety_checks(data, {})) {
    if (check.name == "no_runaway") {
      return check;
    }
  }
  ADD_FAILURE() << "not judged";
  return {};
}

TEST(NoRunaway, AShortAxisIsJudgedBesideALongOneThatWasFartherOff) {
  const auto check = no_runaway_of({.y_m = 0.22, .x_m = 0.20});
  EXPECT_EQ(check.verdict, Verdict::kFail);
  EXPECT_THAT(check.reason, HasSubstr("x at 0.5"));
  EXPECT_DOUBLE_EQ(*check.value, 0.20);
  EXPECT_DOUBLE_EQ(*check.max, 0.17);
}

TEST(NoRunaway, TellsTheAxisThatIsNearestToItsLimit) {
  const auto check = no_runaway_of({.y_m = 0.22, .x_m = 0.10});
  EXPECT_EQ(check.verdict, Verdict::kPass);
  EXPECT_DOUBLE_EQ(*check.value, 0.22);
  EXPECT_DOUBLE_EQ(*check.max, 0.25);
}

TEST(NoRunaway, EachAxisHasALimit) {
  EXPECT_EQ(no_runaway_of({.y_m = 0.26}).verdict, Verdict::kFail);
  EXPECT_EQ(no_runaway_of({.x_m = 0.18}).verdict, Verdict::kFail);
  EXPECT_EQ(no_runaway_of({.y_m = 0.24, .x_m = 0.16}).verdict, Verdict::kPass);
}

TEST(NoRunaway, AnAxisWithoutDriveMayBeAnywhere) {
  EXPECT_EQ(no_runaway_of({.y_m = 1.0, .x_m = 0.5, .duty_pct = 0}).verdict, Verdict::kPass);
}

}  // namespace
}  // namespace towbench::harness
