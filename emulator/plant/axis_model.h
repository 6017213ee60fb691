// What never changes during a run: one axis's derived mechanics, friction laws and linear modes.
//
//   winding    L i' = v - R i - K_T w                                   (3.13)
//              v = sat(K_p (i_ref - i) + q),  q' = (v - q) K_i / K_p    current loop, kCurrentLoop;
//                                                       v at the limit: kLimitedLoop
//              v held, q' = 0                                           kFixedVoltage
//              i' = 0, q' = 0                                           kFixedCurrent
//   motor      J_m w' = K_T i - B_m w - r F_t + tau                     (3.37), errata corrected
//   carriage   M v'   = F_t - B_c v + F + F_end                         (3.38)
//   elastic    F_t = K_s d + B_s d',  d = r theta - x,  d' = r w - v; half of both on one strand,
//              none in a gap (transmission_play.h)
//   cable      F_cable = -K_w (x - x_w)
//   at rest    w = 0, or on an elastic contact: tau = -sigma_0 (theta - theta_0) - sigma_1 w
//              (presliding.h); the carriage likewise
//   hard end   F_end = -K_e (x - x_end) - B_e v, only while it pushes
//   rigid      J w' = K_T i - B w + tau + r (F + F_end),  v = r w       (3.33)
//
// The loop is a PI in its automatic-reset form: unlimited, q' = K_i (i_ref - i); at the limit q
// settles to the limit and no further. So nothing winds up, and z' has no jump at the limit: with
// an integrator that merely stops there it has one, and where the set-point cannot be reached the
// axis would chatter between the two.
//
// tau and F are what is held during a step: dry friction, outside forces, what held_terms.h adds. A
// body that sticks without presliding has its speed row zero.
#pragma once

#include <array>

#include "emulator/plant/derived_mechanics.h"
#include "emulator/plant/friction_law.h"
#include "emulator/plant/gear_loss.h"
#include "emulator/plant/linear_mode.h"
#include "emulator/plant/presliding.h"
#include "emulator/plant/regime.h"
#include "emulator/plant/torque_ripple.h"
#include "emulator/plant/transmission_play.h"
#include "emulator/plant/wheel.h"

namespace towbench::emulator {

struct AxisModel {
  // Parameters must be consistent (axis_parameters.h); aborts on a mode too fast for the tick.
  AxisModel(const AxisParameters& axis, double tick_length_s) noexcept;

  AxisParameters parameters;
  DerivedMechanics mechanics;
  StribeckCurve stribeck;
  PositionCurve position_friction;  // N, or N m when the transmission is rigid
  PositionCurve position_force;     // N
  SineTable sine;
  TorqueRipple ripple;
  Wheel wheel;
  GearLoss gear_loss;
  TransmissionPlay play;
  ElasticContact motor_contact;
  ElasticContact carriage_contact;
  double tick_s;
  bool motor_is_dry;     // has friction to stick with
  bool carriage_is_dry;  // likewise; false when the transmission is rigid
  bool has_terms;        // whether held_terms.h has anything to add
  std::array<DiscreteMode, kModeCount> ticks{};
  std::array<ContinuousMode, kModeCount> flows{};
};

[[nodiscard]] ContinuousMode continuous_mode(const AxisParameters& axis,
                                             const DerivedMechanics& mechanics,
                                             const ModeKey& key) noexcept;

// Of each body with itself; absent without presliding.
[[nodiscard]] ElasticContact motor_contact(const AxisParameters& axis,
                                           const DerivedMechanics& mechanics) noexcept;
[[nodiscard]] ElasticContact carriage_contact(const AxisParameters& axis,
                                              const DerivedMechanics& mechanics) noexcept;

// Modes that can occur: a transmission without play never lets go.
[[nodiscard]] std::size_t modes_in_use(const TransmissionPlay& play) noexcept;

}  // namespace towbench::emulator
