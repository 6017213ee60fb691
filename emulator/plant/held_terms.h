// The optional laws as inputs of the linear mode: each is taken in the middle of a piece of motion,
// where it stands for the piece's mean to second order in its length.
//
//   motor    + ripple(theta) - r F_x - delta'(theta) F_t
//   carriage + F_P(x) + F_x - m g l sin(q + q0)
//   F_x      = what the mode's transmission lacks: K delta + B delta' w, and the gap's constant
//   level    = scale ((C + (S - C) f_s)(1 + s a) + ...) + s a_v B |v| + position + load
//              motor: gear loss (gear_loss.h); carriage: load_ratio |F_t|
//
// s is the direction, a the asymmetry of each level. Position friction and load are neither skewed
// nor warmed.
#pragma once

#include "emulator/plant/situation.h"

namespace towbench::emulator {

// A piece of motion, by its middle.
struct MiddleOfMotion {
  double motor_rad = 0;
  double motor_rad_per_s = 0;
  double carriage_m = 0;
  double carriage_m_per_s = 0;
  double travel_rad = 0;  // of the motor, over the whole piece
};

[[nodiscard]] inline MiddleOfMotion motion_at(const AxisModel& model, const StateVector& z,
                                              double duration_s = 0) noexcept {
  return {.motor_rad = z[kMotorAngle],
          .motor_rad_per_s = z[kMotorSpeed],
          .carriage_m = carriage_position_m(model, z),
          .carriage_m_per_s = z[kCarriageSpeed],
          .travel_rad = duration_s * z[kMotorSpeed]};
}

// Brings everything held into line with the motion: s.terms, friction of a moving body, break-away
// level of a resting one.
TOWBENCH_REALTIME void hold_terms(const AxisModel& model, Situation& s,
                                  const MiddleOfMotion& middle) noexcept;

// The break-away levels alone; s.terms must be up to date.
TOWBENCH_REALTIME void hold_motor_breakaway(const AxisModel& model, Situation& s,
                                            double carriage_m) noexcept;
TOWBENCH_REALTIME void hold_carriage_breakaway(const AxisModel& model, Situation& s,
                                               double carriage_m) noexcept;

}  // namespace towbench::emulator
