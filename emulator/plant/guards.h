// The margins that keep an axis in its regime, and the event when one turns negative.
//
// Every margin is affine in z. `one` carries its constant part, so that the same line of code gives
// the margin itself (one = 1) and, fed with the Taylor coefficients of z, those of the margin.
#pragma once

#include <cstdint>

#include "emulator/plant/situation.h"

namespace towbench::emulator {

enum class Event : std::uint8_t {
  kVoltageLimitReached,
  kVoltageLimitLeft,
  kCurrentLimitReached,
  kCurrentLimitLeft,
  kCurrentDied,
  kMotorStops,
  kMotorBreaksAway,
  kCarriageStops,
  kCarriageBreaksAway,
  kEndReached,
  kEndReleases,
  kEndPushesAgain,
  kEndCleared,
};

// sink(event, sign, margin): the regime holds while margin >= 0.
template <typename Sink>
[[gnu::always_inline]] inline void visit_drive_guards(const AxisModel& model, const Situation& s,
                                                      const StateVector& z, double one,
                                                      Sink&& sink) noexcept {
  const auto& axis = model.parameters;
  const double sign = s.regime.drive_sign;
  const auto demanded_V = [&]() {
    return model.mechanics.proportional_gain_V_per_A * (one * s.held.set_point_A - z[kCurrent]) +
           z[kIntegral];
  };
  switch (s.regime.drive) {
    case Drive::kRegulated:
      sink(Event::kVoltageLimitReached, 1.0, one * s.held.limit_V - demanded_V());
      sink(Event::kVoltageLimitReached, -1.0, one * s.held.limit_V + demanded_V());
      return;
    case Drive::kLimited:
      sink(Event::kVoltageLimitLeft, sign, sign * demanded_V() - one * s.held.limit_V);
      return;
    case Drive::kVoltage:
      sink(Event::kCurrentLimitReached, 1.0, one * axis.current_limit_A - z[kCurrent]);
      sink(Event::kCurrentLimitReached, -1.0, one * axis.current_limit_A + z[kCurrent]);
      return;
    case Drive::kCurrentLimited:
      sink(Event::kCurrentLimitLeft, sign,
           sign * (one * s.held.command_terminal_V - axis.winding.resistance_ohm * z[kCurrent] -
                   axis.torque_constant_Nm_per_A * z[kMotorSpeed]));
      return;
    case Drive::kFreewheel:
      sink(Event::kCurrentDied, sign, sign * z[kCurrent]);
      return;
    case Drive::kOpen:
      return;
  }
}

template <typename Sink>
[[gnu::always_inline]] inline void visit_friction_guards(const AxisModel& model, const Situation& s,
                                                         const StateVector& z, double one,
                                                         Sink&& sink) noexcept {
  if (model.motor_is_dry) {
    if (s.regime.motor_direction != 0) {
      sink(Event::kMotorStops, 0.0, s.regime.motor_direction * z[kMotorSpeed]);
    } else {
      const double load = motor_load_Nm(model, s, z, one);
      sink(Event::kMotorBreaksAway, 1.0, one * s.motor_friction_Nm - load);
      sink(Event::kMotorBreaksAway, -1.0, one * s.motor_friction_Nm + load);
    }
  }
  if (model.carriage_is_dry) {
    if (s.regime.carriage_direction != 0) {
      sink(Event::kCarriageStops, 0.0, s.regime.carriage_direction * z[kCarriageSpeed]);
    } else {
      const double load = carriage_load_N(model, s, z, one);
      sink(Event::kCarriageBreaksAway, 1.0, one * s.carriage_friction_N - load);
      sink(Event::kCarriageBreaksAway, -1.0, one * s.carriage_friction_N + load);
    }
  }
}

template <typename Sink>
[[gnu::always_inline]] inline void visit_end_guards(const AxisModel& model, const Situation& s,
                                                    const StateVector& z, double one,
                                                    Sink&& sink) noexcept {
  const double sign = s.regime.end_sign;
  switch (s.regime.end) {
    case HardEnd::kClear:
      if (model.parameters.hard_ends.fitted) {
        sink(Event::kEndReached, 1.0, -penetration_m(model, z, one, 1.0));
        sink(Event::kEndReached, -1.0, -penetration_m(model, z, one, -1.0));
      }
      return;
    case HardEnd::kPushing:
      sink(Event::kEndReleases, sign, end_push_N(model, z, one, sign));
      return;
    case HardEnd::kRebounding:
      sink(Event::kEndPushesAgain, sign, -end_push_N(model, z, one, sign));
      sink(Event::kEndCleared, sign, penetration_m(model, z, one, sign));
      return;
  }
}

template <typename Sink>
[[gnu::always_inline]] inline void visit_guards(const AxisModel& model, const Situation& s,
                                                const StateVector& z, double one,
                                                Sink&& sink) noexcept {
  visit_drive_guards(model, s, z, one, sink);
  visit_friction_guards(model, s, z, one, sink);
  visit_end_guards(model, s, z, one, sink);
}

// Whether z lies inside the regime.
[[nodiscard, gnu::always_inline]] inline bool regime_holds(const AxisModel& model,
                                                           const Situation& s,
                                                           const StateVector& z) noexcept {
  bool holds = true;
  visit_guards(model, s, z, 1.0,
               [&holds](Event, double, double margin) { holds &= margin >= 0.0; });
  return holds;
}

}  // namespace towbench::emulator
