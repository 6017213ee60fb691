// Encoders that freeze on the way to standstill, fed to the judge of encoders sample by sample:
// what a motor cannot do is found, what it can do is not.
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "bbmc/system/axis_control.h"
#include "bbmc/system/configuration.h"

namespace towbench::tests {
namespace {

using core::ErrorCode;

constexpr core::Nanoseconds kExchange_ns = core::kNanosecondsPerMillisecond;

bbmc::AxisConfiguration y_axis() {
  auto settings = bbmc::Configuration().axes[core::Axis::kY];
  settings.plausibility.index_fitted = false;
  return settings;
}

class Encoder {
 public:
  explicit Encoder(const bbmc::AxisConfiguration& settings) : plausibility_(settings) {}

  ErrorCode moves(std::int64_t counts, double torque_Nm) {
    change_.time_ns += kExchange_ns;
    change_.elapsed_s = core::seconds(kExchange_ns);
    change_.counts = counts;
    change_.raw_count += counts;
    change_.edges = static_cast<std::uint32_t>(std::abs(counts));
    change_.speed_count_per_s = static_cast<double>(counts) / change_.elapsed_s;
    change_.torque_Nm = torque_Nm;
    return plausibility_.update(change_, bbmc::EncoderPlausibility::Scope::kEverything);
  }

 private:
  bbmc::EncoderPlausibility plausibility_;
  bbmc::EncoderChange change_;
};

TEST(ComesToRest, AMotorThatFrictionStopsIsSound) {
  Encoder encoder(y_axis());
  for (int i = 0; i < 400; ++i) {
    ASSERT_EQ(encoder.moves(8, 2e-3), ErrorCode::kNone);
  }
  for (const int counts : {8, 7, 5, 4, 3, 1, 0, 0, 0, 0, 0, 0, 0, 0}) {
    EXPECT_EQ(encoder.moves(counts, 0), ErrorCode::kNone) << counts;
  }
}

TEST(ComesToRest, AMotorThatFullReverseStopsIsSound) {
  const auto settings = y_axis();
  Encoder encoder(settings);
  for (int i = 0; i < 400; ++i) {
    ASSERT_EQ(encoder.moves(8, 2e-3), ErrorCode::kNone);
  }
  const double full_reverse_Nm = -settings.drive.torque_limit_Nm();
  EXPECT_EQ(encoder.moves(4, full_reverse_Nm), ErrorCode::kNone);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(encoder.moves(0, i == 0 ? full_reverse_Nm : 0), ErrorCode::kNone) << i;
  }
}

// It froze while the carriage ran on: the observer swings, which would explain a drive that holds
// the motor. For as long as a quarter of a swing, not for longer.
TEST(HeldByNothing, ASwingThatHasTurnedRoundExplainsNoStandstill) {
  const auto settings = y_axis();
  Encoder encoder(settings);
  std::int64_t rate = 0;
  for (; rate < 60; ++rate) {
    ASSERT_EQ(encoder.moves(rate, 20e-3), ErrorCode::kNone) << rate;
  }
  for (int i = 0; i < 300; ++i) {
    ASSERT_EQ(encoder.moves(rate, 2e-3), ErrorCode::kNone) << i;
  }
  for (; rate > 3; --rate) {  // a = 1.6 m/s2
    ASSERT_EQ(encoder.moves(rate, -20e-3), ErrorCode::kNone) << rate;
  }
  int found_ms = 0;
  for (int ms = 1; ms < 300 && found_ms == 0; ++ms) {
    const double torque_Nm = -1.8 * settings.plausibility.worst_breakaway_Nm;
    found_ms = encoder.moves(0, torque_Nm) == ErrorCode::kFaultEncoderFrozen ? ms : 0;
  }
  EXPECT_GT(found_ms, 10);
  EXPECT_LT(found_ms, 100);
}

// Two edges 1 us apart are a speed of 2 m/s, once.
TEST(SpeedLimit, OneFalseSpeedIsNotTooFast) {
  const bbmc::Configuration configuration;
  const auto is_too_fast = [&](int samples) {
    bbmc::AxisControl axis(configuration.axes[core::Axis::kY], configuration.safety, 1e3, 1e3);
    bbmc::Eqep::Reading reading;
    bool found = false;
    for (int ms = 1; ms <= 300; ++ms) {
      const bool false_speed = ms >= 200 && ms < 200 + samples;
      reading.time_ns += kExchange_ns;
      reading.position += 20;
      reading.edges += 20;
      reading.capture_valid = true;
      reading.capture_ticks = false_speed ? 2 : 78;  // of 1.5625 MHz
      axis.observe(reading);
      found = axis.breaks_limits() || found;
    }
    return found;
  };
  EXPECT_FALSE(is_too_fast(0));
  EXPECT_FALSE(is_too_fast(1));
  EXPECT_TRUE(is_too_fast(2));
}

}  // namespace
}  // namespace towbench::tests
