#include "emulator/plant/transmission_play.h"

#include <numbers>

namespace towbench::emulator {

TransmissionPlay transmission_play(const AxisParameters& axis,
                                   const DerivedMechanics& mechanics) noexcept {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  TransmissionPlay play;
  if (axis.elasticity.rigid) {
    return play;
  }
  const double backlash_m = axis.gear.backlash_deg * kRadPerDeg * axis.output_radius_m;
  play.half_gap_m = 0.5 * (backlash_m + axis.elasticity.slack_m);
  play.pretension_N = axis.elasticity.pretension_N;
  play.strand_slack_m =
      2.0 * axis.elasticity.pretension_N / mechanics.transmission_stiffness_N_per_m;
  play.engaged =
      axis.elasticity.slack_m > 0 ? TransmissionContact::kOneStrand : TransmissionContact::kTaut;
  return play;
}

}  // namespace towbench::emulator
