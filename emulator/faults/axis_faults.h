// What may be broken in one axis between its connectors and its carriage, as a change of what
// reaches the plant: command, enable, and forces on the carriage. Nothing broken changes no bit.
//
// Forces are those of a spring and damper that take hold of the carriage, evaluated at the start of
// each tick; their rates (m omega^2 and 2 m omega of a 6 kg carriage at 60 Hz) are far inside what
// an explicit step of 100 us follows.
#pragma once

#include <limits>

#include "core/realtime.h"
#include "emulator/faults/scheduled_event.h"
#include "emulator/plant/axis_plant.h"

namespace towbench::emulator {

class AxisFaults {
 public:
  // `state` and `command_V` are those of now.
  TOWBENCH_REALTIME void set(ScheduledEventKind kind, double value, const AxisState& state,
                             double command_V) noexcept;

  // `acceleration_m_per_s2` of the carriage over the tick before.
  TOWBENCH_REALTIME void apply(const AxisState& state, double acceleration_m_per_s2,
                               AxisInput& input) const noexcept {
    if (broken_) {
      apply_command(input);
      input.carriage_force_N += carriage_force_N(state, acceleration_m_per_s2);
    }
  }

 private:
  TOWBENCH_REALTIME void apply_command(AxisInput& input) const noexcept;
  [[nodiscard]] double carriage_force_N(const AxisState& state,
                                        double acceleration_m_per_s2) const noexcept;

  bool broken_ = false;  // anything at all, once; never false again
  bool amplifier_off_ = false;
  bool shorted_ = false;
  bool command_held_ = false;
  double held_V_ = 0;
  double command_gain_ = 1;
  double command_limit_V_ = std::numeric_limits<double>::infinity();
  bool jammed_ = false;
  double jammed_at_m_ = 0;
  double drag_N_ = 0;
  double obstacle_side_ = 0;  // +1 towards max, -1 towards min, 0 none
  double obstacle_at_m_ = 0;
  double lost_mass_kg_ = 0;
};

}  // namespace towbench::emulator
