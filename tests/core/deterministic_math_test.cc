#include "core/deterministic_math.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace towbench::core {
namespace {

// Truth: the C library in extended precision.
TEST(DeterministicMath, SineAndCosineAgreeWithExtendedPrecision) {
  for (int i = -40'000; i <= 40'000; ++i) {
    const double turns = i * 1.37e-4;
    const long double angle = 2.0L * std::numbers::pi_v<long double> * turns;
    const SineCosine value = sine_cosine_of_turns(turns);
    ASSERT_NEAR(value.sine, static_cast<double>(std::sin(angle)), 3e-16) << turns;
    ASSERT_NEAR(value.cosine, static_cast<double>(std::cos(angle)), 3e-16) << turns;
  }
}

TEST(DeterministicMath, QuarterTurnsAreExact) {
  EXPECT_EQ(sine_cosine_of_turns(0.25).sine, 1.0);
  EXPECT_EQ(sine_cosine_of_turns(0.25).cosine, 0.0);
  EXPECT_EQ(sine_cosine_of_turns(-1.5).cosine, -1.0);
  EXPECT_EQ(sine_cosine_of_turns(1e6 + 0.75).sine, -1.0);
}

TEST(DeterministicMath, ExponentialAgreesWithExtendedPrecision) {
  for (int i = -7'000; i <= 7'000; ++i) {
    const double x = i * 0.1;
    const auto truth = static_cast<double>(std::exp(static_cast<long double>(x)));
    ASSERT_NEAR(exponential(x) / truth, 1.0, 4e-16) << x;
  }
  EXPECT_EQ(exponential(0.0), 1.0);
  EXPECT_EQ(exponential(-1e9), 0.0);
  EXPECT_TRUE(std::isfinite(exponential(1e9)));
}

TEST(DeterministicMath, FloorIsExactOnBothSidesOfZero) {
  EXPECT_EQ(floor_exact(-0.5), -1.0);
  EXPECT_EQ(floor_exact(-2.0), -2.0);
  EXPECT_EQ(floor_exact(2.999), 2.0);
}

}  // namespace
}  // namespace towbench::core
