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
  kTransmissionPulls,
  kTransmissionReleases,
  kTransmissionClears,
  kStrandSlackens,
  kStrandTightens,
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

// Of a body at rest: its load below break-away, or its elastic contact bent less than its travel.
template <typename Sink>
[[gnu::always_inline]] inline void visit_rest_guards(const AxisModel& model, const Situation& s,
                                                     const StateVector& z, double one, Event event,
                                                     const ElasticContact& contact, double bend,
                                                     const BreakAway& level, double load,
                                                     Sink&& sink) noexcept {
  if (contact.present()) {
    sink(event, 1.0, one * contact.travel - bend);
    sink(event, -1.0, one * contact.travel + bend);
    return;
  }
  const double transmission_N = model.has_terms ? transmission_force_N(model, s, z, one) : 0.0;
  sink(event, 1.0, breakaway_margin(level, 1.0, load, transmission_N, one));
  sink(event, -1.0, breakaway_margin(level, -1.0, load, transmission_N, one));
}

template <typename Sink>
[[gnu::always_inline]] inline void visit_friction_guards(const AxisModel& model, const Situation& s,
                                                         const StateVector& z, double one,
                                                         Sink&& sink) noexcept {
  if (model.motor_is_dry) {
    if (s.regime.motor_direction != 0) {
      sink(Event::kMotorStops, 0.0, s.regime.motor_direction * z[kMotorSpeed]);
    } else {
      visit_rest_guards(model, s, z, one, Event::kMotorBreaksAway, model.motor_contact,
                        motor_bend_rad(s, z, one), s.motor_breakaway,
                        motor_load_Nm(model, s, z, one), sink);
    }
  }
  if (model.carriage_is_dry) {
    if (s.regime.carriage_direction != 0) {
      sink(Event::kCarriageStops, 0.0, s.regime.carriage_direction * z[kCarriageSpeed]);
    } else {
      visit_rest_guards(model, s, z, one, Event::kCarriageBreaksAway, model.carriage_contact,
                        carriage_bend_m(model, s, z, one), s.carriage_breakaway,
                        carriage_load_N(model, s, z, one), sink);
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

// Only for a transmission with play or strands that may go slack (transmission_play.h).
template <typename Sink>
[[gnu::always_inline]] inline void visit_transmission_guards(const AxisModel& model,
                                                             const Situation& s,
                                                             const StateVector& z, double one,
                                                             Sink&& sink) noexcept {
  const TransmissionPlay& play = model.play;
  const double side = s.regime.transmission_sign;
  const double stretch_m = transmission_stretch_m(s, z, one);
  const double gap_m = one * play.half_gap_m;
  const double slack_from_m = one * (play.half_gap_m + play.strand_slack_m);
  switch (s.regime.transmission) {
    case TransmissionContact::kTaut:
      if (!play.has_gap()) {
        sink(Event::kStrandSlackens, 1.0, slack_from_m - stretch_m);
        sink(Event::kStrandSlackens, -1.0, slack_from_m + stretch_m);
        return;
      }
      sink(Event::kTransmissionReleases, side, side * transmission_force_N(model, s, z, one));
      if (play.has_strands()) {
        sink(Event::kStrandSlackens, side, slack_from_m - side * stretch_m);
      }
      return;
    case TransmissionContact::kOneStrand:
      if (play.has_strands()) {
        sink(Event::kStrandTightens, side, side * stretch_m - slack_from_m);
      } else {
        sink(Event::kTransmissionReleases, side, side * transmission_force_N(model, s, z, one));
      }
      return;
    case TransmissionContact::kOpen:
      sink(Event::kTransmissionPulls, 1.0, gap_m - stretch_m);
      sink(Event::kTransmissionPulls, -1.0, gap_m + stretch_m);
      return;
    case TransmissionContact::kLeaving: {
      const TransmissionLaw engaged = transmission_law(model.mechanics, play, play.engaged, side);
      sink(Event::kTransmissionPulls, side,
           -side * transmission_force_N(model, engaged, s, z, one));
      sink(Event::kTransmissionClears, side, side * stretch_m - gap_m);
      return;
    }
  }
}

template <typename Sink>
[[gnu::always_inline]] inline void visit_guards(const AxisModel& model, const Situation& s,
                                                const StateVector& z, double one,
                                                Sink&& sink) noexcept {
  visit_drive_guards(model, s, z, one, sink);
  visit_friction_guards(model, s, z, one, sink);
  visit_end_guards(model, s, z, one, sink);
  if (model.play.present()) {
    visit_transmission_guards(model, s, z, one, sink);
  }
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
