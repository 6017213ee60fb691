#include "emulator/plant/wheel.h"

#include <numbers>

namespace towbench::emulator {

Wheel::Wheel(const AxisParameters& axis) noexcept
    : radius_m_(axis.output_radius_m),
      teeth_(axis.disturbances.wheel.teeth),
      eccentricity_m_(axis.disturbances.wheel.eccentricity_m),
      phase_turns_(axis.disturbances.wheel.eccentricity_phase_deg / 360.0),
      sine_of_phase_(core::sine_cosine_of_turns(phase_turns_).sine),
      turns_per_rad_(1.0 / (2.0 * std::numbers::pi * axis.gear_ratio)),
      per_gear_(1.0 / axis.gear_ratio) {
  if (teeth_ != 0) {
    const double half_pitch_rad = std::numbers::pi / teeth_;
    pitch_angle_rad_ = 2.0 * half_pitch_rad;
    pitch_radius_m_ = radius_m_ * half_pitch_rad / core::sine_cosine_of_turns(0.5 / teeth_).sine;
  }
}

}  // namespace towbench::emulator
