#include "bbmc/system/system_manager.h"

#include <cmath>

#include "bbmc/device/device_manager.h"
#include "bbmc/system/motion_check.h"
#include "core/check.h"

namespace towbench::bbmc {

using core::Axis;
using core::ErrorCode;
using core::failure;

SystemManager::SystemManager(const Configuration& configuration, DeviceManager& devices,
                             std::span<DataLogRow> log_storage)
    : configuration_(configuration),
      exchange_ns_(exchange_period_ns(configuration.control_period_ns())),
      io_(devices),
      log_(log_storage),
      motion_(configuration, exchange_ns_, log_) {}

core::Status SystemManager::start() noexcept {
  return io_.start(configuration_);
}

// ---- the control path and what surrounds it ----

void SystemManager::service(core::Nanoseconds now_ns) noexcept {
  serve_interrupts();
  io_.sample(now_ns, sample_);
  core::check(samples_.push(sample_));

  ControlSample in;
  DriveCommand out;
  while (samples_.pop(in)) {
    motion_.exchange(in, line_edges_, out);
    core::check(commands_.push(out));
  }

  while (commands_.pop(out)) {
    io_.drive(out);
  }
  if (sample_.tick_due) {
    perf_.record(now_ns - sample_.tick_due_ns, io_.clock_ns() - now_ns);
  }
}

void SystemManager::serve_interrupts() noexcept {
  Aintc::Reading edge;
  while (line_edges_.size() < LineEdgeQueue::capacity() && io_.next_interrupt(edge)) {
    if (edge.line == Line::kKillSwitch && edge.active) {
      io_.remove_drive();  // before anything is computed
    }
    core::check(line_edges_.push(edge));
  }
}

void SystemManager::link_lost(ErrorCode why) noexcept {
  io_.remove_drive();
  motion_.link_lost(why, motion_.status().time_ns);
}

// ---- requests ----

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
  for (Axis which : core::kAxes) {
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
  for (Axis which : core::kAxes) {
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
  for (Axis which : core::kAxes) {
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
  for (Axis which : core::kAxes) {
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

// ---- settings ----

core::Status SystemManager::set_gains(Axis axis, const PidGains& gains) noexcept {
  for (const double gain : {gains.proportional_Nm_per_rad, gains.integral_Nm_per_rad_s,
                            gains.derivative_Nm_s_per_rad}) {
    if (!std::isfinite(gain) || gain < 0) {
      return failure(ErrorCode::kRequestOutOfRange);
    }
  }
  if (gains_are_unstable(configuration_.axes[axis], gains, configuration_.control_rate_Hz)) {
    return failure(ErrorCode::kRequestOutOfRange);
  }
  configuration_.axes[axis].gains = gains;
  motion_.axis(axis).set_gains(gains);
  return {};
}

core::Status SystemManager::set_feed_forward(Axis axis, const FeedForward& model) noexcept {
  for (const double value :
       {model.inertia_kg_m2, model.viscous_friction_Nm_s_per_rad, model.coulomb_friction_Nm}) {
    if (!std::isfinite(value) || value < 0) {
      return failure(ErrorCode::kRequestOutOfRange);
    }
  }
  if (!motion_.at_rest()) {
    return failure(ErrorCode::kRequestWrongState);
  }
  configuration_.axes[axis].feed_forward = model;
  motion_.axis(axis).set_feed_forward(model);
  return {};
}

core::Status SystemManager::set_velocity_method(Axis axis, VelocityMethod method) noexcept {
  if (!motion_.at_rest()) {
    return failure(ErrorCode::kRequestWrongState);
  }
  configuration_.axes[axis].velocity.method = method;
  motion_.axis(axis).set_velocity_estimation(configuration_.axes[axis].velocity,
                                             configuration_.control_rate_Hz);
  return {};
}

core::Status SystemManager::set_control_rate(double rate_Hz) noexcept {
  if (!(rate_Hz >= 1.0 && rate_Hz <= 5000.0)) {
    return failure(ErrorCode::kRequestOutOfRange);
  }
  if (!motion_.at_rest()) {
    return failure(ErrorCode::kRequestWrongState);
  }
  const core::Nanoseconds period_ns = core::nanoseconds(1.0 / rate_Hz);
  // The board is served every exchange; ticks fall on those.
  bool possible = period_ns % exchange_ns_ == 0;
  for (const AxisConfiguration& axis : configuration_.axes) {
    possible = possible && !gains_are_unstable(axis, axis.gains, rate_Hz);
  }
  if (!possible) {
    return failure(ErrorCode::kRequestOutOfRange);
  }
  if (auto status = io_.set_period(period_ns); !status) {
    return status;
  }
  configuration_.control_rate_Hz = rate_Hz;
  motion_.set_control_period(period_ns);
  for (Axis which : core::kAxes) {
    motion_.axis(which).set_velocity_estimation(configuration_.axes[which].velocity, rate_Hz);
  }
  return {};
}

// ---- what is known ----

const Configuration& SystemManager::configuration() const noexcept {
  return configuration_;
}
const SystemStatus& SystemManager::status() const noexcept {
  return motion_.status();
}
bool SystemManager::at_rest() const noexcept {
  return motion_.at_rest();
}

double SystemManager::speed_allowed_m_per_s(Axis axis, double position_m,
                                            int direction) const noexcept {
  return planned_speed_limit_m_per_s(motion_.axis(axis), position_m, direction);
}

DataLog& SystemManager::data_log() noexcept {
  return log_;
}
PerfLog& SystemManager::perf_log() noexcept {
  return perf_;
}
bool SystemManager::next_row(TelemetryRow& row) noexcept {
  return motion_.next_row(row);
}
bool SystemManager::next_event(SystemEvent& event) noexcept {
  return motion_.next_event(event);
}
std::uint64_t SystemManager::rows_lost() const noexcept {
  return motion_.lost();
}

}  // namespace towbench::bbmc
