// The fin's force over time (EXP-5), from s = t - start_s:
//
//   forward  F_0 + F_1 sin(2 pi f s + phi)
//   left     F_2 sin(pi f s + phi / 2)
//
// The plant holds a force over its tick, so each tick gets the mean of the sine over it (the value
// at its middle times sin(pi f T) / (pi f T)): the impulse is exact and no slower beat appears.
#pragma once

#include "core/realtime.h"
#include "core/time.h"
#include "emulator/water/plane_vector.h"
#include "emulator/water/water_parameters.h"

namespace towbench::emulator {

class FinThrust {
 public:
  FinThrust(const FinParameters& fin, double body_yaw_deg) noexcept;

  // Mean over the tick that begins at `start_ns`, N in the tank. Begins and ends with a whole tick.
  TOWBENCH_REALTIME [[nodiscard]] PlaneVector over_tick(core::Nanoseconds start_ns) const noexcept;

 private:
  // Turns per second and where it begins; amplitude already times the mean over a tick.
  struct Oscillation {
    double frequency_Hz = 0;
    double phase_turns = 0;
    double amplitude_N = 0;
  };
  [[nodiscard]] static Oscillation over_ticks(double frequency_Hz, double phase_turns,
                                              double amplitude_N) noexcept;
  [[nodiscard]] static double at(const Oscillation& o, double middle_s) noexcept;

  BodyFrame frame_;
  core::Nanoseconds begin_ns_;
  core::Nanoseconds end_ns_;
  double mean_N_;
  Oscillation thrust_;
  Oscillation side_;
};

}  // namespace towbench::emulator
