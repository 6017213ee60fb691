#include "bbmc/system/trajectory/harmonic.h"

#include <cmath>
#include <numbers>

#include "core/deterministic_math.h"

namespace towbench::bbmc {
namespace {

constexpr double kTwoPi = 2 * std::numbers::pi;

}  // namespace

core::Result<Harmonic> Harmonic::make(const HarmonicParameters& wanted) noexcept {
  const bool usable = std::isfinite(wanted.start_m) && std::isfinite(wanted.amplitude_m) &&
                      wanted.amplitude_m != 0 && std::isfinite(wanted.starting_phase_turns);
  if (!usable) {
    return core::failure(core::ErrorCode::kRequestBadArgument);
  }
  const core::Result<PhaseRamp> phase = PhaseRamp::make(wanted.phase);
  if (!phase) {
    return core::failure(phase.error());
  }
  Harmonic motion;
  motion.start_m_ = wanted.start_m;
  motion.amplitude_m_ = wanted.amplitude_m;
  motion.starting_phase_turns_ = wanted.starting_phase_turns;
  motion.starting_cosine_ = core::sine_cosine_of_turns(wanted.starting_phase_turns).cosine;
  motion.phase_ = *phase;
  return motion;
}

Reference Harmonic::at(double time_s) const noexcept {
  const Phase phase = phase_.at(time_s);
  const auto [sine, cosine] = core::sine_cosine_of_turns(phase.turns + starting_phase_turns_);
  const double rate_rad_per_s = kTwoPi * phase.frequency_hz;
  return {.position_m = start_m_ + amplitude_m_ * (starting_cosine_ - cosine),
          .velocity_m_per_s = amplitude_m_ * rate_rad_per_s * sine,
          .acceleration_m_per_s2 = amplitude_m_ * (kTwoPi * phase.frequency_rate_hz_per_s * sine +
                                                   rate_rad_per_s * rate_rad_per_s * cosine)};
}

double Harmonic::peak_speed_m_per_s() const noexcept {
  return std::fabs(amplitude_m_) * kTwoPi * phase_.peak_frequency_hz();
}

double Harmonic::lowest_m() const noexcept {
  return start_m_ + amplitude_m_ * starting_cosine_ - std::fabs(amplitude_m_);
}

double Harmonic::highest_m() const noexcept {
  return start_m_ + amplitude_m_ * starting_cosine_ + std::fabs(amplitude_m_);
}

}  // namespace towbench::bbmc
