// What can be set while the controller runs: all of a setting, or nothing of it.
#include <cmath>

#include "bbmc/system/system_manager.h"

namespace towbench::bbmc {

using core::Axis;
using core::ErrorCode;
using core::failure;

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

core::Status SystemManager::set_law(Axis axis, const AxisConfiguration& parts) noexcept {
  for (const double value :
       {parts.feed_forward.inertia_kg_m2, parts.feed_forward.viscous_friction_Nm_s_per_rad,
        parts.feed_forward.coulomb_friction_Nm, parts.friction.breakaway_Nm,
        parts.friction.coulomb_friction_Nm, parts.friction.viscous_friction_Nm_s_per_rad,
        parts.disturbance_observer.damping_ratio, parts.chain.carriage_friction_Nm}) {
    if (!std::isfinite(value) || value < 0) {
      return failure(ErrorCode::kRequestOutOfRange);
    }
  }
  for (const double value :
       {parts.friction.stribeck_speed_rad_per_s, parts.friction.smoothing_rad_per_s,
        parts.disturbance_observer.bandwidth_rad_per_s, parts.disturbance_observer.inertia_kg_m2,
        parts.disturbance_observer.compensation_rad_per_s, parts.disturbance_observer.limit_Nm,
        parts.chain.smoothing_rad_per_s, parts.nonlinear_observer.gain_rad_per_s,
        parts.nonlinear_observer.inertia_kg_m2, parts.nonlinear_observer.rest_speed_rad_per_s,
        parts.nonlinear_observer.limit_Nm}) {
    if (!std::isfinite(value) || value <= 0) {
      return failure(ErrorCode::kRequestOutOfRange);
    }
  }
  if (parts.disturbance_observer.enabled && parts.nonlinear_observer.enabled) {
    return failure(ErrorCode::kRequestOutOfRange);
  }
  if (!motion_.at_rest()) {
    return failure(ErrorCode::kRequestWrongState);
  }
  AxisConfiguration& settings = configuration_.axes[axis];
  settings.feed_forward = parts.feed_forward;
  settings.friction = parts.friction;
  settings.disturbance_observer = parts.disturbance_observer;
  settings.nonlinear_observer = parts.nonlinear_observer;
  settings.chain = parts.chain;
  motion_.axis(axis).set_law(settings);
  return {};
}

core::Status SystemManager::set_cross_coupling(const CrossCouplingConfiguration& wanted) noexcept {
  if (!std::isfinite(wanted.ratio) || wanted.ratio < 0 || wanted.ratio > 10.0) {
    return failure(ErrorCode::kRequestOutOfRange);
  }
  if (!motion_.at_rest()) {
    return failure(ErrorCode::kRequestWrongState);
  }
  configuration_.cross_coupling = wanted;
  motion_.set_cross_coupling(wanted);
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

core::Status SystemManager::set_drive(Axis axis, std::int64_t pwm_period_ticks,
                                      double duty_limit_pct) noexcept {
  if (pwm_period_ticks < 10 || pwm_period_ticks > 65535 ||
      !(duty_limit_pct >= 1.0 && duty_limit_pct <= 100.0)) {
    return failure(ErrorCode::kRequestOutOfRange);
  }
  if (!motion_.at_rest()) {
    return failure(ErrorCode::kRequestWrongState);
  }
  if (auto status = io_.set_pwm_period(axis, pwm_period_ticks); !status) {
    return status;
  }
  DriveConfiguration& drive = configuration_.axes[axis].drive;
  drive.pwm_period_ticks = pwm_period_ticks;
  drive.duty_limit_pct = duty_limit_pct;
  motion_.axis(axis).set_drive(drive);
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
  for (Axis which : kAxes) {
    motion_.axis(which).set_velocity_estimation(configuration_.axes[which].velocity, rate_Hz);
  }
  return {};
}

}  // namespace towbench::bbmc
