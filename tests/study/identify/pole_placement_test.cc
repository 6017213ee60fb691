// Placed poles against what shares no code with them: the characteristic polynomial of a rigid
// axis, whose gains have a closed form, and the sampled loop run forwards in small steps.
#include "study/identify/pole_placement.h"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace towbench::study::identify {
namespace {

const TwoMassAxis kTable7_4{1.714e-5, 3.6e-6, 1.106e-5, 9, 0.06};  // Table 7.4, App. A
const SampledLoop kLoop{.period_s = 1e-3};

// A mode of 5 kHz is as good as rigid, and 1 us as no delay: J s^3 + (B + K_D) s^2 + K_P s +
// K_I is J (s + w)(s^2 + 2 zeta w s + w^2).
TEST(PolePlacement, OfARigidAxisHasTheGainsOfItsPolynomial) {
  const TwoMassAxis rigid{1.714e-5, 3.6e-6, 1.106e-5, 5000, 0.06};
  const double w = 40;
  const double zeta = 0.7;
  const auto gains = place_poles(rigid, {.period_s = 1e-6}, w, zeta);
  ASSERT_TRUE(gains.has_value());
  EXPECT_NEAR(gains->proportional_Nm_per_rad, 1.714e-5 * w * w * (1 + 2 * zeta), 3e-5);
  EXPECT_NEAR(gains->integral_Nm_per_rad_s, 1.714e-5 * w * w * w, 5e-4);
  EXPECT_NEAR(gains->derivative_Nm_s_per_rad, 1.714e-5 * w * (1 + 2 * zeta) - 1.106e-5, 5e-7);
}

// The linear equations hold for a delay as such, the poles for the sampled loop: two ways.
TEST(PolePlacement, PutsPolesOfTheSampledLoopWhereTheyWereWanted) {
  for (const double w : {15.0, 60.0, 120.0}) {
    const auto gains = place_poles(kTable7_4, kLoop, w, 0.5);
    if (!gains) {
      continue;
    }
    const std::complex<double> wanted(-0.5 * w, w * std::sqrt(0.75));
    double nearest = 1e9;
    for (const auto& pole : sampled_poles(kTable7_4, kLoop, *gains)) {
      nearest = std::min(nearest, std::abs(pole - wanted));
    }
    EXPECT_LT(nearest, 0.05 * w) << w;
  }
}

// What is left of a blow to the motor after `until_s`, over its largest: the two masses in steps of
// 10 us, the controller once a millisecond and one millisecond late.
double left_of_a_blow(const LoopGains& gains, double until_s) {
  const double mode = 2 * std::numbers::pi * kTable7_4.resonance_Hz;
  const double carriage = kTable7_4.inertia_kg_m2 - kTable7_4.rotor_inertia_kg_m2;
  const double reduced = kTable7_4.rotor_inertia_kg_m2 * carriage / kTable7_4.inertia_kg_m2;
  double motor = 0;
  double load = 0;
  double motor_speed = 1;
  double load_speed = 0;
  double integral = 0;
  double before = 0;
  double next_Nm = 0;
  double largest = 0;
  double left = 0;
  for (int k = 0; 1e-3 * k < until_s; ++k) {
    const double applied_Nm = next_Nm;
    integral -= gains.integral_Nm_per_rad_s * motor * 1e-3;
    next_Nm = integral - gains.proportional_Nm_per_rad * motor -
              gains.derivative_Nm_s_per_rad * (motor - before) / 1e-3;
    before = motor;
    largest = std::max(largest, std::fabs(motor) + std::fabs(load));
    left = 1e-3 * k > until_s - 0.3 ? std::max(left, std::fabs(motor) + std::fabs(load)) : 0;
    for (int step = 0; step < 100; ++step) {
      const double pull = reduced * mode * mode * (motor - load) +
                          2 * kTable7_4.damping_ratio * mode * reduced * (motor_speed - load_speed);
      motor_speed += 1e-5 * (applied_Nm - kTable7_4.viscous_Nm_s_per_rad * motor_speed - pull) /
                     kTable7_4.rotor_inertia_kg_m2;
      load_speed += 1e-5 * pull / carriage;
      motor += 1e-5 * motor_speed;
      load += 1e-5 * load_speed;
    }
  }
  return left / largest;
}

TEST(PolePlacement, TheDampedLoopStopsACarriageThatTheStiffOneLetsSwing) {
  const auto stiff = fastest_loop(kTable7_4, kLoop, {});
  const auto damped = fastest_loop(kTable7_4, kLoop, {.dominant = true});
  ASSERT_TRUE(stiff && damped);
  EXPECT_GT(stiff->gains.proportional_Nm_per_rad, 10 * damped->gains.proportional_Nm_per_rad);
  EXPECT_LE(stiff->largest_sensitivity, 2.0);
  EXPECT_GE(stiff->largest_sensitivity, 1.5);  // or it could be faster
  EXPECT_LT(stiff->slowest_decay_per_s, 1);
  EXPECT_GT(damped->slowest_decay_per_s, 8);
  // From 1 s to 2 s each falls as its slowest pole says.
  const auto falls = [](const LoopGains& gains) {
    return left_of_a_blow(gains, 2.0) / left_of_a_blow(gains, 1.0);
  };
  EXPECT_NEAR(falls(stiff->gains), std::exp(-stiff->slowest_decay_per_s), 0.05);
  EXPECT_LT(falls(damped->gains), 1e-3);
}

// The gain at which proportional control is at the edge of stability, by the poles.
TEST(PolePlacement, TheSampledPolesCrossWhereTheLoopBeginsToGrow) {
  const auto gains = [](double gain) { return LoopGains{gain, 0.1 * gain, 1e-5}; };
  double low = 1e-4;
  double high = 1;
  for (int k = 0; k < 40; ++k) {
    const double middle = std::sqrt(low * high);
    double worst = -1e9;
    for (const auto& pole : sampled_poles(kTable7_4, kLoop, gains(middle))) {
      worst = std::max(worst, pole.real());
    }
    (worst < 0 ? low : high) = middle;
  }
  EXPECT_GT(low, 2e-3);
  EXPECT_LT(low, 0.5);
  EXPECT_LT(left_of_a_blow(gains(0.8 * low), 12), 0.9 * left_of_a_blow(gains(0.8 * low), 4));
  EXPECT_EQ(left_of_a_blow(gains(1.2 * low), 12), 1);
}

TEST(PolePlacement, SaysWhereNoLoopMeetsTheDemands) {
  EXPECT_FALSE(fastest_loop(kTable7_4, kLoop, {.largest_sensitivity = 1.01}).has_value());
}

}  // namespace
}  // namespace towbench::study::identify
