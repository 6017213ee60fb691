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

// Dry friction of both bodies as inputs, for speeds in the middle of a tick.
[[nodiscard, gnu::always_inline]] inline InputVector cruise_inputs(
    const AxisModel& model, const Cruise& c, double rails_N, double motor_rad_per_s,
    double carriage_m_per_s) noexcept {
  const DerivedMechanics& m = model.mechanics;
  const double motor_Nm = friction_level(model, m.motor, motor_rad_per_s);
  const double carriage_N = friction_level(model, m.carriage, carriage_m_per_s) + rails_N;
  return {c.set_point_A, -c.motor_direction * motor_Nm,
          c.force_N - c.carriage_direction * carriage_N};
}

// One tick. False, and nothing changed but `half`, when the regime ends within it.
[[nodiscard, gnu::always_inline]] inline bool cruise(const AxisModel& model, const Cruise& c,
                                                     std::size_t& interval, HalfChange& half,
                                                     const StateVector& z,
                                                     StateVector& next) noexcept {
  const DerivedMechanics& m = model.mechanics;
  const double w = z[kMotorSpeed];
  const double v = z[kCarriageSpeed];
  const double rails_N =
      model.position_friction(carriage_position_m(model, z) + 0.5 * model.tick_s * v, interval);
  const InputVector inputs =
      cruise_inputs(model, c, rails_N, w + half.motor_rad_per_s, v + half.carriage_m_per_s);
  next = step(*c.mode, z, inputs);
  const HalfChange was = half;
  half = {.motor_rad_per_s = 0.5 * (next[kMotorSpeed] - w),
          .carriage_m_per_s = 0.5 * (next[kCarriageSpeed] - v)};
  if (std::fabs(half.motor_rad_per_s - was.motor_rad_per_s) * m.motor.inverse_speed > kSpeedMiss ||
      std::fabs(half.carriage_m_per_s - was.carriage_m_per_s) * m.carriage.inverse_speed >
          kSpeedMiss) {
    const InputVector refined =
        cruise_inputs(model, c, rails_N, w + half.motor_rad_per_s, v + half.carriage_m_per_s);
    add_input(*c.mode, kMotorTorque, refined[kMotorTorque] - inputs[kMotorTorque], next);
    add_input(*c.mode, kCarriageForce, refined[kCarriageForce] - inputs[kCarriageForce], next);
  }
  const double demanded_V =
      m.proportional_gain_V_per_A * (c.set_point_A - next[kCurrent]) + next[kIntegral];
  const double next_m = carriage_position_m(model, next);
  return std::fabs(demanded_V) <= c.limit_V && c.motor_direction * next[kMotorSpeed] >= 0 &&
         c.carriage_direction * next[kCarriageSpeed] >= 0 && next_m >= c.min_m && next_m <= c.max_m;
}

}  // namespace towbench::emulator
