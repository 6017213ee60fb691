// Torque that depends on the motor's angle (cogging, commutation), periodic in a turn:
//
//   tau(theta) = A sin(k theta + phi)
//
// Its mean over a piece of motion at steady speed is the value in the middle times sinc(k w T / 2).
// Not in the thesis.
#pragma once

#include <numbers>

#include "emulator/plant/disturbance_parameters.h"
#include "emulator/plant/sine_table.h"

namespace towbench::emulator {

class TorqueRipple {
 public:
  explicit TorqueRipple(const TorqueRippleParameters& p) noexcept
      : amplitude_Nm_(p.amplitude_Nm),
        periods_per_rad_(p.periods_per_turn / (2.0 * std::numbers::pi)),
        half_harmonic_(0.5 * p.periods_per_turn),
        phase_turns_(p.phase_deg / 360.0) {}

  [[nodiscard]] bool present() const noexcept { return amplitude_Nm_ != 0; }

  [[nodiscard]] double at(const SineTable& sine, double motor_rad) const noexcept {
    return amplitude_Nm_ * sine(periods_per_rad_ * motor_rad + phase_turns_).sine;
  }

  // Mean of a motion through `motor_rad` in its middle that takes `travel_rad` in all.
  [[nodiscard, gnu::always_inline]] double mean(const SineTable& sine, double motor_rad,
                                                double travel_rad) const noexcept {
    const double y = half_harmonic_ * travel_rad;  // half the phase passed
    return at(sine, motor_rad) * sinc_of_square(y * y);
  }

 private:
  // sin(y)/y up to the first zero, to 0.3 %; faster ripple averages out.
  [[nodiscard]] static double sinc_of_square(double square) noexcept {
    constexpr double kFirstZero = std::numbers::pi * std::numbers::pi;
    if (square > kFirstZero) {
      return 0.0;
    }
    // Factors, not divisors: a chain of divisions would take as long as the rest of the step.
    constexpr double k3 = 1.0 / 6.0;
    constexpr double k5 = 1.0 / 20.0;
    constexpr double k7 = 1.0 / 42.0;
    constexpr double k9 = 1.0 / 72.0;
    return 1.0 - square * k3 * (1.0 - square * k5 * (1.0 - square * k7 * (1.0 - square * k9)));
  }

  double amplitude_Nm_;
  double periods_per_rad_;
  double half_harmonic_;
  double phase_turns_;
};

}  // namespace towbench::emulator
