// An axis with one thing wrong, and the log that its bench would write. Shares no code with the
// library of effects under test: laws are written again, in time, as forces on a body.
//
// The body is the nominal Y axis seen at the carriage (docs/reference/constants.md: Table 7.4
// through R/n): 8.39 kg, 5.41 N s/m, 1.58 N, 445,345 counts/m, 0.691 N per % duty; 1 kHz PID with
// 0.1 % duty steps.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace towbench::tests {

struct HiddenAxis {
  double mass_kg = 8.387;
  double viscous_N_s_per_m = 5.412;
  double coulomb_N = 1.581;
  double newton_per_duty_pct = 0.6911;
  double counts_per_m = 445345.0;
  double motor_turns_per_m = 111.336;
  double output_radius_m = 0.050;
  double duration_s = 30;
  double period_s = 1e-3;
  double duty_step_pct = 0.1;
  bool open_loop = false;  // sines of command, whatever the axis makes of them; no reference
  std::string effect;  // a name of the interface, "outside" for one that is in no library, or empty
  double size = 1;     // in units of the law's own constants (hidden_force.cc)
  std::string second_effect;
  double second_size = 1;
  std::uint64_t machine = 0;  // draws the signs and phases; 0: the motion's seed does
};

struct HiddenLog {
  std::vector<double> time_s, position_m, duty_pct, reference_m;
};

// Draws the motion, the signs and the phases from the seed.
[[nodiscard]] HiddenLog make_hidden_log(const HiddenAxis& axis, std::uint64_t seed);

}  // namespace towbench::tests
