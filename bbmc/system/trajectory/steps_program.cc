#include "bbmc/system/trajectory/steps_program.h"

#include "bbmc/system/trajectory/program_time.h"

namespace towbench::bbmc {

core::Result<StepsProgram> StepsProgram::make(std::span<const DutyStep> steps) noexcept {
  if (steps.empty() || steps.size() > kMaxSteps) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  StepsProgram program;
  program.size_ = steps.size();
  core::Nanoseconds end_ns = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const bool usable = (steps[i].duty_pct == 0 || is_duty(steps[i].duty_pct)) &&
                        is_time(steps[i].time_s) && core::nanoseconds(steps[i].time_s) > 0;
    if (!usable) {
      return core::failure(core::ErrorCode::kRequestBadArgument);
    }
    end_ns += core::nanoseconds(steps[i].time_s);
    program.duty_pct_[i] = steps[i].duty_pct;
    program.ends_ns_[i] = end_ns;
  }
  return program;
}

double StepsProgram::duty_pct(double time_s) const noexcept {
  if (!(time_s >= 0)) {
    return 0;
  }
  const core::Nanoseconds time_ns = whole_nanoseconds(time_s);
  for (std::size_t i = 0; i < size_; ++i) {
    if (time_ns < ends_ns_[i]) {
      return duty_pct_[i];
    }
  }
  return 0;
}

}  // namespace towbench::bbmc
