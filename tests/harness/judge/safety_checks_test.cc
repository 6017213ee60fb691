// The kill switch and the operator's reset, on runs whose duty is known row by row.
#include "harness/judge/safety_checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/messages.h"
#include "tests/harness/judge/synthetic_run.h"

namespace towbench::harness {
namespace {

using ::testing::HasSubstr;

constexpr core::Nanoseconds kRow_ns = core::kNanosecondsPerMillisecond;

struct Drives {
  double from_s;
  double to_s;
};

class KillAndReset : public ::testing::Test {
 protected:
  void line(double time_s, bool pressed) {
    run_.event(fmt::format(
        R"({{"time_s":{},"side":"plant","kind":"input_line_changed","lines":{},"value":4}})",
        time_s, pressed ? protocol::mask_of(protocol::InputLine::kKillSwitch) : 0));
  }
  void reset(double time_s, int told = 1) {
    run_.event(fmt::format(R"({{"time_s":{},"side":"plant","kind":"operator_reset","value":{}}})",
                           time_s, told));
  }
  // The named check of a run of a second; one without a verdict where it is left out.
  Check check(const char* name, const std::vector<Drives>& drives, const SafetyScope& scope = {}) {
    run_.write(
        kRow_ns, 1000 * kRow_ns,
        [&](double time_s, bbmc::TelemetryRow& row) {
          for (const auto& each : drives) {
            const bool on = time_s > each.from_s - 1e-9 && time_s < each.to_s - 1e-9;
            row.axes[core::Axis::kY].duty_pct += on ? 10 : 0;
          }
        },
        [](double /*time_s*/, emulator::TruthRow& /*row*/) {});
    for (const auto& found : safety_checks(run_.load(), scope)) {
      if (found.name == name) {
        return found;
      }
    }
    Check none;
    none.name = "left out";
    return none;
  }
  SyntheticRun run_;
};

TEST_F(KillAndReset, NothingIsDrivenBetweenTheEdgeAndAResetBehindTheRelease) {
  line(0.2, true);
  line(0.4, false);
  reset(0.5);
  const auto kept = check("kill_to_zero_duty", {{0.05, 0.201}, {0.501, 1}});
  EXPECT_EQ(kept.verdict, Verdict::kPass) << kept.reason;
  EXPECT_NEAR(*kept.value, 1e-3, 1e-9);
}

TEST_F(KillAndReset, DriveBetweenReleaseAndResetFails) {
  line(0.2, true);
  line(0.4, false);
  reset(0.5);
  const auto broken = check("kill_to_zero_duty", {{0.05, 0.201}, {0.45, 1}});
  EXPECT_EQ(broken.verdict, Verdict::kFail);
  EXPECT_THAT(broken.reason, HasSubstr("driven until 0.5000 s"));
}

TEST_F(KillAndReset, AResetWhileTheSwitchIsPressedFreesNothing) {
  line(0.2, true);
  reset(0.3);
  line(0.4, false);
  EXPECT_EQ(check("kill_to_zero_duty", {{0.05, 0.201}, {0.45, 1}}).verdict, Verdict::kFail);
}

TEST_F(KillAndReset, WithoutAResetItHoldsToTheEnd) {
  line(0.2, true);
  line(0.4, false);
  EXPECT_EQ(check("kill_to_zero_duty", {{0.05, 0.201}, {0.9, 0.91}}).verdict, Verdict::kFail);
}

TEST_F(KillAndReset, TheSecondPressIsJudgedLikeTheFirst) {
  line(0.2, true);
  line(0.3, false);
  reset(0.4);
  line(0.6, true);
  const auto broken = check("kill_to_zero_duty", {{0.05, 0.2}, {0.45, 0.65}});
  EXPECT_EQ(broken.verdict, Verdict::kFail);
  EXPECT_THAT(broken.reason, HasSubstr("pressed at 0.6000 s"));
  EXPECT_NEAR(*broken.value, 0.05, 1e-9);
}

// What an image takes for a reset is not known, and that something was typed is.
SafetyScope image(std::vector<double> typed_s) {
  return {.reference_is_known = false,
          .operator_types = true,
          .typed_s = std::move(typed_s),
          .restarts_s = {}};
}

TEST_F(KillAndReset, AnImageMayDriveOnceSomethingWasTypedBehindTheRelease) {
  line(0.2, true);
  line(0.4, false);
  const std::vector<Drives> drives{{0.05, 0.201}, {0.501, 1}};
  EXPECT_EQ(check("kill_to_zero_duty", drives, image({0.01, 0.5})).verdict, Verdict::kPass);
  EXPECT_EQ(check("kill_to_zero_duty", drives, image({0.01, 0.3})).verdict, Verdict::kFail)
      << "typed while it was pressed";
  EXPECT_EQ(check("kill_to_zero_duty", drives, image({0.01})).verdict, Verdict::kFail)
      << "the release alone frees nothing";
}

TEST_F(KillAndReset, AnImageIsJudgedWhereTheContactBounces) {
  line(0.2, true);
  line(0.201, false);
  line(0.2015, true);
  EXPECT_EQ(check("kill_to_zero_duty", {{0.05, 0.9}}, image({0.01})).verdict, Verdict::kFail);
  EXPECT_EQ(check("kill_to_zero_duty", {{0.05, 0.202}}, image({0.01})).verdict, Verdict::kPass);
}

TEST_F(KillAndReset, TheSecondPressUnderAnImageIsJudgedLikeTheFirst) {
  line(0.2, true);
  line(0.3, false);
  line(0.6, true);
  EXPECT_EQ(check("kill_to_zero_duty", {{0.05, 0.2}, {0.45, 0.65}}, image({0.01, 0.4})).verdict,
            Verdict::kFail);
}

TEST_F(KillAndReset, AnImageThatBeginsAgainWaitsForACommandAgain) {
  auto scope = image({0.1, 0.6});
  scope.restarts_s = {0.4};
  EXPECT_EQ(check("starts_undriven", {{0.15, 0.4}, {0.65, 1}}, scope).verdict, Verdict::kPass);
  const auto resumes = check("starts_undriven", {{0.15, 0.4}, {0.45, 1}}, scope);
  EXPECT_EQ(resumes.verdict, Verdict::kFail);
  EXPECT_THAT(resumes.reason, HasSubstr("at 0.4500 s"));
  scope.typed_s.pop_back();
  EXPECT_EQ(check("starts_undriven", {{0.15, 0.4}, {0.65, 1}}, scope).verdict, Verdict::kFail)
      << "nobody has typed since";
}

TEST_F(KillAndReset, AControllerThatIsNotToldMakesTheRunInvalid) {
  reset(0.5, 0);
  const auto told = check("reset_told", {});
  EXPECT_EQ(told.verdict, Verdict::kInvalid);
  EXPECT_THAT(told.reason, HasSubstr("0.5000 s"));
}

TEST_F(KillAndReset, OneThatIsToldIsNoMatter) {
  reset(0.5);
  EXPECT_EQ(check("reset_told", {}).name, "left out");
}

}  // namespace
}  // namespace towbench::harness
