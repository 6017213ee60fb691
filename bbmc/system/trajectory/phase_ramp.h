// The phase of a periodic motion that starts and ends at rest.
//
// The frequency rises from 0 over the ramp as a half cosine, stays, and falls the same way:
//
//   f(t)   = f_0 (1 - cos(pi t / t_r)) / 2,   phi(t) = f_0 (t - (t_r/pi) sin(pi t/t_r)) / 2   entry
//   f(t)   = f_0,                             phi(t) = f_0 (t - t_r/2)                      between
//   phi(t) = N - phi(t_f - t)                                                                  exit
//
// so that the shape drawn stays exactly what it is (a circle stays a circle) and neither velocity
// nor acceleration along it jumps. Each ramp takes f_0 t_r / 2 turns, t_f = N / f_0 + t_r. With
// t_r = 0 it is the plain phase of (4.22), which starts with whatever velocity the shape has.
// Too few turns for the ramps: same angular acceleration, lower peak frequency.
#pragma once

#include "core/result.h"

namespace towbench::bbmc {

struct Phase {
  double turns = 0;
  double frequency_hz = 0;             // its rate
  double frequency_rate_hz_per_s = 0;  // and the rate of that
};

struct PhaseRampParameters {
  double frequency_hz = 0;  // f_0, > 0
  double turns = 0;         // N, > 0, need not be whole
  double ramp_s = 0;        // t_r, >= 0
  double wait_s = 0;        // rest before t = 0 of the formulas, >= 0
};

class PhaseRamp {
 public:
  // A phase that rests at 0.
  PhaseRamp() noexcept = default;

  // kRequestBadArgument for anything not finite or outside the signs above.
  [[nodiscard]] static core::Result<PhaseRamp> make(const PhaseRampParameters& wanted) noexcept;

  [[nodiscard]] Phase at(double time_s) const noexcept;
  [[nodiscard]] double duration_s() const noexcept { return end_s_; }
  [[nodiscard]] double turns() const noexcept { return turns_; }
  [[nodiscard]] double peak_frequency_hz() const noexcept { return frequency_hz_; }

 private:
  [[nodiscard]] Phase entry(double time_s) const noexcept;

  double frequency_hz_ = 0;
  double turns_ = 0;
  double ramp_s_ = 0;
  double wait_s_ = 0;
  double end_s_ = 0;
};

}  // namespace towbench::bbmc
