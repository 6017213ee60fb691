// The plain regimes made short: amplifier in current mode (in control, at its limit, or off),
// elastic transmission, each body sliding or standing, no stop touched, no optional term. The same
// arithmetic as the general tick (axis_plant.cc) with every other case left out: nearly every tick
// of a run is of this kind, and it takes a third of the time.
#pragma once

#include <cmath>

#include "emulator/plant/situation.h"

namespace towbench::emulator {

// Prepared whenever the regime changes; what follows from the input alone is renewed with it.
struct PlainTick {
  bool possible = false;
  bool still = false;  // the tick before changed nothing, nor will the next with the same input
  const DiscreteMode* mode = nullptr;
  double motor_direction = 0;  // 0: stands
  double carriage_direction = 0;
  double motor_breakaway_Nm = 0;  // of a body that stands
  double carriage_breakaway_N = 0;
  double set_point_A = 0;
  double electrical = 0;  // kElectricalInput
  double lowest_V = 0;    // that the loop may demand before its regime ends
  double highest_V = 0;
  double force_N = 0;  // from outside
  double min_m = 0;
  double max_m = 0;
};

[[nodiscard]] inline bool stands(const PlainTick& t) noexcept {
  return t.motor_direction == 0 && t.carriage_direction == 0;
}

// Half the speed changes of the tick before: what the next tick's middle is predicted from.
struct HalfChange {
  double motor_rad_per_s = 0;
  double carriage_m_per_s = 0;
};

[[nodiscard]] PlainTick prepare_plain_tick(const AxisModel& model, const Situation& s) noexcept;

// Takes a new input whose drive regime is settled. False when a body that stands would now be torn
// off: then the regime must be settled as a whole.
[[nodiscard]] bool renew_plain_tick(const AxisModel& model, const Situation& s,
                                    const StateVector& z, PlainTick& tick) noexcept;

// Off by more than this share of the Stribeck speed, a predicted middle speed shows in the
// friction.
inline constexpr double kSpeedMiss = 1e-4;

// Dry friction of the bodies that slide as inputs, for speeds in the middle of a tick.
[[nodiscard, gnu::always_inline]] inline InputVector plain_inputs(
    const AxisModel& model, const PlainTick& t, double rails_N, double motor_rad_per_s,
    double carriage_m_per_s) noexcept {
  const DerivedMechanics& m = model.mechanics;
  const double motor_Nm =
      t.motor_direction == 0 ? 0.0 : friction_level(model, m.motor, motor_rad_per_s);
  const double carriage_N = t.carriage_direction == 0
                                ? 0.0
                                : friction_level(model, m.carriage, carriage_m_per_s) + rails_N;
  return {t.electrical, -t.motor_direction * motor_Nm,
          t.force_N - t.carriage_direction * carriage_N};
}

// Whether drive and bodies are still in their regime at z.
[[nodiscard, gnu::always_inline]] inline bool plain_regime_holds(const AxisModel& model,
                                                                 const PlainTick& t,
                                                                 const StateVector& z) noexcept {
  const DerivedMechanics& m = model.mechanics;
  const double demanded_V =
      m.proportional_gain_V_per_A * (t.set_point_A - z[kCurrent]) + z[kIntegral];
  bool holds = demanded_V >= t.lowest_V && demanded_V <= t.highest_V;
  if (t.motor_direction != 0 && t.carriage_direction != 0) {
    const double x = carriage_position_m(model, z);
    return holds && t.motor_direction * z[kMotorSpeed] >= 0 &&
           t.carriage_direction * z[kCarriageSpeed] >= 0 && x >= t.min_m && x <= t.max_m;
  }
  const double transmission_N = m.transmission_stiffness_N_per_m * z[kStretch] +
                                m.transmission_damping_N_s_per_m *
                                    (m.metres_per_motor_rad * z[kMotorSpeed] - z[kCarriageSpeed]);
  if (t.motor_direction == 0) {
    const double load_Nm = model.parameters.torque_constant_Nm_per_A * z[kCurrent] -
                           m.metres_per_motor_rad * transmission_N;
    holds = holds && std::fabs(load_Nm) <= t.motor_breakaway_Nm;
  } else {
    holds = holds && t.motor_direction * z[kMotorSpeed] >= 0;
  }
  if (t.carriage_direction == 0) {
    return holds && std::fabs(transmission_N + t.force_N) <= t.carriage_breakaway_N;
  }
  const double x = carriage_position_m(model, z);
  return holds && t.carriage_direction * z[kCarriageSpeed] >= 0 && x >= t.min_m && x <= t.max_m;
}

// One tick. False, and nothing changed but `half`, when the regime ends within it.
[[nodiscard, gnu::always_inline]] inline bool step_plainly(const AxisModel& model,
                                                           const PlainTick& t,
                                                           std::size_t& interval, HalfChange& half,
                                                           const StateVector& z,
                                                           StateVector& next) noexcept {
  const DerivedMechanics& m = model.mechanics;
  const double w = z[kMotorSpeed];
  const double v = z[kCarriageSpeed];
  const double rails_N =
      t.carriage_direction == 0
          ? 0.0
          : model.position_friction(carriage_position_m(model, z) + 0.5 * model.tick_s * v,
                                    interval);
  const InputVector inputs =
      plain_inputs(model, t, rails_N, w + half.motor_rad_per_s, v + half.carriage_m_per_s);
  next = step(*t.mode, z, inputs);
  const HalfChange was = half;
  half = {.motor_rad_per_s = 0.5 * (next[kMotorSpeed] - w),
          .carriage_m_per_s = 0.5 * (next[kCarriageSpeed] - v)};
  if (std::fabs(half.motor_rad_per_s - was.motor_rad_per_s) * m.motor.inverse_speed > kSpeedMiss ||
      std::fabs(half.carriage_m_per_s - was.carriage_m_per_s) * m.carriage.inverse_speed >
          kSpeedMiss) {
    const InputVector refined =
        plain_inputs(model, t, rails_N, w + half.motor_rad_per_s, v + half.carriage_m_per_s);
    add_input(*t.mode, kMotorTorque, refined[kMotorTorque] - inputs[kMotorTorque], next);
    add_input(*t.mode, kCarriageForce, refined[kCarriageForce] - inputs[kCarriageForce], next);
  }
  return plain_regime_holds(model, t, next);
}

}  // namespace towbench::emulator
