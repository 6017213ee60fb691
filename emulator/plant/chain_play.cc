#include "emulator/plant/chain_play.h"

#include <numbers>

namespace towbench::emulator {

ChainPlay chain_play(const AxisParameters& axis, const DerivedMechanics& mechanics) noexcept {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  ChainPlay play;
  if (axis.chain.rigid) {
    return play;
  }
  const double backlash_m = axis.gear.backlash_deg * kRadPerDeg * axis.sprocket_radius_m;
  play.half_gap_m = 0.5 * (backlash_m + axis.chain.slack_m);
  play.pretension_N = axis.chain.pretension_N;
  play.strand_slack_m = 2.0 * axis.chain.pretension_N / mechanics.chain_stiffness_N_per_m;
  play.engaged = axis.chain.slack_m > 0 ? ChainContact::kOneStrand : ChainContact::kTaut;
  return play;
}

}  // namespace towbench::emulator
