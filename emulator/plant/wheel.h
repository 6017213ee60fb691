// How much further a real wheel moves what runs over it than a true circle of radius R does, at
// motor angle theta = n phi:
//
//   delta(theta) = e (sin(phi + phi_0) - sin(phi_0))                    eccentric by e
//                + (R_p sin(psi) - R psi),  psi = phi - (2 pi / N) round(phi N / 2 pi)
//                                                                       polygon of N teeth
//   R_p = R (pi/N) / sin(pi/N): N chords are as long as a circle of radius R
//
// The transmission's stretch is r theta + delta(theta) - x, and by virtual work its force acts on
// the motor with lever r + delta'(theta): speed and torque ripple are one law. That links lie on
// their wheel as chords is textbook kinematics.
#pragma once

#include "emulator/plant/axis_parameters.h"
#include "emulator/plant/sine_table.h"

namespace towbench::emulator {

class Wheel {
 public:
  explicit Wheel(const AxisParameters& axis) noexcept;

  struct Excess {
    double offset_m = 0;         // delta
    double slope_m_per_rad = 0;  // delta', a radian of motor
  };

  [[nodiscard]] bool present() const noexcept { return eccentricity_m_ != 0 || teeth_ != 0; }

  [[nodiscard, gnu::always_inline]] Excess operator()(const SineTable& sine,
                                                      double motor_rad) const noexcept {
    Excess excess;
    const double turns = motor_rad * turns_per_rad_;
    if (eccentricity_m_ != 0) {
      const SineTable::Value wave = sine(turns + phase_turns_);
      excess.offset_m = eccentricity_m_ * (wave.sine - sine_of_phase_);
      excess.slope_m_per_rad = eccentricity_m_ * turns_per_rad_ * wave.slope_per_turn;
    }
    if (teeth_ != 0) {
      add_polygon(turns, excess);
    }
    return excess;
  }

 private:
  // 1 - z a (1 - z b (1 - z c (1 - z d))); factors, not divisors: those would cost too much time.
  [[nodiscard, gnu::always_inline]] static double one_minus_nested(double z,
                                                                   const double (&f)[4]) noexcept {
    return 1.0 - z * f[0] * (1.0 - z * f[1] * (1.0 - z * f[2] * (1.0 - z * f[3])));
  }

  // |psi| <= pi/5: the series ends below 1e-9.
  [[gnu::always_inline]] void add_polygon(double turns, Excess& excess) const noexcept {
    const double pitches = turns * teeth_;
    const double psi = (pitches - core::floor_exact(pitches + 0.5)) * pitch_angle_rad_;
    const double z = psi * psi;
    constexpr double kSine[] = {1.0 / 6.0, 1.0 / 20.0, 1.0 / 42.0, 1.0 / 72.0};
    constexpr double kCosine[] = {1.0 / 2.0, 1.0 / 12.0, 1.0 / 30.0, 1.0 / 56.0};
    const double sine = psi * one_minus_nested(z, kSine);
    const double cosine = one_minus_nested(z, kCosine);
    excess.offset_m += pitch_radius_m_ * sine - radius_m_ * psi;
    excess.slope_m_per_rad += (pitch_radius_m_ * cosine - radius_m_) * per_gear_;
  }

  double radius_m_;
  double pitch_radius_m_ = 0;
  double teeth_;
  double pitch_angle_rad_ = 0;
  double eccentricity_m_;
  double phase_turns_;
  double sine_of_phase_;
  double turns_per_rad_;  // of the wheel, a radian of motor
  double per_gear_;       // 1/n
};

}  // namespace towbench::emulator
