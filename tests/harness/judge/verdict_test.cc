#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/judge/budget_checks.h"
#include "harness/judge/integrity_checks.h"
#include "tests/harness/judge/synthetic_run.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

constexpr core::Nanoseconds kOneMs = core::kNanosecondsPerMillisecond;
constexpr auto kAxisY = core::Axis::kY;

std::vector<Measurement> measured(double value, std::size_t samples = 1) {
  return {{find_metric("y_duty_peak_pct"), "whole", {value, samples}}};
}

Budget budget(std::optional<double> min, std::optional<double> max) {
  return {.metric = "y_duty_peak_pct", .window = "whole", .min = min, .max = max, .source = ""};
}

TEST(Budget, PassesInsideWithItsMarginToTheNearerLimit) {
  const auto check = judge_budget(budget(8.0, 20.0), measured(10.0));
  EXPECT_EQ(check.verdict, Verdict::kPass);
  EXPECT_DOUBLE_EQ(*check.margin, 0.25);
  EXPECT_DOUBLE_EQ(*judge_budget(budget({}, 20.0), measured(15.0)).margin, 0.25);
}

TEST(Budget, LimitsThemselvesPass) {
  EXPECT_EQ(judge_budget(budget(10.0, 10.0), measured(10.0)).verdict, Verdict::kPass);
}

TEST(Budget, FailsOnEitherSideAndSaysWhich) {
  const auto above = judge_budget(budget(0.0, 1.0), measured(1.5));
  EXPECT_EQ(above.verdict, Verdict::kFail);
  EXPECT_LT(*above.margin, 0.0);
  EXPECT_THAT(above.reason, HasSubstr("above"));
  const auto below = judge_budget(budget(1.0, 2.0), measured(0.5));
  EXPECT_EQ(below.verdict, Verdict::kFail);
  EXPECT_THAT(below.reason, HasSubstr("below"));
}

TEST(Budget, WithoutSamplesOrWithoutNumberIsInvalid) {
  EXPECT_EQ(judge_budget(budget({}, 1.0), measured(0.0, 0)).verdict, Verdict::kInvalid);
  EXPECT_EQ(judge_budget(budget({}, 1.0), measured(std::nan(""))).verdict, Verdict::kInvalid);
  EXPECT_EQ(judge_budget(budget({}, 1.0), {}).verdict, Verdict::kInvalid);
}

TEST(Verdict, OfARunIsItsWorstAndOfNothingInvalid) {
  const auto of = [](std::initializer_list<Verdict> verdicts) {
    std::vector<Check> checks;
    for (const auto verdict : verdicts) {
      checks.emplace_back().verdict = verdict;
    }
    return worst_of(checks);
  };
  EXPECT_EQ(of({}), Verdict::kInvalid);
  EXPECT_EQ(of({Verdict::kPass, Verdict::kPass}), Verdict::kPass);
  EXPECT_EQ(of({Verdict::kPass, Verdict::kFail}), Verdict::kFail);
  EXPECT_EQ(of({Verdict::kFail, Verdict::kInvalid, Verdict::kPass}), Verdict::kInvalid);
  EXPECT_EQ(Check{}.verdict, Verdict::kInvalid);
}

ExpectedRecord complete(core::Nanoseconds end_ns) {
  ExpectedRecord expected;
  expected.control_period_ns = kOneMs;
  expected.exchange_ns = kOneMs;
  expected.end_ns = end_ns;
  return expected;
}

SyntheticRun moving_run(std::uint32_t edges) {
  SyntheticRun run;
  run.write(
      kOneMs, 100 * kOneMs,
      [&](double, bbmc::TelemetryRow& row) { row.axes[kAxisY].edges = edges; },
      [](double time_s, emulator::TruthRow& row) { row.axes[kAxisY].carriage_m = time_s; });
  return run;
}

TEST(Integrity, AWholeRecordPasses) {
  auto run = moving_run(5);
  const auto data = run.load();
  EXPECT_EQ(check_log_complete(data, complete(100 * kOneMs)).verdict, Verdict::kPass);
  EXPECT_EQ(check_truth_complete(data, complete(100 * kOneMs)).verdict, Verdict::kPass);
  EXPECT_EQ(check_edges_seen(data).verdict, Verdict::kPass);
  EXPECT_EQ(check_events_fired(data, complete(100 * kOneMs)).verdict, Verdict::kPass);
}

TEST(Integrity, AMotionThatTheDecoderDidNotSeeIsInvalid) {
  auto run = moving_run(0);
  const auto check = check_edges_seen(run.load());
  EXPECT_EQ(check.verdict, Verdict::kInvalid);
  EXPECT_THAT(check.reason, HasSubstr("saw no edge"));
}

