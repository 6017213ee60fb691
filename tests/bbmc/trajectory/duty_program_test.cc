#include "bbmc/system/trajectory/duty_program.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::bbmc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

TEST(StepsProgram, HoldsEachStepForItsTime) {
  const std::vector<DutyStep> steps{{0, 0.3}, {10, 0.1}, {-4, 0.2}};
  const auto program = StepsProgram::make(steps);
  ASSERT_TRUE(program);
  for (int k = -5; k < 1000; ++k) {
    const double expected = k < 300 || k >= 600 ? 0 : k < 400 ? 10 : -4;
    ASSERT_EQ(program->duty_pct(k * 1e-3), expected) << k;
  }
  EXPECT_DOUBLE_EQ(program->duration_s(), 0.6);
  EXPECT_EQ(program->duty_pct(kNan), 0);
}

TEST(DutyProgram, RestsWithoutDriveAfterItsShape) {
  const std::vector<DutyStep> steps{{7, 0.1}};
  const DutyProgram program(*StepsProgram::make(steps), 0.4);
  EXPECT_DOUBLE_EQ(program.duration_s(), 0.5);
  EXPECT_EQ(program.duty_pct(0.0999), 7);
  EXPECT_EQ(program.duty_pct(0.1), 0);
  EXPECT_EQ(DutyProgram(*StepsProgram::make(steps), -1).duration_s(), 0.1);
  EXPECT_EQ(DutyProgram(*StepsProgram::make(steps), kNan).duration_s(), 0.1);
  EXPECT_EQ(DutyProgram().duration_s(), 0);
  EXPECT_EQ(DutyProgram().duty_pct(0), 0);
  // A ramp that has reached its limit does not hold it for ever.
  const DutyProgram ramp = *BreakAwayProgram::make({});
  EXPECT_NEAR(ramp.duty_pct(ramp.duration_s() - 1e-3), 20, 1e-9);
  EXPECT_EQ(ramp.duty_pct(ramp.duration_s()), 0);
}

TEST(StepsProgram, RefusesWhatIsNoStep) {
  EXPECT_FALSE(StepsProgram::make({}));
  for (const DutyStep bad : {DutyStep{101, 1}, {kNan, 1}, {1, 0}, {1, -1}, {1, kNan}, {1, 1e9}}) {
    EXPECT_FALSE(StepsProgram::make(std::vector<DutyStep>{bad}));
  }
  EXPECT_FALSE(StepsProgram::make(std::vector<DutyStep>(StepsProgram::kMaxSteps + 1, {1, 1})));
}

TEST(SineProgram, IsASineOnItsOffset) {
  const auto program = SineProgram::make(
      {.amplitude_pct = 8, .offset_pct = -3, .frequency_hz = 2.5, .cycles = 4, .wait_s = 0.2});
  ASSERT_TRUE(program);
  EXPECT_DOUBLE_EQ(program->duration_s(), 0.2 + 1.6);
  for (int k = 0; k < 2000; ++k) {
    const double t = k * 1e-3;
    const bool on = k >= 200 && k < 1800;
    const double expected =
        on ? -3 + 8 * std::sin(2 * std::numbers::pi * 2.5 * (k - 200) * 1e-3) : 0;
    ASSERT_NEAR(program->duty_pct(t), expected, 1e-12) << k;
  }
  EXPECT_FALSE(SineProgram::make({.amplitude_pct = 60, .offset_pct = 41}));
  EXPECT_FALSE(SineProgram::make({.frequency_hz = 0}));
  EXPECT_FALSE(SineProgram::make({.cycles = kNan}));
  EXPECT_FALSE(SineProgram::make({.frequency_hz = 1e-9}));
}

// Independent of how the sequence is made: maximum length means that every window of `order` bits
// but zero occurs exactly once, and that the autocorrelation is -1 at every shift but 0.
TEST(PrbsProgram, HasMaximumLengthAndAFlatSpectrum) {
  for (int order = 4; order <= 11; ++order) {
    const auto program = PrbsProgram::make({.bit_s = 0.001, .order = order, .wait_s = 0});
    ASSERT_TRUE(program);
    const std::size_t length = (std::size_t{1} << static_cast<unsigned>(order)) - 1;
    std::vector<int> bits;
    for (std::size_t i = 0; i < length; ++i) {
      bits.push_back(program->duty_pct(1e-3 * static_cast<double>(i)) > 0 ? 1 : -1);
    }
    std::set<std::vector<int>> windows;
    for (std::size_t i = 0; i < length; ++i) {
      std::vector<int> window;
      for (std::size_t k = 0; k < static_cast<std::size_t>(order); ++k) {
        window.push_back(bits[(i + k) % length]);
      }
      windows.insert(window);
    }
    EXPECT_EQ(windows.size(), length) << order;
    for (std::size_t shift = 1; shift < length; shift += 7) {
      int sum = 0;
      for (std::size_t i = 0; i < length; ++i) {
        sum += bits[i] * bits[(i + shift) % length];
      }
      ASSERT_EQ(sum, -1) << order << ' ' << shift;
    }
  }
}

TEST(PrbsProgram, RepeatsAndEnds) {
  const auto program = PrbsProgram::make({.duty_pct = -12, .order = 5, .periods = 2});
  ASSERT_TRUE(program);
  EXPECT_DOUBLE_EQ(program->duration_s(), 0.5 + 62 * 0.05);
  EXPECT_EQ(program->duty_pct(0.4999), 0);
  EXPECT_EQ(program->duty_pct(0.5), -12);
  for (int bit = 0; bit < 31; ++bit) {
    const double t = 0.5 + (bit + 0.5) * 0.05;
    EXPECT_EQ(program->duty_pct(t), program->duty_pct(t + 31 * 0.05));
  }
  EXPECT_EQ(program->duty_pct(3.61), 0);
  EXPECT_FALSE(PrbsProgram::make({.order = 3}));
  EXPECT_FALSE(PrbsProgram::make({.order = 12}));
  EXPECT_FALSE(PrbsProgram::make({.periods = 0}));
  EXPECT_FALSE(PrbsProgram::make({.bit_s = kNan}));
  EXPECT_FALSE(PrbsProgram::make({.bit_s = 100, .order = 11}));
}

}  // namespace
}  // namespace towbench::bbmc
