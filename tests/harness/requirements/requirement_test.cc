// Requirements of an experiment: read, refused, and judged on records that are known.
#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "harness/experiment/requirement_text.h"
#include "harness/judge/safety_checks.h"
#include "harness/requirements/judged_requirement.h"
#include "harness/requirements/run_signals.h"
#include "tests/harness/judge/synthetic_run.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

constexpr core::Nanoseconds kOneMs = core::kNanosecondsPerMillisecond;
constexpr auto kAxisY = core::Axis::kY;

Requirement requirement(const std::string& text) {
  return {.id = "R", .text = text, .parsed = *parse_formula(text, run_vocabulary({"steady"}))};
}

JudgedRequirement judged(SyntheticRun& run, const std::string& text) {
  return judge_requirement(requirement(text), trace_of(run.load(), {{"steady", {0.02, 0.05}}}));
}

SyntheticRun with_error(double error_m) {
  SyntheticRun run;
  run.write(
      kOneMs, 60 * kOneMs,
      [=](double time_s, bbmc::TelemetryRow& row) {
        row.axes[kAxisY].mode = time_s < 0.01 ? bbmc::AxisMode::kIdle : bbmc::AxisMode::kPosition;
        // At its worst at 40 ms.
        row.axes[kAxisY].reference_m = 1 + error_m * (1 - std::fabs(time_s - 0.04));
        row.axes[kAxisY].position_m = 1;
      },
      [](double time_s, emulator::TruthRow& row) { row.axes[kAxisY].carriage_m = 3.5 + time_s; });
  return run;
}

TEST(JudgedRequirement, HasItsMarginInTheUnitOfTheSignalAndItsWorstMoment) {
  auto run = with_error(0.4e-3);
  const auto found = judged(run, "always in steady: |y_error| < 1 mm");
  EXPECT_EQ(found.check.verdict, Verdict::kPass);
  EXPECT_NEAR(*found.check.value, 0.6e-3, 1e-12);
  EXPECT_EQ(found.check.unit, "m");
  EXPECT_NEAR(*found.robustness.worst_s, 0.04, 1e-9);
  auto worse = with_error(1.2e-3);
  const auto broken = judged(worse, "always in steady: |y_error| < 1 mm");
  EXPECT_EQ(broken.check.verdict, Verdict::kFail);
  EXPECT_THAT(broken.check.reason, HasSubstr("-0.0002 m at 0.0400 s"));
}

TEST(JudgedRequirement, ReadsTheTruthAtTheTimesOfTheLog) {
  auto run = with_error(0);
  // 4.0 m is the hard end; the last row stands at 3.56 m.
  EXPECT_NEAR(*judged(run, "always: y_end_distance > 0 m").check.value, 0.44, 1e-9);
}

TEST(JudgedRequirement, ThatTheRunHoldsNothingForIsInvalid) {
  auto run = with_error(0);
  EXPECT_EQ(judged(run, "after kill_edge: |y_duty| = 0").check.verdict, Verdict::kInvalid);
  EXPECT_EQ(judged(run, "always: |x_error| < 1 mm").check.verdict, Verdict::kInvalid);
}

// The rule for the kill switch that stands in safety_checks.cc says the same, in other code.
TEST(JudgedRequirement, OfTheKillSwitchAgreesWithTheRuleForEveryController) {
  std::mt19937 random(11);  // NOLINT(cert-msc51-cpp): the same runs every time
  std::size_t broken = 0;
  for (int i = 0; i < 60; ++i) {
    const auto edge_ns = 20 * kOneMs + static_cast<core::Nanoseconds>(random() % 4) * 250'000;
    const auto zero_ns = edge_ns - edge_ns % kOneMs + static_cast<int>(random() % 5) * kOneMs;
    const bool driven_again = random() % 4 == 0;
    const bool reset = random() % 2 == 0;
    SyntheticRun run;
    run.write(
        kOneMs, 60 * kOneMs,
        [=](double /*time_s*/, bbmc::TelemetryRow& row) {
          const bool driven = (row.time_ns >= 10 * kOneMs && row.time_ns < zero_ns) ||
                              (driven_again && row.time_ns == 50 * kOneMs);
          row.axes[kAxisY].duty_pct = driven ? 10 : 0;
        },
        [](double, emulator::TruthRow&) {});
    const auto mask = protocol::mask_of(protocol::InputLine::kKillSwitch);
    const auto line = [](core::Nanoseconds time_ns, const char* kind, unsigned lines) {
      return fmt::format(
          R"({{"time_s":{},"side":"plant","kind":"{}","axis":"y","lines":{},"value":1}})",
          core::seconds(time_ns), kind, lines);
    };
    run.event(line(edge_ns, "input_line_changed", mask));
    run.event(line(40 * kOneMs, "input_line_changed", 0));
    if (reset) {
      run.event(line(45 * kOneMs, "operator_reset", 0));
    }
    const auto by_formula =
        judged(run, "after kill_edge within 2 ms: |y_duty| = 0 and |x_duty| = 0 until reset");
    for (const auto& check : safety_checks(run.load())) {
      if (check.name == "kill_to_zero_duty") {
        EXPECT_EQ(by_formula.check.verdict, check.verdict)
            << i << ": " << by_formula.check.reason << " / " << check.reason;
        broken += check.verdict == Verdict::kFail ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(broken, 10U);
  EXPECT_LT(broken, 50U);
}

std::vector<Requirement> read(const std::string& text) {
  static const std::vector<EvaluationWindow> windows(1);
  const auto file = FixtureFile::parse("schema = 1\n" + text, "made.toml");
  TableReader reader(file, file.table());
  return read_requirements(reader, windows);
}

std::string refusal(const std::string& text) {
  try {
    (void)read(text);
  } catch (const FixtureError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(RequirementText, ReadsBackAsItWasWritten) {
  const auto first = read(
      "[[requirement]]\nid = \"KILL\"\nformula = \"after kill_edge: fault > 0\"\nsource = "
      "\"SAF-1\"\n"
      "under_faults = true\n");
  const auto again = read(to_toml(first.front()));
  EXPECT_EQ(again.front().id, "KILL");
  EXPECT_EQ(again.front().text, "after kill_edge: fault > 0");
  EXPECT_EQ(again.front().source, "SAF-1");
  EXPECT_TRUE(again.front().under_faults);
}

TEST(RequirementText, IsRefusedWithFileLineAndKey) {
  EXPECT_THAT(refusal("[[requirement]]\nid = \"A\"\nformula = \"always: |y_eror| < 1 mm\"\n"),
              HasSubstr("made.toml:4: requirement[0].formula: given \"y_eror\" at column 10"));
  EXPECT_THAT(refusal("[[requirement]]\nid = \"A\"\n"), HasSubstr("formula"));
  EXPECT_THAT(refusal("[[requirement]]\nid = \"a b\"\nformula = \"always: fault = 0\"\n"),
              HasSubstr("letters, digits"));
  const std::string one = "[[requirement]]\nid = \"A\"\nformula = \"always: fault = 0\"\n";
  EXPECT_THAT(refusal(one + one), HasSubstr("no other requirement has"));
}

}  // namespace
}  // namespace towbench::harness
