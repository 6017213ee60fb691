// Play between motor and carriage, and strands that go slack: (3.37)-(3.38) with dead zones
// (docs/theory/plant.md, 6). Values: gearhead data sheet, App. A, 0.35 deg.
//
// A massless wheel behind the gear lets gear backlash (an arc R beta) and the slack s of what runs
// over the wheel add up to one gap, half_gap p = (R beta + s) / 2. With the transmission's
// stretch d:
//
//   taut         F = K (d - sigma p) + B d'                both strands pull; side sigma
//   one strand   F = K/2 (d - sigma p) + B/2 d' + sigma T  the other is slack, beyond
//                                                          |d| = p + 2T/K
//   open         F = 0                                     |d| < p
//   leaving      F = 0                                     beyond p, but F would pull apart
//
// T is a strand's pre-tension at rest; none given means strands that never go slack. A transmission
// with slack hangs on one strand at a time: T = 0 and no taut state. A contact starts where the gap
// is closed and ends where its force would change sign, as at the hard ends.
#pragma once

#include "emulator/plant/derived_mechanics.h"
#include "emulator/plant/regime.h"

namespace towbench::emulator {

// F = stiffness d + damping d' + constant.
struct TransmissionLaw {
  double stiffness_N_per_m = 0;
  double damping_N_s_per_m = 0;
  double constant_N = 0;
};

struct TransmissionPlay {
  double half_gap_m = 0;
  double pretension_N = 0;
  double strand_slack_m = 0;  // 2T/K past the gap the other strand is slack
  TransmissionContact engaged = TransmissionContact::kTaut;  // what closing the gap leads to

  [[nodiscard]] bool has_gap() const noexcept { return half_gap_m > 0; }
  [[nodiscard]] bool has_strands() const noexcept { return pretension_N > 0; }
  [[nodiscard]] bool present() const noexcept { return has_gap() || has_strands(); }
};

[[nodiscard]] TransmissionPlay transmission_play(const AxisParameters& axis,
                                                 const DerivedMechanics& mechanics) noexcept;

// The force law of a contact on side `sign` (+1: the motor is ahead, the transmission pulls towards
// max).
[[nodiscard]] inline TransmissionLaw transmission_law(const DerivedMechanics& m,
                                                      const TransmissionPlay& play,
                                                      TransmissionContact contact,
                                                      double sign) noexcept {
  const double k = m.transmission_stiffness_N_per_m;
  const double b = m.transmission_damping_N_s_per_m;
  switch (contact) {
    case TransmissionContact::kTaut:
      return {k, b, -sign * k * play.half_gap_m};
    case TransmissionContact::kOneStrand:
      return {0.5 * k, 0.5 * b, sign * (play.pretension_N - 0.5 * k * play.half_gap_m)};
    case TransmissionContact::kLeaving:
    case TransmissionContact::kOpen:
      break;
  }
  return {};
}

}  // namespace towbench::emulator
