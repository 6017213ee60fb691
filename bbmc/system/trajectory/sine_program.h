// Open-loop duty as a sine on an offset, for frequency responses.
#pragma once

#include "core/realtime.h"
#include "core/result.h"
#include "core/time.h"

namespace towbench::bbmc {

struct SineParameters {
  double amplitude_pct = 10;  // > 0
  double offset_pct = 0;      // amplitude + |offset| <= 100
  double frequency_hz = 1;    // > 0
  double cycles = 5;          // > 0; whole cycles end where they began
  double wait_s = 0.5;        // >= 0
};

class SineProgram {
 public:
  // kRequestBadArgument for anything not finite or outside the bounds above, or longer than a day.
  [[nodiscard]] static core::Result<SineProgram> make(const SineParameters& wanted) noexcept;

  TOWBENCH_REALTIME [[nodiscard]] double duty_pct(double time_s) const noexcept;
  [[nodiscard]] double duration_s() const noexcept { return core::seconds(end_ns_); }

 private:
  double amplitude_pct_ = 0;
  double offset_pct_ = 0;
  double frequency_hz_ = 1;
  core::Nanoseconds wait_ns_ = 0;
  core::Nanoseconds end_ns_ = 0;
};

}  // namespace towbench::bbmc
