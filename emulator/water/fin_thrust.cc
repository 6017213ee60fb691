#include "emulator/water/fin_thrust.h"

#include <numbers>

namespace towbench::emulator {
namespace {

core::Nanoseconds first_tick_from(double time_s) noexcept {
  const core::Nanoseconds time_ns = core::nanoseconds(time_s);
  return (time_ns + core::kPlantTick_ns - 1) / core::kPlantTick_ns * core::kPlantTick_ns;
}

}  // namespace

FinThrust::FinThrust(const FinParameters& fin, double body_yaw_deg) noexcept
    : frame_(body_yaw_deg),
      begin_ns_(first_tick_from(fin.start_s)),
      end_ns_(first_tick_from(fin.start_s + fin.duration_s)),
      mean_N_(fin.mean_thrust_N),
      thrust_(over_ticks(fin.thrust_frequency_Hz, fin.phase_deg / 360.0, fin.thrust_amplitude_N)),
      side_(over_ticks(0.5 * fin.thrust_frequency_Hz, 0.5 * fin.phase_deg / 360.0,
                       fin.side_amplitude_N)) {}

FinThrust::Oscillation FinThrust::over_ticks(double frequency_Hz, double phase_turns,
                                             double amplitude_N) noexcept {
  const double half_turn = 0.5 * frequency_Hz * core::kPlantTick_s;
  const double mean_over_middle =
      core::sine_cosine_of_turns(half_turn).sine / (2.0 * std::numbers::pi * half_turn);
  return {frequency_Hz, phase_turns, amplitude_N * mean_over_middle};
}

double FinThrust::at(const Oscillation& o, double middle_s) noexcept {
  return o.amplitude_N * core::sine_cosine_of_turns(o.frequency_Hz * middle_s + o.phase_turns).sine;
}

PlaneVector FinThrust::over_tick(core::Nanoseconds start_ns) const noexcept {
  if (start_ns < begin_ns_ || start_ns >= end_ns_) {
    return {};
  }
  const double middle_s =
      1e-9 * static_cast<double>(start_ns - begin_ns_) + 0.5 * core::kPlantTick_s;
  return frame_.to_tank({.forward = mean_N_ + at(thrust_, middle_s), .left = at(side_, middle_s)});
}

}  // namespace towbench::emulator
