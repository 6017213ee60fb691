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
  Check check(const char* name, const std::vector<Drives>& drives) {
    run_.write(
        kRow_ns, 1000 * kRow_ns,
        [&](double time_s, bbmc::TelemetryRow& row) {
          for (const auto& each : drives) {
            const bool on = time_s > each.from_s - 1e-9 && time_s < each.to_s - 1e-9;
            row.axes[core::Axis::kY].duty_pct += on ? 10 : 0;
          }
        },
        [](double /*time_s*/, emulator::TruthRow& /*row*/) {});
    for (const auto& found : safety_checks(run_.load())) {
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
