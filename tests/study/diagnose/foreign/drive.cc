#include "tests/study/diagnose/foreign/drive.h"

#include <algorithm>
#include <cmath>

namespace towbench::tests::foreign {

double in_steps(const Machine& machine, double units) {
  const double limited = std::clamp(units, -machine.unit_limit, machine.unit_limit);
  return machine.unit_step > 0 ? std::round(limited / machine.unit_step) * machine.unit_step
                               : limited;
}

Drive::Drive(const Machine& machine, const std::vector<Law>& laws)
    : laws_(laws), period_s_(machine.period_s) {
  for (const Law& law : laws) {
    dead_time_s_ += law.dead_time_s;
    lag_s_ += law.lag_s;
  }
}

void Drive::command(double command_N) {
  commands_N_.push_back(command_N);
  since_s_ = 0;
}

double Drive::step(double h_s, const Now& now) {
  // The command that was held a dead time before the middle of this step.
  const double back = (dead_time_s_ - since_s_ - 0.5 * h_s) / period_s_;
  const auto age = static_cast<std::size_t>(std::max(0.0, std::ceil(back)));
  const double held_N =
      age < commands_N_.size() ? commands_N_[commands_N_.size() - 1 - age] : commands_N_.front();
  since_s_ += h_s;
  lagged_N_ =
      begun_ && lag_s_ > 0 ? held_N + (lagged_N_ - held_N) * std::exp(-h_s / lag_s_) : held_N;
  begun_ = true;
  force_N_ = lagged_N_;
  for (const Law& law : laws_) {
    force_N_ = law.delivered_N ? law.delivered_N(force_N_, now) : force_N_;
  }
  return force_N_;
}

}  // namespace towbench::tests::foreign
