#include "bbmc/system/trajectory/sine_program.h"

#include <cmath>

#include "bbmc/system/trajectory/program_time.h"
#include "core/deterministic_math.h"

namespace towbench::bbmc {

core::Result<SineProgram> SineProgram::make(const SineParameters& wanted) noexcept {
  const bool usable = is_duty(wanted.amplitude_pct) && wanted.amplitude_pct > 0 &&
                      wanted.amplitude_pct + std::fabs(wanted.offset_pct) <= 100 &&
                      std::isfinite(wanted.frequency_hz) && wanted.frequency_hz > 0 &&
                      std::isfinite(wanted.cycles) && wanted.cycles > 0 && is_time(wanted.wait_s) &&
                      is_time(wanted.wait_s + wanted.cycles / wanted.frequency_hz);
  if (!usable) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  SineProgram program;
  program.amplitude_pct_ = wanted.amplitude_pct;
  program.offset_pct_ = wanted.offset_pct;
  program.frequency_hz_ = wanted.frequency_hz;
  program.wait_ns_ = core::nanoseconds(wanted.wait_s);
  program.end_ns_ = core::nanoseconds(wanted.wait_s + wanted.cycles / wanted.frequency_hz);
  return program;
}

double SineProgram::duty_pct(double time_s) const noexcept {
  const core::Nanoseconds time_ns = whole_nanoseconds(time_s);
  if (time_ns < wait_ns_ || time_ns >= end_ns_) {
    return 0;
  }
  const double turns = frequency_hz_ * core::seconds(time_ns - wait_ns_);
  return offset_pct_ + amplitude_pct_ * core::sine_cosine_of_turns(turns).sine;
}

}  // namespace towbench::bbmc
