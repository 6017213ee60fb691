// One axis between its encoder and its PWM: what it knows, what it does, what may stop it. It knows
// neither the other axis nor the motion as a whole (motion_control.h).
#pragma once

#include <cstdint>

#include "bbmc/system/axis_observer.h"
#include "bbmc/system/brake.h"
#include "bbmc/system/configuration.h"
#include "bbmc/system/control_law.h"
#include "bbmc/system/control_sample.h"
#include "bbmc/system/dead_reckoning.h"
#include "bbmc/system/encoder_plausibility.h"
#include "bbmc/system/end_stop_guard.h"
#include "bbmc/system/state_observer.h"
#include "bbmc/system/stopping_distance.h"
#include "bbmc/system/telemetry_row.h"
#include "bbmc/system/trajectory/reference.h"
#include "bbmc/system/velocity_estimator.h"
#include "core/error.h"
#include "core/realtime.h"

namespace towbench::bbmc {

[[nodiscard]] constexpr bool is_driven(AxisMode mode) noexcept {
  return mode == AxisMode::kOpenLoop || mode == AxisMode::kPosition || mode == AxisMode::kVelocity;
}

class AxisControl {
 public:
  AxisControl(const AxisConfiguration& axis, const SafetyConfiguration& safety,
              double control_rate_Hz, double exchange_rate_Hz) noexcept;

  // ---- once an exchange ----
  TOWBENCH_REALTIME void observe(const Eqep::Reading& reading) noexcept {
    observer_.observe(reading);
  }
  // Whether the encoder can be believed.
  TOWBENCH_REALTIME [[nodiscard]] core::ErrorCode judge_encoder() noexcept;
  // Whether the axis moves where or as fast as it must not, by count and speed alone. Asked once an
  // exchange: too fast is what is too fast twice, because the last two edges of a wrong encoder
  // reading may make a speed of anything.
  TOWBENCH_REALTIME [[nodiscard]] bool breaks_limits() noexcept;
  TOWBENCH_REALTIME [[nodiscard]] bool amplifier_failed(core::Nanoseconds now_ns,
                                                        bool ready) const noexcept;
  // Whether the encoder tells a motion against the one that the axis must have, and by far.
  TOWBENCH_REALTIME [[nodiscard]] bool encoder_turned_over() const noexcept;
  // Whether it tells at least a quarter of the speed that the axis must have, that way.
  TOWBENCH_REALTIME [[nodiscard]] bool encoder_keeps_up() const noexcept;
  // Goes on braking; the mode stays kBraking until the caller acts on the state returned.
  TOWBENCH_REALTIME [[nodiscard]] BrakeState serve_brake(core::Nanoseconds now_ns) noexcept;

  // ---- once a control tick ----
  TOWBENCH_REALTIME void estimate_velocity() noexcept;
  // `across_path_m`: this axis's part of the error across a 2-D path, times its gain ratio.
  TOWBENCH_REALTIME void follow(const Reference& reference, AxisMode mode, double step_s,
                                double across_path_m = 0, double integral_ratio = 1) noexcept;
  TOWBENCH_REALTIME void drive_duty(double duty_pct) noexcept;
  // Motor torque, within the axis's limit.
  TOWBENCH_REALTIME void drive_torque(double torque_Nm) noexcept;

  // ---- changes of mode ----
  void begin(AxisMode mode, core::Nanoseconds now_ns) noexcept;
  // Of the motion that begins (control_law.h).
  void allow_moving_reference(bool allowed) noexcept { law_.allow_moving(allowed); }
  void begin_braking(core::Nanoseconds now_ns) noexcept;
  // Of an axis that brakes: an end-stop has spoken, then or since.
  void end_is_ahead(End end) noexcept;
  // Without the encoder. False when the speed is not known well enough, or braking is switched off:
  // nothing has changed then. What an encoder has said of late counts where only the link or the
  // clock is in doubt.
  enum class Suspect : std::uint8_t { kEncoder, kLink };
  [[nodiscard]] bool begin_blind_braking(core::Nanoseconds now_ns, Suspect suspect) noexcept;
  // No power from now on.
  void power_off(AxisMode mode) noexcept;

