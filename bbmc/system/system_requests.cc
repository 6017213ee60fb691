// What the system manager is asked to do with the machine, and why it may refuse.
#include <cmath>

#include "bbmc/system/motion_check.h"
#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {

using core::Axis;
using core::ErrorCode;
using core::failure;

ErrorCode SystemManager::why_not_now() const noexcept {
  if (motion_.status().kill_switch_pressed) {
    return ErrorCode::kRequestSwitchPressed;
  }
  if (motion_.status().fault != ErrorCode::kNone) {
    return ErrorCode::kRequestFaultLatched;
  }
  return motion_.at_rest() ? ErrorCode::kNone : ErrorCode::kRequestWrongState;
}

core::Status SystemManager::order(const MotionOrder& order) noexcept {
  bool any = false;
  for (Axis which : kAxes) {
    if (order.driven[which] && !configuration_.axes[which].exists) {
      return failure(ErrorCode::kRequestOutOfRange);
    }
    any = any || order.driven[which];
  }
  if (!any) {
    return failure(ErrorCode::kRequestBadArgument);
  }
  return motion_.submit(order) ? core::Status{} : failure(ErrorCode::kRequestWrongState);
}

core::Status SystemManager::request_motion(const MotionRequest& request) noexcept {
  if (const ErrorCode why = why_not_now(); why != ErrorCode::kNone) {
    return failure(why);
  }
  for (Axis which : kAxes) {
    if (request.driven[which]) {
      const ErrorCode why =
          check_reference(motion_.axis(which), configuration_.safety, request.trajectory[which]);
      if (why != ErrorCode::kNone) {
        return failure(why);
      }
    }
  }
  return order({.kind = MotionKind::kReference,
                .driven = request.driven,
                .trajectory = request.trajectory,
                .until_settled = request.until_settled});
}

core::Status SystemManager::request_open_loop(const OpenLoopRequest& request) noexcept {
  if (const ErrorCode why = why_not_now(); why != ErrorCode::kNone) {
    return failure(why);
  }
  if (!(request.stop_speed_count_per_s >= 0)) {
    return failure(ErrorCode::kRequestBadArgument);
  }
  for (Axis which : kAxes) {
    if (request.driven[which]) {
      const ErrorCode why =
          check_duty(motion_.axis(which), configuration_.axes[which].drive.duty_limit_pct,
                     request.program[which]);
      if (why != ErrorCode::kNone) {
        return failure(why);
      }
    }
  }
  return order({.kind = MotionKind::kOpenLoop,
                .driven = request.driven,
                .program = request.program,
                .stop_speed_count_per_s = request.stop_speed_count_per_s});
}

core::Status SystemManager::request_goto(const GotoRequest& request) noexcept {
  if (const ErrorCode why = why_not_now(); why != ErrorCode::kNone) {
    return failure(why);
  }
  MotionOrder wanted{.kind = MotionKind::kGoto, .target_m = request.target_m, .fast = request.fast};
  for (Axis which : kAxes) {
    wanted.driven[which] = configuration_.axes[which].exists;
    if (wanted.driven[which]) {
      const ErrorCode why = check_target(motion_.axis(which), request.target_m[which]);
      if (why != ErrorCode::kNone) {
        return failure(why);
      }
    }
  }
  return order(wanted);
}

core::Status SystemManager::request_homing(const HomingRequest& request) noexcept {
  if (const ErrorCode why = why_not_now(); why != ErrorCode::kNone) {
    return failure(why);
  }
  if (!request.wanted[Axis::kY] && !request.wanted[Axis::kX]) {
    return failure(ErrorCode::kRequestBadArgument);
  }
  MotionOrder wanted{.kind = MotionKind::kHoming, .homes = request.wanted, .home_end = request.end};
  for (Axis which : kAxes) {
    const EndStopGuard& stops = motion_.axis(which).end_stops();
    if (request.wanted[which] && !configuration_.axes[which].exists) {
      return failure(ErrorCode::kRequestOutOfRange);
    }
    if (request.wanted[which] && stops.active(End::kMin) && stops.active(End::kMax)) {
      return failure(ErrorCode::kRequestBeyondSoftLimit);
    }
    wanted.driven[which] = configuration_.axes[which].exists;
  }
  return order(wanted);
}

core::Status SystemManager::request_tuning(const TuningRequest& request) noexcept {
  constexpr double kLargest_m = 0.02;
  if (const ErrorCode why = why_not_now(); why != ErrorCode::kNone) {
    return failure(why);
  }
  if (!(request.amplitude_m > 0 && request.amplitude_m <= kLargest_m)) {
    return failure(ErrorCode::kRequestOutOfRange);
  }
  const AxisConfiguration& axis = configuration_.axes[request.axis];
  // Well above the worst break-away, so that it moves; half of the drive is more than it ever
  // takes.
  MotionOrder wanted{.kind = MotionKind::kTuning,
                     .relay = {.amplitude_rad = request.amplitude_m / axis.metres_per_motor_rad(),
                               .torque_Nm = 2.0 * axis.plausibility.worst_breakaway_Nm,
                               .torque_limit_Nm = 0.5 * axis.drive.torque_limit_Nm()}};
  wanted.driven[request.axis] = true;
  return order(wanted);
}

core::Status SystemManager::stop() noexcept {
  if (motion_.at_rest()) {
    return failure(ErrorCode::kRequestWrongState);
  }
  motion_.request_stop();
  return {};
}

core::Status SystemManager::reset() noexcept {
  if (motion_.status().kill_switch_pressed) {
    return failure(ErrorCode::kRequestSwitchPressed);
  }
  if (motion_.status().fault == ErrorCode::kNone || !motion_.at_rest()) {
    return failure(ErrorCode::kRequestWrongState);
  }
  motion_.clear_fault();
  return {};
}

core::Status SystemManager::calibrate_position(Axis axis, std::int64_t count) noexcept {
  // Far beyond any machine, and far from overflow.
  constexpr std::int64_t kLargest = std::int64_t{1} << 40;
  if (count < -kLargest || count > kLargest) {
    return failure(ErrorCode::kRequestOutOfRange);
  }
  if (!motion_.at_rest() || !motion_.axis(axis).stands_still()) {
    return failure(ErrorCode::kRequestWrongState);
  }
  motion_.axis(axis).declare_position(count);
  motion_.publish();
  return {};
}

core::Status SystemManager::forget_calibration(Axis axis) noexcept {
  if (!motion_.at_rest()) {
    return failure(ErrorCode::kRequestWrongState);
  }
  motion_.axis(axis).forget_calibration();
  motion_.publish();
  return {};
}

}  // namespace towbench::bbmc
