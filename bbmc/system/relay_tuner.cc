#include "bbmc/system/relay_tuner.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace towbench::bbmc {
namespace {

// Cycles of a round: the first ones are transient, the rest is averaged.
constexpr std::int32_t kTransientCycles = 6;
constexpr std::int32_t kCountedCycles = 8;
constexpr std::int32_t kMostRounds = 40;
// Rounds of large steps; then small ones.
constexpr std::int32_t kCoarseRounds = 8;
// The amplitude is as wanted within so much.
constexpr double kTolerance = 0.05;
// Further away than so many amplitudes is no oscillation; no crossing for so long neither.
constexpr double kLost = 20.0;
constexpr double kLongestCycle_s = 5.0;

}  // namespace

RelayTuner::RelayTuner(const RelayParameters& parameters, double centre_rad) noexcept
    : parameters_(parameters),
      centre_rad_(centre_rad),
      relay_Nm_(std::min(parameters.torque_Nm, parameters.torque_limit_Nm)),
      lowest_rad_(centre_rad),
      highest_rad_(centre_rad),
      over_(false) {}

double RelayTuner::step(double angle_rad, double step_s) noexcept {
  if (over_) {
    return 0.0;
  }
  since_cycle_s_ += step_s;
  cycle_s_ += step_s;
  lowest_rad_ = std::min(lowest_rad_, angle_rad);
  highest_rad_ = std::max(highest_rad_, angle_rad);
  const double error_rad = centre_rad_ - angle_rad;
  if (std::fabs(error_rad) > kLost * parameters_.amplitude_rad ||
      since_cycle_s_ > kLongestCycle_s) {
    over_ = true;
    return 0.0;
  }
  const bool up = error_rad > 0 || (error_rad == 0 && pushes_up_);
  if (up && !pushes_up_) {
    end_cycle();
  }
  pushes_up_ = up;
  return over_ ? 0.0 : (up ? relay_Nm_ : -relay_Nm_);
}

void RelayTuner::end_cycle() noexcept {
  ++cycles_;
  if (cycles_ > kTransientCycles) {
    total_s_ += cycle_s_;
    total_swing_rad_ += highest_rad_ - lowest_rad_;
  }
  cycle_s_ = 0;
  since_cycle_s_ = 0;
  lowest_rad_ = centre_rad_;
  highest_rad_ = centre_rad_;
  if (cycles_ == kTransientCycles + kCountedCycles) {
    end_round();
  }
}

void RelayTuner::end_round() noexcept {
  const double amplitude_rad = total_swing_rad_ / (2.0 * kCountedCycles);
  const double period_s = total_s_ / kCountedCycles;
  const double ratio = parameters_.amplitude_rad / amplitude_rad;
  if (std::fabs(ratio - 1.0) <= kTolerance) {
    result_ = {.critical_gain_Nm_per_rad = 4.0 * relay_Nm_ / (std::numbers::pi * amplitude_rad),
               .critical_period_s = period_s,
               .amplitude_rad = amplitude_rad,
               .relay_Nm = relay_Nm_};
    over_ = true;
    return;
  }
  // The amplitude grows faster than the relay, with the square to the cube of it: half a step in
  // proportion converges from either side.
  // Where it does not settle so, the amplitude has two values over a range of the relay, up and
  // down: then slowly along one of them.
  const double whole = std::clamp(std::sqrt(ratio), 0.6, 1.6);
  const double change = rounds_ < kCoarseRounds ? whole : 1.0 + 0.25 * (whole - 1.0);
  // Not beyond the limit; there it must do, or not at all.
  const bool at_limit = relay_Nm_ >= parameters_.torque_limit_Nm;
  const double next_Nm = std::min(relay_Nm_ * change, parameters_.torque_limit_Nm);
  ++rounds_;
  over_ = rounds_ == kMostRounds || (at_limit && change > 1.0);
  relay_Nm_ = next_Nm;
  cycles_ = 0;
  total_s_ = 0;
  total_swing_rad_ = 0;
}

ZieglerNicholsGains ziegler_nichols_pid(const RelayResult& result) noexcept {
  if (!result.found()) {
    return {};
  }
  const double proportional = 0.6 * result.critical_gain_Nm_per_rad;
  return {.proportional_Nm_per_rad = proportional,
          .integral_Nm_per_rad_s = proportional / (result.critical_period_s / 2.0),
          .derivative_Nm_s_per_rad = proportional * result.critical_period_s / 8.0};
}

}  // namespace towbench::bbmc
