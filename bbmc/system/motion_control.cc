#include "bbmc/system/motion_control.h"

#include <algorithm>
#include <cmath>

#include "bbmc/system/cross_coupling.h"

namespace towbench::bbmc {

using core::Axis;
using core::ErrorCode;
using Kind = SystemEvent::Kind;

MotionControl::MotionControl(const Configuration& configuration, core::Nanoseconds exchange_ns,
                             DataLog& log) noexcept
    : configuration_(configuration),
      log_(&log),
      period_ns_(configuration.control_period_ns()),
      exchange_ns_(exchange_ns),
      axes_{{AxisControl(configuration.axes[Axis::kY], configuration.safety,
                         configuration.control_rate_Hz, 1.0 / core::seconds(exchange_ns)),
             AxisControl(configuration.axes[Axis::kX], configuration.safety,
                         configuration.control_rate_Hz, 1.0 / core::seconds(exchange_ns))}} {}

void MotionControl::exchange(const ControlSample& sample, LineEdgeQueue& line_edges,
                             DriveCommand& command) noexcept {
  now_ns_ = sample.time_ns;
  lines_ = sample.lines;
  for (Axis which : kAxes) {
    axes_[which].observe(sample.encoder[which]);
  }
  Aintc::Reading edge;
  while (line_edges.pop(edge)) {
    serve_line(edge);
  }
  watch(sample);
  if (stop_requested_) {
    stop_requested_ = false;
    status_.stopped_by_user = true;
    end_motion(ErrorCode::kNone);
  }
  if (sample.tick_due) {
    tick(sample);
  }
  serve_brakes();
  settle_after_fault();
  finish_motion_when_at_rest();
  if (sample.tick_due) {
    record(sample);
  }
  publish();
  for (Axis which : kAxes) {
    command.axes[which] = axes_[which].drive();
  }
  command.tick = sample.tick_due;
}

void MotionControl::tick(const ControlSample& sample) noexcept {
  ++status_.control_ticks;
  status_.late_ticks += sample.ticks_missed;
  const double step_s = core::seconds(last_tick_ns_ == 0 ? period_ns_ : now_ns_ - last_tick_ns_);
  last_tick_ns_ = now_ns_;
  for (Axis which : kAxes) {
    axes_[which].estimate_velocity();
  }
  begin_waiting_order(now_ns_);
  if (status_.motion == MotionKind::kNone || motion_ending_) {
    return;
  }
  const double time_s = core::seconds(now_ns_ - motion_.start_ns);
  status_.motion_time_s = time_s;
  ErrorCode result = ErrorCode::kNone;
  if (motion_is_over(time_s, result)) {
    end_motion(result);
    return;
  }
  find_error_across_path(time_s);
  for (Axis which : kAxes) {
    if (is_driven(axes_[which].mode())) {
      drive_axis(which, time_s, step_s);
    }
  }
  check_tracking();
}

void MotionControl::begin_waiting_order(core::Nanoseconds now_ns) noexcept {
  if (status_.motion != MotionKind::kNone || !orders_.pop(motion_.order)) {
    return;
  }
  const MotionOrder& order = motion_.order;
  status_.stopped_by_user = false;
  motion_.start_ns = now_ns;
  motion_.settled = false;
  motion_.has_stood = {};
  motion_.duration_s = 0;
  status_.motion = order.kind;
  motion_ending_ = false;
  log_full_told_ = false;
  if (status_.fault != ErrorCode::kNone || status_.kill_switch_pressed) {
    // Between request and start the machine has stopped: nothing is powered.
    motion_ending_ = true;
    motion_result_ = status_.fault;
    return;
  }
  const GotoConfiguration& go_to = configuration_.go_to;
  for (Axis which : kAxes) {
    if (!order.driven[which]) {
      continue;
    }
    AxisControl& axis = axes_[which];
    const bool open_loop = order.kind == MotionKind::kOpenLoop || order.kind == MotionKind::kTuning;
    axis.begin(open_loop ? AxisMode::kOpenLoop : AxisMode::kPosition, now_ns);
    axis.allow_moving_reference(order.kind == MotionKind::kReference);
    motion_.has_stood[which] = axis.is_at_rest();
    const double duration_s =
        order.kind == MotionKind::kReference  ? order.trajectory[which].duration_s()
        : order.kind == MotionKind::kOpenLoop ? order.program[which].duration_s()
                                              : 0.0;
    motion_.duration_s = std::max(motion_.duration_s, duration_s);
    const double speed_count_per_s =
        order.fast ? go_to.fast_speed_count_per_s : go_to.speed_count_per_s;
    motion_.approach[which].begin(
        axis.position_m(), order.target_m[which],
        std::min(speed_count_per_s * configuration_.axes[which].m_per_count(),
                 configuration_.axes[which].speed_limit_m_per_s),
        go_to.acceleration_m_per_s2);
    if (order.kind == MotionKind::kHoming) {
      begin_homing(which);
    }
    if (order.kind == MotionKind::kTuning) {
      motion_.tuner[which] = RelayTuner(order.relay, axis.motor_rad());
    }
    post(Kind::kMotionStarted, which, ErrorCode::kNone);
    set_mode_event(which);
  }
}

void MotionControl::drive_axis(Axis which, double time_s, double step_s) noexcept {
  AxisControl& axis = axes_[which];
  switch (motion_.order.kind) {
    case MotionKind::kReference:
      axis.follow(motion_.order.trajectory[which].at(time_s), AxisMode::kPosition, step_s,
                  motion_.across_path_m[which]);
      break;
    case MotionKind::kOpenLoop:
      axis.drive_duty(motion_.order.program[which].duty_pct(time_s));
      break;
    case MotionKind::kGoto:
      drive_approach(which, step_s);
      break;
    case MotionKind::kHoming:
      drive_homing(which, step_s);
      break;
    case MotionKind::kTuning:
      axis.drive_torque(motion_.tuner[which].step(axis.motor_rad(), step_s));
      break;
    case MotionKind::kNone:
      break;
  }
}

void MotionControl::find_error_across_path(double time_s) noexcept {
  motion_.across_path_m = {};
  const MotionOrder& order = motion_.order;
  const CrossCouplingConfiguration& coupling = configuration_.cross_coupling;
  if (!coupling.enabled || order.kind != MotionKind::kReference || !order.driven[Axis::kY] ||
      !order.driven[Axis::kX]) {
    return;
  }
  PerAxis<Reference> reference;
  PerAxis<double> error_m;
  for (Axis which : kAxes) {
    reference[which] = order.trajectory[which].at(time_s);
    // What an axis leads by on purpose is no error.
    error_m[which] =
        reference[which].position_m + axes_[which].lead_m() - axes_[which].position_m();
  }
  const PerAxis<double> across_m = error_across_path_m(reference, error_m);
  for (Axis which : kAxes) {
    motion_.across_path_m[which] = coupling.ratio * across_m[which];
  }
}

void MotionControl::drive_approach(Axis which, double step_s) noexcept {
  AxisControl& axis = axes_[which];
  ApproachProfile& approach = motion_.approach[which];
  const double final_m =
      configuration_.go_to.final_distance_count * configuration_.axes[which].m_per_count();
  const Reference reference = approach.step(step_s);
  const AxisMode before = axis.mode();
  axis.follow(reference,
              std::fabs(approach.left_m()) > final_m ? AxisMode::kVelocity : AxisMode::kPosition,
              step_s, 0.0, approach.arrived() ? settling_ratio(which) : 1.0);
  if (axis.mode() != before) {
    set_mode_event(which);
  }
  if (!approach.arrived()) {
    motion_.duration_s = core::seconds(now_ns_ - motion_.start_ns) + step_s;
  }
}

void MotionControl::check_tracking() noexcept {
  for (Axis which : kAxes) {
    const AxisControl& axis = axes_[which];
    if (axis.mode() != AxisMode::kPosition && axis.mode() != AxisMode::kVelocity) {
      continue;
    }
    const double error_m = axis.reference().position_m - axis.position_m();
    if (!(std::fabs(error_m) <= configuration_.safety.tracking_error_limit_m)) {
      brake_all(ErrorCode::kFaultTrackingError, which);
    }
  }
}

bool MotionControl::any_powered() const noexcept {
  return std::any_of(axes_.begin(), axes_.end(), [](const AxisControl& axis) {
    return is_driven(axis.mode()) || axis.mode() == AxisMode::kBraking;
  });
}

bool MotionControl::at_rest() const noexcept {
  return status_.motion == MotionKind::kNone && orders_.empty() && !any_powered();
}

bool MotionControl::braking() const noexcept {
  return std::any_of(axes_.begin(), axes_.end(),
                     [](const AxisControl& axis) { return axis.mode() == AxisMode::kBraking; });
}

}  // namespace towbench::bbmc
