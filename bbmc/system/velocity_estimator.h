// Velocity from an incremental encoder, thesis 3.4.2, in counts/s.
//
//   frequency  v_f = (n_k - n_(k-1)) / T_s                       (3.46), quantum 1/T_s  (3.48)
//   period     v_p = +-N_s f_c / m,  m capture ticks per N_s counts, (3.53), (3.54); N_s = 1:
//              quantum v^2/f_c
//   hybrid     v_p below, v_f above the speed where both quanta are equal:
//              v_sw = sqrt(f_c / T_s)                            39,528 counts/s at 1 kHz, 1.5625
//              MHz
//
// N_s is 1, and no key sets another: every port of eqep.h times one count to the next. With more
// the newest value would be N_s counts old, at 89 counts/s and N_s = 4 older than the time-out.
//
// The print gives (3.58) without omega: SNR_f = omega N T_s / 2 pi is a function of speed and
// equals SNR_p = gamma at the switching speed only; v_sw above is that speed with gamma_p = f_c /
// v.
//
// Between edges the period value is not simply held: a count that has not come for t seconds bounds
// the speed by 1/t. So the value decays from the moment the next edge is overdue, is 0 after the
// time-out, and repeats exactly (no dip to 0) when samples repeat at steady motion (defect 8).
#pragma once

#include <cstdint>

#include "bbmc/device/eqep.h"
#include "bbmc/system/axis_configuration.h"
#include "core/realtime.h"
#include "core/time.h"

namespace towbench::bbmc {

class VelocityEstimator {
 public:
  // `sample_rate_Hz` sets the switching speed only; differences use the times of the samples.
  VelocityEstimator(const VelocityEstimation& settings, double sample_rate_Hz) noexcept;

  // One sample; `count` is unwrapped. Times ascend. Returns counts/s.
  TOWBENCH_REALTIME double update(const Eqep::Reading& sample, std::int64_t count) noexcept;

  [[nodiscard]] double counts_per_s() const noexcept { return estimate_; }
  // Of the hybrid; whatever the method.
  [[nodiscard]] double switching_speed_counts_per_s() const noexcept { return switching_speed_; }
  [[nodiscard]] bool uses_frequency() const noexcept { return uses_frequency_; }

 private:
  [[nodiscard]] double by_period(const Eqep::Reading& sample) const noexcept;

  VelocityEstimation settings_;
  double switching_speed_;
  core::Nanoseconds timeout_ns_;
  double tick_ns_;
  core::Nanoseconds last_time_ns_ = 0;
  core::Nanoseconds last_change_ns_ = 0;
  std::int64_t last_count_ = 0;
  double frequency_value_ = 0;
  double estimate_ = 0;
  bool uses_frequency_ = false;
  bool started_ = false;
};

}  // namespace towbench::bbmc
