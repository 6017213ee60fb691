#include "bbmc/system/velocity_estimator.h"

#include <cmath>

namespace towbench::bbmc {

VelocityEstimator::VelocityEstimator(const VelocityEstimation& settings,
                                     double sample_rate_Hz) noexcept
    : settings_(settings),
      switching_speed_(settings.switch_ratio *
                       std::sqrt(sample_rate_Hz * settings.capture_clock_Hz)),
      timeout_ns_(core::nanoseconds(settings.timeout_s)),
      tick_ns_(1e9 / settings.capture_clock_Hz) {}

double VelocityEstimator::by_period(const Eqep::Reading& sample) const noexcept {
  // The timer saturates; beyond that the time of the last change seen by sampling has to do.
  const bool timer_saturated = sample.since_edge_ticks >= kCaptureSaturation_ticks;
  const double waited_ns = timer_saturated
                               ? static_cast<double>(sample.time_ns - last_change_ns_)
                               : static_cast<double>(sample.since_edge_ticks) * tick_ns_;
  const bool timed_out =
      waited_ns >= static_cast<double>(timeout_ns_) ||
      (timer_saturated &&
       timeout_ns_ < static_cast<core::Nanoseconds>(tick_ns_ * kCaptureSaturation_ticks));
  if (!sample.capture_valid || timed_out) {
    return 0.0;
  }
  // One tick at least: two edges in one tick are at the timer's limit (3.55).
  double ticks = sample.capture_ticks == 0 ? 1.0 : static_cast<double>(sample.capture_ticks);
  const double waited_ticks = waited_ns / tick_ns_;
  ticks = waited_ticks > ticks ? waited_ticks : ticks;
  const double speed = settings_.capture_clock_Hz / ticks;
  return sample.forward ? speed : -speed;
}

double VelocityEstimator::update(const Eqep::Reading& sample, std::int64_t count) noexcept {
  if (!started_) {
    started_ = true;
    last_time_ns_ = sample.time_ns;
    last_change_ns_ = sample.time_ns;
    last_count_ = count;
    return estimate_;
  }
  const core::Nanoseconds elapsed_ns = sample.time_ns - last_time_ns_;
  if (elapsed_ns <= 0) {
    return estimate_;  // the same sample again says nothing new
  }
  const std::int64_t change = count - last_count_;
  frequency_value_ = static_cast<double>(change) * 1e9 / static_cast<double>(elapsed_ns);
  last_time_ns_ = sample.time_ns;
  last_count_ = count;
  if (change != 0) {
    last_change_ns_ = sample.time_ns;
  }
  // v_f decides in both directions: it is never invalid, and its quantum is well inside the band.
  const double band =
      uses_frequency_ ? 1.0 - settings_.hysteresis_ratio : 1.0 + settings_.hysteresis_ratio;
  uses_frequency_ = std::fabs(frequency_value_) > switching_speed_ * band;

  switch (settings_.method) {
    case VelocityMethod::kFrequency:
      estimate_ = frequency_value_;
      break;
    case VelocityMethod::kPeriod:
      estimate_ = by_period(sample);
      break;
    case VelocityMethod::kHybrid:
      estimate_ = uses_frequency_ ? frequency_value_ : by_period(sample);
      break;
  }
  return estimate_;
}

}  // namespace towbench::bbmc
