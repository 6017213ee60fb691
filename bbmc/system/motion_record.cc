// What motion control tells of itself: status, telemetry rows, data log, events.
#include "bbmc/system/motion_control.h"

namespace towbench::bbmc {

using core::Axis;
using Kind = SystemEvent::Kind;

void MotionControl::publish() noexcept {
  status_.time_ns = now_ns_;
  for (Axis which : kAxes) {
    const AxisControl& axis = axes_[which];
    AxisStatus& status = status_.axes[which];
    status.mode = axis.mode();
    status.count = axis.observer().count();
    status.position_m = axis.position_m();
    status.velocity_m_per_s = axis.velocity_m_per_s();
    status.duty_pct = axis.duty_pct();
    status.position_calibrated = axis.calibrated();
    status.hall_min_active = axis.end_stops().active(End::kMin);
    status.hall_max_active = axis.end_stops().active(End::kMax);
    status.amplifier_ready = (lines_ & mask_of(amplifier_ready_of(which))) != 0;
    status.amplifier_enabled = axis.drive().enable;
    status.reference_m = axis.reference().position_m;
    status.integral_Nm = axis.integral_Nm();
    status.disturbance_Nm = axis.disturbance_Nm();
    status.local_count = axis.observer().count() - axis.start_count();
  }
}

void MotionControl::record(const ControlSample& sample) noexcept {
  TelemetryRow row;
  row.time_ns = sample.time_ns;
  row.fault = status_.fault;
  for (Axis which : kAxes) {
    AxisControl& axis = axes_[which];
    const bool has_reference = is_driven(axis.mode());
    row.axes[which] = {
        .reference_m = has_reference ? axis.reference().position_m : axis.position_m(),
        .reference_velocity_m_per_s = has_reference ? axis.reference().velocity_m_per_s : 0.0,
        .count = axis.observer().count(),
        .position_m = axis.position_m(),
        .velocity_m_per_s = axis.velocity_m_per_s(),
        .duty_pct = axis.duty_pct(),
        .edges = axis.take_edges(),
        .mode = axis.mode()};
  }
  if (!rows_.push(row)) {
    ++lost_;
  }
  if (status_.motion != MotionKind::kNone && log_->any_enabled()) {
    record_log();
  }
}

void MotionControl::record_log() noexcept {
  DataLogRow row;
  row.time_ns = now_ns_ - motion_.start_ns;
  for (Axis which : kAxes) {
    if (!log_->enabled(which)) {
      continue;
    }
    const AxisControl& axis = axes_[which];
    const double counts_per_m = configuration_.axes[which].counts_per_m();
    row.axes[which] = {.count = axis.observer().count(),
                       .speed_count_per_s = static_cast<float>(axis.velocity_count_per_s()),
                       .reference_speed_count_per_s =
                           static_cast<float>(axis.reference().velocity_m_per_s * counts_per_m),
                       .reference_count = axis.reference().position_m * counts_per_m - 0.5,
                       .duty_pct = static_cast<float>(axis.duty_pct()),
                       .mode = axis.mode()};
  }
  if (!log_->append(row) && !log_full_told_) {
    log_full_told_ = true;
    post(Kind::kLogFull, Axis::kY, core::ErrorCode::kRequestLogFull,
         static_cast<std::int64_t>(log_->capacity()));
  }
}

void MotionControl::post(Kind kind, Axis which, core::ErrorCode code, std::int64_t value) noexcept {
  post_at(now_ns_, kind, which, code, value);
}

void MotionControl::post_at(core::Nanoseconds time_ns, Kind kind, Axis which, core::ErrorCode code,
                            std::int64_t value) noexcept {
  if (!events_.push(
          {.time_ns = time_ns, .kind = kind, .axis = which, .code = code, .value = value})) {
    ++lost_;
  }
}

void MotionControl::set_mode_event(Axis which) noexcept {
  post(Kind::kStateChanged, which, core::ErrorCode::kNone,
       static_cast<std::int64_t>(axes_[which].mode()));
}

}  // namespace towbench::bbmc
