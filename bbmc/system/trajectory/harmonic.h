// One axis of a periodic motion: sinusoid (4.22)-(4.24), and by two of them circle and ellipse.
//
//   x = x_s + A (cos 2 pi p - cos 2 pi (phi + p))
//
// starts at x_s whatever its starting phase p. p = 0 is (4.22) with theta_0 = x_s + A; p = 1/4 is
// x_s + A sin(2 pi phi), a quarter behind it. phi(t) is a PhaseRamp: with no ramp the velocity
// of p = 1/4 starts with a jump, as BBMC 0.5's circle did.
#pragma once

#include "bbmc/system/trajectory/phase_ramp.h"
#include "bbmc/system/trajectory/reference.h"
#include "core/result.h"

namespace towbench::bbmc {

struct HarmonicParameters {
  double start_m = 0;
  double amplitude_m = 0;  // signed: negative starts the other way; not 0
  double starting_phase_turns = 0;
  PhaseRampParameters phase;
};

class Harmonic {
 public:
  // kRequestBadArgument for anything not finite, a zero amplitude, or an unusable phase.
  [[nodiscard]] static core::Result<Harmonic> make(const HarmonicParameters& wanted) noexcept;

  [[nodiscard]] Reference at(double time_s) const noexcept;
  [[nodiscard]] double duration_s() const noexcept { return phase_.duration_s(); }

  // The largest speed and the extent of the motion; bounds when the turns are fewer than one.
  [[nodiscard]] double peak_speed_m_per_s() const noexcept;
  [[nodiscard]] double lowest_m() const noexcept;
  [[nodiscard]] double highest_m() const noexcept;

 private:
  double start_m_ = 0;
  double amplitude_m_ = 0;
  double starting_phase_turns_ = 0;
  double starting_cosine_ = 1;
  PhaseRamp phase_;
};

}  // namespace towbench::bbmc
