#include "emulator/command_path.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

namespace towbench::emulator {
namespace {

using core::ErrorCode;

protocol::PwmDuty duty(std::uint16_t a, std::uint16_t b, std::uint32_t sequence) {
  return {.enable = true,
          .channel_a_ticks = a,
          .channel_b_ticks = b,
          .period_ticks = 1000,
          .sequence = sequence};
}

CommandPath prompt_path() {
  return CommandPath({.pwm_amplitude_V = 10.0, .delay_s = 0.0});
}

TEST(CommandPath, TurnsTicksOfTheActiveChannelIntoVolts) {
  CommandPath path = prompt_path();
  EXPECT_EQ(path.accept(duty(157, 0, 0)), ErrorCode::kNone);
  EXPECT_DOUBLE_EQ(path.step(), 1.57);
  EXPECT_EQ(path.accept(duty(0, 1000, 1)), ErrorCode::kNone);
  EXPECT_DOUBLE_EQ(path.step(), -10.0);
  EXPECT_EQ(path.accept(duty(0, 0, 2)), ErrorCode::kNone);
  EXPECT_DOUBLE_EQ(path.step(), 0.0);
}

TEST(CommandPath, DrivesNothingWhenBothChannelsAreActiveAndSaysSo) {
  CommandPath path = prompt_path();
  ASSERT_EQ(path.accept(duty(500, 0, 0)), ErrorCode::kNone);
  EXPECT_EQ(path.accept(duty(500, 1, 1)), ErrorCode::kBothChannelsActive);
  EXPECT_DOUBLE_EQ(path.step(), 0.0);
}

TEST(CommandPath, IsZeroWhileThePwmIsDisabled) {
  CommandPath path = prompt_path();
  ASSERT_EQ(path.accept(duty(500, 0, 0)), ErrorCode::kNone);
  protocol::PwmDuty off = duty(500, 0, 1);
  off.enable = false;
  EXPECT_EQ(path.accept(off), ErrorCode::kNone);
  EXPECT_DOUBLE_EQ(path.step(), 0.0);
}

TEST(CommandPath, RefusesTicksThatNoCounterCanHave) {
  CommandPath path = prompt_path();
  ASSERT_EQ(path.accept(duty(300, 0, 0)), ErrorCode::kNone);
  protocol::PwmDuty no_period = duty(0, 0, 1);
  no_period.period_ticks = 0;
  EXPECT_EQ(path.accept(no_period), ErrorCode::kMessageBadField);
  EXPECT_EQ(path.accept(duty(1001, 0, 1)), ErrorCode::kMessageBadField);
  EXPECT_EQ(path.accept(duty(0, 1001, 1)), ErrorCode::kMessageBadField);
  EXPECT_DOUBLE_EQ(path.step(), 3.0);
}

TEST(CommandPath, DeliversTheImpulseOfADelayedChange) {
  CommandPath path({.pwm_amplitude_V = 10.0, .delay_s = 30e-6});
  ASSERT_EQ(path.accept(duty(400, 0, 0)), ErrorCode::kNone);
  EXPECT_DOUBLE_EQ(path.step(), 4.0 * 0.7);  // 70 us of 4 V in the first step
  EXPECT_DOUBLE_EQ(path.step(), 4.0);
  ASSERT_EQ(path.accept(duty(0, 200, 1)), ErrorCode::kNone);
  EXPECT_NEAR(path.step(), 4.0 * 0.3 - 2.0 * 0.7, 1e-14);
  EXPECT_DOUBLE_EQ(path.step(), -2.0);
}

TEST(CommandPath, TellsLostFromRepeatedAndOldMessages) {
  CommandPath path = prompt_path();
  ASSERT_EQ(path.accept(duty(100, 0, 41)), ErrorCode::kNone);
  EXPECT_EQ(path.accept(duty(200, 0, 43)), ErrorCode::kSequence);  // one lost: the newest counts
  EXPECT_DOUBLE_EQ(path.step(), 2.0);
  EXPECT_EQ(path.accept(duty(900, 0, 43)), ErrorCode::kSequence);  // repeated: ignored
  EXPECT_EQ(path.accept(duty(900, 0, 42)), ErrorCode::kSequence);  // late: ignored
  EXPECT_DOUBLE_EQ(path.step(), 2.0);
  EXPECT_EQ(path.accept(duty(300, 0, 44)), ErrorCode::kNone);
}

TEST(CommandPath, CountsOnThroughTheWrapOfTheSequence) {
  CommandPath path = prompt_path();
  ASSERT_EQ(path.accept(duty(100, 0, 0xFFFF'FFFFU)), ErrorCode::kNone);
  EXPECT_EQ(path.accept(duty(200, 0, 0)), ErrorCode::kNone);
}

TEST(CommandPath, RemovedIsZeroWhateverWasCommanded) {
  CommandPath path = prompt_path();
  ASSERT_EQ(path.accept(duty(1000, 0, 0)), ErrorCode::kNone);
  path.remove();
  EXPECT_DOUBLE_EQ(path.step(), 0.0);
}

// The fundamental of a PWM goes with sin(pi duty), and a filter scales it.
TEST(CommandPath, RipplesByTheCarriersFundamentalAtItsDuty) {
  constexpr int kSteps = 50'000;
  for (const auto& [ticks, share] : {std::pair{500, 1.0}, std::pair{250, std::sqrt(0.5)},
                                     std::pair{0, 0.0}, std::pair{1000, 0.0}}) {
    CommandPath path({.pwm_amplitude_V = 10.0, .delay_s = 0.0, .ripple_rms_V = 0.2}, 3);
    ASSERT_EQ(path.accept(duty(static_cast<std::uint16_t>(ticks), 0, 0)), ErrorCode::kNone);
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double off_V = path.step() - 0.01 * ticks;
      sum += off_V;
      squares += off_V * off_V;
    }
    EXPECT_NEAR(sum / kSteps, 0.0, 4.0 * 0.2 / std::sqrt(kSteps)) << ticks;
    EXPECT_NEAR(std::sqrt(squares / kSteps), 0.2 * share, 0.2 * 4.0 / std::sqrt(2.0 * kSteps))
        << ticks;
  }
}

TEST(CommandPath, RipplesNoMoreOnceItsDriveIsRemoved) {
  CommandPath path({.pwm_amplitude_V = 10.0, .delay_s = 0.0, .ripple_rms_V = 0.2}, 3);
  ASSERT_EQ(path.accept(duty(500, 0, 0)), ErrorCode::kNone);
  EXPECT_NE(path.step(), 5.0);
  path.remove();
  EXPECT_EQ(path.step(), 0.0);
}

}  // namespace
}  // namespace towbench::emulator
