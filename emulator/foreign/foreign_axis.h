// One axis of a foreign plant, with what the bench adds to it: the command as each kind of drive
// puts it out, and hard ends.
//
//   u = clamp(k_v u_c, r U)    i = clamp(k_a u_c, I_max)    F = K_T i n / R        off: 0
//   F_end = -(c d + b v), d: depth beyond the end; pushes, never pulls; the mean over the step
//
// u_c: command voltage, U: supply, the rest: AxisParameters. The motion inside a step is the cubic
// Hermite polynomial between its ends; what that costs: tests/harness/foreign_plant.
#pragma once

#include "core/realtime.h"
#include "emulator/foreign/foreign_plant.h"
#include "emulator/plant/axis_plant.h"

namespace towbench::emulator {

class ForeignAxis {
 public:
  // Mass and friction of the parameters move nothing; the mass is that of a contact's energy.
  ForeignAxis(const AxisParameters& parameters, const ForeignOutput& at_start) noexcept
      : parameters_(parameters), now_(at_start) {}

  // What the plant gets over the coming step.
  TOWBENCH_REALTIME [[nodiscard]] ForeignInput input_for(const AxisInput& input) noexcept;
  // What it said at the step's end; what its motor shaft did meanwhile.
  TOWBENCH_REALTIME void follow(const ForeignOutput& output, MotionSegments& segments) noexcept;

  [[nodiscard]] AxisState state() const noexcept;
  [[nodiscard]] const HardEndContact& contact() const noexcept { return contact_; }
  // A foreign plant does not tell its friction: 0.
  [[nodiscard]] AxisForces forces() const noexcept;

 private:
  [[nodiscard]] double end_force_N() const noexcept;
  void find_contact(const ForeignOutput& before) noexcept;

  AxisParameters parameters_;
  ForeignOutput now_;
  HardEndContact contact_;
  double terminal_V_ = 0;
  double external_force_N_ = 0;  // as given, without the ends
  double end_force_N_ = 0;
};

}  // namespace towbench::emulator
