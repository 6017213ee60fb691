#include <cmath>

#include <gtest/gtest.h>

#include "tests/emulator/recording_peer.h"

namespace towbench::emulator {
namespace {

using core::Axis;

constexpr core::Nanoseconds kMillisecond_ns = core::kNanosecondsPerMillisecond;

RigParameters quiet_sensors(RigParameters rig) {
  for (RigAxisParameters& axis : rig.axes) {
    axis.current_monitor = {.fitted = true, .noise_rms_A = 0.0, .bias_deviation_A = 0.0};
  }
  rig.force_sensor = {.fitted = true,
                      .load_mass_kg = 0.4,
                      .force_noise_rms_N = 0.0,
                      .torque_noise_rms_Nm = 0.0,
                      .force_bias_deviation_N = 0.0,
                      .torque_bias_deviation_Nm = 0.0};
  return rig;
}

TEST(PlantNodeMeasurement, NothingIsMeasuredThatIsNotFitted) {
  ScriptedController c(rig_starting_at(1.0, 0.3));
  c.greet();
  c.run_for(20 * kMillisecond_ns);
  EXPECT_TRUE(c.peer.all<protocol::CurrentSample>().empty());
  EXPECT_TRUE(c.peer.all<protocol::ForceSample>().empty());
}

TEST(PlantNodeMeasurement, SamplesComeAtTheirPeriodWhateverTheExchange) {
  RigParameters rig = quiet_sensors(rig_starting_at(1.0, 0.3));
  rig.axes[Axis::kX].current_monitor.sample_period_s = 0.3e-3;
  ScriptedController c(rig);
  c.greet();
  c.advance_by(3 * kMillisecond_ns);
  std::vector<core::Nanoseconds> x_times;
  std::size_t y_samples = 0;
  for (const auto& sample : c.peer.all<protocol::CurrentSample>()) {
    if (sample.axis == Axis::kX) {
      x_times.push_back(sample.time_ns);
    } else {
      EXPECT_EQ(sample.time_ns, static_cast<core::Nanoseconds>(++y_samples) * kMillisecond_ns);
    }
  }
  EXPECT_EQ(y_samples, 3U);
  ASSERT_EQ(x_times.size(), 10U);
  for (std::size_t i = 0; i < x_times.size(); ++i) {
    EXPECT_EQ(x_times[i], static_cast<core::Nanoseconds>(i + 1) * 300'000);
  }
  EXPECT_EQ(c.peer.all<protocol::ForceSample>().size(), 3U);
}

TEST(PlantNodeMeasurement, TheCurrentMonitorShowsTheArmatureCurrent) {
  ScriptedController c(quiet_sensors(rig_starting_at(1.0, 0.3)));
  c.greet();
  c.enable();
  c.drive(Axis::kY, 30);  // 0.3 V x 0.37 A/V: below break-away, so it comes to rest
  c.run_for(1000 * kMillisecond_ns);
  for (const auto& sample : c.peer.all<protocol::CurrentSample>()) {
    if (sample.time_ns > 900 * kMillisecond_ns) {
      EXPECT_NEAR(sample.armature_current_A, sample.axis == Axis::kY ? 0.111 : 0.0, 1e-4);
    }
  }
}

TEST(PlantNodeMeasurement, AHeldLoadShowsThePushAndItsMomentInTheTankFrame) {
  ScriptedController c(
      quiet_sensors(rig_starting_at(1.0, 0.3)),
      {{.kind = ScheduledEventKind::kPushCarriage, .axis = Axis::kY, .value = -0.8},
       {.kind = ScheduledEventKind::kPushCarriage, .axis = Axis::kX, .value = 0.5}});
  c.greet();
  c.run_for(2000 * kMillisecond_ns);  // below break-away: the transmission rings, then all is still
  const auto sample = c.peer.all<protocol::ForceSample>().back();
  EXPECT_NEAR(sample.force_N[0], 0.5, 1e-3);
  EXPECT_NEAR(sample.force_N[1], -0.8, 1e-3);
  EXPECT_EQ(sample.force_N[2], 0.0F);
  EXPECT_NEAR(sample.torque_Nm[0], 0.3 * -0.8, 1e-3);
  EXPECT_NEAR(sample.torque_Nm[1], -0.3 * 0.5, 1e-3);
}

// What the sensor saw of an unloaded run is m a, so its sum over time is -m times the speed gained.
TEST(PlantNodeMeasurement, TheForceOfAnUnloadedRunIntegratesToTheLoadsMomentum) {
  ScriptedController c(quiet_sensors(rig_starting_at(1.0, 0.3)));
  c.greet();
  c.enable();
  double impulse_Ns = 0.0;
  for (int i = 0; i < 300; ++i) {
    c.drive(Axis::kY, i < 200 ? 200 : 0);
    c.advance_by(kMillisecond_ns);
  }
  for (const auto& sample : c.peer.all<protocol::ForceSample>()) {
    impulse_Ns += static_cast<double>(sample.force_N[1]) * 1e-3;
  }
  const double speed = c.peer.truth.back().axes[Axis::kY].carriage_speed_m_per_s;
  ASSERT_GT(speed, 0.1);
  // Sampling a 9 Hz ringing at 1 kHz through 200 Hz: the sum is off by the last 0.8 ms of force.
  EXPECT_NEAR(impulse_Ns, -0.4 * speed, 0.02 * 0.4 * speed);
}

TEST(PlantNodeMeasurement, FittingASensorChangesNoBitOfTheMachine) {
  const auto run = [](const RigParameters& rig) {
    ScriptedController c(rig);
    c.greet();
    c.enable();
    c.drive(Axis::kY, 230);
    c.run_for(300 * kMillisecond_ns);
    return c.peer.truth.back().axes[Axis::kY].motor_angle_rad;
  };
  EXPECT_EQ(run(rig_starting_at(1.0, 0.3)), run(quiet_sensors(rig_starting_at(1.0, 0.3))));
}

TEST(PlantNodeMeasurement, NoiseRepeatsWithTheSeed) {
  const auto run = [](std::uint64_t seed) {
    RigParameters rig = rig_starting_at(1.0, 0.3);
    rig.force_sensor.fitted = true;
    ScriptedController c(rig, {}, seed);
    c.greet();
    c.run_for(10 * kMillisecond_ns);
    return c.peer.all<protocol::ForceSample>().back().force_N;
  };
  EXPECT_EQ(run(3), run(3));
  EXPECT_NE(run(3), run(4));
}

}  // namespace
}  // namespace towbench::emulator
