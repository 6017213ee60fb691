#include "bbmc/system/axis_control.h"

#include <algorithm>
#include <cmath>

namespace towbench::bbmc {

AxisControl::AxisControl(const AxisConfiguration& axis, const SafetyConfiguration& safety,
                         double control_rate_Hz, double exchange_rate_Hz) noexcept
    : settings_(axis),
      safety_(safety),
      m_per_count_(axis.m_per_count()),
      standstill_count_per_s_(axis.braking.standstill_m_per_s * axis.counts_per_m()),
      observer_(axis, exchange_rate_Hz),
      velocity_(axis.velocity, control_rate_Hz),
      state_observer_(axis, control_rate_Hz),
      law_(axis),
      brake_(axis),
      end_stops_(axis),
      plausibility_(axis),
      reckoning_(axis),
      speed_limits_(axis, safety.latency_s) {
  set_drive(axis.drive);
}

void AxisControl::set_drive(const DriveConfiguration& drive) noexcept {
  settings_.drive = drive;
  ticks_per_Nm_ = static_cast<double>(drive.pwm_period_ticks) / drive.full_duty_torque_Nm();
  torque_limit_Nm_ = drive.torque_limit_Nm();
  // Rounded down: a limit is a limit.
  tick_limit_ = std::min(static_cast<std::int32_t>(drive.pwm_period_ticks),
                         static_cast<std::int32_t>(torque_limit_Nm_ * ticks_per_Nm_ + 1e-6));
}

core::ErrorCode AxisControl::judge_encoder() noexcept {
  // What the drive was told until now is what has moved the axis since the exchange before.
  observer_.change().torque_Nm = torque_Nm();
  reckoning_.update(observer_.change().time_ns, observer_.speed_count_per_s(), torque_Nm(),
                    observer_.change().elapsed_s);
  const auto scope = is_driven(mode_)              ? EncoderPlausibility::Scope::kEverything
                     : mode_ == AxisMode::kBraking ? EncoderPlausibility::Scope::kSignals
                                                   : EncoderPlausibility::Scope::kNothing;
  return plausibility_.update(observer_.change(), scope);
}

double AxisControl::speed_limit_here_m_per_s(double speed_m_per_s) const noexcept {
  return calibrated_ ? speed_limits_.calibrated_m_per_s(position_m(), speed_m_per_s > 0 ? 1 : -1)
                     : speed_limits_.uncalibrated_m_per_s();
}

bool AxisControl::breaks_limits() noexcept {
  const double speed_m_per_s = observer_.speed_count_per_s() * m_per_count_;
  const bool too_fast =
      !stands_still() && std::fabs(speed_m_per_s) >
                             safety_.speed_margin_ratio * speed_limit_here_m_per_s(speed_m_per_s);
  const bool twice = too_fast && was_too_fast_;
  was_too_fast_ = too_fast;
  if (stands_still() || !calibrated_) {
    return twice;
  }
  const double here_m = position_m();
  const bool beyond = speed_m_per_s > 0 ? here_m > speed_limits_.guard_max_m()
                                        : here_m < speed_limits_.guard_min_m();
  return beyond || twice;
}

bool AxisControl::amplifier_failed(core::Nanoseconds now_ns, bool ready) const noexcept {
  return safety_.amplifier_ready_fitted && enabled_ && !ready &&
         now_ns - enabled_ns_ > core::nanoseconds(safety_.amplifier_ready_timeout_s);
}

BrakeInput AxisControl::brake_input(core::Nanoseconds now_ns) const noexcept {
  return {.now_ns = now_ns,
          .speed_count_per_s = observer_.speed_count_per_s(),
          .age_ns = now_ns - observer_.reading().time_ns,
          .since_ns = core::nanoseconds(observer_.change().elapsed_s),
          .momentum_count_per_s = reckoning_.momentum_count_per_s()};
}

BrakeState AxisControl::serve_brake(core::Nanoseconds now_ns) noexcept {
  const BrakeState state = brake_.update(brake_input(now_ns));
  set_ticks(brake_.torque_Nm() * ticks_per_Nm_);
  return state;
}

void AxisControl::estimate_velocity() noexcept {
  velocity_.update(observer_.reading(), observer_.raw_count());
  if (std::fabs(velocity_.counts_per_s()) > standstill_count_per_s_) {
    moved_ns_ = observer_.reading().time_ns;
  }
}

double AxisControl::speed_for_the_law_m_per_s(double step_s) noexcept {
  if (!state_observer_.works()) {
    return velocity_m_per_s();
  }
  return settings_.metres_per_motor_rad() *
         state_observer_
             .update(motor_rad(), velocity_count_per_s() * settings_.rad_per_count(), torque_Nm(),
                     step_s)
             .motor_rad_per_s;
}

void AxisControl::follow(const Reference& reference, AxisMode mode, double step_s,
                         double across_path_m, double integral_ratio) noexcept {
  mode_ = mode;
  reference_ = reference;
  const double wanted_Nm = law_.torque_Nm({.reference = reference,
                                           .position_m = position_m(),
                                           .velocity_m_per_s = speed_for_the_law_m_per_s(step_s),
                                           .across_path_m = across_path_m,
                                           .applied_Nm = torque_Nm(),
                                           .limit_Nm = torque_limit_Nm_,
                                           .step_s = step_s,
                                           .integral_ratio = integral_ratio});
  set_ticks(wanted_Nm * ticks_per_Nm_);
}

void AxisControl::drive_duty(double duty_pct) noexcept {
  reference_ = {.position_m = position_m()};
  set_ticks(duty_pct / 100.0 * static_cast<double>(settings_.drive.pwm_period_ticks));
}

void AxisControl::drive_torque(double torque_Nm) noexcept {
  reference_ = {.position_m = position_m()};
  set_ticks(torque_Nm * ticks_per_Nm_);
}

void AxisControl::begin(AxisMode mode, core::Nanoseconds now_ns) noexcept {
  mode_ = mode;
  enabled_ = true;
  enabled_ns_ = now_ns;
  start_count_ = observer_.count();
  reference_ = {.position_m = position_m()};
  law_.reset();
  state_observer_.reset();
  end_stops_.arm(observer_.raw_count());
}

void AxisControl::begin_braking(core::Nanoseconds now_ns) noexcept {
  mode_ = AxisMode::kBraking;
  brake_.begin(brake_input(now_ns), safety_.coasting_stop);
}

void AxisControl::end_is_ahead(End end) noexcept {
  const auto& ends = settings_.ends;
  const std::int64_t room_count = end == End::kMin ? ends.hall_min_count - ends.hard_min_count
                                                   : ends.hard_max_count - ends.hall_max_count;
  brake_.end_is_ahead(end == End::kMin ? -1.0 : 1.0, static_cast<double>(room_count));
}

bool AxisControl::encoder_turned_over() const noexcept {
  // Beyond what the motor swings on its chain.
  constexpr double kFar_m_per_s = 0.25;
  const double told = observer_.speed_count_per_s();
  const double rigid = reckoning_.rigid_count_per_s();
  return told * rigid < 0 && std::fabs(told - rigid) > kFar_m_per_s * settings_.counts_per_m();
}

bool AxisControl::encoder_keeps_up() const noexcept {
  constexpr double kLeastRatio = 0.25;
  return !encoder_turned_over() && std::fabs(observer_.speed_count_per_s()) >=
                                       kLeastRatio * std::fabs(reckoning_.speed_count_per_s());
}

bool AxisControl::begin_blind_braking(core::Nanoseconds now_ns, Suspect suspect) noexcept {
  const double speed_count_per_s = suspect == Suspect::kEncoder ? reckoning_.speed_count_per_s()
                                                                : reckoning_.momentum_count_per_s();
  if (speed_count_per_s == 0 || safety_.coasting_stop) {
    return false;
  }
  mode_ = AxisMode::kBraking;
  brake_.begin_blind(now_ns, speed_count_per_s, suspect == Suspect::kEncoder);
  return true;
}

void AxisControl::power_off(AxisMode mode) noexcept {
  mode_ = mode;
  ticks_ = 0;
  enabled_ = false;
}

bool AxisControl::stands_still() const noexcept {
  return std::fabs(observer_.speed_count_per_s()) <= standstill_count_per_s_;
}

double AxisControl::duty_pct() const noexcept {
  return 100.0 * static_cast<double>(ticks_) /
         static_cast<double>(settings_.drive.pwm_period_ticks);
}

std::uint32_t AxisControl::take_edges() noexcept {
  const std::uint32_t total = observer_.reading().edges;
  const std::uint32_t since = total - edges_taken_;
  edges_taken_ = total;
  return since;
}

void AxisControl::declare_position(std::int64_t count) noexcept {
  // The local state is relative to a place, whatever that place is called.
  start_count_ += count - observer_.count();
  observer_.declare(count);
  state_observer_.reset();
  calibrated_ = true;
}

void AxisControl::set_velocity_estimation(const VelocityEstimation& velocity,
                                          double control_rate_Hz) noexcept {
  settings_.velocity = velocity;
  velocity_ = VelocityEstimator(velocity, control_rate_Hz);
  state_observer_ = StateObserver(settings_, control_rate_Hz);
}

void AxisControl::set_ticks(double ticks) noexcept {
  // A law that yields no number must not become one by a conversion.
  if (!(std::fabs(ticks) < 1e9)) {
    ticks_ = 0;
    return;
  }
  const auto nearest = static_cast<std::int32_t>(ticks + (ticks < 0 ? -0.5 : 0.5));
  ticks_ = std::clamp(nearest, -tick_limit_, tick_limit_);
}

}  // namespace towbench::bbmc
