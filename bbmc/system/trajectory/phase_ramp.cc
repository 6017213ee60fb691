#include "bbmc/system/trajectory/phase_ramp.h"

#include <cmath>
#include <numbers>

#include "core/deterministic_math.h"

namespace towbench::bbmc {

core::Result<PhaseRamp> PhaseRamp::make(const PhaseRampParameters& wanted) noexcept {
  const bool usable = std::isfinite(wanted.frequency_hz) && wanted.frequency_hz > 0 &&
                      std::isfinite(wanted.turns) && wanted.turns > 0 &&
                      std::isfinite(wanted.ramp_s) && wanted.ramp_s >= 0 &&
                      std::isfinite(wanted.wait_s) && wanted.wait_s >= 0;
  if (!usable) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  // Turns of both ramps go with the square of the peak frequency when the angular acceleration
  // stays.
  const double ramp_turns = wanted.frequency_hz * wanted.ramp_s;
  const double scale = wanted.turns < ramp_turns ? std::sqrt(wanted.turns / ramp_turns) : 1.0;
  PhaseRamp phase;
  phase.frequency_hz_ = wanted.frequency_hz * scale;
  phase.ramp_s_ = wanted.ramp_s * scale;
  phase.turns_ = wanted.turns;
  phase.wait_s_ = wanted.wait_s;
  phase.end_s_ = wanted.wait_s + wanted.turns / phase.frequency_hz_ + phase.ramp_s_;
  return phase;
}

Phase PhaseRamp::entry(double time_s) const noexcept {
  const core::SineCosine half_turn = core::sine_cosine_of_turns(time_s / (2 * ramp_s_));
  return {
      .turns = frequency_hz_ / 2 * (time_s - ramp_s_ / std::numbers::pi * half_turn.sine),
      .frequency_hz = frequency_hz_ / 2 * (1 - half_turn.cosine),
      .frequency_rate_hz_per_s = frequency_hz_ * std::numbers::pi / (2 * ramp_s_) * half_turn.sine};
}

Phase PhaseRamp::at(double time_s) const noexcept {
  const double tau_s = time_s - wait_s_;
  const double left_s = end_s_ - time_s;
  if (tau_s < 0) {
    return {};
  }
  if (left_s <= 0) {
    return {.turns = turns_};
  }
  if (tau_s < ramp_s_) {
    return entry(tau_s);
  }
  if (left_s < ramp_s_) {
    const Phase mirrored = entry(left_s);
    return {.turns = turns_ - mirrored.turns,
            .frequency_hz = mirrored.frequency_hz,
            .frequency_rate_hz_per_s = -mirrored.frequency_rate_hz_per_s};
  }
  return {.turns = frequency_hz_ * (tau_s - ramp_s_ / 2), .frequency_hz = frequency_hz_};
}

}  // namespace towbench::bbmc
