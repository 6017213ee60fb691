// When a motion is over, how it ends, and what it leaves behind.
#include <algorithm>
#include <cmath>

#include "bbmc/system/motion_control.h"

namespace towbench::bbmc {

using core::Axis;
using core::ErrorCode;
using Kind = SystemEvent::Kind;

namespace {

// An axis that stands off its target is driven as if it were so far off.
constexpr double kSeekAsIfOff_counts = 8;

}  // namespace

bool MotionControl::motion_is_over(double time_s, ErrorCode& result) noexcept {
  if (motion_.order.kind == MotionKind::kOpenLoop) {
    return time_s >= motion_.duration_s || broke_away();
  }
  if (motion_.order.kind == MotionKind::kTuning) {
    return tuning_is_over(result);
  }
  const bool must_settle = motion_.order.kind == MotionKind::kGoto || motion_.order.until_settled;
  if (!must_settle) {
    return time_s >= motion_.duration_s + configuration_.hold_time_s;
  }
  if (time_s < motion_.duration_s || time_s == 0) {
    return false;
  }
  if (settled_long_enough()) {
    return true;
  }
  if (time_s >= motion_.duration_s + configuration_.go_to.timeout_s) {
    result = ErrorCode::kMotionNotSettled;
    return true;
  }
  return false;
}

bool MotionControl::tuning_is_over(ErrorCode& result) noexcept {
  bool over = true;
  for (Axis which : kAxes) {
    if (motion_.order.driven[which]) {
      over = over && motion_.tuner[which].over();
      status_.axes[which].tuning = motion_.tuner[which].result();
      result = status_.axes[which].tuning.found() ? result : ErrorCode::kMotionNotSettled;
    }
  }
  return over;
}

bool MotionControl::is_near(Axis which) const noexcept {
  const double distance_m = axes_[which].reference().position_m - axes_[which].position_m();
  const double allowed_m = (static_cast<double>(configuration_.go_to.done_within_counts) + 0.5) *
                           configuration_.axes[which].m_per_count();
  return std::fabs(distance_m) <= allowed_m;
}

// A few counts off, dry friction holds an axis until the integral has grown to break-away; and on
// the target it must not grow on while the other axis still seeks its own.
double MotionControl::settling_ratio(Axis which) const noexcept {
  if (is_near(which)) {
    return 0.0;
  }
  const double distance_m = axes_[which].reference().position_m - axes_[which].position_m();
  const double least_m = kSeekAsIfOff_counts * configuration_.axes[which].m_per_count();
  return std::max(1.0, least_m / std::fabs(distance_m));
}

bool MotionControl::settled_long_enough() noexcept {
  bool near = true;
  for (Axis which : kAxes) {
    if (is_driven(axes_[which].mode())) {
      near = near && is_near(which) && axes_[which].stands_still();
    }
  }
  if (!near) {
    motion_.settled = false;
    return false;
  }
  if (!motion_.settled) {
    motion_.settled = true;
    motion_.settled_since_ns = now_ns_;
  }
  return now_ns_ - motion_.settled_since_ns >=
         core::nanoseconds(configuration_.go_to.settle_time_s);
}

bool MotionControl::broke_away() noexcept {
  const double threshold = motion_.order.stop_speed_count_per_s;
  if (threshold <= 0) {
    return false;
  }
  for (Axis which : kAxes) {
    const AxisControl& axis = axes_[which];
    // An axis that still swings from the motion before has not broken away.
    motion_.has_stood[which] = motion_.has_stood[which] || axis.is_at_rest();
    if (is_driven(axis.mode()) && motion_.has_stood[which] &&
        std::fabs(axis.velocity_count_per_s()) > threshold) {
      status_.axes[which].break_away_count = axis.observer().count();
      status_.axes[which].break_away_duty_pct = axis.duty_pct();
      return true;
    }
  }
  return false;
}

void MotionControl::end_motion(ErrorCode result) noexcept {
  if (status_.motion == MotionKind::kNone || motion_ending_) {
    return;
  }
  motion_ending_ = true;
  motion_result_ = result;
  for (Axis which : kAxes) {
    AxisControl& axis = axes_[which];
    if (!is_driven(axis.mode())) {
      continue;
    }
    if (axis.stands_still()) {
      power_off(which, AxisMode::kIdle, result);
    } else {
      axis.begin_braking(now_ns_);
      set_mode_event(which);
    }
  }
}

void MotionControl::finish_motion_when_at_rest() noexcept {
  if (status_.motion == MotionKind::kNone || !motion_ending_ || any_powered()) {
    return;
  }
  for (Axis which : kAxes) {
    if (motion_.order.driven[which]) {
      post(Kind::kMotionEnded, which, motion_result_);
    }
  }
  status_.motion = MotionKind::kNone;
  status_.motion_time_s = core::seconds(now_ns_ - motion_.start_ns);
  status_.last_motion_result = motion_result_;
  ++status_.motions_ended;
  motion_ending_ = false;
}

}  // namespace towbench::bbmc
