#include "bbmc/system/trajectory/pulse_program.h"

#include <algorithm>
#include <cmath>

#include "bbmc/system/trajectory/program_time.h"

namespace towbench::bbmc {
namespace {

constexpr double kMostSteps = 1e6;

}  // namespace

core::Result<PulseProgram> PulseProgram::make(const PulseParameters& wanted) noexcept {
  const bool usable = is_duty(wanted.duty_pct) && is_time(wanted.on_s) && wanted.on_s > 0 &&
                      is_time(wanted.off_s) && is_time(wanted.wait_s) && wanted.pulses >= 1 &&
                      is_time((wanted.on_s + wanted.off_s) * wanted.pulses + wanted.wait_s);
  if (!usable || core::nanoseconds(wanted.on_s) == 0) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  PulseProgram program;
  program.duty_pct_ = wanted.duty_pct;
  program.on_ns_ = core::nanoseconds(wanted.on_s);
  program.period_ns_ = program.on_ns_ + core::nanoseconds(wanted.off_s);
  program.wait_ns_ = core::nanoseconds(wanted.wait_s);
  program.pulses_ = wanted.pulses;
  program.alternate_ = wanted.alternate;
  return program;
}

double PulseProgram::duty_pct(double time_s) const noexcept {
  const core::Nanoseconds tau_ns = whole_nanoseconds(time_s) - wait_ns_;
  if (tau_ns < 0) {
    return 0;
  }
  const std::int64_t pulse = tau_ns / period_ns_;
  if (pulse >= pulses_ || tau_ns % period_ns_ >= on_ns_) {
    return 0;
  }
  return alternate_ && pulse % 2 == 1 ? -duty_pct_ : duty_pct_;
}

double PulseProgram::duration_s() const noexcept {
  return core::seconds(wait_ns_ + pulses_ * period_ns_);
}

core::Result<BreakAwayProgram> BreakAwayProgram::make(const BreakAwayParameters& wanted) noexcept {
  const bool usable = is_duty(wanted.increment_pct) && is_time(wanted.step_s) &&
                      is_duty(wanted.limit_pct) && wanted.limit_pct > 0;
  if (!usable || core::nanoseconds(wanted.step_s) == 0) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  // A millionth of a step of grace: 20 / 0.05 must be 400 steps, not 399.
  const double steps = wanted.limit_pct / std::fabs(wanted.increment_pct) + 1e-6;
  if (steps < 1 || steps > kMostSteps || !is_time(wanted.step_s * (steps + 1))) {
    return core::failure(core::ErrorCode::kRequestOutOfRange);
  }
  BreakAwayProgram program;
  program.increment_pct_ = wanted.increment_pct;
  program.step_ns_ = core::nanoseconds(wanted.step_s);
  program.steps_ = static_cast<std::int64_t>(steps);
  return program;
}

double BreakAwayProgram::duty_pct(double time_s) const noexcept {
  const std::int64_t step = std::min(whole_nanoseconds(time_s) / step_ns_, steps_);
  return increment_pct_ * static_cast<double>(step);
}

double BreakAwayProgram::duration_s() const noexcept {
  return core::seconds((steps_ + 1) * step_ns_);
}

}  // namespace towbench::bbmc
