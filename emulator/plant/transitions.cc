#include "emulator/plant/transitions.h"

#include "emulator/plant/held_terms.h"

namespace towbench::emulator {
namespace {

double sign_of(double value) noexcept {
  return value < 0 ? -1.0 : 1.0;
}

void settle_disabled(Situation& s, StateVector& z) noexcept {
  Regime& regime = s.regime;
  if (regime.drive == Drive::kFreewheel || regime.drive == Drive::kOpen) {
    return;
  }
  z[kIntegral] = 0;
  regime.drive = z[kCurrent] == 0 ? Drive::kOpen : Drive::kFreewheel;
  regime.drive_sign = sign_of(z[kCurrent]);
}

void settle_current_mode(const AxisModel& model, Situation& s, const StateVector& z) noexcept {
  Regime& regime = s.regime;
  const double demanded_V =
      model.mechanics.proportional_gain_V_per_A * (s.held.set_point_A - z[kCurrent]) + z[kIntegral];
  const bool beyond = demanded_V > s.held.limit_V || demanded_V < -s.held.limit_V;
  regime.drive = beyond ? Drive::kLimited : Drive::kRegulated;
  regime.drive_sign = sign_of(demanded_V);
}

void settle_voltage_mode(const AxisModel& model, Situation& s, const StateVector& z) noexcept {
  Regime& regime = s.regime;
  const auto& axis = model.parameters;
  const double sign = sign_of(z[kCurrent]);
  const double surplus_V =
      sign * (s.held.command_terminal_V - axis.winding.resistance_ohm * z[kCurrent] -
              axis.torque_constant_Nm_per_A * z[kMotorSpeed]);
  const bool limited = sign * z[kCurrent] >= axis.current_limit_A && surplus_V > 0;
  regime.drive = limited ? Drive::kCurrentLimited : Drive::kVoltage;
  regime.drive_sign = sign;
}

// 0 while friction holds `load`, else the direction in which the body starts.
double direction_under(const BreakAway& level, double load, double transmission_N) noexcept {
  for (const double sign : {1.0, -1.0}) {
    if (breakaway_margin(level, sign, load, transmission_N, 1.0) < 0) {
      return sign;
    }
  }
  return 0.0;
}

// A body on an elastic contact is never torn off by a jump: it must bend the contact first.
void settle_resting_motor(const AxisModel& model, Situation& s, const StateVector& z) noexcept {
  s.regime.motor_direction = 0;
  hold_motor_breakaway(model, s, carriage_position_m(model, z));
  if (!model.motor_contact.present()) {
    s.regime.motor_direction = direction_under(s.motor_breakaway, motor_load_Nm(model, s, z, 1.0),
                                               transmission_force_N(model, s, z, 1.0));
  }
}

void settle_resting_carriage(const AxisModel& model, Situation& s, const StateVector& z) noexcept {
  s.regime.carriage_direction = 0;
  hold_carriage_breakaway(model, s, carriage_position_m(model, z));
  if (!model.carriage_contact.present()) {
    s.regime.carriage_direction =
        direction_under(s.carriage_breakaway, carriage_load_N(model, s, z, 1.0),
                        transmission_force_N(model, s, z, 1.0));
  }
}

void settle_friction(const AxisModel& model, Situation& s, const StateVector& z) noexcept {
  if (!model.motor_is_dry) {
    s.regime.motor_direction = 1.0;  // moves freely, whichever way
  } else if (s.regime.motor_direction == 0) {
    settle_resting_motor(model, s, z);
  }
  if (model.parameters.elasticity.rigid) {
    return;
  }
  if (!model.carriage_is_dry) {
    s.regime.carriage_direction = 1.0;
  } else if (s.regime.carriage_direction == 0) {
    settle_resting_carriage(model, s, z);
  }
}

void settle_end(const AxisModel& model, Situation& s, const StateVector& z) noexcept {
  if (s.regime.end != HardEnd::kClear || !model.parameters.hard_ends.fitted) {
    return;
  }
  for (const double sign : {1.0, -1.0}) {
    if (penetration_m(model, z, 1.0, sign) > 0) {
      s.regime.end = end_push_N(model, z, 1.0, sign) > 0 ? HardEnd::kPushing : HardEnd::kRebounding;
      s.regime.end_sign = sign;
    }
  }
}

void stop_motor(const AxisModel& model, Situation& s, StateVector& z) noexcept {
  s.motor_anchor_rad =
      anchor_after_sliding(model.motor_contact, z[kMotorAngle], s.regime.motor_direction);
  z[kMotorSpeed] = 0;
  if (model.parameters.elasticity.rigid) {
    z[kCarriageSpeed] = 0;
  }
  settle_resting_motor(model, s, z);
}

void stop_carriage(const AxisModel& model, Situation& s, StateVector& z) noexcept {
  s.carriage_anchor_m = anchor_after_sliding(model.carriage_contact, carriage_position_m(model, z),
                                             s.regime.carriage_direction);
  z[kCarriageSpeed] = 0;
  settle_resting_carriage(model, s, z);
}

void cross_transmission(const AxisModel& model, Event event, double sign, Situation& s) noexcept {
  Regime& regime = s.regime;
  switch (event) {
    case Event::kTransmissionPulls:
      regime.transmission = model.play.engaged;
      regime.transmission_sign = sign;
      break;
    case Event::kTransmissionReleases:
      regime.transmission = TransmissionContact::kLeaving;
      break;
    case Event::kTransmissionClears:
      regime.transmission = TransmissionContact::kOpen;
      break;
    case Event::kStrandSlackens:
      regime.transmission = TransmissionContact::kOneStrand;
      regime.transmission_sign = sign;
      break;
    default:
      regime.transmission = TransmissionContact::kTaut;
      regime.transmission_sign = model.play.has_gap() ? sign : 0.0;
      break;
  }
  s.transmission =
      transmission_law(model.mechanics, model.play, regime.transmission, regime.transmission_sign);
}

void cross_drive(const AxisModel& model, Event event, double sign, Situation& s,
                 StateVector& z) noexcept {
  Regime& regime = s.regime;
  regime.drive_sign = sign;
  switch (event) {
    case Event::kVoltageLimitReached:
      regime.drive = Drive::kLimited;
      return;
    case Event::kVoltageLimitLeft:
      regime.drive = Drive::kRegulated;
      return;
    case Event::kCurrentLimitReached:
      regime.drive = Drive::kCurrentLimited;
      z[kCurrent] = sign * model.parameters.current_limit_A;
      return;
    case Event::kCurrentLimitLeft:
      regime.drive = Drive::kVoltage;
      return;
    default:
      regime.drive = Drive::kOpen;
      z[kCurrent] = 0;
      return;
  }
}

}  // namespace

void settle_drive(const AxisModel& model, Situation& s, StateVector& z) noexcept {
  if (!s.held.enabled) {
    settle_disabled(s, z);
  } else if (model.parameters.amplifier.mode == AmplifierMode::kCurrent) {
    settle_current_mode(model, s, z);
  } else {
    settle_voltage_mode(model, s, z);
  }
}

void settle(const AxisModel& model, Situation& s, StateVector& z) noexcept {
  settle_drive(model, s, z);
  settle_end(model, s, z);
  if (model.has_terms) {
    hold_terms(model, s, motion_at(model, z));
  }
  settle_friction(model, s, z);
}

void cross(const AxisModel& model, Event event, double sign, Situation& s,
           StateVector& z) noexcept {
  switch (event) {
    case Event::kVoltageLimitReached:
    case Event::kVoltageLimitLeft:
    case Event::kCurrentLimitReached:
    case Event::kCurrentLimitLeft:
    case Event::kCurrentDied:
      cross_drive(model, event, sign, s, z);
      return;
    case Event::kMotorStops:
      stop_motor(model, s, z);
      return;
    case Event::kMotorBreaksAway:
      s.regime.motor_direction = sign;
      return;
    case Event::kCarriageStops:
      stop_carriage(model, s, z);
      return;
    case Event::kCarriageBreaksAway:
      s.regime.carriage_direction = sign;
      return;
    case Event::kEndReached:
    case Event::kEndPushesAgain:
      s.regime.end = HardEnd::kPushing;
      s.regime.end_sign = sign;
      return;
    case Event::kEndReleases:
      s.regime.end = HardEnd::kRebounding;
      return;
    case Event::kEndCleared:
      s.regime.end = HardEnd::kClear;
      return;
    case Event::kTransmissionPulls:
    case Event::kTransmissionReleases:
    case Event::kTransmissionClears:
    case Event::kStrandSlackens:
    case Event::kStrandTightens:
      cross_transmission(model, event, sign, s);
      hold_terms(model, s, motion_at(model, z));
      settle_friction(model, s, z);
      return;
  }
}

}  // namespace towbench::emulator
