// The safety subsystem: what stops the machine, how, and what stays latched afterwards.
//
//   kill switch, peer gone            no power, both axes, at once
//   link silent, clock set back       both axes brake blind: commands may still arrive
//   encoder of one axis               it brakes blind if its speed is still known, else no power
//                                     there; the other brakes
//   amplifier of one axis             both axes brake: one that comes back in time may still stop
//   index of an encoder lost          both axes brake: the speed can still be believed
//   end-stop, limit, tracking, link   both axes brake
//   corrupt
#include <cmath>

#include "bbmc/system/motion_control.h"

namespace towbench::bbmc {
namespace {

using core::Axis;
using core::ErrorCode;
using Kind = SystemEvent::Kind;
using Suspect = AxisControl::Suspect;

// Served so much later than due, an axis ran blind. Counted in exchanges, not in control ticks: at
// 10 Hz as soon as at 1 kHz.
constexpr core::Nanoseconds kOverrun_ns = 20 * core::kNanosecondsPerMillisecond;

struct HallLine {
  Axis axis;
  End end;
};

constexpr HallLine hall_of(Line line) noexcept {
  return {line == Line::kHallYMin || line == Line::kHallYMax ? Axis::kY : Axis::kX,
          line == Line::kHallYMin || line == Line::kHallXMin ? End::kMin : End::kMax};
}

}  // namespace

void MotionControl::serve_line(const Aintc::Reading& edge) noexcept {
  const auto number = static_cast<std::int64_t>(index_of(edge.line)) + 1;
  post_at(edge.time_ns, Kind::kLineEdge, Axis::kY, ErrorCode::kNone,
          edge.active ? number : -number);
  if (edge.line == Line::kKillSwitch) {
    status_.kill_switch_pressed = edge.active;
    if (edge.active) {
      cut_all(ErrorCode::kFaultKillSwitch, Axis::kY);
    }
    return;
  }
  if (index_of(edge.line) > index_of(Line::kHallXMax)) {
    return;  // amplifier lines are judged by their level
  }
  const HallLine hall = hall_of(edge.line);
  AxisControl& axis = axes_[hall.axis];
  const bool stops = axis.end_stops().edge(hall.end, edge.active, axis.observer().raw_count(),
                                           axis.observer().speed_count_per_s(),
                                           core::seconds(now_ns_ - edge.time_ns));
  if (stops && any_powered()) {
    brake_all(end_stop_fault(hall.end), hall.axis);
  }
}

void MotionControl::watch(const ControlSample& sample) noexcept {
  status_.kill_switch_pressed = (sample.lines & mask_of(Line::kKillSwitch)) != 0;
  if (status_.kill_switch_pressed && (status_.fault == ErrorCode::kNone || any_powered())) {
    cut_all(ErrorCode::kFaultKillSwitch, Axis::kY);  // pressed before anybody listened for edges
  }
  for (Axis which : kAxes) {
    axes_[which].end_stops().see((sample.lines & mask_of(hall_min_of(which))) != 0,
                                 (sample.lines & mask_of(hall_max_of(which))) != 0);
    watch_axis(which, sample);
  }
  watch_clock(sample.time_ns);
}

void MotionControl::watch_clock(core::Nanoseconds time_ns) noexcept {
  const core::Nanoseconds before_ns = last_served_ns_;
  last_served_ns_ = time_ns;
  if (before_ns < 0 || !any_powered()) {
    return;
  }
  if (time_ns < before_ns) {
    // The clock has gone back: speeds and ages cannot be believed, the next tick is far away. Not
    // twice: the end of a blind brake is a time too.
    if (axes_[Axis::kY].brakes_blind() || axes_[Axis::kX].brakes_blind()) {
      cut_all(ErrorCode::kFaultControlOverrun, Axis::kY);
    } else {
      give_up_encoders(ErrorCode::kFaultControlOverrun);
    }
  } else if (time_ns - before_ns - exchange_ns_ > kOverrun_ns) {
    brake_all(ErrorCode::kFaultControlOverrun, Axis::kY);
  }
}

void MotionControl::watch_axis(Axis which, const ControlSample& sample) noexcept {
  AxisControl& axis = axes_[which];
  const ErrorCode encoder = axis.judge_encoder();
  if (!is_driven(axis.mode()) && axis.mode() != AxisMode::kBraking) {
    return;
  }
  const core::Nanoseconds age_ns = sample.time_ns - sample.encoder[which].time_ns;
  if (axis.brakes_blind()) {
    return;  // it already does all it can
  }
  if (age_ns > core::nanoseconds(configuration_.safety.link_timeout_s)) {
    // Silence, or a clock that leapt ahead. Commands may still arrive; where they do not, the plant
    // takes the drive away itself.
    give_up_encoders(ErrorCode::kFaultLinkLost);
    return;
  }
  if (encoder == ErrorCode::kFaultEncoderIndex) {
    brake_all(encoder, which);  // the place is in doubt, the speed is not
  } else if (encoder != ErrorCode::kNone) {
    give_up_encoder(encoder, which, Suspect::kEncoder);
    return;
  }
  const bool ready = (sample.lines & mask_of(amplifier_ready_of(which))) != 0;
  if (is_driven(axis.mode()) && axis.amplifier_failed(sample.time_ns, ready)) {
    brake_all(ErrorCode::kFaultAmplifierNotReady, which);
    return;
  }
  End end = End::kMin;
  if (axis.end_stops().moves_into(axis.observer().raw_count(), axis.observer().speed_count_per_s(),
                                  end)) {
    brake_all(end_stop_fault(end), which);
  } else if (is_driven(axis.mode()) && axis.breaks_limits()) {
    brake_all(ErrorCode::kFaultSoftLimit, which);
  }
}

void MotionControl::serve_brakes() noexcept {
  for (Axis which : kAxes) {
    AxisControl& axis = axes_[which];
    if (axis.mode() != AxisMode::kBraking) {
      continue;
    }
    switch (axis.serve_brake(now_ns_)) {
      case BrakeState::kBraking:
        break;
      case BrakeState::kStandstill:
        power_off(which, status_.fault == ErrorCode::kNone ? AxisMode::kIdle : AxisMode::kFaulted,
                  status_.fault);
        break;
      case BrakeState::kTimedOut:
        cut_one(ErrorCode::kFaultStopTimeout, which);
        break;
      case BrakeState::kRanAway:
        cut_one(ErrorCode::kFaultEncoderReversed, which);
        break;
    }
  }
}

void MotionControl::latch(ErrorCode code, Axis which) noexcept {
  if (status_.fault == ErrorCode::kNone) {
    status_.fault = code;
    status_.fault_axis = which;
    post(Kind::kFaultLatched, which, code);
  }
  if (status_.motion != MotionKind::kNone && !motion_ending_) {
    motion_ending_ = true;
    motion_result_ = code;
  } else if (motion_ending_ && motion_result_ == ErrorCode::kNone) {
    motion_result_ = code;
  }
}

void MotionControl::brake_all(ErrorCode code, Axis which) noexcept {
  latch(code, which);
  for (Axis each : kAxes) {
    AxisControl& axis = axes_[each];
    if (is_driven(axis.mode())) {
      // A frozen encoder that nothing has noticed yet would say that there is nothing to brake, and
      // one that is turned over would have the brake push.
      const bool blind =
          !axis.encoder_keeps_up() && axis.begin_blind_braking(now_ns_, Suspect::kEncoder);
      if (!blind && axis.encoder_turned_over()) {
        power_off(each, AxisMode::kFaulted, code);
      } else {
        if (!blind) {
          axis.begin_braking(now_ns_);
        }
        set_mode_event(each);
      }
    }
  }
  for (End end : {End::kMin, End::kMax}) {
    if (code == end_stop_fault(end)) {
      axes_[which].end_is_ahead(end);
    }
  }
}

void MotionControl::cut_one(ErrorCode code, Axis which) noexcept {
  power_off(which, AxisMode::kFaulted, code);
  brake_all(code, which);
}

void MotionControl::give_up_encoder(ErrorCode code, Axis which, Suspect suspect) noexcept {
  if (axes_[which].begin_blind_braking(now_ns_, suspect)) {
    set_mode_event(which);
    brake_all(code, which);
  } else {
    cut_one(code, which);
  }
}

void MotionControl::give_up_encoders(ErrorCode code) noexcept {
  latch(code, Axis::kY);
  for (Axis which : kAxes) {
    const AxisMode mode = axes_[which].mode();
    if (is_driven(mode) || (mode == AxisMode::kBraking && !axes_[which].brakes_blind())) {
      give_up_encoder(code, which, Suspect::kLink);
    }
  }
}

void MotionControl::cut_all(ErrorCode code, Axis which) noexcept {
  latch(code, which);
  for (Axis each : kAxes) {
    power_off(each, AxisMode::kFaulted, code);
  }
}

void MotionControl::settle_after_fault() noexcept {
  if (status_.fault == ErrorCode::kNone) {
    return;
  }
  for (Axis which : kAxes) {
    if (axes_[which].mode() == AxisMode::kIdle) {
      power_off(which, AxisMode::kFaulted, status_.fault);
    }
  }
}

void MotionControl::power_off(Axis which, AxisMode mode, ErrorCode why) noexcept {
  AxisControl& axis = axes_[which];
  if (axis.mode() == mode) {
    return;
  }
  const bool had_power = axis.drive().enable;
  axis.power_off(mode);
  if (had_power) {
    post(Kind::kDutyZeroed, which, why);
  }
  set_mode_event(which);
}

void MotionControl::clear_fault() noexcept {
  status_.fault = ErrorCode::kNone;
  post(Kind::kReset, Axis::kY, ErrorCode::kNone);
  for (Axis which : kAxes) {
    if (axes_[which].mode() == AxisMode::kFaulted) {
      power_off(which, AxisMode::kIdle, ErrorCode::kNone);
    }
  }
  publish();
}

void MotionControl::link_lost(ErrorCode why, core::Nanoseconds now_ns) noexcept {
  now_ns_ = now_ns;
  post(Kind::kPeerLost, Axis::kY, why);
  if (why == ErrorCode::kFaultLinkCorrupt) {
    // Motion was missed, but commands may still arrive. What came out of step may make an encoder
    // unbelievable; then its axis goes on braking blind.
    brake_all(why, Axis::kY);
  } else {
    cut_all(why, Axis::kY);
  }
  finish_motion_when_at_rest();
  publish();
}

}  // namespace towbench::bbmc