TEST(Integrity, ARunWithoutAnyEdgeIsInvalidEvenIfNothingMoved) {
  SyntheticRun run;
  run.write(
      kOneMs, 10 * kOneMs, [](double, bbmc::TelemetryRow&) {}, [](double, emulator::TruthRow&) {});
  EXPECT_EQ(check_edges_seen(run.load()).verdict, Verdict::kInvalid);
}

TEST(Integrity, ALogThatEndsEarlyIsInvalid) {
  auto run = moving_run(5);
  EXPECT_EQ(check_log_complete(run.load(), complete(102 * kOneMs)).verdict, Verdict::kInvalid);
  EXPECT_EQ(check_truth_complete(run.load(), complete(102 * kOneMs)).verdict, Verdict::kInvalid);
}

TEST(Integrity, AMissingRowIsInvalidAndNamed) {
  auto run = moving_run(5);
  const auto path = run.folder() / "log.csv";
  std::ifstream in(path);
  std::string text;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    text += number == 50 ? "" : line + "\n";
  }
  std::ofstream(path) << text;
  const auto check = check_log_complete(run.load(), complete(100 * kOneMs));
  EXPECT_EQ(check.verdict, Verdict::kInvalid);
  EXPECT_THAT(check.reason, HasSubstr("row 49"));
}

TEST(Integrity, ATornLastRowIsInvalid) {
  auto run = moving_run(5);
  const auto path = run.folder() / "log.csv";
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 3);
  EXPECT_EQ(check_log_complete(run.load(), complete(100 * kOneMs)).verdict, Verdict::kInvalid);
}

TEST(Integrity, LostRowsAndFailedWritesAreInvalid) {
  auto run = moving_run(5);
  const auto data = run.load();
  auto lost = complete(100 * kOneMs);
  lost.rows_lost = 1;
  EXPECT_EQ(check_log_complete(data, lost).verdict, Verdict::kInvalid);
  auto disk_full = complete(100 * kOneMs);
  disk_full.writes_succeeded = false;
  EXPECT_EQ(check_log_complete(data, disk_full).verdict, Verdict::kInvalid);
}

TEST(Integrity, AnEventThatDidNotFireIsInvalid) {
  auto run = moving_run(5);
  const auto data = run.load();
  auto silent = complete(100 * kOneMs);
  silent.scheduled_events = 1;
  EXPECT_EQ(check_events_fired(data, silent).verdict, Verdict::kInvalid);
  auto too_late = complete(100 * kOneMs);
  too_late.unreached_events = 1;
  EXPECT_EQ(check_events_fired(data, too_late).verdict, Verdict::kInvalid);
}

TEST(Windows, MayCountFromTheFirstMotion) {
  SyntheticRun run;
  run.write(
      kOneMs, 100 * kOneMs,
      [](double time_s, bbmc::TelemetryRow& row) {
        row.axes[kAxisY].mode = time_s >= 0.02 ? bbmc::AxisMode::kPosition : bbmc::AxisMode::kIdle;
      },
      [](double, emulator::TruthRow&) {});
  const auto windows =
      resolve_windows({{}, {"w", EvaluationWindow::Origin::kMotion, 0.01, 0.03}}, run.load());
  ASSERT_EQ(windows.size(), 2U);
  EXPECT_TRUE(windows[1].found);
  EXPECT_TRUE(windows[1].span.holds(0.03));
  EXPECT_TRUE(windows[1].span.holds(0.05));
  EXPECT_FALSE(windows[1].span.holds(0.029));
  EXPECT_FALSE(windows[1].span.holds(0.051));
}

// Another controller tells of no state, and its machine may have axes beside y and x.
TEST(Windows, CountFromTheFirstAxisThatIsDrivenWhicheverItIs) {
  const TemporaryFixtures files;
  files.write("log.csv",
              "time_s,y_duty_pct,x_duty_pct,z_duty_pct\n"
              "0,0,0,0\n0.001,0,0,0\n0.002,0,0,5\n0.003,0,-5,5\n");
  files.write("truth.csv", "time_s\n0.001\n");
  files.write("events.jsonl", "");
  core::PerAxis<AxisLimits> limits;
  for (const auto further : core::kFurtherAxes) {
    limits[further].exists = further == core::Axis::kZ;
  }
  const auto window = resolve_windows({{"w", EvaluationWindow::Origin::kMotion, 0, 1}},
                                      load_run_data(files.folder(), limits))[0];
  ASSERT_TRUE(window.found);
  EXPECT_TRUE(window.span.holds(0.002));
  EXPECT_FALSE(window.span.holds(0.001));
}

TEST(Windows, WithoutMotionAreNotFound) {
  SyntheticRun run;
  run.write(
      kOneMs, 10 * kOneMs, [](double, bbmc::TelemetryRow&) {}, [](double, emulator::TruthRow&) {});
  EXPECT_FALSE(
      resolve_windows({{"w", EvaluationWindow::Origin::kMotion, 0, 1}}, run.load())[0].found);
}

}  // namespace
}  // namespace towbench::harness
