#include "emulator/supply.h"

#include <cmath>

#include <gtest/gtest.h>

namespace towbench::emulator {
namespace {

TEST(Supply, SagsByItsSourceResistanceUnderTheLoadOfBothAxes) {
  Supply supply({.voltage_V = 12.0, .source_resistance_ohm = 0.1, .amplifier_efficiency = 0.95});
  for (int i = 0; i < 100; ++i) {
    supply.step(20.0);
  }
  // 0.95 V (12 - V) / 0.1 = 20, the upper root.
  const double expected_V = 6.0 + std::sqrt(36.0 - 20.0 * 0.1 / 0.95);
  EXPECT_NEAR(supply.voltage_V(), expected_V, 1e-9);
  EXPECT_TRUE(supply.ready());
}

TEST(Supply, TripsOnOverCurrentThatLastsAndStaysOff) {
  const SupplyParameters parameters{.over_current_A = 4.5, .over_current_delay_s = 10e-3};
  Supply supply(parameters);
  const double power_W = 4.6 * 0.95 * 12.0;
  for (int i = 0; i < 99; ++i) {
    supply.step(power_W);
    ASSERT_TRUE(supply.ready()) << i;
  }
  supply.step(0.0);  // a pause: the timer starts anew
  for (int i = 0; i < 100; ++i) {
    supply.step(power_W);
    ASSERT_TRUE(supply.ready()) << i;
  }
  supply.step(power_W);
  supply.step(power_W);
  EXPECT_TRUE(supply.tripped());
  for (int i = 0; i < 1000; ++i) {
    supply.step(0.0);
  }
  EXPECT_FALSE(supply.ready());
  EXPECT_EQ(supply.voltage_V(), 0.0);
}

TEST(Supply, CutsTheAmplifiersBelowTheirMinimumAndBringsThemBackWithHysteresis) {
  Supply supply({.voltage_V = 12.0, .source_resistance_ohm = 0.5, .over_current_A = 100.0});
  supply.step(0.95 * 12.0 * 1.3);  // 0.65 V of sag
  EXPECT_TRUE(supply.cut_out());
  EXPECT_FALSE(supply.ready());
  supply.step(0.95 * supply.voltage_V() * 1.0);  // 11.5 V: above 11.4, inside the hysteresis
  EXPECT_TRUE(supply.cut_out());
  supply.step(0.0);
  EXPECT_TRUE(supply.ready());
}

}  // namespace
}  // namespace towbench::emulator
