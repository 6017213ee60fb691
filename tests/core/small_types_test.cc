// Axis, time and parameter ranges.
#include <limits>

#include <gtest/gtest.h>

#include "core/axis.h"
#include "core/parameter.h"
#include "core/time.h"

namespace towbench::core {
namespace {

TEST(Axis, IndexesAValueForEachAxis) {
  PerAxis<int> values;
  values[Axis::kY] = 1;
  values[Axis::kX] = 2;
  EXPECT_EQ(values.values[0], 1);
  EXPECT_EQ(values.values[1], 2);
  EXPECT_EQ(name_of(Axis::kY), "y");
  EXPECT_EQ(name_of(Axis::kX), "x");
}

TEST(Time, ConvertsSecondsToTheNearestNanosecond) {
  EXPECT_EQ(nanoseconds(1.0), kNanosecondsPerSecond);
  EXPECT_EQ(nanoseconds(1e-4), kPlantTick_ns);
  EXPECT_EQ(nanoseconds(-0.3e-9), 0);
  EXPECT_EQ(nanoseconds(-1.6e-9), -2);
  EXPECT_EQ(nanoseconds(0.1) * 10, kNanosecondsPerSecond);
  EXPECT_DOUBLE_EQ(seconds(1'500'000'000), 1.5);
}

TEST(Range, ContainsItsEndsUnlessToldOtherwiseAndNeverWhatIsNotFinite) {
  EXPECT_TRUE(between(1.0, 2.0).contains(1.0));
  EXPECT_TRUE(between(1.0, 2.0).contains(2.0));
  EXPECT_FALSE(between(1.0, 2.0).contains(2.1));
  EXPECT_FALSE(above(0.0).contains(0.0));
  EXPECT_TRUE(above(0.0).contains(std::numeric_limits<double>::denorm_min()));
  EXPECT_TRUE(at_least(0.0).contains(0.0));
  for (const double value :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
        -std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(any_finite().contains(value));
    EXPECT_FALSE(above(0.0).contains(value));
  }
}

}  // namespace
}  // namespace towbench::core
