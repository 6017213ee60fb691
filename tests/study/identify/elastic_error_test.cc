// The stretch of a transmission from encoder and camera, on motions whose stretch has a closed
// form.
#include "study/identify/elastic_error.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "emulator/sensors/camera.h"

namespace towbench::study::identify {
namespace {

constexpr double kDelay_s = 0.083;
constexpr double kPerAcceleration_s2 = 1 / (25.9 * 25.9);
constexpr double kFriction_m = 2.5e-4;
constexpr double kOffset_m = 0.0123;
constexpr double kAngular_per_s = 2 * 3.14159265358979 / 7;

double friction_of(double speed) {
  return kFriction_m * speed / (std::fabs(speed) + 1e-3);
}

// 14 s of a sinusoid of 0.2 m in 7 s; the carriage is behind the motor by the model's stretch.
ElasticInput sinusoid(std::uint64_t seed, double noise_m) {
  ElasticInput input;
  emulator::Camera camera({.fitted = true,
                           .frame_period_s = 0.04,
                           .delay_s = kDelay_s,
                           .noise_m = noise_m,
                           .resolution_m = 5e-4},
                          seed);
  for (int k = 1; k < 14'000; ++k) {
    const double t = 1e-3 * k;
    const double phase = kAngular_per_s * t;
    const double motor = 0.2 * (1 - std::cos(phase));
    const double speed = 0.2 * kAngular_per_s * std::sin(phase);
    const double acceleration = 0.2 * kAngular_per_s * kAngular_per_s * std::cos(phase);
    input.time_s.push_back(t);
    input.motor_m.push_back(motor);
    input.speed_m_per_s.push_back(speed);
    const double carriage =
        motor - kOffset_m - kPerAcceleration_s2 * acceleration - friction_of(speed);
    if (const auto frame = camera.see(core::nanoseconds(t), {{carriage, 0}})) {
      input.frame_s.push_back(core::seconds(frame->arrived_ns));
      input.seen_m.push_back(frame->carriage_m[core::Axis::kY]);
    }
  }
  return input;
}

TEST(ElasticError, FindsDelayStretchAndFrequencyThroughNoiseAndPixels) {
  int covered = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const auto found = elastic_error(sinusoid(seed, 2e-4));
    ASSERT_EQ(found.trouble, "");
    EXPECT_NEAR(found.delay_s.value, kDelay_s, 1e-3);
    EXPECT_NEAR(found.friction_stretch_m.value, kFriction_m, 0.5 * kFriction_m);
    EXPECT_LT(found.delay_s.half_width, 1e-3);
    // Noise and pixels, no more and no less: sqrt(s^2 + r^2/12).
    EXPECT_NEAR(found.residual_rms_m / std::hypot(2e-4, 5e-4 / std::sqrt(12)), 1, 0.15);
    covered += std::fabs(found.delay_s.value - kDelay_s) <= found.delay_s.half_width ? 1 : 0;
    covered += std::fabs(found.friction_stretch_m.value - kFriction_m) <=
                       found.friction_stretch_m.half_width
                   ? 1
                   : 0;
    covered += std::fabs(found.per_acceleration_s2.value - kPerAcceleration_s2) <=
                       found.per_acceleration_s2.half_width
                   ? 1
                   : 0;
  }
  EXPECT_GE(covered, 51);  // of 60 intervals of 95 %
}

TEST(ElasticError, RefusesOneConstantSpeedWhereDelayAndStretchAreTheSame) {
  ElasticInput input;
  for (int k = 0; k < 4000; ++k) {
    input.time_s.push_back(1e-3 * k);
    input.motor_m.push_back(1e-4 * k);
    input.speed_m_per_s.push_back(0.1);
    if (k % 40 == 0) {
      input.frame_s.push_back(1e-3 * k + 0.05);
      input.seen_m.push_back(1e-4 * k - 3e-4 + (k % 80 == 0 ? 1e-4 : -1e-4));
    }
  }
  EXPECT_NE(elastic_error(input).trouble, "");
}

TEST(ElasticError, SaysWhereThereAreTooFewFrames) {
  auto input = sinusoid(1, 2e-4);
  input.frame_s.resize(20);
  input.seen_m.resize(20);
  EXPECT_NE(elastic_error(input).trouble.find("frames"), std::string::npos);
}

}  // namespace
}  // namespace towbench::study::identify
