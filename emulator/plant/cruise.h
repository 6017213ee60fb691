// The common regime made short: current loop in control, elastic chain, both bodies sliding, no
// stop touched. The same arithmetic as the general tick (axis_plant.cc) with every other case left
// out; most ticks of a run are of this kind, and it takes half the time.
#pragma once

#include <cmath>

#include "emulator/plant/situation.h"

namespace towbench::emulator {

// Prepared whenever regime or inputs change.
struct Cruise {
  bool possible = false;
  const DiscreteMode* mode = nullptr;
  double motor_direction = 0;
  double carriage_direction = 0;
  double set_point_A = 0;
  double limit_V = 0;
  double force_N = 0;  // from outside
  double min_m = 0;
  double max_m = 0;
};

// Half the speed changes of the tick before: what the next tick's middle is predicted from.
struct HalfChange {
  double motor_rad_per_s = 0;
  double carriage_m_per_s = 0;
};

[[nodiscard]] Cruise prepare_cruise(const AxisModel& model, const Situation& s) noexcept;

// Off by more than this share of the Stribeck speed, a predicted middle speed shows in the
// friction.
inline constexpr double kSpeedMiss = 1e-4;

// One tick. False, and nothing changed, when the regime ends within it.
[[nodiscard, gnu::always_inline]] inline bool cruise(const AxisModel& model, const Cruise& c,
                                                     std::size_t& interval, HalfChange& half,
                                                     const StateVector& z,
                                                     StateVector& next) noexcept {
  const DerivedMechanics& m = model.mechanics;
  const DiscreteMode& mode = *c.mode;
  const double position_m = m.metres_per_radian * z[kMotorAngle] - z[kStretch];
  const double rails_N =
      model.position_friction(position_m + 0.5 * model.tick_s * z[kCarriageSpeed], interval);
  const double motor_ratio =
      std::fabs(z[kMotorSpeed] + half.motor_rad_per_s) * m.motor.inverse_speed;
  const double carriage_ratio =
      std::fabs(z[kCarriageSpeed] + half.carriage_m_per_s) * m.carriage.inverse_speed;
  const double motor_Nm = m.motor.coulomb + m.motor.excess * model.stribeck(motor_ratio);
  const double carriage_N =
      m.carriage.coulomb + m.carriage.excess * model.stribeck(carriage_ratio) + rails_N;
  next = step(mode, z,
              {c.set_point_A, -c.motor_direction * motor_Nm,
               c.force_N - c.carriage_direction * carriage_N});
  const double motor_change = 0.5 * (next[kMotorSpeed] - z[kMotorSpeed]);
  const double carriage_change = 0.5 * (next[kCarriageSpeed] - z[kCarriageSpeed]);
  const bool missed =
      std::fabs(motor_change - half.motor_rad_per_s) * m.motor.inverse_speed > kSpeedMiss ||
      std::fabs(carriage_change - half.carriage_m_per_s) * m.carriage.inverse_speed > kSpeedMiss;
  half = {.motor_rad_per_s = motor_change, .carriage_m_per_s = carriage_change};
  if (missed &&
      !(model.stribeck.has_faded(motor_ratio) && model.stribeck.has_faded(carriage_ratio))) {
    return false;
  }
  const double demanded_V =
      m.proportional_gain_V_per_A * (c.set_point_A - next[kCurrent]) + next[kIntegral];
  const double next_m = m.metres_per_radian * next[kMotorAngle] - next[kStretch];
  return std::fabs(demanded_V) <= c.limit_V && c.motor_direction * next[kMotorSpeed] >= 0 &&
         c.carriage_direction * next[kCarriageSpeed] >= 0 && next_m >= c.min_m && next_m <= c.max_m;
}

}  // namespace towbench::emulator