  // ---- what is known ----
  [[nodiscard]] AxisMode mode() const noexcept { return mode_; }
  [[nodiscard]] const AxisObserver& observer() const noexcept { return observer_; }
  [[nodiscard]] EndStopGuard& end_stops() noexcept { return end_stops_; }
  [[nodiscard]] const EndStopGuard& end_stops() const noexcept { return end_stops_; }
  [[nodiscard]] const SpeedLimits& speed_limits() const noexcept { return speed_limits_; }
  [[nodiscard]] bool brakes_blind() const noexcept {
    return mode_ == AxisMode::kBraking && brake_.blind();
  }
  [[nodiscard]] bool stands_still() const noexcept;
  [[nodiscard]] double position_m() const noexcept {
    return settings_.position_m(observer_.count());
  }
  [[nodiscard]] double velocity_m_per_s() const noexcept {
    return velocity_.counts_per_s() * m_per_count_;
  }
  [[nodiscard]] double velocity_count_per_s() const noexcept { return velocity_.counts_per_s(); }
  [[nodiscard]] const Reference& reference() const noexcept { return reference_; }
  [[nodiscard]] double duty_pct() const noexcept;
  // Asked of the motor until now.
  [[nodiscard]] double torque_Nm() const noexcept {
    return static_cast<double>(ticks_) / ticks_per_Nm_;
  }
  // Not just at a turning point: half a swing of the slowest chain, 4 Hz, is shorter.
  [[nodiscard]] bool is_at_rest() const noexcept {
    constexpr core::Nanoseconds kAtRest_ns = 250 * core::kNanosecondsPerMillisecond;
    return observer_.reading().time_ns - moved_ns_ >= kAtRest_ns;
  }
  // Estimated by the law, if it does; + pushes towards max.
  [[nodiscard]] double disturbance_Nm() const noexcept { return law_.disturbance_Nm(); }
  // Motor, carriage and load, of the motion that is followed; null where it is not enabled.
  [[nodiscard]] const AxisState* full_state() const noexcept {
    return state_observer_.works() ? &state_observer_.state() : nullptr;
  }
  [[nodiscard]] double lead_m() const noexcept { return law_.lead_m(); }
  [[nodiscard]] double integral_Nm() const noexcept { return law_.integral_Nm(); }
  [[nodiscard]] double motor_rad() const noexcept {
    return (static_cast<double>(observer_.count()) + 0.5) * settings_.rad_per_count();
  }
  [[nodiscard]] AxisDrive drive() const noexcept { return {ticks_, enabled_}; }
  [[nodiscard]] bool calibrated() const noexcept { return calibrated_; }
  [[nodiscard]] std::int64_t start_count() const noexcept { return start_count_; }
  // A and B edges since this was last asked.
  [[nodiscard]] std::uint32_t take_edges() noexcept;

  // ---- settings that change while the controller runs ----
  void declare_position(std::int64_t count) noexcept;
  void forget_calibration() noexcept { calibrated_ = false; }
  void set_gains(const PidGains& gains) noexcept { law_.set_gains(gains); }
  // Ticks of a PWM period and largest duty; with no power.
  void set_drive(const DriveConfiguration& drive) noexcept;
  void set_law(const AxisConfiguration& axis) noexcept { law_.set_additions(axis); }
  void set_velocity_estimation(const VelocityEstimation& velocity, double control_rate_Hz) noexcept;

 private:
  void set_ticks(double ticks) noexcept;
  [[nodiscard]] double speed_for_the_law_m_per_s(double step_s) noexcept;
  [[nodiscard]] double speed_limit_here_m_per_s(double speed_m_per_s) const noexcept;
  [[nodiscard]] BrakeInput brake_input(core::Nanoseconds now_ns) const noexcept;

  AxisConfiguration settings_;
  SafetyConfiguration safety_;
  double m_per_count_;
  double ticks_per_Nm_ = 0;
  double torque_limit_Nm_ = 0;
  std::int32_t tick_limit_ = 0;
  double standstill_count_per_s_;
  AxisObserver observer_;
  VelocityEstimator velocity_;
  StateObserver state_observer_;
  ControlLaw law_;
  Brake brake_;
  EndStopGuard end_stops_;
  EncoderPlausibility plausibility_;
  DeadReckoning reckoning_;
  SpeedLimits speed_limits_;
  Reference reference_;
  AxisMode mode_ = AxisMode::kIdle;
  core::Nanoseconds enabled_ns_ = 0;
  core::Nanoseconds moved_ns_ = -core::kNanosecondsPerSecond;
  std::int64_t start_count_ = 0;
  std::uint32_t edges_taken_ = 0;
  std::int32_t ticks_ = 0;
  bool enabled_ = false;
  bool calibrated_ = false;
  bool was_too_fast_ = false;
};

}  // namespace towbench::bbmc
