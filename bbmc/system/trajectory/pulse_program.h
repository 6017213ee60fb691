// Open-loop duty against time: square-wave pulses (thesis 7.2.1), steps, and the break-away ramp.
//
// Times are compared in whole nanoseconds (program_time.h).
#pragma once

#include <cstdint>

#include "core/realtime.h"
#include "core/result.h"
#include "core/time.h"

namespace towbench::bbmc {

// `pulses` times: duty for on_s, then rest for off_s. BBMC 0.5: 10 %, 200/300 ms, 5 s in all.
struct PulseParameters {
  double duty_pct = 10;      // signed, 0 < |duty| <= 100
  double on_s = 0.2;         // > 0
  double off_s = 0.3;        // >= 0
  double wait_s = 0.5;       // rest before the first pulse, >= 0
  std::int32_t pulses = 10;  // >= 1
  bool alternate = false;    // every second pulse has the other sign, so the axis stays in place
};

class PulseProgram {
 public:
  // kRequestBadArgument for anything not finite or outside the signs above, or longer than a day.
  [[nodiscard]] static core::Result<PulseProgram> make(const PulseParameters& wanted) noexcept;

  // % of full drive; 0 before the first pulse and after the last.
  TOWBENCH_REALTIME [[nodiscard]] double duty_pct(double time_s) const noexcept;
  [[nodiscard]] double duration_s() const noexcept;

 private:
  double duty_pct_ = 0;
  core::Nanoseconds on_ns_ = 1;
  core::Nanoseconds period_ns_ = 1;
  core::Nanoseconds wait_ns_ = 0;
  std::int32_t pulses_ = 0;
  bool alternate_ = false;
};

// Duty rises by increment_pct every `ticks_per_step` control ticks until the axis moves (EXP-OL-1):
// whoever runs it stops it when |v| > stop_speed. BBMC 0.5: +0.05 % every 20 samples, 1000
// counts/s.
struct BreakAwayParameters {
  double increment_pct = 0.05;  // signed, not 0
  double step_s = 0.02;         // 20 samples at 1 kHz, > 0
  double limit_pct = 20;        // > 0: the ramp ends there, and the attempt with it
};

class BreakAwayProgram {
 public:
  [[nodiscard]] static core::Result<BreakAwayProgram> make(
      const BreakAwayParameters& wanted) noexcept;

  TOWBENCH_REALTIME [[nodiscard]] double duty_pct(double time_s) const noexcept;
  // When the limit has been held for one step.
  [[nodiscard]] double duration_s() const noexcept;

 private:
  double increment_pct_ = 0;
  core::Nanoseconds step_ns_ = 1;
  std::int64_t steps_ = 0;
};

}  // namespace towbench::bbmc
